#pragma once

#include <string_view>

#include "records/detail/text_file.hpp"
#include "records/ground_motion.hpp"
#include "records/read_options.hpp"

/// The CSV of write_csv(): `# key: value` lines, a title line `time_s,NAME,...`, rows of 17-digit numbers. README.md shows one.
namespace musim::records::detail {

inline constexpr std::string_view kMusimCsvTitle = "# musim ground motion 1";

/// Reads it back to the last bit; errors as read_text().
GroundMotion parse_musim_csv(const TextFile& file, const ReadOptions& options);

}  // namespace musim::records::detail
