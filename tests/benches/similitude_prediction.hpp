#pragma once

#include <string_view>

#include "tests/benches/similitude_model.hpp"

namespace musim::lsdem {

/// Measure that is compared between model and prototype, both scaled back.
enum class Measure {
    peak,       ///< greatest displacement relative to the base, or tilt
    peak_time,  ///< when, since the base began to move
};

std::string_view to_string(Measure measure);

/// Model over prototype, as theory has it.
struct Prediction {
    double ratio = 1.0;
    double tolerance = 0.0;  ///< of the ratio, absolute: what the closed form leaves out
};

/// Ratio of the measure from the groups of the model over those of the prototype; docs/validation/similitude.md has the derivation. Throws
/// std::invalid_argument for the column, which has no closed form, and as the closed forms do.
Prediction predict(BenchScene scene, const TwinScales& scales, const Break& broken, Measure measure);

}  // namespace musim::lsdem
