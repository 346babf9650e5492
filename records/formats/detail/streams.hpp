#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "records/formats/read_record.hpp"
#include "records/headers/text_file.hpp"

/// Channels as data centres pass them on, piece after piece: miniSEED 2 and 3, SLIST, TSPAIR.
namespace musim::records::detail {

/// A data stream by its SEED codes.
struct StreamCodes {
    std::string network = {};
    std::string station = {};
    std::string location = {};  ///< often empty
    std::string channel = {};   ///< band, instrument and orientation: "HNE"; "H_N_E1" where one of them has more letters

    friend bool operator==(const StreamCodes&, const StreamCodes&) = default;
};

/// "CI.CLC..HNE"
std::string to_string(const StreamCodes& codes);

/// Codes of an FDSN source identifier, "FDSN:CI_CLC__H_N_E" or without its first word; nothing for anything else.
std::optional<StreamCodes> parse_source_identifier(std::string_view text);

/// The letters of a channel code that stand for the instrument: "N" of "HNE" and of "H_N_E1"; empty when there are none.
std::string_view instrument_of(std::string_view channel);

/// Samples of one stream, all pieces of a file so far.
struct Stream {
    StreamCodes codes;
    UtcTime first;
    double rate = 0.0;                    ///< [1/s]
    std::optional<SampleUnit> unit = {};  ///< of the samples where the file gives it; nothing: counts
    std::vector<double> samples = {};
    std::optional<double> azimuth_deg = {};  ///< where the file gives it and the unit
};

/// Ends reading with what is wrong with the piece at hand, why, and what to do; throws ReadError.
using FailPiece = std::function<void(std::string_view what_why, const Remedy& what_to_do)>;

/// Where a record of a binary file stands, and how messages call it.
struct RecordPlace {
    const BinaryFile& file;
    std::size_t ordinal;  ///< from 1
    std::size_t at;       ///< byte of the file

    [[noreturn]] void fail(std::string_view what_why, const Remedy& what_to_do) const;
    FailPiece fails() const {
        return [this](std::string_view what_why, const Remedy& what_to_do) { fail(what_why, what_to_do); };
    }
};

/// The stream that a piece of these codes, start, rate [1/s] and unit continues, or begins. Fails unless all pieces of a file are of one
/// station and those of a stream have one rate and unit and follow one another within half a step, counted from the first sample: a clock
/// that drifts further is a gap or overlap too.
Stream& continue_stream(std::vector<Stream>& streams, const Stream& piece, const FailPiece& fail);

/// True for an instant that stands for a start on an unknown clock: the writer counts it from 1970, when nobody recorded miniSEED.
inline bool is_clockless(UtcTime first) { return std::chrono::abs(first.time_since_epoch()) < std::chrono::days(1); }

/// Throws ReadError unless the options say once what counts are worth and contradict nothing; `counts` is false where the file gives the
/// unit itself.
void check_count_options(const InputFile& file, const ReadOptions& options, std::string_view format, bool counts);

/// The motion of all streams: counts divided by the sensitivity that the options or the StationXML file give, samples with a unit in SI.
/// The quantity of counts is that of the StationXML file; else options.quantity, which contradicts the code of an accelerometer only where
/// counts are counts (sensitivity not 1); else that of the code.
GroundMotion make_motion(const InputFile& file, std::string_view format, std::vector<Stream> streams, const ReadOptions& options);

}  // namespace musim::records::detail
