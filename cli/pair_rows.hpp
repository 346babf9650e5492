#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scaling/dimension.hpp"
#include "scaling/structures/structure_properties.hpp"

namespace musim::cli {

/// A quantity of prototype and model, and the factor that similarity asks of it.
struct PairRow {
    std::string key;    ///< in JSON: "shear_wave_speed"
    std::string title;  ///< in tables: "c_e, shear wave (stick)"
    scaling::Dimension dimension;
    std::optional<double> prototype, model;  ///< [SI]
    double required_factor = 1.0;

    /// What the model would need.
    std::optional<double> required() const;
    std::optional<double> factor() const;
};

/// Stiffnesses, moduli, wave speeds and times to climb, S_e^N; of a column whose blocks turn the fastest sway.
std::vector<PairRow> make_speed_rows(const scaling::PairProperties& properties, const scaling::Similitude& similitude);

/// Peaks, periods and frequencies of a motion, as far as either gives them.
std::vector<PairRow> make_motion_rows(const scaling::MotionProperties& prototype, const scaling::MotionProperties& model,
                                      const scaling::Similitude& similitude);

/// R, α, p, e_r and r of the block in one direction.
std::vector<PairRow> make_rocking_rows(const scaling::PairProperties& properties, const scaling::Similitude& similitude,
                                       scaling::Direction direction);

}  // namespace musim::cli
