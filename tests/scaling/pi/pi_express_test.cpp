#include "scaling/pi/pi_express.hpp"

#include <doctest/doctest.h>

#include "tests/scaling/pi_problems.hpp"

namespace musim::scaling::tests {

namespace {

std::vector<PiQuantity> sliding() {
    return make_problem({{"v", "m/s"}, {"a", "gn"}, {"l", "m"}, {"mu", "1"}, {"g", "gn"}, {"rho", "kg/m^3"}});
}

}  // namespace

TEST_CASE("a group is read from text") {
    const auto quantities = sliding();
    const auto text_of = [&](std::string_view text) { return format_group(parse_group(text, quantities), quantities); };
    CHECK(text_of("v^2/(g*l)") == "v^2/(l*g)");
    CHECK(text_of("v/sqrt(mu g l)") == "v/(l^(1/2)*mu^(1/2)*g^(1/2))");
    CHECK(text_of("1/v**-2") == "v^2");
    CHECK(text_of("v/l/g") == "v/(l*g)");
    CHECK(text_of("(v^0.5)^(4/3)") == "v^(2/3)");
    CHECK(text_of("a a / g") == "a^2/g");
    CHECK(text_of("mu/mu") == "1");
    const auto blank = make_problem({{"mu g", "m/s^2"}, {"mu", "1"}, {"a", "m/s^2"}});
    CHECK(format_group(parse_group("a/mu g", blank), blank) == "a/mu g");
}

TEST_CASE("text that is no product is refused with the reason") {
    const auto quantities = sliding();
    const auto refusal = [&](std::string_view text) { return pi_error([&] { parse_group(text, quantities); }); };
    for (const char* text : {"", "v^", "v^x", "v*", "v/", "(v", "v)", "sqrt v", "2*v", "v^(1/0)", "v^99999999", "v+l", "*v"}) {
        CHECK_MESSAGE(!refusal(text).empty(), text);
    }
    CHECK(refusal("v^2/(g*ll)") == "\"ll\" is no quantity of the problem; did you mean \"l\"?");
    CHECK(refusal("2*v").find("the number 2 has no place") != std::string::npos);
    CHECK(refusal(std::string(2000, '(')) == "the group is too long; shorten it");
}

TEST_CASE("a group is expressed over a basis exactly") {
    const auto quantities = sliding();
    const PiBasis basis = find_pi_basis(quantities, {"rho", "l", "g"});  // v^2/(l*g), a/g, mu
    const auto powers_of = [&](std::string_view text) { return express(parse_group(text, quantities), basis.groups, quantities); };
    CHECK(powers_of("v/sqrt(mu*g*l)") == std::vector<Rational>{{1, 2}, 0, {-1, 2}});
    CHECK(powers_of("a/(mu*g)") == std::vector<Rational>{0, 1, -1});
    CHECK(powers_of("(v^2/(a*l))^(1/3)") == std::vector<Rational>{{1, 3}, {-1, 3}, 0});
    CHECK(powers_of("1") == std::vector<Rational>{0, 0, 0});
    CHECK(pi_error([&] { powers_of("v^2/g"); }) == "v^2/g is not dimensionless: it is a length; correct its exponents");
    CHECK(pi_error([&] { express(parse_group("a/g", quantities), {basis.groups[0]}, quantities); }) ==
          "a/g is no product of the groups; add one that holds what they lack");
}

}  // namespace musim::scaling::tests
