#pragma once

#include <string>
#include <vector>

/// Reports of runs as HTML pages that stand alone.
namespace musim::lsdem {

/// Text with the characters that HTML reserves replaced, also for attributes.
std::string escape_html(const std::string& text);

/// Tone of a statement, shown by colour and by a word.
enum class Tone { plain, good, note, warning, bad };

/// "good", "note", "warning", "bad"; empty for plain. Also the class of the style sheet.
std::string to_string(Tone tone);

/// Tone of the severity of a distortion or of a run's end, in words; `otherwise` for other words.
Tone find_tone(const std::string& word, Tone otherwise);

/// A sentence of a verdict and how good the news is.
struct Statement {
    Tone tone = Tone::plain;
    std::string text;
};

/// A cell of a table: numbers stand on the right.
struct HtmlCell {
    std::string text;
    bool is_number = false;
    Tone tone = Tone::plain;
};

/// A number with so many significant digits; "-" when it is not finite.
HtmlCell number_cell(double value, int digits = 4);

struct HtmlTable {
    std::string caption;
    std::vector<std::string> heads;
    std::vector<std::vector<HtmlCell>> rows = {};
};

/// A table with its caption, heads as column headers and the first cell of each row as its header, in a box that scrolls where it is too
/// wide.
std::string to_html(const HtmlTable& table);

/// A paragraph of a tone, its word before the text; a headline, the main result, is larger.
std::string make_statement(Tone tone, const std::string& text, bool is_headline = false);

}  // namespace musim::lsdem
