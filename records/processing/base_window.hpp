#pragma once

#include <string>
#include <vector>

#include "records/processing/base_motion.hpp"

namespace musim::records {

/// Reach of a window that is chosen beyond the strong motion, at either end [fraction of the strong motion's length].
inline constexpr double kWindowReach = 0.5;

/// Cost below which a shorter window is worth more than a cheaper one [-]: what warns of a change of PGV.
inline constexpr double kCheapWindow = 0.02;

/// The window of a record that is to shake a base: it holds the strong motion (find_strong_motion() without margin, of the first
/// component that is a translation, or the first; differentiated where it is no acceleration) and opens and closes within kWindowReach of
/// it. Taken is the shortest that costs at most kCheapWindow, or the cheapest where none does.
///
/// The cost of a window is what its correction to rest takes from the velocity and the displacement, each over its peak in the record, of
/// the component for which their sum is largest; the displacement counts from the record's own zero, so that windows open where the record
/// is back there. `components`: names, at least one. `settings` has no window. Throws as make_base_motion() does, and ReadError for an
/// unknown component.
TimeWindow find_base_window(const GroundMotion& motion, const std::vector<std::string>& components,
                            const BaseMotionSettings& settings = {});

}  // namespace musim::records
