#pragma once

#include "records/ground_motion.hpp"

namespace musim::records {

/// The component of largest peak acceleration, among those with a direction where any has one: a record whose file names no directions is
/// taken as it is. Throws ProcessingError when a component holds no acceleration.
const Component& find_strongest_horizontal(const GroundMotion& motion);

}  // namespace musim::records
