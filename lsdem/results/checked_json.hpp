#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace musim::lsdem {

/// Text of an object for a file that is read back: indented, with the key "checksum", the 64-bit FNV-1a hash of what the rest says. White
/// space and the spelling of numbers do not count.
std::string make_checked_json(nlohmann::json object);

/// Does an object say what it was written with? False for one without "checksum".
bool agrees_with_checksum(const nlohmann::json& object);

/// Reads what make_checked_json() has written. Throws ResultError for a file that is missing, cut, changed, or has no checksum.
nlohmann::json read_checked_json(const std::filesystem::path& file);

}  // namespace musim::lsdem
