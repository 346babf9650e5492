#pragma once

#include <string>
#include <vector>

namespace musim::cli {

/// Cells of text under a header, every row as long as it.
struct TextTable {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows = {};
};

/// Columns two blanks apart, each as wide as its widest cell.
std::string to_plain_text(const TextTable& table);

/// A table in Markdown; `|` in cells is escaped.
std::string to_markdown(const TextTable& table);

/// What a report of several tables is written for.
enum class ReportStyle { plain, markdown };

/// The title of a report, and of a section with an empty line before it.
std::string make_title(const std::string& text, ReportStyle style);
std::string make_heading(const std::string& text, ReportStyle style);

std::string make_table(const TextTable& table, ReportStyle style);

}  // namespace musim::cli
