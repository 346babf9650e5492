#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// Parts of files that may be missing, null, or of another kind than is expected, in files that are damaged or of another version.
namespace musim::lsdem {

/// The value of a key; `fallback` where `object` has no such key, or a value of another kind than `fallback` at it.
inline nlohmann::json find_part(const nlohmann::json& object, const std::string& key, nlohmann::json fallback) {
    const auto found = object.find(key);
    if (found == object.end()) return fallback;
    const bool is_kind = fallback.is_number() ? found->is_number() : found->type() == fallback.type();
    return is_kind ? *found : fallback;
}

/// Empty when there is none.
inline nlohmann::json find_object(const nlohmann::json& object, const std::string& key) {
    return find_part(object, key, nlohmann::json::object());
}
inline nlohmann::json find_list(const nlohmann::json& object, const std::string& key) {
    return find_part(object, key, nlohmann::json::array());
}

/// Numbers of a list; NaN where an entry is none.
inline std::vector<double> to_numbers(const nlohmann::json& list) {
    std::vector<double> numbers;
    if (!list.is_array()) return numbers;
    for (const nlohmann::json& entry : list) {
        numbers.push_back(entry.is_number() ? entry.get<double>() : std::numeric_limits<double>::quiet_NaN());
    }
    return numbers;
}
inline std::vector<double> find_numbers(const nlohmann::json& object, const std::string& key) { return to_numbers(find_list(object, key)); }

inline double find_number(const nlohmann::json& object, const std::string& key,
                          double fallback = std::numeric_limits<double>::quiet_NaN()) {
    return find_part(object, key, fallback).get<double>();
}

inline std::string find_text(const nlohmann::json& object, const std::string& key, const std::string& fallback = "") {
    return find_part(object, key, fallback).get<std::string>();
}

/// False when it is not said.
inline bool find_flag(const nlohmann::json& object, const std::string& key) { return find_part(object, key, false).get<bool>(); }

}  // namespace musim::lsdem
