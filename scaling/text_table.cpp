#include "scaling/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <sstream>
#include <string_view>

namespace musim::scaling {

namespace {

using Row = std::vector<std::string>;

/// Cells with more letters than this break into lines in LaTeX: five such columns still fit a page.
constexpr std::size_t kLongCell = 28;

/// Share of the line's width that long columns have together in LaTeX [-]; short ones have the rest.
constexpr double kShareOfLong = 0.6;

/// Letters that a line of LaTeX has room for, across a page on its side in small print: in wider tables every column breaks.
constexpr std::size_t kLatexLine = 130;

/// Share of what goes beyond its longest word that counts for the width of a column which breaks: lines are about three of it [-].
constexpr double kBroken = 1.0 / 3.0;

/// Letters between two columns.
constexpr std::size_t kBetween = 2;

/// Letters of a text in UTF-8: all bytes but those that continue one.
std::size_t count_letters(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// Widths of the widest cell in each column [letters].
std::vector<std::size_t> find_widths(const TextTable& table) {
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < table.header.size(); ++i) {
        widths.push_back(count_letters(table.header[i]));
        for (const Row& row : table.rows) widths[i] = std::max(widths[i], count_letters(row[i]));
    }
    return widths;
}

std::string make_plain_row(const Row& row, const std::vector<std::size_t>& widths) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += row[i] + std::string(widths[i] - count_letters(row[i]) + kBetween, ' ');
    line.erase(line.find_last_not_of(' ') + 1);
    return line + "\n";
}

std::string make_markdown_row(const Row& row) {
    std::string line = "|";
    for (const std::string& cell : row) {
        line += ' ';
        for (const char c : cell) line += c == '|' ? std::string("\\|") : std::string(1, c);
        line += " |";
    }
    return line + "\n";
}

std::string make_latex_row(const Row& row) {
    std::string line;
    for (const std::string& cell : row) line += (line.empty() ? "  " : " & ") + escape_latex(cell);
    return line + " \\\\\n";
}

std::size_t find_longest_word(const std::string& text) {
    std::size_t longest = 0;
    std::istringstream words(text);
    for (std::string word; words >> word;) longest = std::max(longest, count_letters(word));
    return longest;
}

/// "lp{0.3\linewidth}l".
std::string make_latex_columns(const std::vector<std::size_t>& widths) {
    std::size_t letters = 0;
    for (const std::size_t width : widths) letters += width > kLongCell ? width : 0;
    std::string columns;
    for (const std::size_t width : widths) {
        const double share = kShareOfLong * static_cast<double>(width) / static_cast<double>(std::max<std::size_t>(letters, 1));
        columns += width > kLongCell ? fmt::format("p{{{:.2f}\\linewidth}}", share) : "l";
    }
    return columns;
}

/// All columns share the line, by their longest words first.
std::string make_broken_latex_columns(const TextTable& table, const std::vector<std::size_t>& widths) {
    std::vector<double> weights;
    for (std::size_t i = 0; i < widths.size(); ++i) {
        std::size_t word = find_longest_word(table.header[i]);
        for (const Row& row : table.rows) word = std::max(word, find_longest_word(row[i]));
        weights.push_back(static_cast<double>(word + kBetween) + kBroken * static_cast<double>(widths[i] - word));
    }
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::string columns;
    for (const double weight : weights) {
        columns += fmt::format(">{{\\raggedright\\arraybackslash}}p{{\\dimexpr{:.3f}\\linewidth-2\\tabcolsep\\relax}}", weight / total);
    }
    return columns;
}

bool is_too_wide(const std::vector<std::size_t>& widths) {
    const auto add = [](std::size_t sum, std::size_t width) { return sum + std::min(width, kLongCell) + kBetween; };
    return std::accumulate(widths.begin(), widths.end(), std::size_t{0}, add) > kLatexLine;
}

}  // namespace

std::string to_plain_text(const TextTable& table) {
    const std::vector<std::size_t> widths = find_widths(table);
    std::string text = make_plain_row(table.header, widths);
    for (const Row& row : table.rows) text += make_plain_row(row, widths);
    return text;
}

std::string to_markdown(const TextTable& table) {
    std::string text = make_markdown_row(table.header) + make_markdown_row(Row(table.header.size(), "---"));
    for (const Row& row : table.rows) text += make_markdown_row(row);
    return text;
}

std::string to_latex(const TextTable& table) {
    const std::vector<std::size_t> widths = find_widths(table);
    const std::string columns = is_too_wide(widths) ? make_broken_latex_columns(table, widths) : make_latex_columns(widths);
    std::string text = fmt::format("\\begin{{longtable}}{{{}}}\n\\hline\n", columns);
    text += make_latex_row(table.header) + "\\hline\n\\endhead\n";
    for (const Row& row : table.rows) text += make_latex_row(row);
    return text + "\\hline\n\\end{longtable}\n";
}

std::string make_table(const TextTable& table, ReportStyle style) {
    if (style == ReportStyle::markdown) return to_markdown(table);
    return style == ReportStyle::latex ? to_latex(table) : to_plain_text(table);
}

std::string make_title(const std::string& text, ReportStyle style) {
    if (style == ReportStyle::markdown) return "# " + text + "\n\n";
    return style == ReportStyle::latex ? fmt::format("\\section*{{{}}}\n", escape_latex(text)) : text + "\n";
}

std::string make_heading(const std::string& text, ReportStyle style) {
    if (style == ReportStyle::markdown) return "\n## " + text + "\n\n";
    return style == ReportStyle::latex ? fmt::format("\n\\subsection*{{{}}}\n", escape_latex(text)) : "\n" + text + "\n";
}

std::string make_lines(const std::vector<std::string>& lines, ReportStyle style) {
    if (lines.empty()) return "";
    const bool is_latex = style == ReportStyle::latex;
    std::string text = is_latex ? "\\begin{itemize}\n" : "";
    for (const std::string& line : lines) {
        text += is_latex ? "  \\item " + escape_latex(line) : (style == ReportStyle::markdown ? "- " : "") + line;
        text += '\n';
    }
    return is_latex ? text + "\\end{itemize}\n" : text;
}

std::string make_paragraph(const std::string& text, ReportStyle style) {
    return (style == ReportStyle::latex ? escape_latex(text) : text) + "\n";
}

std::string escape_latex(const std::string& text) {
    static const std::map<char, std::string_view> kSigns{
        {'\\', "\\textbackslash{}"}, {'^', "\\textasciicircum{}"}, {'~', "\\textasciitilde{}"}, {'<', "$<$"}, {'>', "$>$"}, {'|', "$|$"}};
    std::string escaped;
    for (const char c : text) {
        const auto sign = kSigns.find(c);
        if (sign != kSigns.end()) {
            escaped += sign->second;
            continue;
        }
        if (std::string_view("#$%&_{}").find(c) != std::string_view::npos) escaped += '\\';
        escaped += c;
    }
    return escaped;
}

}  // namespace musim::scaling
