#pragma once

#include <string>

#include "tests/benches/accuracy_sweep.hpp"

namespace musim::lsdem {

/// Error over run time as an SVG document: one panel per problem, both axes logarithmic, one mark and colour per family, the Pareto front
/// as a stepped line with its labels. Errors below 1e-10 stand on the lower edge, infinite ones on the upper one.
std::string make_accuracy_svg(const AccuracySweep& sweep);

}  // namespace musim::lsdem
