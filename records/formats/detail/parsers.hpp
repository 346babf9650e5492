#pragma once

#include "records/formats/read_record.hpp"
#include "records/headers/text_file.hpp"

/// One parser per format, on a file already in memory; errors as of read_record().
namespace musim::records::detail {

/// Motion that read_record() makes of the bytes of a file called `path`, whatever their format.
GroundMotion parse_record(const std::filesystem::path& path, std::string bytes, const ReadOptions& options);

GroundMotion parse_afad(const TextFile& file, const ReadOptions& options);
/// ASA 2.0, the accelerogram format of Mexico's institutes (UNAM, CICESE, ...): up to twelve channels of one length.
GroundMotion parse_asa(const TextFile& file, const ReadOptions& options);
/// A file of PEER, PACIFIC ENGINEERING or their imitators: AT2 (acceleration), VT2 (velocity) or DT2 (displacement). Header lines
/// "NPTS= 8000, DT= .0050 SEC" or "8000 0.0050 NPTS, DT", the unit in "... IN UNITS OF G"; values, any number a line, up to a trailer of
/// "***" lines.
GroundMotion parse_at2(const TextFile& file, const ReadOptions& options);
GroundMotion parse_bbp(const TextFile& file, const ReadOptions& options);
GroundMotion parse_bhrc(const TextFile& file, const ReadOptions& options);
GroundMotion parse_cosmos(const TextFile& file, const ReadOptions& options);
/// CSMIP/CGS volume 1 (uncorrected, g) or volume 2 (corrected, cm/s²) with all its channels, each with its own length: samples in Fortran
/// columns, e.g. (8f9.6), or, in volume 1, (time, value) pairs, which are put on an even clock.
GroundMotion parse_csmip(const TextFile& file, const ReadOptions& options);
/// China's national strong-motion network: one component below labelled lines, cm/s², cm/s or cm; its recorder's clock is not taken, since
/// files do not say whether it counts the seconds before the event.
GroundMotion parse_csmnc(const TextFile& file, const ReadOptions& options);
GroundMotion parse_cwa(const TextFile& file, const ReadOptions& options);
/// Input motion of DEEPSOIL: number of points and time step, then rows of time and acceleration in g (unless the options say otherwise).
GroundMotion parse_deepsoil(const TextFile& file, const ReadOptions& options);
GroundMotion parse_esm(const TextFile& file, const ReadOptions& options);
GroundMotion parse_geonet(const TextFile& file, const ReadOptions& options);
/// CSV of the Japan Meteorological Agency: up to three axes, clock UTC+9, the instrument's offset left in.
GroundMotion parse_jma(const TextFile& file, const ReadOptions& options);
GroundMotion parse_knet(const TextFile& file, const ReadOptions& options);
GroundMotion parse_miniseed(const BinaryFile& file, const ReadOptions& options);
/// FDSN miniSEED 3: records of any length with a CRC-32C; integers, floats, Steim-1 and Steim-2.
GroundMotion parse_miniseed3(const BinaryFile& file, const ReadOptions& options);
/// The CSV of write_csv(), whose first line is kMusimCsvTitle: `# key: value` lines, a title line `time_s,NAME,...`, rows of 17-digit
/// numbers (docs/user/record_formats.md shows one); back to the last bit.
GroundMotion parse_musim_csv(const TextFile& file, const ReadOptions& options);
inline constexpr std::string_view kMusimCsvTitle = "# musim ground motion 1";
/// In the place of an azimuth.
inline constexpr std::string_view kUp = "up";
GroundMotion parse_sac(const BinaryFile& file, const ReadOptions& options);
/// One component in columns of one width that may touch, (8F9.6) or (5E15.7), with a number behind each line or without, below any header:
/// the input of SHAKE. In g unless the header or the options say otherwise.
GroundMotion parse_shake(const TextFile& file, const ReadOptions& options);
/// SLIST and TSPAIR, the texts that data centres make of miniSEED: series below lines "TIMESERIES XX_ABC__HNE_D, 4000 samples, ...", or
/// below those of GeoCSV, "# SID: XX_ABC__HNE" and so on, which may give the sensitivity.
GroundMotion parse_slist(const TextFile& file, const ReadOptions& options);
GroundMotion parse_smc(const TextFile& file, const ReadOptions& options);
/// Numbers in columns, and the CSV that write_csv() writes. Text above the numbers says what columns are (text_heading.hpp), else what they
/// hold does (text_layout.hpp, text_clock.hpp, text_samples.hpp). The history says how it was read, with kUnitNotGiven when the unit is a
/// guess. Uneven times and lines of different length are refused.
GroundMotion parse_text(const TextFile& file, const ReadOptions& options);
GroundMotion parse_usc(const TextFile& file, const ReadOptions& options);

/// True for files of the SCEC Broadband Platform, whose last leading comment names time and three axes with their units.
bool looks_like_bbp(const TextFile& file);

bool looks_like_csmnc(const TextFile& file);
/// True for a first row "number step" above rows of two numbers, of which the first rise by that step.
bool looks_like_deepsoil(const TextFile& file);
bool looks_like_jma(const TextFile& file);
/// True for rows of numbers in even columns that blanks alone do not part, or part from a line number behind them.
bool looks_like_shake(const TextFile& file);
bool looks_like_slist(const TextFile& file);

/// Bytes of the fixed header of a miniSEED 2 record.
inline constexpr std::size_t kMiniseedHeaderBytes = 48;

/// True when `bytes` begin as a miniSEED 2 record does.
bool is_miniseed_header(std::string_view bytes);

/// True when `bytes` begin as a miniSEED 3 record does.
bool is_miniseed3_header(std::string_view bytes);

/// Unit that the options give the samples, with defaults filled in; throws ReadError for an unknown unit or one of another quantity.
SampleUnit requested_unit(const InputFile& file, const ReadOptions& options);

/// The time step the file states on line `index`; throws ReadError unless it is positive and finite.
scaling::Time checked_dt(const TextFile& file, std::size_t index, double seconds);

/// The number of points, or of another `noun`, that is `text` on line `index`; throws ReadError unless that is a positive integer.
std::size_t checked_count(const TextFile& file, std::size_t index, std::string_view text, std::string_view what_to_do = "correct the line",
                          std::string_view noun = "point");

/// The sample `text` on line `index`, times `si`; throws ReadError, naming its ordinal number, unless that is a finite number.
double checked_sample(const TextFile& file, std::size_t index, std::string_view text, std::size_t ordinal, double si);

/// Are two time steps [s] the same, as files print them?
bool is_same_time_step(double a, double b);

/// Throws ReadError when the options contradict the unit and time step that the file states.
void refuse_contradictions(const InputFile& file, const ReadOptions& options, const SampleUnit& unit, scaling::Time dt);

}  // namespace musim::records::detail
