#include "scaling/nearest_name.hpp"

#include <doctest/doctest.h>

using namespace musim::scaling;

TEST_CASE("the nearest name differs in a third of its letters at most, and the nearer of two wins") {
    const std::vector<std::string> known{"duration", "density", "dt", "x"};
    CHECK(find_nearest_name("duratoin", known) == "duration");
    CHECK(find_nearest_name("Density", known) == "density");
    CHECK(find_nearest_name("dtt", known) == "dt");
    CHECK(find_nearest_name("rnu", {"scale", "run"}) == "run");
    CHECK(find_nearest_name("velocity", known).empty());
    CHECK(find_nearest_name("y", known).empty());
    CHECK(find_nearest_name("densitx", {"intensity", "density"}) == "density");
    CHECK(suggest_name("velocity", known) == "known are duration, density, dt, x");
    CHECK(suggest_name("densty", known) == "did you mean \"density\"?");
    CHECK(hint_at_name("densty", known) == " (did you mean \"density\"?)");
    CHECK(hint_at_name("velocity", known).empty());
}
