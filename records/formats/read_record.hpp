#pragma once

#include <filesystem>

#include "records/formats/read_options.hpp"
#include "records/ground_motion.hpp"

namespace musim::records {

/// Reads a record; its content, not its name, decides the format: PEER AT2/VT2/DT2, CSMIP/CGS V1 and V2, COSMOS, USGS SMC, K-NET and
/// KiK-net, ESM, GeoNet, AFAD, UNAM, CWA, USC, RENADIC, BHRC, SCEC BBP, SAC, miniSEED, musim CSV, plain text columns.
///
/// Samples come back in SI, g = 9.80665 m/s². Nothing is filtered, shifted or padded.
/// Throws ReadError `path:line: what (why); what to do` for a file that is missing, unreadable, empty, truncated, damaged, of a format that
/// is recognised but not supported (named in the message) or unknown, and for options that contradict the file.
GroundMotion read_record(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace musim::records
