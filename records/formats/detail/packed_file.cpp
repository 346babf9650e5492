#include "records/formats/detail/packed_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string_view>

#include "records/headers/text_file.hpp"

namespace musim::records::detail {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kGzip = "\x1F\x8B";
constexpr std::string_view kZip = "PK\3\4";
constexpr std::string_view kEmptyZip = "PK\5\6";

bool is_zip(std::string_view bytes) { return bytes.starts_with(kZip) || bytes.starts_with(kEmptyZip); }

/// Archive of another kind, by its first bytes.
struct OtherArchive {
    std::string_view start;
    std::string_view name;
};
constexpr std::array<OtherArchive, 6> kOtherArchives{{{"BZh", "bzip2"},
                                                      {"\xFD"
                                                       "7zXZ",
                                                       "xz"},
                                                      {"7z\xBC\xAF", "7-Zip"},
                                                      {"\x28\xB5\x2F\xFD", "zstd"},
                                                      {"\x1F\x9D", "compress (.Z)"},
                                                      {"Rar!", "RAR"}}};

std::optional<std::string_view> find_other_archive(std::string_view bytes) {
    for (const OtherArchive& archive : kOtherArchives)
        if (bytes.starts_with(archive.start)) return archive.name;
    constexpr std::size_t kTarMark = 257;  // bytes before "ustar"
    if (bytes.size() > kTarMark && bytes.substr(kTarMark).starts_with("ustar")) return "tar";
    return std::nullopt;
}

/// zlib's state, ended with its owner.
class Inflater {
  public:
    Inflater() {
        constexpr int kGzipOnly = 15 + 16;  // largest window, with a gzip header
        if (inflateInit2(&stream, kGzipOnly) != Z_OK) throw std::bad_alloc();
    }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
    ~Inflater() { inflateEnd(&stream); }

    z_stream stream{};
};

// all members of a gzip file one behind the other, as gzip does; zeros behind the last are padding
std::string gunzip(const BinaryFile& file, std::size_t largest) {
    const std::string_view packed = file.bytes();
    std::string unpacked;
    const auto chunk = std::make_unique<std::array<char, std::size_t{1} << 16U>>();
    Inflater inflater;
    z_stream& stream = inflater.stream;
    // zlib reads these bytes only
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());  // at most kLargestFileBytes
    for (int status = Z_OK; status != Z_STREAM_END;) {
        stream.next_out = reinterpret_cast<Bytef*>(chunk->data());
        stream.avail_out = static_cast<uInt>(chunk->size());
        status = inflate(&stream, Z_NO_FLUSH);
        if (status == Z_BUF_ERROR)
            file.fail(fmt::format("unpacks to {} bytes, then ends (file is truncated)", unpacked.size()), "fetch the record again");
        if (status != Z_OK && status != Z_STREAM_END) {
            file.fail(fmt::format("cannot be unpacked behind {} bytes ({}; file is damaged)", unpacked.size(),
                                  stream.msg == nullptr ? "no gzip data" : stream.msg),
                      "fetch the record again");
        }
        unpacked.append(chunk->data(), chunk->size() - stream.avail_out);
        if (unpacked.size() > largest) {
            file.fail(fmt::format("unpacks to more than {:.3g} GB (no record)", 1e-9 * static_cast<double>(largest)),
                      "cut it into shorter records");
        }
        const std::string_view rest = packed.substr(packed.size() - stream.avail_in);
        const bool has_more = status == Z_STREAM_END && rest.find_first_not_of('\0') != std::string_view::npos;
        if (has_more) {
            if (!rest.starts_with(kGzip)) file.fail("bytes follow the packed data (file is damaged)", "fetch the record again");
            inflateReset(&stream);
            status = Z_OK;
        }
    }
    return unpacked;
}

void refuse_archive(const NamedBytes& file, std::string_view why) {
    std::optional<std::string_view> name = find_other_archive(file.bytes);
    if (!name && file.bytes.starts_with(kGzip)) name = "gzip";
    if (!name && is_zip(file.bytes)) name = "zip";
    if (name) BinaryFile(file.path, {}).fail(fmt::format("holds a {} archive ({})", *name, why), "unpack it first");
}

}  // namespace

NamedBytes unpack(NamedBytes packed, std::size_t largest) {
    const bool is_gzip = packed.bytes.starts_with(kGzip);
    if (!is_gzip && !is_zip(packed.bytes)) {
        if (const auto name = find_other_archive(packed.bytes))
            BinaryFile(packed.path, {}).fail(fmt::format("is a {} archive (unpacked are .gz and .zip)", *name), "unpack it first");
        return packed;
    }
    NamedBytes unpacked =
        is_gzip ? NamedBytes{packed.path, gunzip(BinaryFile(packed.path, std::move(packed.bytes)), largest)} : unzip(packed, largest);
    if (unpacked.bytes.empty())
        BinaryFile(unpacked.path, {}).fail("packed file is empty (no header, no samples)", "fetch the record again");
    refuse_archive(unpacked, "one is unpacked, none within another");
    return unpacked;
}

}  // namespace musim::records::detail
