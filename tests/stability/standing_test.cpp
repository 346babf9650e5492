#include <doctest/doctest.h>

#include <cstddef>
#include <string>

#include "tests/stability/scenes.hpp"
#include "tests/stability/table.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

void check_standing(const std::string& name, const Model& column) {
    // What moves is the ringing of stuck joints, on which no dashpot acts: rounding, 1e-16 of the height of the column, sets it off, and a
    // slender column answers with a hundred times that. Closure and gain: rounding too.
    check_sound(name, observe(column, default_time_step(column), 60.0, 240),
                {.closure = 1e-6, .gain = 1e-9, .drift = 1e-9, .kinetic = 1e-9, .overlap = 1e-2});
}

}  // namespace

// Large blocks, because the step grows with the root of their size.
TEST_SUITE("stability-slow") {
    TEST_CASE("a column of 38 that was let go stands for a minute") {
        const Stone stone = at_length(wood(), 107.0);
        Model column = make_model(stone);
        for (std::size_t i = 0; i < 38; ++i)
            column.blocks.push_back(make_block(stone, {0.0, 0.0, (0.5 + static_cast<double>(i)) * stone.size.z()}));
        check_standing("column of 38, 60 s", column);
    }

    // A column of n joints of bending stiffness k_θ = k_n b²/12 buckles under its own weight from n³ = 7.84 k_θ/(m g H) on: 91 blocks of
    // the papers' wood, 195 cubes of it, 282 of cubes three times as stiff. Let go, 200 of them carry twice their weight again and again,
    // sway by parametric resonance, and ring on; so they start at rest.
    TEST_CASE("a column of 200 at rest stands for a minute") {
        Stone stone = wood();
        const double edge = stone.size.x(), area = edge * edge / stone.face_area();
        stone.size = Vector3::Constant(edge);
        stone = stiffened(stone, 3.0 * area);
        stone.nodes_per_face = 4;  // an even lattice, which the shape has to have
        check_standing("column of 200, 60 s", make_resting_column(at_length(stone, 856.0), 200));
    }
}
