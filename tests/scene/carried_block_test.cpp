#include <doctest/doctest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/scene/build_model.hpp"
#include "tests/scene/made_scene.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;

namespace {

const std::string kShaken =
    R"(, "base_motion": {"signal": "sine", "direction": "x", "amplitude": "0.9 g", "frequency": "8 Hz", "cycles": 2})";
const std::string kCarriedBox = R"({"size": ["0.1 m", "0.1 m", "0.1 m"], "position": [0, 0, )";

/// Wood of one stiffness per area, whatever the first block.
const std::string kCarriedMaterial =
    R"({"preset": "wood", "normal_stiffness_per_area": "10 GPa/m", "shear_stiffness_per_area": "5 GPa/m"})";
constexpr double kStep = 5e-6;  // [s]

Simulation start(const std::string& blocks) {
    const Scene scene =
        parse_scene(R"({"schema": "musim-scene/1", "material": )" + kCarriedMaterial + R"(, "structure": {"kind": "blocks", "blocks": [)" +
                    blocks + "]}" + kShaken + R"(, "time": {"duration": "1 s"}})");
    return Simulation(make_model(scene), kStep);
}

Simulation start_on_plate(const std::string& held = R"("with_base": true)") {
    return start(R"({"size": ["0.3 m", "0.3 m", "0.1 m"], "position": [0, 0, "0.05 m"], )" + held + "}, " + kCarriedBox + "\"0.15 m\"]}");
}

}  // namespace

TEST_CASE("a box slides on a plate that moves with the base as on the ground") {
    Simulation plate = start_on_plate(), ground = start(kCarriedBox + "\"0.05 m\"]}");
    const auto steps = static_cast<std::uint64_t>(0.0625 / kStep);
    const double balance = plate.energy().balance();
    plate.advance(steps);
    ground.advance(steps);
    // half a cycle: the base has moved by A/(2π f)·t, and the box, whose friction is 0.63, not as far
    const double base = plate.base().displacement.x();
    CHECK(base == doctest::Approx(0.9 * 9.80665 / (2.0 * std::acos(-1.0) * 8.0) * 0.0625).epsilon(1e-3));
    CHECK(plate.position(0).x() == doctest::Approx(base).epsilon(1e-12));
    CHECK(base - plate.position(1).x() > 1e-4);
    // friction that starts and ends to slide within a step is what the two may differ by
    CHECK(plate.position(1).x() == doctest::Approx(ground.position(0).x()).epsilon(1e-6));
    CHECK(plate.base_reaction().z() == doctest::Approx(ground.base_reaction().z()).epsilon(1e-6));
    CHECK(plate.energy().base_work == doctest::Approx(ground.energy().base_work).epsilon(1e-6));
    CHECK(std::abs(plate.energy().balance() - balance) < 1e-3 * std::abs(plate.energy().base_work));
}

TEST_CASE("a plate that moves with the base has its velocity, one that is held has none") {
    Simulation moving = start_on_plate(), held = start_on_plate(R"("fixed": true)");
    const auto steps = static_cast<std::uint64_t>(0.0625 / kStep);
    moving.advance(steps);
    held.advance(steps);
    // half a cycle after the start the base is fastest: 2 A/(2π f)
    CHECK(moving.velocity(0).x() == doctest::Approx(2.0 * 0.9 * 9.80665 / (2.0 * std::acos(-1.0) * 8.0)).epsilon(0.02));
    CHECK(held.velocity(0).isZero(0.0));
    CHECK(held.position(0).x() == 0.0);
    CHECK(held.position(1).x() == 0.0);
}

TEST_CASE("a simulation with a block that moves with the base goes on from its saved state with the same bits") {
    Simulation whole = start_on_plate();
    whole.advance(1500);
    std::stringstream state;
    whole.save(state);
    Simulation rest = Simulation::restore(whole.model(), state);
    whole.advance(1500);
    rest.advance(1500);
    CHECK(rest.state_hash() == whole.state_hash());
    CHECK(rest.position(0) == whole.position(0));
}
