#include "records/headers/text_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <optional>
#include <system_error>

#include "records/detail/text.hpp"
#include "scaling/regular_file.hpp"

namespace musim::records::detail {
namespace {

[[noreturn]] void fail_file(const std::filesystem::path& path, std::string_view what_why, const Remedy& what_to_do) {
    throw ReadError(fmt::format("{}: {}", path.string(), what_why), what_to_do);
}

}  // namespace

std::string read_bytes(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) fail_file(path, "no such file (or no access to its folder)", "check the path");
    if (std::filesystem::is_directory(status)) fail_file(path, "is a folder (a record file is needed)", "name a file in it");
    if (!std::filesystem::is_regular_file(status)) fail_file(path, "is not a regular file (device or pipe)", "copy it to a file first");

    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (!error && size > kLargestFileBytes) {
        fail_file(path,
                  fmt::format("file has {:.3g} GB (more than {:.3g} GB is no record)", 1e-9 * static_cast<double>(size),
                              1e-9 * static_cast<double>(kLargestFileBytes)),
                  "cut it into shorter records");
    }
    errno = 0;
    std::optional<std::string> bytes = scaling::read_regular_file(path);
    if (!bytes) {
        const std::string why = errno == 0 ? "input error" : std::generic_category().message(errno);
        fail_file(path, fmt::format("cannot be opened, or not read to its end ({})", why), "check its permissions and the disk");
    }
    if (bytes->empty()) fail_file(path, "file is empty (no header, no samples)", "fetch the record again");
    return *std::move(bytes);
}

std::string decode_utf16(std::string bytes) {
    const bool is_little = bytes.starts_with("\xFF\xFE");
    if (!is_little && !bytes.starts_with("\xFE\xFF")) return bytes;
    const auto unit_at = [&](std::size_t at) {
        const auto low = static_cast<unsigned char>(bytes[at + (is_little ? 0 : 1)]),
                   high = static_cast<unsigned char>(bytes[at + (is_little ? 1 : 0)]);
        return static_cast<unsigned>(high << 8U) | low;
    };
    std::string text;
    text.reserve(bytes.size() / 2);
    for (std::size_t at = 2; at + 1 < bytes.size(); at += 2) {
        const unsigned letter = unit_at(at);
        if (letter < 0x80) {
            text += static_cast<char>(letter);
        } else if (letter < 0x800) {
            text += {static_cast<char>(0xC0U | (letter >> 6U)), static_cast<char>(0x80U | (letter & 0x3FU))};
        } else if (letter < 0xD800 || letter > 0xDFFF) {
            text += {static_cast<char>(0xE0U | (letter >> 12U)), static_cast<char>(0x80U | ((letter >> 6U) & 0x3FU)),
                     static_cast<char>(0x80U | (letter & 0x3FU))};
        } else {
            text += '?';  // halves of letters that no record needs
        }
    }
    return text;
}

TextFile::TextFile(std::filesystem::path path, std::string bytes) : InputFile(std::move(path)), bytes_(std::move(bytes)) {
    std::string_view rest = bytes_;
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
    rest = rest.substr(0, rest.find_last_not_of('\x1A') + 1);
    const char line_end = rest.find('\n') == std::string_view::npos ? '\r' : '\n';
    while (!rest.empty()) {
        std::string_view line = rest.substr(0, rest.find(line_end));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
        lines_.push_back(line);
    }
}

std::string TextFile::place_of(std::size_t index) const { return fmt::format("{}:{}", path().string(), index + 1); }

void TextFile::skip(std::size_t count) {
    if (count >= lines_.size()) {
        fail(fmt::format("{} lines are to be skipped (the file has {})", count, lines_.size()), {"correct ", Setting::skipped_lines});
    }
    std::fill_n(lines_.begin(), count, std::string_view{});
}

void TextFile::fail(std::size_t index, std::string_view what_why, const Remedy& what_to_do) const {
    throw ReadError(fmt::format("{}: {}", place_of(index), what_why), what_to_do);
}

void InputFile::fail(std::string_view what_why, const Remedy& what_to_do) const { fail_file(path_, what_why, what_to_do); }

}  // namespace musim::records::detail
