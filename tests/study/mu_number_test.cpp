// The mu number itself: one block slides on the shaken ground; the model has another friction coefficient than the prototype.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "scaling/structures/distortion.hpp"

namespace {

using musim::lsdem::Scene;
using musim::lsdem::Simulation;
using musim::scaling::make_similitude;
using musim::scaling::Similitude;

constexpr double kPrototypeFriction = 0.59;
constexpr int kRunSamples = 400;

/// A concrete slab, so flat that no edge lifts even when friction turns around (eccentricity 3 mu H/2 below the kernel w/6), under the
/// built-in record of PGA 1.5 g and PGV 100 cm/s.
Scene make_prototype() {
    return musim::lsdem::parse_scene(R"({
        "schema": "musim-scene/1", "name": "sliding block",
        "material": { "density": "2320 kg/m^3", "normal_stiffness": "26.25 GN/m", "shear_stiffness": "25 GN/m", "friction": 0.59,
                      "restitution": 0.5 },
        "structure": { "kind": "blocks", "blocks": [ { "size": ["4.25 m", "2.82 m", "0.5 m"], "position": [0, 0, "0.25 m"] } ] },
        "base_motion": { "signal": "synthetic", "direction": "x", "pga": "1.5 g", "pgv": "100 cm/s", "duration": "8 s", "dt": "0.005 s",
                         "seed": 2 },
        "time": { "duration": "8 s" } })",
                                     "mu_number_test");
}

/// Slip of the block on the ground at equal parts of the duration [m].
std::vector<double> simulate_slip(const Scene& scene) {
    const musim::lsdem::Model model = musim::lsdem::make_model(scene);
    const double limit = musim::lsdem::compute_time_step(scene, model).value();
    const double interval = scene.time.duration.value() / kRunSamples;
    const auto steps = static_cast<std::uint64_t>(std::ceil(interval / limit));
    Simulation simulation(model, interval / static_cast<double>(steps));
    std::vector<double> slip;
    for (int sample = 0; sample < kRunSamples; ++sample) {
        simulation.advance(steps);
        slip.push_back(simulation.position(0).x() - model.blocks[0].position.x() - simulation.base().displacement.x());
    }
    return slip;
}

double peak(const std::vector<double>& values) {
    double largest = 0.0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    return largest;
}

/// Largest difference between the model's slip, scaled back by the length factor, and the prototype's, over the prototype's peak.
double slip_difference(const Similitude& similitude) {
    const Scene prototype = make_prototype();
    const std::vector<double> slip_prototype = simulate_slip(prototype);
    const std::vector<double> slip_model = simulate_slip(scale_scene(prototype, similitude));
    double largest = 0.0;
    for (std::size_t i = 0; i < slip_prototype.size(); ++i)
        largest = std::max(largest, std::abs(slip_model[i] / similitude.length() - slip_prototype[i]));
    // slip that matters: centimetres at full size, ten thousand times the elastic give of the interface
    REQUIRE(peak(slip_prototype) > 0.01);
    return largest / peak(slip_prototype);
}

double distortion_of(const Similitude& similitude, const std::string& group) {
    musim::scaling::ModelProperties properties;
    properties.friction_prototype = kPrototypeFriction;
    for (const auto& distortion : musim::scaling::find_distortions(similitude, properties))
        if (distortion.group == group) return distortion.factor;
    return 1.0;
}

}  // namespace

// [Rosakis21], [Andrade22] eq. (3): with a, t and v scaled by the mu law, slip/l depends on a/(mu g) and the waveform alone.
// 1e-3: the interface's elastic give (m g mu/k_s over the peak slip, below 1e-4) scales alike; what is left is the first-order time
// error of stick and slip, one step of the order of 1/20000 of the duration.
TEST_CASE("slip histories of blocks with different friction collapse under the mu law") {
    for (const double friction : {0.18, 0.63}) {
        CAPTURE(friction);
        const Similitude mu_law = make_similitude("mu", {.length = 1.0 / 107.0, .friction = friction / kPrototypeFriction});
        CHECK(slip_difference(mu_law) < 1e-3);
        CHECK(distortion_of(mu_law, "mu^N") == 1.0);
        CHECK(distortion_of(mu_law, "a/(mu*g)") == 1.0);
    }
}

// Froude input breaks mu^N by 1/sqrt(lambda_mu) and a/(mu g) by 1/lambda_mu: aluminium 1.8105 and 3.2778, wood 0.9677 and 0.9365.
TEST_CASE("under Froude input they do not, and the broken groups are named with their factors") {
    struct Case {
        double friction, mu_number, demand, least_difference;
    };
    for (const Case& c : {Case{0.18, 1.8105, 3.2778, 0.5}, Case{0.63, 0.9677, 0.9365, 0.02}}) {
        CAPTURE(c.friction);
        const Similitude froude = make_similitude("froude", {.length = 1.0 / 107.0, .friction = c.friction / kPrototypeFriction});
        CHECK(slip_difference(froude) > c.least_difference);
        CHECK(distortion_of(froude, "mu^N") == doctest::Approx(c.mu_number).epsilon(5e-5));
        CHECK(distortion_of(froude, "a/(mu*g)") == doctest::Approx(c.demand).epsilon(5e-5));
    }
}
