#pragma once

#include <cmath>
#include <cstddef>

#include "lsdem/model.hpp"
#include "tests/support/heaps.hpp"
#include "tests/support/models.hpp"
#include "tests/support/motion.hpp"

namespace musim::lsdem::tests {

/// Wood at 1:107; where it is probed by nodes, with 3 x 5 on the face across z: as coarse as a face can be and still bend.
inline Stone coarse_wood() {
    Stone stone = wood();
    stone.nodes_per_face = 15;
    return stone;
}

/// The same stone at another length, its stiffness by the law of compliant contact in equal gravity, λ_k = λ_l².
inline Stone at_length(Stone stone, double length_factor) {
    stone.size *= length_factor;
    stone.normal_stiffness *= length_factor * length_factor;
    stone.shear_stiffness *= length_factor * length_factor;
    return stone;
}

/// Shakes the base along x and, weaker and faster, along y, from rest, for a duration [s]: amplitude [m/s²], frequency [Hz].
inline void shake(Model& model, double amplitude, double frequency, double duration) {
    const auto samples = static_cast<std::size_t>(std::ceil(200.0 * duration * frequency));
    const double omega = 2.0 * kPi * frequency;
    model.ground.motion.shift[0] =
        sample_velocity(duration, samples, [=](double t) { return amplitude / omega * (1.0 - std::cos(omega * t)); });
    model.ground.motion.shift[1] =
        sample_velocity(duration, samples, [=](double t) { return 0.7 * amplitude / omega * std::sin(1.3 * omega * t); });
}

/// A small wall of 3 x 5 blocks in running bond, the first of the scenes that a stress is put on.
inline Model make_wall(const Stone& stone) { return make_running_bond(stone, 1, 3, 5); }

/// The wall shaken at 0.3 g and 30 Hz for 0.15 s: it rocks and slides.
inline Model make_shaken_wall(const Stone& stone) {
    Model model = make_wall(stone);
    shake(model, 0.3 * kGravity, 30.0, 0.15);
    return model;
}

}  // namespace musim::lsdem::tests
