#include "records/formats/read_record.hpp"

#include <fmt/format.h>

#include "records/detail/text.hpp"
#include "records/formats/detail/packed_file.hpp"
#include "records/formats/detail/parsers.hpp"

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

/// A binary format: how its files are distinguished from others, and who reads them. The first that matches reads the file.
struct BinaryFormat {
    bool (*matches)(std::string_view bytes);
    GroundMotion (*parse)(const detail::BinaryFile&, const ReadOptions&);
    bool holds_counts = false;  ///< which a sensitivity turns into motion
};

constexpr BinaryFormat kBinaryFormats[] = {
    {detail::is_miniseed_header, detail::parse_miniseed, true},
    {detail::is_miniseed3_header, detail::parse_miniseed3, true},
    {looks_like_sac, detail::parse_sac},
};

// other formats hold motion, not counts
void refuse_sensitivity(const std::filesystem::path& path, const ReadOptions& options) {
    if (!options.sensitivity && !options.station_xml) return;
    throw ReadError(fmt::format("{}: sensitivity is given (the file holds no counts)", path.string()),
                    Remedy{"drop ", Setting::sensitivity, " or ", Setting::station_response});
}

// binary data have neither lines nor columns
void refuse_choices(const std::filesystem::path& path, const ReadOptions& options) {
    if (!options.columns && !options.skipped_lines) return;
    throw ReadError(fmt::format("{}: columns or lines are chosen (binary data have none)", path.string()),
                    {"drop ", Setting::columns, " and ", Setting::skipped_lines});
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
    {"CSMIP V3 (spectra, no time series)", 0, "Response and Fourier amplitude spectra"},
    {"XML", 0, "<?xml"},
};

void refuse_unsupported(const TextFile& file) {
    for (const Signature& signature : kUnsupported) {
        if (contains_ignoring_case(file.line(signature.line), signature.phrase)) refuse_format(file.path(), signature.format);
    }
}

bool looks_like_cosmos(const TextFile& file) { return contains_ignoring_case(file.line(0), "(FORMAT V0"); }

bool looks_like_bhrc(const TextFile& file) { return contains_ignoring_case(file.line(0), "* VOL1DS FILE"); }

bool looks_like_usc(const TextFile& file) {
    constexpr std::string_view kPhrase = "OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I";
    return contains_ignoring_case(file.line(0), kPhrase) || contains_ignoring_case(file.line(1), kPhrase);
}

bool looks_like_esm(const TextFile& file) { return file.line(0).starts_with("EVENT_NAME:"); }

bool looks_like_geonet(const TextFile& file) {
    return contains_ignoring_case(file.line(0), "CORRECTED ACCELEROGRAM") && contains_ignoring_case(file.line(0), "GNS Science");
}

bool looks_like_afad(const TextFile& file) { return file.line(0).starts_with("STRONG GROUND MOTION RECORDS OF TURKIYE"); }

bool looks_like_asa(const TextFile& file) {
    constexpr std::size_t kLetterhead = 12;  // lines of the institute's name and address; met: 2 to 7
    for (std::size_t index = 0; index < kLetterhead; ++index)
        if (find_ignoring_case(file.line(index), "ARCHIVO ESTANDAR DE ACELERACION") == 0) return true;
    return contains_ignoring_case(file.line(1), "INSTITUTO DE INGENIERIA");
}

bool looks_like_cwa(const TextFile& file) { return file.line(0).starts_with("#Earthquake Information"); }

bool looks_like_csmip(const TextFile& file) {
    return find_ignoring_case(file.line(0), "CORRECTED ACCELEROGRAM") == 0 ||
           find_ignoring_case(file.line(0), "UNCORRECTED ACCELEROGRAM DATA") == 0;
}

bool looks_like_smc(const TextFile& file) {
    const std::string_view line = file.line(0);
    for (const std::string_view title : {"0 UNKNOWN", "1 UNCORRECTED ACCELEROGRAM", "2 CORRECTED ACCELEROGRAM", "3 VELOCITY",
                                         "4 DISPLACEMENT", "5 RESPONSE SPECTRA", "6 FOURIER AMPLITUDE SPECTRA"})
        if (find_ignoring_case(line, title) == 0) return true;
    return false;
}

