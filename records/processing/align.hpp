#pragma once

#include <vector>

#include "records/ground_motion.hpp"

/// Components of one record on one clock.
namespace musim::records {

/// One record of several files of the same shaking: all their components, in order. Where files say when they begin, components are placed
/// by that time, whatever their number of samples; where none does they begin together, as records of one station without times do, and the
/// history says so. A name that comes twice gets its station or a number in front. Throws ProcessingError for no file, and when only some
/// say and others do not.
GroundMotion merge(const std::vector<GroundMotion>& files);

/// The record with all components on one clock: the shortest of their steps, the stretch that all of them cover. Those that differ are
/// resampled (band-limited) and shifted by the part of a step that is left; nothing is moved by counting samples. The history says what was
/// done. Throws ProcessingError when there is no such stretch, or their quantities differ.
GroundMotion align(const GroundMotion& motion);

/// Two horizontal components seen along `azimuth_deg` and 90° clockwise of it (names and azimuths of the new ones), in their place in an
/// aligned record; others stay. The two may stand at any angle that is not flat. Throws ProcessingError unless exactly two components have
/// an azimuth, on one clock, more than 1° from parallel.
GroundMotion rotate(const GroundMotion& motion, double azimuth_deg);

}  // namespace musim::records
