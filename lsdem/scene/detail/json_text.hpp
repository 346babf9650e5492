#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace musim::lsdem::scene::detail {

/// Whole content of a text file. Throws SceneError when it cannot be read.
std::string read_text(const std::filesystem::path& path);

/// JSON value of `text`. Throws SceneError with line and column (`origin:3:14: ...`) on a syntax error or a key given twice.
nlohmann::json parse_json(std::string_view text, const std::string& origin);

/// "a, b, c", for lists of names in messages.
std::string join(const std::vector<std::string>& names);

}  // namespace musim::lsdem::scene::detail
