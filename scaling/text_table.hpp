#pragma once

#include <string>
#include <vector>

namespace musim::scaling {

/// Cells of text under a header, every row as long as it.
struct TextTable {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows = {};
};

/// Use that a report is written for.
enum class ReportStyle { plain, markdown, latex };

/// Columns two blanks apart, each as wide as its widest cell; letters outside ASCII count as one.
std::string to_plain_text(const TextTable& table);

/// A table in Markdown; `|` in cells is escaped, formulas in dollars stay.
std::string to_markdown(const TextTable& table);

/// A longtable of LaTeX (packages longtable and array) between two rules, which may go over pages: columns with long texts share a part of
/// the line and break; in a table wider than a line all do. Cells are escaped.
std::string to_latex(const TextTable& table);

/// A table in one of these forms.
std::string make_table(const TextTable& table, ReportStyle style);

/// The title of a report, and of a section with an empty line before it.
std::string make_title(const std::string& text, ReportStyle style);
std::string make_heading(const std::string& text, ReportStyle style);

/// Lines of a report, one below the other; items of a list in Markdown and LaTeX. Empty for no lines.
std::string make_lines(const std::vector<std::string>& lines, ReportStyle style);

/// A paragraph of its own.
std::string make_paragraph(const std::string& text, ReportStyle style);

/// A text with the signs escaped that mean something to LaTeX.
std::string escape_latex(const std::string& text);

}  // namespace musim::scaling
