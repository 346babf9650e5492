#include "cli/named_values.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/output.hpp"

namespace musim::cli {
namespace {

/// Characters of a column: what four digits take at most.
std::size_t find_width(const NamedValue& column) { return std::max<std::size_t>(9, column.title.size()); }

}  // namespace

std::string or_dash(const std::optional<double>& value, int digits) { return value ? fmt::format("{:.{}g}", *value, digits) : "-"; }

nlohmann::json or_null(const std::optional<double>& value) { return value ? nlohmann::json(*value) : nlohmann::json(); }

nlohmann::json text_or_null(const std::string& text) { return text.empty() ? nlohmann::json() : nlohmann::json(text); }

void add_to_json(nlohmann::json& object, const std::vector<NamedValue>& values) {
    for (const NamedValue& value : values) object[value.key] = or_null(value.value);
}

void print_titles(const std::string& first, const std::vector<NamedValue>& values) {
    print("{:<10}", first);
    for (const NamedValue& column : values) print(" {:>{}}", column.title, find_width(column));
    print("\n");
}

void print_row(const std::string& first, const std::vector<NamedValue>& values) {
    print("{:<10}", first);
    for (const NamedValue& column : values) print(" {:>{}}", or_dash(column.value, 4), find_width(column));
    print("\n");
}

}  // namespace musim::cli
