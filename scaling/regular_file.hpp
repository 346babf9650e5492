#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

/// Every file that musim reads is opened here, or asked about here first.
namespace musim::scaling {

/// Why a path cannot be read as a file: "no such file", "a folder", "a pipe, device or socket, not a file", the system's reason; empty for
/// a regular file, whatever its permissions.
std::string find_obstacle(const std::filesystem::path& path);

/// Opens a regular file for reading its bytes. The stream has failed when the file cannot be opened, and at once for what is none: opening
/// a pipe would wait for whoever writes to it, a device may never end.
std::ifstream open_regular_file(const std::filesystem::path& path);

/// The bytes of a regular file; none where it cannot be opened, with the reason in errno, or not read to its end.
std::optional<std::string> read_regular_file(const std::filesystem::path& path);

}  // namespace musim::scaling
