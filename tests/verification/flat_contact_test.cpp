#include <doctest/doctest.h>

#include <cmath>

#include "lsdem/motion/simulation.hpp"
#include "tests/support/faces.hpp"
#include "tests/support/models.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Load and energy of two bodies whose rims are flush, over K [m³, m⁴].
struct Flat {
    double force, energy;
};

/// Up to half of the width b the closed form of `flat_stiffness`; deeper, the middle line is as deep as it gets, b/2 below the sides, and
/// each layer adds the integral of the depth below them, that of a hipped roof, b² w/4 − b³/12.
Flat press_flat(const Vector3& size, double d) {
    const double b = std::min(size.x(), size.y()), w = std::max(size.x(), size.y()), roof = b * b * w / 4.0 - b * b * b / 12.0;
    const double within = std::min(d, 0.5 * b), cube = within * within * within;
    const double energy = 0.5 * b * w * within * within - (b + w) * cube / 3.0 + within * cube / 3.0;
    return {d < 0.5 * b ? d * flat_stiffness(size, d, 2) : roof, energy + roof * (d - within)};
}

}  // namespace

// E = K/2 ∫ (d_A + d_B) dV, F = −dE/dx, at any depth: also where no point of one block is nearest to the face that it came through.
TEST_CASE("a block pressed flat into another bears and stores the closed form however deep") {
    const Stone stone = wood();
    Model model = make_model(stone);
    model.gravity.setZero();
    model.ground.present = false;
    model.blocks.assign(2, make_block(stone, Vector3::Zero()));
    for (const double part : {1e-6, 1e-4, 0.01, 0.1, 0.3, 0.49, 0.51, 0.7, 0.9}) {
        CAPTURE(part);
        const double d = part * stone.size.x();
        model.blocks[1].position.z() = stone.size.z() - d;
        const Simulation s(model, 1e-6);
        const double stiffness = model.materials[0].normal_stiffness;
        const Flat exact = press_flat(stone.size, d);
        // rounding of heights over the overlap
        const double rounding = 10.0 * 1e-16 * stone.size.z() / d + 1e-13;
        CHECK(s.contact_force(1).z() == relative(stiffness * exact.force, rounding));
        CHECK(s.energy().elastic_normal == relative(stiffness * exact.energy, 2.0 * rounding));
    }
}
