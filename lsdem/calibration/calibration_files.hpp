#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lsdem/calibration/rocking_impact.hpp"
#include "lsdem/calibration/tilt_test.hpp"
#include "lsdem/calibration/wave_speed.hpp"

/// Tests on single blocks as tables and pictures.
namespace musim::lsdem {

/// time_s, base_m, layer1_m, ...: displacements of a wave test; at most 2000 rows, evenly thinned.
std::string make_wave_csv(const WaveHistory& history);

/// Displacement of the base, every fifth layer and the top over time, as Fig. 4 of [Harmon23].
std::string make_wave_svg(const WaveHistory& history, const BlockSample& sample, const std::string& title, const WaveSpeed& speed);

/// The block's edge that points downhill: "b", "w" or "H".
std::string downhill_edge(const TiltCase& test);

/// pose,support,downhill,event,angle_deg,half_interval_deg,tangent,expected_slip_deg,expected_topple_deg: one line per test.
std::string make_tilt_csv(const std::vector<TiltCase>& cases, const std::vector<TiltResult>& results);

/// The energy ratio that [Harmon23] measured on wood blocks let go at 22, 11 or 6 degrees: about 0.6, 0.5 and 0.25, the last one uncertain.
std::optional<double> find_published_ratio(double start);

/// Mean energy ratio over restitution for one support, with Housner's values and the published measurements.
std::string make_rocking_svg(const BlockSample& sample, const std::vector<RockingCurve>& curves, RockingSupport support);

}  // namespace musim::lsdem
