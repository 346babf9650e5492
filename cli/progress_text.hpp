#pragma once

#include <string>

#include "lsdem/run/progress_file.hpp"

namespace musim::cli {

/// Where a run stands: "0.61 of 1.365 s, kinetic energy 1.2 mJ, largest drift 0.84 %, 12 of 7144 blocks fallen".
std::string describe_progress(const lsdem::RunProgress& progress);

/// The velocity of the top as a line of bars with its axis, " top v_x ▁▅█"; empty when there is none.
std::string draw_progress(const lsdem::RunProgress& progress);

/// "1 h 05 min", "3 min 20 s" or "12 s".
std::string format_duration(double seconds);

/// A time that is left [s]: "12 s", or "12 s to 3 min 20 s" where it is known between bounds only.
std::string describe_left(double least, double most);

}  // namespace musim::cli
