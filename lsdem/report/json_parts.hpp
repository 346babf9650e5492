#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// Parts of files that may be missing, null, or of another kind than is expected, in files that are damaged or of another version.
namespace musim::lsdem::report {

/// The value of a key, when `object` is an object that has it.
inline const nlohmann::json* find_part(const nlohmann::json& object, const std::string& key) {
    const auto found = object.find(key);
    return object.is_object() && found != object.end() ? &*found : nullptr;
}

/// An empty object when there is none.
inline nlohmann::json find_object(const nlohmann::json& object, const std::string& key) {
    const nlohmann::json* part = find_part(object, key);
    return part != nullptr && part->is_object() ? *part : nlohmann::json::object();
}

/// An empty list when there is none.
inline nlohmann::json find_list(const nlohmann::json& object, const std::string& key) {
    const nlohmann::json* part = find_part(object, key);
    return part != nullptr && part->is_array() ? *part : nlohmann::json::array();
}

/// Of a list; not a number where an entry is none.
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
    const nlohmann::json* part = find_part(object, key);
    return part != nullptr && part->is_number() ? part->get<double>() : fallback;
}

inline std::string find_text(const nlohmann::json& object, const std::string& key, const std::string& fallback = "") {
    const nlohmann::json* part = find_part(object, key);
    return part != nullptr && part->is_string() ? part->get<std::string>() : fallback;
}

/// False when it is not said.
inline bool find_flag(const nlohmann::json& object, const std::string& key) {
    const nlohmann::json* part = find_part(object, key);
    return part != nullptr && part->is_boolean() && part->get<bool>();
}

}  // namespace musim::lsdem::report
