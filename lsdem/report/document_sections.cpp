#include "lsdem/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "lsdem/report/json_parts.hpp"

namespace musim::lsdem {
namespace {

using nlohmann::json;

bool is_plain(const json& value) {
    return value.is_primitive() ||
           (value.is_array() && std::all_of(value.begin(), value.end(), [](const json& one) { return one.is_primitive(); }));
}

HtmlCell make_cell(const std::string& key, const json& value) {
    if (value.is_null()) return {.text = "-"};
    if (value.is_number_integer()) return {.text = value.dump(), .is_number = true};
    if (value.is_number()) return number_cell(value.get<double>(), 6);
    if (value.is_boolean()) return {.text = value.get<bool>() ? "yes" : "no"};
    if (value.is_string()) {
        const auto text = value.get<std::string>();
        return {.text = text, .tone = key == "severity" ? find_tone(text, Tone::plain) : Tone::plain};
    }
    if (!value.is_array()) return {.text = value.dump()};
    std::string list;
    for (const json& one : value) list += (list.empty() ? "" : ", ") + make_cell(key, one).text;
    return {.text = list};
}

/// Keys that name a row, which come first.
constexpr std::array kFirst{"group", "name", "quantity", "law", "label", "component", "file"};

std::vector<std::string> list_plain_keys(const json& list) {
    std::vector<std::string> keys;
    const auto add = [&](const std::string& key) {
        if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    };
    for (const char* first : kFirst) {
        if (std::any_of(list.begin(), list.end(), [&](const json& one) { return one.contains(first) && is_plain(one[first]); })) add(first);
    }
    for (const json& object : list) {
        for (const auto& [key, value] : object.items()) {
            if (is_plain(value)) add(key);
        }
    }
    return keys;
}

/// Lists of objects: a row each, a column per key whose values are plain.
HtmlTable make_rows(const json& list, const std::string& caption) {
    HtmlTable table{.caption = caption, .heads = list_plain_keys(list)};
    for (const json& object : list) {
        std::vector<HtmlCell>& row = table.rows.emplace_back();
        for (const std::string& key : table.heads) {
            const json value = object.value(key, json());
            row.push_back(is_plain(value) ? make_cell(key, value) : HtmlCell{.text = "see below"});
        }
    }
    return table;
}

bool holds_objects(const json& value) {
    return value.is_array() && !value.empty() && std::all_of(value.begin(), value.end(), [](const json& one) { return one.is_object(); });
}

/// Contents of an object's or a list's members, each under a caption of its own.
std::string describe_inside(const json& object, const std::string& caption) {
    std::string html;
    for (const auto& [key, inner] : object.items()) {
        if (!is_plain(inner)) html += to_html(inner, fmt::format("{}, {}", caption, key));
    }
    return html;
}

}  // namespace

std::string to_html(const json& value, const std::string& caption) {
    if (holds_objects(value)) {
        std::string html = to_html(make_rows(value, caption));
        for (std::size_t i = 0; i < value.size(); ++i) {
            const std::string which = fmt::format("{}, row {}", caption, i + 1), inside = describe_inside(value[i], which);
            if (!inside.empty()) html += fmt::format("<details><summary>{}</summary>\n{}</details>\n", escape_html(which), inside);
        }
        return html;
    }
    if (!value.is_object()) return to_html(HtmlTable{.caption = caption, .heads = {"value"}, .rows = {{make_cell("", value)}}});
    HtmlTable table{.caption = caption, .heads = {"name", "value"}};
    for (const auto& [key, inner] : value.items()) {
        if (is_plain(inner)) table.rows.push_back({{.text = key}, make_cell(key, inner)});
    }
    return (table.rows.empty() ? "" : to_html(table)) + describe_inside(value, caption);
}

std::string make_document_verdict(const ReportedDocument& document) {
    const auto found = document.json.find("distortions");
    if (found == document.json.end() || !found->is_array()) return make_statement(Tone::note, document.label + ": read unchanged");
    if (!holds_objects(*found)) return make_statement(Tone::good, document.label + ": no group is distorted");
    Tone worst = Tone::plain;
    std::string names;
    for (const json& distortion : *found) {
        worst = std::max(worst, find_tone(find_text(distortion, "severity"), Tone::plain));
        names += (names.empty() ? "" : ", ") + find_text(distortion, "group");
    }
    return make_statement(worst, fmt::format("{}: {} {} distorted: {}", document.label, found->size(),
                                             found->size() == 1 ? "group is" : "groups are", names));
}

ReportSection make_document_section(const ReportedDocument& document, std::size_t number) {
    return {.id = fmt::format("document-{}", number), .title = document.label, .html = to_html(document.json, document.label)};
}

}  // namespace musim::lsdem
