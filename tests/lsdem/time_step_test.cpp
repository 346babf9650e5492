#include "lsdem/time_step.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "lsdem/motion/simulation.hpp"
#include "tests/support/models.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

Stone undamped(Stone stone) {
    stone.restitution = 1.0;
    return stone;
}

}  // namespace

// [Brillouin53]: the stiffest mode of a chain is 2 sqrt(k/m), its limit sqrt(m/k): 18.851 µs for wood.
TEST_CASE("without rotation the limit is that of a chain") {
    const Model model = make_resting_column(undamped(wood()), 5, true);
    CHECK(compute_critical_time_step(model) == relative(std::sqrt(wood().mass() / wood().normal_stiffness), 1e-9));
    CHECK(compute_critical_time_step(model) == relative(18.851e-6, 4e-5));
}

// Lagged damping: k dt²/(4m) + c dt/(2m) < 1 for the chain's stiffest mode, k = 4 k_n, c = 4 c_n, c_n = 2ζ sqrt(k_n m/2), that is
// x² + 2 sqrt(2) ζ x < 1 for x = ω0 dt. 11.59 µs for wood is the textbook's ζ = 0.357857, which gives e = 0.397140; e = 0.3 takes 0.497239.
TEST_CASE("damping lowers the limit of a chain as for the papers' wood") {
    for (const double restitution : {0.397140, 0.3}) {
        const double zeta = restitution == 0.3 ? 0.497239 : 0.357857, half = std::sqrt(2.0) * zeta;
        const double expected = (std::sqrt(1.0 + half * half) - half) * std::sqrt(wood().mass() / wood().normal_stiffness);
        Stone stone = wood();
        stone.restitution = restitution;
        Model model = make_resting_column(stone, 5, true);
        model.ground.present = false;  // where the effective mass, and with it the dashpot, is larger than between two blocks
        const double limit = compute_critical_time_step(model);
        CHECK(limit == relative(expected, 5e-6));
        if (restitution != 0.3) CHECK(limit == relative(11.59e-6, 5e-4));
    }
}

// Uniform rotation of all blocks against their shear springs: ω = sqrt(12 k_s H²/(m (b² + H²))) = 3.30 sqrt(k_s/m), when k_n is low enough.
TEST_CASE("the rotation of all blocks against their shear springs bounds the limit") {
    const Model model = make_resting_column(undamped(wood()), 5);
    const double b = wood().size.x(), h = wood().size.z();
    const double shear_rotation = std::sqrt(12.0 * wood().shear_stiffness * h * h / (wood().mass() * (b * b + h * h)));
    CHECK(shear_rotation == relative(3.30 * std::sqrt(wood().shear_stiffness / wood().mass()), 2e-3));
    const double limit = compute_critical_time_step(model);
    INFO("undamped limit over that of the shear-rotation mode: " << limit * shear_rotation / 2.0);
    // the bound counts single blocks, with the lattice's (1 + 2/(n − 1)²) for bending: on the safe side of the mode by a tenth or so
    CHECK(limit <= 2.0 / shear_rotation * (1.0 + 1e-12));
    CHECK(limit > 0.8 * 2.0 / shear_rotation);
}

TEST_CASE("the limit scales with the square root of mass over stiffness and is a number of the model alone") {
    Model model = make_resting_column(wood(), 3);
    const double limit = compute_critical_time_step(model);
    Model stiff = make_resting_column(stiffened(wood(), 4.0), 3);
    CHECK(compute_critical_time_step(stiff) == relative(0.5 * limit, 1e-12));
    model.blocks[0].fixed = true;
    CHECK(compute_critical_time_step(model) > 0.0);
    for (Block& block : model.blocks) block.fixed = true;
    CHECK_THROWS_AS(compute_critical_time_step(model), std::invalid_argument);
    Model limp = make_resting_column(wood(), 3);
    limp.materials[0].normal_stiffness = 0.0;
    CHECK_THROWS_AS(compute_critical_time_step(limp), std::invalid_argument);
}

TEST_CASE("a pair of materials that is stiffer than either counts") {
    Model model = make_resting_column(undamped(wood()), 5, true);
    const double limit = compute_critical_time_step(model);
    model.materials.push_back(model.materials[0]);
    model.blocks[2].material = 1;
    CHECK(compute_critical_time_step(model) == limit);
    Material joint = model.materials[0];
    joint.normal_stiffness *= 4.0;
    joint.shear_stiffness *= 4.0;
    model.pairs.push_back({0, 1, joint});
    CHECK(compute_critical_time_step(model) == relative(0.5 * limit, 1e-12));
}

TEST_CASE("a column is stable just below the chain limit and unstable just above it") {
    Model model = make_resting_column(undamped(wood()), 20, true);
    for (std::size_t i = 0; i < 20; ++i) model.blocks[i].velocity.z() = (i % 2 == 0 ? 1e-6 : -1e-6);
    const double limit = compute_critical_time_step(model);
    Simulation below(model, 0.99 * limit), above(model, 1.05 * limit);
    below.advance(20000);
    above.advance(20000);
    CHECK_FALSE(below.divergence().has_value());
    CHECK(below.energy().kinetic < 100.0 * 20.0 * 0.5 * wood().mass() * 1e-12);
    CHECK(above.energy().kinetic > 1e6 * 20.0 * 0.5 * wood().mass() * 1e-12);
}

// Blocks that lie press with faces three times as large, on springs as much stiffer.
TEST_CASE("the limit holds for blocks that lie on each other on their largest faces") {
    const Stone stone = wood();
    Model model = make_model(stone);
    for (std::size_t i = 0; i < 6; ++i)
        model.blocks.push_back(make_block(stone, {0.0, 0.0, (static_cast<double>(i) + 0.5) * stone.size.x()}, lying()));
    Simulation s(model, 0.8 * compute_critical_time_step(model));
    s.advance(20000);
    CHECK_FALSE(s.divergence().has_value());
    CHECK(s.base_reaction().z() == relative(6.0 * stone.weight(), 1e-3));
    CHECK(s.energy().kinetic < 1e-6 * 6.0 * stone.weight() * stone.size.x());
}
