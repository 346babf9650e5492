#include "scaling/laws/named_groups.hpp"

#include <doctest/doctest.h>

#include "scaling/pi/pi_express.hpp"
#include "tests/scaling/pi_problems.hpp"

namespace musim::scaling::tests {

namespace {

std::string name_of(std::string_view product, const std::vector<PiQuantity>& quantities) {
    return recognised_text(recognise(parse_group(product, quantities), quantities));
}

}  // namespace

TEST_CASE("every named group is dimensionless and known by its own symbols") {
    for (const NamedGroup& named : named_groups()) {
        CAPTURE(named.formula);
        RationalDimension dimension;
        std::vector<PiQuantity> quantities;
        std::vector<Rational> exponents;
        for (const GroupRole& role : named.roles) {
            dimension = dimension * pow(role.dimension, role.exponent);
            // the first name of a role, where it has names
            const std::string_view name = role.names.empty() ? role.symbol : role.names.front();
            quantities.push_back({.name = std::string(name), .dimension = role.dimension, .value = {}});
            exponents.push_back(role.exponent);
        }
        CHECK(dimension.is_dimensionless());
        CHECK(recognised_text(recognise(exponents, quantities)) == named.name);
    }
}

TEST_CASE("groups are recognised in any power and inverse") {
    const auto quantities = make_problem({{"v", "m/s"},
                                          {"l", "m"},
                                          {"g", "gn"},
                                          {"mu", "1"},
                                          {"a", "gn"},
                                          {"rho", "kg/m^3"},
                                          {"E", "Pa"},
                                          {"eta", "Pa*s"},
                                          {"sigma", "N/m"},
                                          {"k_n", "MN/m"},
                                          {"c", "m/s"},
                                          {"u", "m"}});
    CHECK(name_of("v/sqrt(g*l)", quantities) == "Froude");
    CHECK(name_of("v^2/(g*l)", quantities) == "Froude^2");
    CHECK(name_of("g*l/v^2", quantities) == "1/Froude^2");
    CHECK(name_of("(v^2/(g*l))^(1/4)", quantities) == "Froude^(1/2)");
    CHECK(name_of("v^2/(mu*g*l)", quantities) == "mu number^2");
    CHECK(name_of("mu*g/a", quantities) == "1/sliding demand");
    CHECK(name_of("u*mu*g/v^2", quantities) == "Newmark slip");
    CHECK(name_of("rho*v^2/E", quantities) == "Cauchy^2");
    CHECK(name_of("eta/(rho*v*l)", quantities) == "1/Reynolds");
    CHECK(name_of("rho*v^2*l/sigma", quantities) == "Weber");
    CHECK(name_of("k_n/(rho*g*l^2)", quantities) == "kappa");
    CHECK(name_of("c/v", quantities) == "1/Mach");
    CHECK(name_of("E/(rho*g*l)", quantities) == "E/(rho*g*l)");
    CHECK(name_of("rho*g*l/E", quantities) == "1/(E/(rho*g*l))");
    CHECK(name_of("mu", quantities) == "");
    CHECK(name_of("l/u", quantities) == "");
}

TEST_CASE("the lumped strength of Andrade et al. makes the mu number, not Froude's") {
    const auto quantities = make_problem({{"v", "m/s"}, {"l", "m"}, {"mu g", "m/s^2"}});
    CHECK(name_of("v^2/(l*mu g)", quantities) == "mu number^2");
}

TEST_CASE("a quantity whose name does not give its role is said to stand for it") {
    const auto quantities = make_problem({{"v", "m/s"}, {"l", "m"}, {"b", "m/s^2"}, {"rho", "kg/m^3"}, {"s", "Pa"}});
    CHECK(name_of("v^2/(b*l)", quantities) == "Froude^2 with b as g");
    CHECK(name_of("s/(rho*v^2)", quantities) == "1/Cauchy^2 with s as E or Euler with s as p");
    // with gravity in the problem no other acceleration stands for it
    const auto with_gravity = make_problem({{"v", "m/s"}, {"l", "m"}, {"a", "m/s^2"}, {"g", "m/s^2"}});
    CHECK(name_of("v^2/(a*l)", with_gravity) == "");
}

}  // namespace musim::scaling::tests
