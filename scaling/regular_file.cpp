#include "scaling/regular_file.hpp"

#include <sstream>
#include <system_error>
#include <utility>

namespace musim::scaling {

std::string find_obstacle(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (std::filesystem::is_regular_file(status)) return {};
    if (status.type() == std::filesystem::file_type::not_found) return "no such file";
    if (std::filesystem::is_directory(status)) return "a folder";
    return std::filesystem::exists(status) && !error ? "a pipe, device or socket, not a file" : error.message();
}

std::ifstream open_regular_file(const std::filesystem::path& path) {
    std::ifstream stream;
    if (find_obstacle(path).empty()) {
        stream.open(path, std::ios::binary);
    } else {
        stream.setstate(std::ios::failbit);
    }
    return stream;
}

std::optional<std::string> read_regular_file(const std::filesystem::path& path) {
    std::ifstream stream = open_regular_file(path);
    if (!stream) return std::nullopt;
    std::ostringstream bytes;
    if (stream.peek() != std::ifstream::traits_type::eof()) bytes << stream.rdbuf();
    if (stream.bad() || bytes.fail()) return std::nullopt;
    return std::move(bytes).str();
}

}  // namespace musim::scaling
