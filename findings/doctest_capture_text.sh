#!/usr/bin/env bash
# doctest 2.4.9: a text in the log of a failed check.
# Guess: CAPTURE(name) and a failed CHECK(name == ...) write the text of a `const char* name`.
# Behaviour: they write its address (DOCTEST_CONFIG_TREAT_CHAR_STAR_AS_STRING is off by default), so the log of a check in a loop over
# names does not say which one failed; of a std::string it does.
set -euo pipefail
source "$(dirname "$(realpath "$0")")/support/debian.sh"
unpack doctest-dev=2.4.9~ds-1

cat > log.cpp <<'CODE'
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>
#include <string>

TEST_CASE("pointer") {
    for (const char* name : {"first"}) {
        CAPTURE(name);
        CHECK(name == std::string("second"));
    }
}
TEST_CASE("string") {
    for (const std::string name : {"first"}) {
        CAPTURE(name);
        CHECK(name == "second");
    }
}
CODE
g++ -std=c++17 -isystem "$root/usr/include" log.cpp -o log
seen() { { ./log -tc="$1" || true; } | sed -n "s/^ *$2\(.*\)/\1/p"; }
address() { sed 's/0x[0-9a-f]*/ADDRESS/'; }
expect "CHECK of a pointer" "$(seen pointer 'values: ' | address)" 'CHECK( ADDRESS == second )'
expect "CAPTURE of a pointer" "$(seen pointer 'logged: name := ' | address)" ADDRESS
expect "CAPTURE of a std::string" "$(seen string 'logged: name := ')" first
