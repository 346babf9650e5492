#pragma once

#include <filesystem>

#include "records/formats/read_options.hpp"
#include "records/ground_motion.hpp"

namespace musim::records {

/// Reads a PEER file: AT2 (acceleration), VT2 (velocity) or DT2 (displacement), one component each.
///
/// Header lines as PEER, PACIFIC ENGINEERING and their imitators write them: "NPTS= 8000, DT= .0050 SEC" or "8000 0.0050 NPTS, DT", any
/// case; the unit stands in "... IN UNITS OF G". Values follow, any number a line, blanks or commas between; a trailer of "***" lines is
/// skipped. Throws ReadError as read_record() does, also when there are fewer or more values than NPTS.
GroundMotion read_at2(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace musim::records
