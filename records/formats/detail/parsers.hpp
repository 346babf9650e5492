#pragma once

#include "records/formats/read_options.hpp"
#include "records/ground_motion.hpp"
#include "records/headers/binary_file.hpp"
#include "records/headers/text_file.hpp"

/// One parser per format, on a file already in memory; errors as in the public headers.
namespace musim::records::detail {

/// What read_record() makes of the bytes of a file called `path`, whatever their format.
GroundMotion parse_record(const std::filesystem::path& path, std::string bytes, const ReadOptions& options);

GroundMotion parse_afad(const TextFile& file, const ReadOptions& options);
GroundMotion parse_at2(const TextFile& file, const ReadOptions& options);
GroundMotion parse_bbp(const TextFile& file, const ReadOptions& options);
GroundMotion parse_bhrc(const TextFile& file, const ReadOptions& options);
GroundMotion parse_cosmos(const TextFile& file, const ReadOptions& options);
GroundMotion parse_csmip(const TextFile& file, const ReadOptions& options);
GroundMotion parse_cwa(const TextFile& file, const ReadOptions& options);
GroundMotion parse_esm(const TextFile& file, const ReadOptions& options);
GroundMotion parse_geonet(const TextFile& file, const ReadOptions& options);
GroundMotion parse_knet(const TextFile& file, const ReadOptions& options);
GroundMotion parse_miniseed(const BinaryFile& file, const ReadOptions& options);
GroundMotion parse_sac(const BinaryFile& file, const ReadOptions& options);
GroundMotion parse_smc(const TextFile& file, const ReadOptions& options);
GroundMotion parse_text(const TextFile& file, const ReadOptions& options);
GroundMotion parse_unam(const TextFile& file, const ReadOptions& options);
GroundMotion parse_usc(const TextFile& file, const ReadOptions& options);

/// True for files of the SCEC Broadband Platform, whose last leading comment names time and three axes with their units.
bool looks_like_bbp(const TextFile& file);

/// Bytes of the fixed header of a miniSEED 2 record.
inline constexpr std::size_t kMiniseedHeaderBytes = 48;

/// True when `bytes` begin as a miniSEED 2 record does.
bool is_miniseed_header(std::string_view bytes);

/// What the options say about the samples, with defaults filled in; throws ReadError for an unknown unit or one of another quantity.
SampleUnit requested_unit(const InputFile& file, const ReadOptions& options);

/// The time step the file states on line `index`; throws ReadError unless it is positive and finite.
scaling::Time checked_dt(const TextFile& file, std::size_t index, double seconds);

/// The sample `text` on line `index`, times `si`; throws ReadError, naming its ordinal number, unless that is a finite number.
double checked_sample(const TextFile& file, std::size_t index, std::string_view text, std::size_t ordinal, double si);

/// Throws ReadError when the options contradict the unit and time step that the file states.
void refuse_contradictions(const InputFile& file, const ReadOptions& options, const SampleUnit& unit, scaling::Time dt);

}  // namespace musim::records::detail
