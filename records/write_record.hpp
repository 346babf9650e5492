#pragma once

#include <filesystem>
#include <string_view>

#include "records/ground_motion.hpp"

namespace musim::records {

/// Writes one component as a PEER file: acceleration in g (AT2), velocity in cm/s (VT2) or displacement in cm (DT2), whichever the series
/// is.
///
/// 17 digits a value, five a line; the format has no place for a start time or a history, which are lost. The file is complete or absent
/// (write_file_atomically). Throws WriteError, and ReadError for an unknown component.
void write_at2(const std::filesystem::path& path, const GroundMotion& motion, std::string_view component);

/// Writes all components as CSV, SI units, one time column; read_record() gives back the same bits (names keep no commas).
///
/// Components may differ in length (the shorter leave their cells empty). Throws WriteError when they differ in quantity, start or time
/// step, and when the file cannot be written; it is complete or absent.
void write_csv(const std::filesystem::path& path, const GroundMotion& motion);

}  // namespace musim::records
