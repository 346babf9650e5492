#include "cli/named_values.hpp"

#include <algorithm>
#include <cstdlib>

#include "cli/output.hpp"

namespace musim::cli {
namespace {

/// Room that four digits take at most [characters].
constexpr int kLeastWidth = 9;

std::string to_cell(const NamedValue& value) {
    if (value.text) return *value.text;
    if (value.value.is_null()) return "-";
    if (value.value.is_string()) return value.value.get<std::string>();
    if (value.value.is_boolean()) return value.value.get<bool>() ? "yes" : "no";
    if (value.value.is_number_float()) return fmt::format(fmt::runtime("{:" + value.format + "}"), value.value.get<double>());
    return value.value.dump();
}

/// One line: columns a blank apart, two where cells on the left follow those on the right.
template <class Report>
void print_line(const std::string& first, const NamedValues& values, const Report& report) {
    std::string line = fmt::format("{:<10}", first);
    bool is_left = true;
    for (const NamedValue& value : values) {
        if (!value.title) continue;
        const bool was_left = is_left;
        const int width = value.width.value_or(std::max(kLeastWidth, static_cast<int>(value.title->size())));
        is_left = width < 0;
        line += !was_left && is_left ? "  " : " ";
        line += is_left ? fmt::format("{:<{}}", report(value), -width) : fmt::format("{:>{}}", report(value), width);
    }
    print("{}\n", line);
}

}  // namespace

std::string or_dash(const std::optional<double>& value, int digits) { return value ? fmt::format("{:.{}g}", *value, digits) : "-"; }

nlohmann::json text_or_null(const std::string& text) { return text.empty() ? nlohmann::json() : nlohmann::json(text); }

void add_to_json(nlohmann::json& object, const NamedValues& values) {
    for (const NamedValue& value : values) {
        if (!value.key.empty()) object[value.key] = value.value;
    }
}

nlohmann::json to_json(const NamedValues& values) {
    nlohmann::json object = nlohmann::json::object();
    add_to_json(object, values);
    return object;
}

nlohmann::json to_json(const std::vector<NamedValues>& rows) {
    nlohmann::json list = nlohmann::json::array();
    for (const NamedValues& row : rows) list.push_back(to_json(row));
    return list;
}

scaling::TextTable to_table(const std::vector<NamedValues>& rows) {
    scaling::TextTable table;
    for (const NamedValues& row : rows) {
        std::vector<std::string>& cells = table.rows.emplace_back();
        for (const NamedValue& value : row) {
            if (!value.title) continue;
            if (table.rows.size() == 1) table.header.push_back(*value.title);
            cells.push_back(to_cell(value));
        }
    }
    return table;
}

void print_titles(const std::string& first, const NamedValues& values) {
    print_line(first, values, [](const NamedValue& value) { return *value.title; });
}

void print_row(const std::string& first, const NamedValues& values) { print_line(first, values, to_cell); }

}  // namespace musim::cli
