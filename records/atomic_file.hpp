#pragma once

#include <filesystem>
#include <string_view>

#include "records/error.hpp"

namespace musim::records {

/// Writes a whole file or nothing: the bytes go to a temporary file in the same folder, reach the disk, and take the name `path` in one
/// step. A reader sees the old file or the new one; when writing fails (disk full, no permission) the old one stays and the temporary file
/// goes. A symbolic link is followed; a device or pipe is written to directly. Throws WriteError.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace musim::records
