#include "lsdem/finite_turn.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "lsdem/base_motion.hpp"

using namespace musim::lsdem;

TEST_CASE("the turn of a rotation vector is by its length about its direction") {
    CHECK(turn_by(Vector3::Zero()).coeffs() == Quaternion::Identity().coeffs());
    const Vector3 axis = Vector3(1.0, -2.0, 0.5).normalized();
    for (const double angle : {1e-12, 1e-3, 0.7, 2.0, 3.1, 5.0, 6.28}) {
        const Quaternion turn = turn_by(angle * axis);
        CHECK(std::abs(turn.w() - std::cos(0.5 * angle)) < 1e-15);
        CHECK((turn.vec() - std::sin(0.5 * angle) * axis).norm() < 1e-15);
    }
}

TEST_CASE("rates of a finite turn are those that its differences have") {
    const auto angle = [](double t) { return Vector3(0.3 + 0.5 * t, -1.1 * t * t, 0.9 * std::sin(2.0 * t)); };
    const auto rate = [](double t) { return Vector3(0.5, -2.2 * t, 1.8 * std::cos(2.0 * t)); };
    const auto acceleration = [](double t) { return Vector3(0.0, -2.2, -3.6 * std::sin(2.0 * t)); };
    const double t = 0.8, h = 1e-4;
    const TurnRates rates = find_turn_rates(angle(t), rate(t), acceleration(t));
    const Quaternion step = turn_by(angle(t + h)) * turn_by(angle(t - h)).conjugate();
    // central differences are off by h²
    CHECK((rates.velocity - step.vec() / h).norm() < 1e-7);
    const Vector3 before = find_turn_rates(angle(t - h), rate(t - h), acceleration(t - h)).velocity;
    const Vector3 after = find_turn_rates(angle(t + h), rate(t + h), acceleration(t + h)).velocity;
    CHECK((rates.acceleration - (after - before) / (2.0 * h)).norm() < 1e-6);
    // about one axis they are the derivatives
    const TurnRates simple = find_turn_rates({0.0, 1.3, 0.0}, {0.0, 0.4, 0.0}, {0.0, -2.0, 0.0});
    CHECK(simple.velocity == Vector3(0.0, 0.4, 0.0));
    CHECK(simple.acceleration == Vector3(0.0, -2.0, 0.0));
}

TEST_CASE("a base that turns rests until its first rate that is not zero") {
    BaseComponents components;
    components.turn[1] = {1.0, 0.5, {0.0, 0.0, 0.2, 0.0}};
    const BaseMotion motion(components);
    CHECK(motion.still_until(0.0) == 1.5);
    CHECK(motion.angle(2.5).y() == 0.1);
    CHECK(motion.turn_rates(2.0).velocity == Vector3(0.0, 0.2, 0.0));
    CHECK(motion.displacement(2.5) == Vector3::Zero());
}
