#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scaling/json_optional.hpp"
#include "scaling/text_table.hpp"

namespace musim::cli {

using scaling::or_null;

/// A value of a result with its names: JSON and tables are written from the same values.
struct NamedValue {
    std::string key;                       ///< in JSON, with the unit: "cav_m_s"; empty: in tables alone
    std::optional<std::string> title;      ///< over its column: "CAV [m/s]"; none: in JSON alone
    nlohmann::json value;                  ///< null: "-" in tables
    std::string format = ".4g";            ///< in tables, of a number that is not whole
    std::optional<int> width = {};         ///< of its column on stdout, below zero with cells on the left; else as wide as needed
    std::optional<std::string> text = {};  ///< in tables, where that is not the value itself
};

/// A value that tables have in words.
inline NamedValue in_words(std::string key, std::string title, nlohmann::json value, std::string text, std::optional<int> width = {}) {
    return {std::move(key), std::move(title), std::move(value), "", width, std::move(text)};
}

/// Values of one line of a table.
using NamedValues = std::vector<NamedValue>;

/// A quantity in SI units, where there is one.
template <class Quantity>
std::optional<double> in_si(const std::optional<Quantity>& quantity) {
    return quantity ? std::optional(quantity->value()) : std::nullopt;
}

/// Name of a value, or null for none.
template <class Named>
nlohmann::json name_or_null(const std::optional<Named>& named) {
    return named ? nlohmann::json(to_string(*named)) : nlohmann::json();
}

/// A number with so many significant digits, or "-" for none.
std::string or_dash(const std::optional<double>& value, int digits);

/// A text, or null for an empty one.
nlohmann::json text_or_null(const std::string& text);

/// Adds key and value of all that have a key to a JSON object.
void add_to_json(nlohmann::json& object, const NamedValues& values);

/// A JSON object of them; a list of objects.
nlohmann::json to_json(const NamedValues& values);
nlohmann::json to_json(const std::vector<NamedValues>& rows);

/// The table of those that have a title, which are the same in each row; there is at least one.
scaling::TextTable to_table(const std::vector<NamedValues>& rows);

/// The titles of a table on stdout, one column per value after a first one, and one of its rows.
void print_titles(const std::string& first, const NamedValues& values);
void print_row(const std::string& first, const NamedValues& values);

}  // namespace musim::cli
