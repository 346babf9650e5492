#include "lsdem/results/checksum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "lsdem/results/result_error.hpp"

namespace musim::lsdem::detail {
namespace {

constexpr std::string_view kLineStart = "musim-checksum ";
constexpr std::size_t kHashSize = 16;
constexpr std::size_t kLineSize = kLineStart.size() + kHashSize + 1;

/// Bytes read at once.
constexpr std::size_t kReadSize = std::size_t{1} << 20U;

std::string make_line(const std::string& hash) { return fmt::format("{}{}\n", kLineStart, hash); }

[[noreturn]] void refuse(const std::filesystem::path& file, const char* what) {
    throw ResultError(fmt::format("{}: {}; remove it and make it again with the command that made it", file.string(), what));
}

}  // namespace

void ContentHash::add(std::string_view piece) {
    for (const char c : piece) hash_ = (hash_ ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
}

std::string ContentHash::name() const { return fmt::format("{:016x}", hash_); }

std::string name_content(std::string_view content) {
    ContentHash hash;
    hash.add(content);
    return hash.name();
}

void append_checksum(std::vector<char>& bytes) {
    const std::string line = make_line(name_content({bytes.data(), bytes.size()}));
    bytes.insert(bytes.end(), line.begin(), line.end());
}

std::string find_checksum(std::string_view bytes) { return std::string(bytes.substr(bytes.size() - kHashSize - 1, kHashSize)); }

std::string require_checksum(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    const std::streamoff size = in.tellg();
    if (!in || size < static_cast<std::streamoff>(kLineSize)) refuse(file, "is no file of musim, or cut off");
    in.seekg(0);
    ContentHash hash;
    std::string piece;
    for (auto left = static_cast<std::size_t>(size) - kLineSize; in && left > 0; left -= piece.size()) {
        piece.resize(std::min(left, kReadSize));
        in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        hash.add(piece);
    }
    std::string line(kLineSize, '\0');
    in.read(line.data(), static_cast<std::streamsize>(line.size()));
    if (!in) refuse(file, "cannot be read to its end");
    if (!line.starts_with(kLineStart)) refuse(file, "has no checksum at its end (it is damaged, or an older musim wrote it)");
    if (line != make_line(hash.name())) refuse(file, "is damaged (its checksum does not match)");
    return hash.name();
}

}  // namespace musim::lsdem::detail
