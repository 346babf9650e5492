#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "lsdem/results/read_results.hpp"

namespace musim::lsdem {

/// Writes the readings of the sensors of a run as miniSEED, in SI units, of one sensor alone when a name is given; the number of streams.
/// The file is complete or absent. The station is the first
/// five letters and digits of the sensor's name as capitals, "S1", "S2", ... where these are taken or there are none. The instrument is N
/// for acceleration, H for velocity, Y for displacement, J for rotation and angular velocity, B for gap and slip, E for force; the
/// orientation 1, 2, 3 for x, y, z; of a joint Z along its normal, 1 and 2 across it. Throws ResultError when there is nothing to write,
/// and records::WriteError.
std::size_t write_sensor_streams(const std::filesystem::path& file, const StoredRun& run, const std::optional<std::string>& name = {});

}  // namespace musim::lsdem
