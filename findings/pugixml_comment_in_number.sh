#!/usr/bin/env bash
# pugixml 1.13: the value of an element whose text is interrupted by a comment, such as a sensitivity in a StationXML edited by hand.
# Guess: comments are left out when XML is parsed (they are by default), so the text of the element is what stands around them.
# Behaviour: the comment goes, the text stays in two pieces, and child_value() and text() give the first alone: 2<!-- 2012 -->11261.5 is
# 2, a number without any sign of an error. Python's ElementTree gives 211261.5.
set -euo pipefail
source "$(dirname "$(realpath "$0")")/support/debian.sh"
unpack libpugixml-dev=1.13-0.2 libpugixml1v5=1.13-0.2

cat > value.cpp <<'CODE'
#include <cstdio>
#include <pugixml.hpp>

int main() {
    pugi::xml_document document;
    if (!document.load_file("a.xml")) return 1;
    std::printf("%g", document.child("InstrumentSensitivity").child("Value").text().as_double());
}
CODE
echo '<InstrumentSensitivity><Value>2<!-- 2012 -->11261.5</Value></InstrumentSensitivity>' > a.xml
g++ -std=c++17 -isystem "$root/usr/include" value.cpp -L "$lib" -lpugixml -o value
expect "pugixml" "$(./value)" 2
expect "ElementTree" "$(python3 -c 'import xml.etree.ElementTree as tree; print(tree.parse("a.xml").findtext("Value"))')" 211261.5
