#pragma once

#include <filesystem>

#include "records/formats/read_options.hpp"
#include "records/ground_motion.hpp"

namespace musim::records {

/// Reads a CSMIP/CGS volume 1 (uncorrected, g) or volume 2 (corrected, cm/s²) file with all its channels, each with its own length.
///
/// Samples stand in Fortran columns, e.g. (8f9.6), without blanks between them. Volume 2 holds acceleration, velocity and displacement:
/// options.quantity chooses (default acceleration). Channels of volume 1 get an integration corner of 0.05 Hz (docs/theory/records.md).
/// Throws ReadError as read_record() does, also when counts in header and data line differ, when the direction in the title and in the
/// integer header differ. Volume 1 of (time, value) pairs is put on an even clock (resample_uneven.hpp).
GroundMotion read_csmip(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace musim::records
