#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "records/ground_motion.hpp"

namespace musim::records {

/// Writes one component as a PEER file: acceleration in g (AT2), velocity in cm/s (VT2) or displacement in cm (DT2), whichever the series
/// is; a rotation is refused.
///
/// 17 digits a value, five a line; an integration corner stands behind the unit ("UNITS OF G, INTEGRATION CORNER= 0.05 HZ"), where
/// read_record() finds it; the format has no place for a start time or a history, which are lost. The file is complete or absent
/// (write_file_atomically). Throws WriteError, and ReadError for an unknown component.
void write_at2(const std::filesystem::path& path, const GroundMotion& motion, std::string_view component);

/// Writes all components as CSV, SI units, one time column; read_record() gives back the same bits (names keep no commas).
///
/// Components may differ in length (the shorter leave their cells empty), and rotations may stand beside translations: the header then
/// has a unit for each. Throws WriteError when translations, or rotations, differ in quantity, when components differ in start or time
/// step, and when the file cannot be written; it is complete or absent.
void write_csv(const std::filesystem::path& path, const GroundMotion& motion);

/// Writes all components as COSMOS 1.20, one section each: V2, or V1 for uncorrected records (those with an integration corner, which
/// stands in a comment line, where read_record() finds it). Samples
/// in cm/s^2, cm/s or cm with 17 digits; azimuths in whole degrees; start times to the microsecond where the motion has a time_zero, else
/// lost, as is the history. Rotations are refused. The station "CE.23837 Pomona" gives the codes CE and 23837; other names stand behind the
/// codes XX and UNKN. Throws WriteError when there is no component, a time step cannot be held to 1/100 of a step over the record (whole
/// nanoseconds), and when the file cannot be written; it is complete or absent.
void write_cosmos(const std::filesystem::path& path, const GroundMotion& motion);

/// Writes all components as miniSEED 2, one stream each: 64-bit floats, since counts would round what processing made, in SI units;
/// read_record() gives back the same samples to the last bit with ReadOptions::sensitivity 1 (and the quantity, for displacement). The
/// station "CI.CLC ..." gives network and station, others are XX.MUSIM. Names of three capitals or digits are channel codes, other
/// components get one: band of the sampling rate, N, H, Y or J for acceleration, velocity, displacement or angular velocity (other
/// rotations are refused), and N, E, Z or the ordinal number. Without a time_zero the clock starts in 1970; an integration corner is lost
/// (read_record() takes kUncorrectedCornerHz). Throws WriteError when there is no component, two have the same channel code, the sampling
/// rate cannot be held to 1/100 of a step over the record, and when the file cannot be written; it is complete or absent.
void write_miniseed(const std::filesystem::path& path, const GroundMotion& motion);

/// Throws WriteError, naming the format, for a component that is a rotation.
void refuse_rotation(const std::filesystem::path& path, const Component& component, std::string_view format);

/// One data stream of miniSEED, of network XX.
struct SeedStream {
    std::string station;  ///< one to five capitals and digits
    std::string code;     ///< instrument and orientation: the last two letters of the channel code
    scaling::Time dt{};
    std::vector<double> samples;
};

/// Writes streams of any quantity as miniSEED 2, 64-bit floats, whose clock starts in 1970; the first letter of their channel codes is the
/// band of the sampling rate. read_record() takes files of one station. Throws WriteError when there is no stream, two have the same
/// station and channel code, the sampling rate cannot be held to 1/100 of a step, and when the file cannot be written; it is complete or
/// absent.
void write_miniseed(const std::filesystem::path& path, const std::vector<SeedStream>& streams);

}  // namespace musim::records
