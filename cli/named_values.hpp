#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace musim::cli {

/// A number of a result that may be missing, with its names.
struct NamedValue {
    std::string key;    ///< in JSON, with the unit: "cav_m_s"
    std::string title;  ///< over its column: "CAV [m/s]"
    std::optional<double> value;
};

/// A number with so many significant digits, or "-" for none.
std::string or_dash(const std::optional<double>& value, int digits);

/// A number, or null for none.
nlohmann::json or_null(const std::optional<double>& value);

/// A text, or null for an empty one.
nlohmann::json text_or_null(const std::string& text);

/// Adds key and number (or null) of every value to a JSON object.
void add_to_json(nlohmann::json& object, const std::vector<NamedValue>& values);

/// The titles of a table on stdout, one column per value after a first one, and one of its rows.
void print_titles(const std::string& first, const std::vector<NamedValue>& values);
void print_row(const std::string& first, const std::vector<NamedValue>& values);

}  // namespace musim::cli
