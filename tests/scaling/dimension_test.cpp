#include "scaling/dimension.hpp"

#include <doctest/doctest.h>

#include <boost/units/pow.hpp>
#include <cmath>

#include "scaling/laws/law_similitude.hpp"
#include "scaling/units.hpp"
#include "tests/scaling/expected.hpp"

namespace musim::scaling::tests {

TEST_CASE("exponents are read from the quantity types, twice each") {
    CHECK(dimension_of<Ratio>() == Dimension{});
    CHECK(dimension_of<Length>() == Dimension{.length = 2});
    CHECK(dimension_of<Volume>() == Dimension{.length = 6});
    CHECK(dimension_of<Frequency>() == Dimension{.time = -2});
    CHECK(dimension_of<AngularAcceleration>() == Dimension{.time = -4});
    CHECK(dimension_of<Velocity>() == Dimension{.length = 2, .time = -2});
    CHECK(dimension_of<Acceleration>() == Dimension{.length = 2, .time = -4});
    CHECK(dimension_of<Density>() == Dimension{.length = -6, .mass = 2});
    CHECK(dimension_of<Force>() == Dimension{.length = 2, .mass = 2, .time = -4});
    CHECK(dimension_of<Stress>() == Dimension{.length = -2, .mass = 2, .time = -4});
    CHECK(dimension_of<Stiffness>() == Dimension{.mass = 2, .time = -4});
    CHECK(dimension_of<StiffnessPerArea>() == Dimension{.length = -4, .mass = 2, .time = -4});
    CHECK(dimension_of<Damping>() == Dimension{.mass = 2, .time = -2});
    CHECK(dimension_of<Moment>() == dimension_of<Energy>());
    CHECK(dimension_of<Inertia>() == Dimension{.length = 4, .mass = 2});
    CHECK(dimension_of<Power>() == Dimension{.length = 4, .mass = 2, .time = -6});
    CHECK(dimension_of<Momentum>() == Dimension{.length = 2, .mass = 2, .time = -2});
}

TEST_CASE("roots of quantities scale by the root of their factor") {
    using RootLength = units::root_typeof_helper<Length, units::static_rational<2>>::type;
    using RootTime = units::root_typeof_helper<Time, units::static_rational<2>>::type;
    CHECK(dimension_of<RootLength>() == Dimension{.length = 1});

    const Similitude similitude = make_similitude("mu", {.length = 1.0 / 107.0, .friction = 0.63 / 0.59});
    CHECK_EXPECTED(similitude.factor<RootLength>(), std::sqrt(similitude.length()));
    CHECK_EXPECTED(similitude.factor<RootTime>(), std::sqrt(similitude.time()));
    CHECK(make_similitude("mu", {.length = 1.0 / 256.0}).factor<RootTime>() == 0.25);
}

}  // namespace musim::scaling::tests
