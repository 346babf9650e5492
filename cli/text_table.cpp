#include "cli/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace musim::cli {
namespace {

using Row = std::vector<std::string>;

std::string make_plain_row(const Row& row, const std::vector<std::size_t>& widths) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += fmt::format("{:<{}}  ", row[i], widths[i]);
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

}  // namespace

std::string to_plain_text(const TextTable& table) {
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < table.header.size(); ++i) {
        widths.push_back(table.header[i].size());
        for (const Row& row : table.rows) widths[i] = std::max(widths[i], row[i].size());
    }
    std::string text = make_plain_row(table.header, widths);
    for (const Row& row : table.rows) text += make_plain_row(row, widths);
    return text;
}

std::string to_markdown(const TextTable& table) {
    std::string text = make_markdown_row(table.header) + make_markdown_row(Row(table.header.size(), "---"));
    for (const Row& row : table.rows) text += make_markdown_row(row);
    return text;
}

std::string make_title(const std::string& text, ReportStyle style) {
    return style == ReportStyle::markdown ? "# " + text + "\n\n" : text + "\n";
}

std::string make_heading(const std::string& text, ReportStyle style) {
    return style == ReportStyle::markdown ? "\n## " + text + "\n\n" : "\n" + text + "\n";
}

std::string make_table(const TextTable& table, ReportStyle style) {
    return style == ReportStyle::markdown ? to_markdown(table) : to_plain_text(table);
}

}  // namespace musim::cli
