#pragma once

#include <string_view>

#include "records/formats/read_options.hpp"
#include "records/ground_motion.hpp"
#include "records/headers/text_file.hpp"

/// The CSV of write_csv(): `# key: value` lines, a title line `time_s,NAME,...`, rows of 17-digit numbers. docs/user/record_formats.md
/// shows one.
namespace musim::records::detail {

inline constexpr std::string_view kMusimCsvTitle = "# musim ground motion 1";

/// Reads it back to the last bit; errors as read_text().
GroundMotion parse_musim_csv(const TextFile& file, const ReadOptions& options);

}  // namespace musim::records::detail
