#include "lsdem/report/html.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "lsdem/plot/svg.hpp"

namespace musim::lsdem {
namespace {

std::string write_cell(const HtmlCell& cell, const char* tag, const char* attributes) {
    std::string classes = cell.is_number ? "number" : "";
    if (cell.tone != Tone::plain) {
        if (!classes.empty()) classes += ' ';
        classes += to_string(cell.tone);
    }
    return fmt::format("<{0}{1}{2}>{3}</{0}>", tag, attributes, classes.empty() ? "" : fmt::format(" class=\"{}\"", classes),
                       escape_html(cell.text));
}

}  // namespace

std::string escape_html(const std::string& text) { return detail::escape_markup(text, "&<>\"'"); }

std::string to_string(Tone tone) {
    constexpr std::array kNames{"", "good", "note", "warning", "bad"};
    return kNames.at(static_cast<std::size_t>(tone));
}

Tone find_tone(const std::string& word, Tone otherwise) {
    static const std::map<std::string, Tone> kTones{
        {"completed", Tone::good}, {"collapsed", Tone::warning}, {"note", Tone::note}, {"warning", Tone::warning}, {"error", Tone::bad}};
    const auto found = kTones.find(word);
    return found == kTones.end() ? otherwise : found->second;
}

HtmlCell number_cell(double value, int digits) {
    return {.text = std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "-", .is_number = true};
}

std::string to_html(const HtmlTable& table) {
    std::string html = "<div class=\"scroll\" tabindex=\"0\"><table>\n<caption>" + escape_html(table.caption) + "</caption>\n<thead><tr>";
    for (const std::string& head : table.heads) html += "<th scope=\"col\">" + escape_html(head) + "</th>";
    html += "</tr></thead>\n<tbody>\n";
    for (const std::vector<HtmlCell>& row : table.rows) {
        html += "<tr>";
        for (std::size_t i = 0; i < row.size(); ++i) {
            html += i == 0 ? write_cell(row[i], "th", " scope=\"row\"") : write_cell(row[i], "td", "");
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

std::string make_statement(Tone tone, const std::string& text, bool is_headline) {
    if (tone == Tone::plain && !is_headline) return "<p>" + escape_html(text) + "</p>\n";
    return fmt::format("<p class=\"{0}statement {1}\"><strong>{1}</strong> {2}</p>\n", is_headline ? "headline " : "", to_string(tone),
                       escape_html(text));
}

}  // namespace musim::lsdem
