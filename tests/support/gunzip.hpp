#pragma once

#include <zlib.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace musim::tests {

/// The bytes that a gzip file packs.
inline std::string gunzip(const std::filesystem::path& path) {
    const gzFile file = gzopen(path.c_str(), "rb");
    if (file == nullptr) throw std::runtime_error("cannot be opened: " + path.string());
    std::string bytes;
    char piece[65536];
    int count = 0;
    while ((count = gzread(file, piece, sizeof piece)) > 0) bytes.append(piece, static_cast<std::size_t>(count));
    gzclose(file);
    if (count < 0) throw std::runtime_error("is no whole gzip file: " + path.string());
    return bytes;
}

}  // namespace musim::tests
