#include "scaling/text_table.hpp"

#include <doctest/doctest.h>

namespace musim::scaling::tests {

namespace {

const TextTable kTable{{"group", "delta"}, {{"a|b", "50 %"}, {"μ_s", "1"}}};

}  // namespace

TEST_CASE("columns of a table are as wide as their widest cell in letters") {
    CHECK(to_plain_text(kTable) == "group  delta\na|b    50 %\nμ_s    1\n");
}

TEST_CASE("a table in Markdown escapes what would end a cell") {
    CHECK(to_markdown(kTable) == "| group | delta |\n| --- | --- |\n| a\\|b | 50 % |\n| μ_s | 1 |\n");
}

TEST_CASE("a table in LaTeX escapes signs and lets long columns break") {
    CHECK(to_latex(kTable) ==
          "\\begin{longtable}{ll}\n\\hline\n  group & delta \\\\\n\\hline\n\\endhead\n  a$|$b & 50 \\% \\\\\n  μ\\_s & 1 \\\\\n\\hline\n"
          "\\end{longtable}\n");
    CHECK(escape_latex("#$%&_{}\\^~<>") == "\\#\\$\\%\\&\\_\\{\\}\\textbackslash{}\\textasciicircum{}\\textasciitilde{}$<$$>$");
    const std::string words(60, 'w');
    // both long columns share 0.6 of the line by their letters
    const std::string text = to_latex({{"a", "b", "c"}, {{words, "x", std::string(30, 'v')}}});
    CHECK(text.find("{p{0.40\\linewidth}lp{0.20\\linewidth}}") != std::string::npos);

    // twelve columns of "ab cd efgh": 4 letters of the longest word and a third of the other 6 each, as much for all
    const std::vector<std::string> row(12, "ab cd efgh");
    const std::string wide = to_latex({row, {row}});
    CHECK(wide.find("p{\\dimexpr0.083\\linewidth-2\\tabcolsep\\relax}") != std::string::npos);
    CHECK(to_latex({std::vector<std::string>(10, "ab cd efgh")}).find("{llllllllll}") != std::string::npos);
}

TEST_CASE("a report has titles and lines in every style") {
    CHECK(make_title("50 %", ReportStyle::plain) == "50 %\n");
    CHECK(make_title("50 %", ReportStyle::markdown) == "# 50 %\n\n");
    CHECK(make_title("50 %", ReportStyle::latex) == "\\section*{50 \\%}\n");
    CHECK(make_heading("a_b", ReportStyle::latex) == "\n\\subsection*{a\\_b}\n");
    CHECK(make_lines({"x", "y"}, ReportStyle::plain) == "x\ny\n");
    CHECK(make_lines({"x", "y"}, ReportStyle::markdown) == "- x\n- y\n");
    CHECK(make_lines({"x", "y_2"}, ReportStyle::latex) == "\\begin{itemize}\n  \\item x\n  \\item y\\_2\n\\end{itemize}\n");
    CHECK(make_lines({}, ReportStyle::latex).empty());
    for (const ReportStyle style : {ReportStyle::plain, ReportStyle::markdown, ReportStyle::latex}) {
        CHECK_FALSE(make_table(kTable, style).empty());
    }
    CHECK(make_table(kTable, ReportStyle::latex) == to_latex(kTable));
}

}  // namespace musim::scaling::tests
