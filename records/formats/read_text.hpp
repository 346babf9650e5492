#pragma once

#include <filesystem>

#include "records/formats/read_options.hpp"
#include "records/ground_motion.hpp"

namespace musim::records {

/// Stands in the history of a text record whose unit nobody gave.
inline constexpr const char* kUnitNotGiven = " (no unit given)";

/// Reads numbers in columns, and the CSV that write_csv() writes.
///
/// - Values are separated by blanks, tabs, commas or semicolons; lines starting with `#`, `%` or `//` are comments; one title line may
/// stand
///   before the numbers, or the pair of lines "name" and "npts dt".
/// - With two columns or more, a first column that increases evenly is time in seconds, the others are components "1", "2", ...
/// - Without it options.dt is needed; up to three columns are components, more are one component written several values a line.
/// - The unit is options.unit, else the one in parentheses in the title or a comment, e.g. "(cm/s/s)", else SI.
/// The history says how it was read, with kUnitNotGiven when the unit is a guess.
/// Throws ReadError as read_record() does, also for uneven times and lines of different length.
GroundMotion read_text(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace musim::records