bool looks_like_peer(const TextFile& file) {
    constexpr std::size_t kHeaderLines = 20;  // PEER needs four; free-text headers of the same family were met with seven
    for (std::size_t index = 0; index < kHeaderLines; ++index) {
        // a comment may count the rows of a table
        if (!file.line(index).starts_with('#') && contains_ignoring_case(file.line(index), "NPTS")) return true;
    }
    return false;
}

bool looks_like_knet(const TextFile& file) {
    constexpr std::size_t kStationLine = 5;
    return file.line(0).starts_with("Origin Time") && file.line(kStationLine).starts_with("Station Code");
}

/// Refuses a caller who expects a rotation of a format that has none.
void refuse_rotation_wanted(const TextFile& file, const ReadOptions& options) {
    const std::optional<SampleUnit> unit = options.unit ? find_sample_unit(*options.unit) : std::nullopt;
    const std::optional<SampleQuantity> wanted = options.quantity ? options.quantity : unit ? std::optional(unit->quantity) : std::nullopt;
    if (!wanted || !is_rotation(*wanted)) return;
    file.fail(fmt::format("format holds translations only (asked for: {})", to_string(*wanted)),
              {"correct ", Setting::quantity, " or ", Setting::unit});
}

/// A text format: how its files are distinguished from others, and who reads them. The first that matches reads the file.
struct TextFormat {
    bool (*matches)(const TextFile&);
    GroundMotion (*parse)(const TextFile&, const ReadOptions&);
    bool holds_counts = false;      ///< which a sensitivity turns into motion
    bool is_numbers_alone = false;  ///< plain text for a caller who chooses columns
};

// GeoNet's title begins like CSMIP's; columns of numbers alone are looked at last
constexpr TextFormat kTextFormats[] = {
    {looks_like_esm, detail::parse_esm},
    {looks_like_geonet, detail::parse_geonet},
    {looks_like_afad, detail::parse_afad},
    {looks_like_asa, detail::parse_asa},
    {looks_like_cwa, detail::parse_cwa},
    {detail::looks_like_bbp, detail::parse_bbp},
    {looks_like_knet, detail::parse_knet},
    {detail::looks_like_jma, detail::parse_jma},
    {detail::looks_like_slist, detail::parse_slist, true},
    {looks_like_cosmos, detail::parse_cosmos},
    {looks_like_bhrc, detail::parse_bhrc},
    {looks_like_usc, detail::parse_usc},
    {looks_like_csmip, detail::parse_csmip},
    {looks_like_smc, detail::parse_smc},
    {detail::looks_like_csmnc, detail::parse_csmnc},
    {looks_like_peer, detail::parse_at2},
    {detail::looks_like_deepsoil, detail::parse_deepsoil, false, true},
    {detail::looks_like_shake, detail::parse_shake, false, true},
};

}  // namespace

GroundMotion detail::parse_record(const std::filesystem::path& packed_path, std::string packed_bytes, const ReadOptions& options) {
    auto [path, bytes] = detail::unpack({packed_path, std::move(packed_bytes)});
    bytes = detail::decode_utf16(std::move(bytes));
    for (const BinaryFormat& format : kBinaryFormats) {
        if (!format.matches(bytes)) continue;
        if (!format.holds_counts) refuse_sensitivity(path, options);
        refuse_choices(path, options);
        return format.parse(detail::BinaryFile(path, std::move(bytes)), options);
    }
    refuse_binary(path, bytes);
    TextFile file(path, std::move(bytes));
    if (options.skipped_lines) file.skip(*options.skipped_lines);
    refuse_unsupported(file);
    for (const TextFormat& format : kTextFormats) {
        if (!format.matches(file) || (options.columns && format.is_numbers_alone)) continue;
        if (!format.holds_counts) refuse_sensitivity(path, options);
        if (!format.holds_counts && !format.is_numbers_alone) refuse_rotation_wanted(file, options);
        if (options.columns) file.fail("columns are given (those of this format are known)", {"drop ", Setting::columns});
        return format.parse(file, options);
    }
    refuse_sensitivity(path, options);
    return detail::parse_text(file, options);
}

GroundMotion read_record(const std::filesystem::path& path, const ReadOptions& options) {
    return detail::parse_record(path, detail::read_bytes(path), options);
}

}  // namespace musim::records
