#include "lsdem/report/html.hpp"

#include <doctest/doctest.h>

#include <limits>

using namespace musim::lsdem;

TEST_CASE("text from outside cannot become markup") {
    CHECK(escape_html("<b a=\"1\" c='2'>&amp;</b>") == "&lt;b a=&quot;1&quot; c=&#39;2&#39;&gt;&amp;amp;&lt;/b&gt;");
    const std::string table =
        to_html({.caption = "<i>", .heads = {"a<b"}, .rows = {{{.text = "<script>"}, {.text = "\"", .tone = Tone::bad}}}});
    CHECK(table.find("<i>") == std::string::npos);
    CHECK(table.find("<script>") == std::string::npos);
    CHECK(table.find("<th scope=\"col\">a&lt;b</th>") != std::string::npos);
    CHECK(table.find("<th scope=\"row\">&lt;script&gt;</th><td class=\"bad\">&quot;</td>") != std::string::npos);
    CHECK(make_statement(Tone::warning, "1 < 2").find("<strong>warning</strong> 1 &lt; 2") != std::string::npos);
}

TEST_CASE("numbers stand on the right with the digits asked for, and what is none is a dash") {
    CHECK(number_cell(1.23456, 3).text == "1.23");
    CHECK(number_cell(1.0).is_number);
    CHECK(number_cell(std::numeric_limits<double>::quiet_NaN()).text == "-");
    const std::string table = to_html({.caption = "", .heads = {"a", "b"}, .rows = {{{.text = "x"}, number_cell(2.5)}}});
    CHECK(table.find("<td class=\"number\">2.5</td>") != std::string::npos);
}
