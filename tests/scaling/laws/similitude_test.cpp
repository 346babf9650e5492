#include "scaling/laws/law_similitude.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "tests/scaling/expected.hpp"

namespace musim::scaling::tests {

namespace {

bool is_power_of_two(double value) {
    int exponent = 0;
    return std::frexp(value, &exponent) == 0.5;
}

std::string similitude_message(const ScaleFactors& chosen, const char* law = "mu") {
    try {
        const Similitude similitude = make_similitude(law, chosen);
    } catch (const SimilitudeError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("an unknown law is answered with the list") {
    CHECK(similitude_message({}, "Froude").find("there is no law \"Froude\" (did you mean \"froude\"?); choose one of artificial_mass,") !=
          std::string::npos);
}

TEST_CASE("the laws scale time, velocity and acceleration by their closed forms") {
    const ScaleFactors chosen{.length = 0.03, .friction = 0.4, .gravity = 1.7, .density = 0.6};
    const double l = chosen.length;
    const double u = chosen.friction;
    const double g = chosen.gravity;
    const double r = chosen.density;

    const Similitude mu = make_similitude("mu", chosen);
    CHECK_EXPECTED(mu.time(), std::sqrt(l / (u * g)));
    CHECK_EXPECTED(mu.velocity(), std::sqrt(l * u * g));
    CHECK_EXPECTED(mu.acceleration(), u * g);

    const Similitude froude = make_similitude("froude", chosen);
    CHECK_EXPECTED(froude.time(), std::sqrt(l / g));
    CHECK_EXPECTED(froude.velocity(), std::sqrt(l * g));
    CHECK_EXPECTED(froude.acceleration(), g);

    // same modulus: wave speeds, hence velocities, scale by √(1/λ_ρ)
    const Similitude cauchy = make_similitude("cauchy", chosen);
    CHECK_EXPECTED(cauchy.time(), l * std::sqrt(r));
    CHECK_EXPECTED(cauchy.velocity(), 1.0 / std::sqrt(r));
    CHECK_EXPECTED(cauchy.stress(), 1.0);
    CHECK_EXPECTED((make_similitude("cauchy", {.length = l}).velocity()), 1.0);
}

TEST_CASE("factors of the mu law follow the table of powers") {
    const ScaleFactors chosen{.length = 0.03, .friction = 0.4, .gravity = 1.7, .density = 0.6};
    const double l = chosen.length;
    const double u = chosen.friction;
    const double g = chosen.gravity;
    const double r = chosen.density;
    const Similitude mu = make_similitude("mu", chosen);
    const double a = u * g;

    CHECK_EXPECTED(mu.frequency(), std::sqrt(a / l));
    CHECK_EXPECTED(mu.factor<AngularAcceleration>(), a / l);
    CHECK_EXPECTED(mu.mass(), r * std::pow(l, 3));
    CHECK_EXPECTED(mu.inertia(), r * std::pow(l, 5));
    CHECK_EXPECTED(mu.force(), r * std::pow(l, 3) * a);
    CHECK_EXPECTED(mu.force_vertical(), r * std::pow(l, 3) * g);
    CHECK_EXPECTED(mu.moment(), r * std::pow(l, 4) * a);
    CHECK_EXPECTED(mu.stress(), r * l * a);
    CHECK_EXPECTED(mu.stress_vertical(), r * l * g);
    CHECK_EXPECTED(mu.stiffness(), r * l * l * a);
    CHECK_EXPECTED(mu.stiffness_static(), r * l * l * g);
    CHECK_EXPECTED(mu.factor<StiffnessPerArea>(), r * a);
    CHECK_EXPECTED(mu.damping(), r * std::pow(l, 2.5) * std::sqrt(a));
    CHECK_EXPECTED(mu.energy(), r * std::pow(l, 4) * a);
    CHECK_EXPECTED(mu.energy_potential(), r * std::pow(l, 4) * g);
    CHECK_EXPECTED(mu.power(), r * std::pow(l, 3.5) * std::pow(a, 1.5));
    CHECK_EXPECTED(mu.momentum(), r * std::pow(l, 3.5) * std::sqrt(a));
    CHECK_EXPECTED(mu.arias_intensity(), std::sqrt(l * a) * u);
}

TEST_CASE("the Cauchy law and a centrifuge of gravity 1/length scale the same solid alike") {
    const double l = 0.03;
    const Similitude cauchy = make_similitude("cauchy", {.length = l});
    const Similitude centrifuge = make_similitude("exact", {.length = l, .gravity = 1.0 / l});
    for (const Similitude& similitude : {cauchy, centrifuge}) {
        CHECK_EXPECTED(similitude.time(), l);
        CHECK_EXPECTED(similitude.velocity(), 1.0);
        CHECK_EXPECTED(similitude.acceleration(), 1.0 / l);
        CHECK_EXPECTED(similitude.force(), l * l);
        CHECK_EXPECTED(similitude.stiffness(), l);
        CHECK_EXPECTED(similitude.factor<StiffnessPerArea>(), 1.0 / l);
        CHECK_EXPECTED(similitude.damping(), l * l);
        CHECK_EXPECTED(similitude.energy(), l * l * l);
        CHECK_EXPECTED(similitude.power(), l * l);
        CHECK_EXPECTED(similitude.momentum(), l * l * l);
    }
    CHECK_EXPECTED(cauchy.arias_intensity(), 1.0 / l);
    CHECK_EXPECTED(centrifuge.arias_intensity(), 1.0);
}

TEST_CASE("lengths that are powers of four give factors that are exact powers of two") {
    for (const double length : {1.0 / 16.0, 1.0 / 64.0, 4.0}) {
        for (const double gravity : {1.0, 4.0}) {
            for (const double density : {1.0, 0.5}) {
                for (const char* law : {"mu", "froude", "exact"}) {
                    const Similitude similitude = make_similitude(law, {.length = length, .gravity = gravity, .density = density});
                    for (const NamedFactor& factor : similitude.factors()) {
                        CAPTURE(factor.name);
                        CHECK(is_power_of_two(factor.value));
                    }
                }
            }
        }
    }
    CHECK(make_similitude("mu", {.length = 1.0 / 16.0}).time() == 0.25);
    CHECK(make_similitude("mu", {.length = 1.0 / 64.0}).damping() == std::ldexp(1.0, -15));
    // the roots are taken of λ_l/λ_a and λ_l λ_a, not of each: 1/8 and 2 are no squares, 1/16 and 1/4 are
    CHECK(make_similitude("mu", {.length = 1.0 / 8.0, .gravity = 2.0}).time() == 0.25);
    CHECK(make_similitude("mu", {.length = 1.0 / 8.0, .gravity = 2.0}).velocity() == 0.5);
}

TEST_CASE("at the same gravity and friction accelerations are not touched by rounding") {
    for (int denominator = 1; denominator <= 200; ++denominator) {
        const Similitude similitude = make_similitude("mu", {.length = 1.0 / denominator});
        CHECK(similitude.factor<Acceleration>() == 1.0);
        CHECK(similitude.factor<Length>() == similitude.length());
        CHECK(similitude.factor<Density>() == 1.0);
        CHECK(similitude.factor<Ratio>() == 1.0);
    }
}

TEST_CASE("a quantity taken to the model and back is the same, bit for bit when the length is a power of four") {
    std::mt19937 random{7};
    std::uniform_real_distribution<double> value{-1e3, 1e3};
    const Similitude exact = make_similitude("exact", {.length = 1.0 / 16.0});
    const Similitude wood = make_similitude("mu", {.length = 1.0 / 107.0, .friction = 0.63 / 0.59, .density = 800.0 / 2320.0});
    for (int i = 0; i < 100; ++i) {
        const Velocity velocity = value(random) * si::meters_per_second;
        const Damping damping = Damping::from_value(value(random));
        CHECK(exact.to_prototype(exact.to_model(velocity)) == velocity);
        CHECK(exact.to_prototype(exact.to_model(damping)) == damping);
        CHECK_EXPECTED(wood.to_prototype(wood.to_model(velocity)).value(), velocity.value());
        CHECK_EXPECTED(wood.to_prototype(wood.to_model(damping)).value(), damping.value());
    }
}

TEST_CASE("factors multiply as their quantities do") {
    const Similitude similitude = make_similitude("mu", {.length = 1.0 / 107.0, .friction = 0.3, .gravity = 2.0, .density = 0.7});
    CHECK_EXPECTED(similitude.mass() * similitude.acceleration(), similitude.force());
    CHECK_EXPECTED(similitude.force() * similitude.velocity(), similitude.power());
    CHECK_EXPECTED(similitude.damping() * similitude.velocity(), similitude.force());
    CHECK_EXPECTED(similitude.momentum(), similitude.force() * similitude.time());
    CHECK_EXPECTED(similitude.inertia() * similitude.factor<AngularAcceleration>(), similitude.moment());
}

TEST_CASE("the list of factors begins with the keys that files rely on and names each once") {
    const std::vector<NamedFactor> factors = make_similitude("mu", {.length = 0.25}).factors();
    const std::vector<std::string> leading = {"length", "time", "velocity", "acceleration", "mass", "force", "stiffness", "damping"};
    REQUIRE(factors.size() > leading.size());
    for (std::size_t i = 0; i < leading.size(); ++i) CHECK(factors[i].name == leading[i]);
    std::set<std::string_view> names;
    for (const NamedFactor& factor : factors) CHECK(names.insert(factor.name).second);
}

TEST_CASE("factors that cannot be are refused with the reason") {
    for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        CHECK(similitude_message({.length = bad}).find("must be positive and finite") != std::string::npos);
        CHECK(similitude_message({.friction = bad}).find("must be positive and finite") != std::string::npos);
        CHECK(similitude_message({.gravity = bad}).find("must be positive and finite") != std::string::npos);
        CHECK(similitude_message({.density = bad}).find("must be positive and finite") != std::string::npos);
    }
    CHECK(similitude_message({.length = 1e-80}).find("leaves the range of doubles") != std::string::npos);
    CHECK(similitude_message({.friction = 0.9}, "exact").find("law exact: mu = 0.9 cannot be where mu is held") != std::string::npos);
    CHECK(similitude_message({.friction = 0.9}, "froude").empty());
}

}  // namespace musim::scaling::tests
