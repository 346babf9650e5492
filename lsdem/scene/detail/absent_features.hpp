#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace musim::lsdem::detail {

/// Feature that musim has not, for a key by which people look for it: "mortar_strength" gives `musim has no mortar (joints are dry); see
/// Limits, docs/theory/limits.md`. Nothing for a key that means no such thing.
std::optional<std::string> describe_absent_feature(std::string_view key);

}  // namespace musim::lsdem::detail
