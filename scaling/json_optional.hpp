#pragma once

#include <nlohmann/json.hpp>
#include <optional>

namespace musim::scaling {

/// A value in JSON, or null for none.
template <class Value>
nlohmann::json or_null(const std::optional<Value>& value) {
    return value ? nlohmann::json(*value) : nlohmann::json();
}

}  // namespace musim::scaling
