#include "records/read_record.hpp"

#include <fmt/format.h>

#include "records/detail/parsers.hpp"
#include "records/detail/text.hpp"

namespace musim::records {
namespace {

using detail::contains_ignoring_case;
using detail::find_ignoring_case;
using detail::TextFile;

[[noreturn]] void refuse_format(const std::filesystem::path& path, std::string_view format) {
    throw ReadError(
        fmt::format("{}: format is {} (recognised but not supported); convert it to PEER AT2, CSMIP V1/V2 or columns of numbers",
                    path.string(), format));
}

bool looks_like_sac(std::string_view bytes) {
    // header version at byte 304, in either byte order
    if (bytes.size() < 308) return false;
    const std::string_view version = bytes.substr(304, 4);
    return version == std::string_view("\6\0\0\0", 4) || version == std::string_view("\0\0\0\6", 4);
}

/// A binary format: how its files are told from others, and who reads them. The first that matches reads the file.
struct BinaryFormat {
    bool (*matches)(std::string_view bytes);
    GroundMotion (*parse)(const detail::BinaryFile&, const ReadOptions&);
};

constexpr BinaryFormat kBinaryFormats[] = {
    {detail::is_miniseed_header, detail::parse_miniseed},
    {looks_like_sac, detail::parse_sac},
};

// other formats hold motion, not counts
void refuse_sensitivity(const std::filesystem::path& path, const ReadOptions& options) {
    if (!options.sensitivity && !options.station_xml) return;
    throw ReadError(
        fmt::format("{}: sensitivity is given (only miniSEED holds counts); drop --sensitivity or --station-xml", path.string()));
}

void refuse_binary(const std::filesystem::path& path, std::string_view bytes) {
    constexpr std::size_t kProbe = 4096;  // bytes; text has no NUL, binary data rarely go that far without
    if (bytes.substr(0, kProbe).find('\0') != std::string_view::npos) {
        throw ReadError(
            fmt::format("{}: unknown format (binary data); convert it to PEER AT2, CSMIP V1/V2 or columns of numbers", path.string()));
    }
}

/// A text format we know by its first or second line, and cannot read.
struct Signature {
    std::string_view format;
    std::size_t line;
    std::string_view phrase;
};

constexpr Signature kUnsupported[] = {
    {"COSMOS", 0, "(Format v0"},
    {"GeoNet", 0, "GNS Science"},
    {"SMC", 0, "0 UNKNOWN"},
    {"SMC", 0, "1 UNCORRECTED ACCELEROGRAM"},
    {"SMC", 0, "2 CORRECTED ACCELEROGRAM"},
    {"SMC", 0, "3 VELOCITY"},
    {"SMC", 0, "4 DISPLACEMENT"},
    {"K-NET/KiK-net", 0, "Origin Time       "},
    {"ESM (ITACA) ASCII", 0, "EVENT_NAME:"},
    {"AFAD", 0, "STRONG GROUND MOTION RECORDS OF TURKIYE"},
    {"UNAM", 1, "INSTITUTO DE INGENIERIA"},
    {"BHRC", 0, "* VOL1DS FILE"},
    {"CWA", 0, "#Earthquake Information"},
    {"USC", 0, "OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I"},
    {"USC", 1, "OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I"},
    {"CSMIP V3 (spectra, no time series)", 0, "Response and Fourier amplitude spectra"},
    {"XML", 0, "<?xml"},
};

void refuse_unsupported(const TextFile& file) {
    for (const Signature& signature : kUnsupported) {
        if (contains_ignoring_case(file.line(signature.line), signature.phrase)) refuse_format(file.path(), signature.format);
    }
}

bool looks_like_csmip(const TextFile& file) {
    return find_ignoring_case(file.line(0), "CORRECTED ACCELEROGRAM") == 0 ||
           find_ignoring_case(file.line(0), "UNCORRECTED ACCELEROGRAM DATA") == 0;
}

bool looks_like_peer(const TextFile& file) {
    constexpr std::size_t kHeaderLines = 20;  // PEER needs four; free-text headers of the same family were met with seven
    for (std::size_t index = 0; index < kHeaderLines; ++index) {
        if (contains_ignoring_case(file.line(index), "NPTS")) return true;
    }
    return false;
}

/// A text format: how its files are told from others, and who reads them. The first that matches reads the file.
struct TextFormat {
    bool (*matches)(const TextFile&);
    GroundMotion (*parse)(const TextFile&, const ReadOptions&);
};

constexpr TextFormat kTextFormats[] = {
    {looks_like_csmip, detail::parse_csmip},
    {looks_like_peer, detail::parse_at2},
};

}  // namespace

GroundMotion read_record(const std::filesystem::path& path, const ReadOptions& options) {
    std::string bytes = detail::read_bytes(path);
    if (!detail::is_miniseed_header(bytes)) refuse_sensitivity(path, options);
    for (const BinaryFormat& format : kBinaryFormats)
        if (format.matches(bytes)) return format.parse(detail::BinaryFile(path, std::move(bytes)), options);
    refuse_binary(path, bytes);
    const TextFile file(path, std::move(bytes));
    refuse_unsupported(file);
    for (const TextFormat& format : kTextFormats)
        if (format.matches(file)) return format.parse(file, options);
    return detail::parse_text(file, options);
}

}  // namespace musim::records
