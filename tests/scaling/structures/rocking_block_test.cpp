#include "scaling/structures/rocking_block.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "scaling/angle.hpp"
#include "tests/scaling/expected.hpp"

namespace musim::scaling::tests {

namespace {

const RockingBlock kThinBlock{.width = 1.36 * si::meters, .height = 4.25 * si::meters};
const RockingBlock kWideBlock{.width = 2.82 * si::meters, .height = 4.25 * si::meters};

}  // namespace

TEST_CASE("the prototype block rocks with its reference size, slenderness, frequency and restitution") {
    CHECK_EXPECTED(kThinBlock.half_diagonal().value(), "2.2311");
    CHECK_EXPECTED(kThinBlock.angle() / kDegree, "17.745");
    CHECK_EXPECTED(kThinBlock.frequency_parameter(kStandardGravity).value(), "1.8156");
    CHECK_EXPECTED(kThinBlock.angular_restitution(), "0.8607");  // √0.7407
    CHECK_EXPECTED(kThinBlock.energy_restitution(), "0.7407");
    CHECK_EXPECTED(kWideBlock.half_diagonal().value(), "2.5502");
    CHECK_EXPECTED(kWideBlock.angle() / kDegree, "33.565");
    CHECK_EXPECTED(kWideBlock.frequency_parameter(kStandardGravity).value(), "1.6982");
    CHECK_EXPECTED(kWideBlock.energy_restitution(), "0.2932");
}

TEST_CASE("p of a model grows by the root of gravity over length, the restitution stays") {
    // λ_p = √(λ_g/λ_l); powers of two, so to the last bit
    const RockingBlock model{.width = kThinBlock.width / 16.0, .height = kThinBlock.height / 16.0};
    CHECK(model.frequency_parameter(4.0 * kStandardGravity) == 8.0 * kThinBlock.frequency_parameter(kStandardGravity));
    CHECK(model.energy_restitution() == kThinBlock.energy_restitution());
}

TEST_CASE("friction needed to rock is tan alpha where rocking starts, and that of the moment balance above") {
    for (const double slenderness : {0.05, 0.32, 0.6635, 1.5}) {
        CHECK_EXPECTED(find_friction_to_rock(slenderness, slenderness), slenderness);

        // moment balance about the edge in SI units: mass 1, height 2, width 2 tan α
        const double acceleration = 3.0 * slenderness, b = slenderness, h = 1.0;  // [g], half sizes
        const double rotation = (acceleration * h - b) / (4.0 / 3.0 * (b * b + h * h));
        const double base_force = acceleration - h * rotation, weight = 1.0 + b * rotation;
        CHECK_EXPECTED(find_friction_to_rock(acceleration, slenderness), base_force / weight);
    }
}

TEST_CASE("a block rests, slides, rocks or does both on the right side of each border") {
    const double slenderness = 0.32;
    CHECK(find_first_motion(0.31, 0.59, slenderness) == FirstMotion::rest);
    CHECK(find_first_motion(0.33, 0.59, slenderness) == FirstMotion::rock);
    CHECK(find_first_motion(0.17, 0.18, slenderness) == FirstMotion::rest);
    CHECK(find_first_motion(0.19, 0.18, slenderness) == FirstMotion::slide);
    CHECK(find_first_motion(5.00, 0.18, slenderness) == FirstMotion::slide);
    const double needed = find_friction_to_rock(1.5, slenderness);
    CHECK(needed > slenderness);
    CHECK(find_first_motion(1.5, 1.001 * needed, slenderness) == FirstMotion::rock);
    CHECK(find_first_motion(1.5, 0.999 * needed, slenderness) == FirstMotion::slide_rock);
}

}  // namespace musim::scaling::tests
