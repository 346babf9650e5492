#include "scaling/pi/pi_groups.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "scaling/pi/pi_remarks.hpp"
#include "tests/scaling/pi_problems.hpp"

namespace musim::scaling::tests {

namespace {

/// [Andrade22] eq. (1): f(v; a; l; mu g; rho) = 0.
std::vector<PiQuantity> tower() { return make_problem({{"v", "m/s"}, {"a", "m/s^2"}, {"l", "m"}, {"mu_g", "m/s^2"}, {"rho", "kg/m^3"}}); }

Texts unused_reasons(const std::vector<PiQuantity>& quantities) {
    Texts reasons;
    for (const UnusedQuantity& unused : explain_unused(quantities, find_pi_basis(quantities))) reasons.push_back(unused.why);
    return reasons;
}

}  // namespace

TEST_CASE("equation (1) of Andrade et al. has rank three, two groups, and rho explained away") {
    const auto quantities = tower();
    CHECK(find_pi_basis(quantities).rank() == 3);
    CHECK(groups_of(quantities) == Texts{"a*l/v^2", "mu_g/a"});
    CHECK(groups_of(quantities, {"l", "mu_g", "rho"}) == Texts{"v^2/(l*mu_g)", "a/mu_g"});
    CHECK(unused_reasons(quantities) == Texts{"rho cannot take part: it alone carries mass"});
}

TEST_CASE("friction apart from gravity is a third group") {
    const auto quantities = make_problem({{"v", "m/s"}, {"a", "m/s^2"}, {"l", "m"}, {"mu", "1"}, {"g", "gn"}, {"rho", "kg/m^3"}});
    CHECK(groups_of(quantities, {"l", "g"}) == Texts{"v^2/(l*g)", "a/g", "mu"});
}

TEST_CASE("classic problems have their known groups") {
    // pendulum: the mass is in none
    const auto pendulum = make_problem({{"T", "s"}, {"l", "m"}, {"g", "m/s^2"}, {"m", "kg"}});
    CHECK(groups_of(pendulum) == Texts{"T^2*g/l"});
    CHECK(unused_reasons(pendulum) == Texts{"m cannot take part: it alone carries mass"});
    // drag on a sphere
    const auto sphere = make_problem({{"F", "N"}, {"v", "m/s"}, {"d", "m"}, {"rho", "kg/m^3"}, {"eta", "Pa*s"}});
    CHECK(groups_of(sphere, {"v", "d", "rho"}) == Texts{"F/(v^2*d^2*rho)", "eta/(v*d*rho)"});
    // pipe flow: pressure drop per length
    const auto pipe = make_problem({{"dp_dx", "Pa/m"}, {"v", "m/s"}, {"D", "m"}, {"rho", "kg/m^3"}, {"eta", "Pa*s"}, {"eps", "mm"}});
    CHECK(groups_of(pipe, {"v", "D", "rho"}) == Texts{"dp_dx*D/(v^2*rho)", "eta/(v*D*rho)", "eps/D"});
    // Rayleigh jet: frequency of break-up by surface tension
    const auto jet = make_problem({{"f", "Hz"}, {"rho", "kg/m^3"}, {"d", "m"}, {"sigma", "N/m"}});
    CHECK(groups_of(jet, {"rho", "d", "sigma"}) == Texts{"f^2*rho*d^3/sigma"});
    // ship resistance
    const auto ship = make_problem({{"R", "N"}, {"v", "m/s"}, {"l", "m"}, {"rho", "kg/m^3"}, {"g", "m/s^2"}, {"nu", "m^2/s"}});
    CHECK(groups_of(ship, {"v", "l", "rho"}) == Texts{"R/(v^2*l^2*rho)", "l*g/v^2", "nu/(v*l)"});
    // Taylor blast
    const auto blast = make_problem({{"R", "m"}, {"E", "J"}, {"rho", "kg/m^3"}, {"t", "s"}});
    CHECK(groups_of(blast, {"E", "rho", "t"}) == Texts{"R^5*rho/(E*t^2)"});
    // rocking block [Housner63]: the mass is in none, the angle is a group by itself
    const auto block = make_problem({{"omega", "rad/s"}, {"a", "m/s^2"}, {"R", "m"}, {"g", "m/s^2"}, {"alpha", "deg"}, {"m", "kg"}});
    CHECK(groups_of(block, {"R", "g"}) == Texts{"omega^2*R/g", "a/g", "alpha"});
}

// pint's basis of its manual's pipe depends on the hash seed, and {L^2, T^3, L T} gives it fractions
TEST_CASE("problems that others answer in several ways have one answer in whole numbers") {
    const auto flow = make_problem({{"V", "m/s"}, {"T", "s"}, {"L", "m"}});
    CHECK(groups_of(flow) == Texts{"L/(V*T)"});
    const auto powers = make_problem({{"A", "m^2"}, {"B", "s^3"}, {"C", "m*s"}});
    CHECK(groups_of(powers) == Texts{"C^6/(A^3*B^2)"});
}

// users of other tools lose the mole or the root in a unit
TEST_CASE("fractional powers and all base dimensions take part exactly") {
    // crack: toughness, stress, length
    CHECK(groups_of(make_problem({{"K", "MPa m^0.5"}, {"s", "Pa"}, {"a", "mm"}})) == Texts{"s^2*a/K^2"});
    // Fourier number of a heated body: a = k/(rho c)
    const auto heat = make_problem({{"k", "W/(m K)"}, {"rho", "kg/m^3"}, {"c", "J/(kg K)"}, {"l", "m"}, {"t", "s"}});
    CHECK(groups_of(heat, {"rho", "c", "l", "t"}) == Texts{"k*t/(rho*c*l^2)"});
    // ohmic heating: U I t/E
    CHECK(groups_of(make_problem({{"U", "V"}, {"I", "A"}, {"t", "s"}, {"E", "J"}})) == Texts{"E/(U*I*t)"});
}

TEST_CASE("the rank counts, not the number of base dimensions") {
    // force and length only ever as N and m: mass and time are tied
    const auto beam = make_problem({{"F", "N"}, {"E", "Pa"}, {"l", "m"}, {"w", "m"}});
    CHECK(find_pi_basis(beam).rank() == 2);
    CHECK(groups_of(beam, {"E", "l"}) == Texts{"F/(E*l^2)", "w/l"});
}

TEST_CASE("what cannot take part is reported with the combination that it alone carries") {
    CHECK(
        unused_reasons(make_problem({{"F", "N"}, {"k", "N/m"}, {"u", "m"}, {"c", "N*s/m"}})) ==
        Texts{"c cannot take part: it alone carries mass and time as kg s^-1, which no product of the others does: they have kg s^-2 (F), "
              "kg s^-2 (k)"});
    CHECK(unused_reasons(make_problem({{"v", "m/s"}})) == Texts{"v cannot take part: it alone carries length"});
    CHECK(unused_reasons(make_problem({{"v", "m/s"}, {"mu", "1"}, {"T", "K"}})) ==
          Texts{"v cannot take part: it alone carries length", "T cannot take part: it alone carries temperature"});
    CHECK(groups_of(make_problem({{"v", "m/s"}, {"mu", "1"}})) == Texts{"mu"});
}

TEST_CASE("plain numbers, angles, equal dimensions and quantities tied to each other are remarked") {
    const auto quantities =
        make_problem({{"alpha", "deg"}, {"mu", "%"}, {"l", "m"}, {"b", "mm"}, {"v", "m/s"}, {"rho", "kg/m^3"}, {"E", "GPa"}, {"g", "gn"}});
    const Texts remarks = find_remarks(quantities, find_pi_basis(quantities));
    CHECK(remarks == Texts{"alpha is an angle: a group by itself", "mu is a plain number: a group by itself",
                           "l, b have one dimension: each of their ratios is dimensionless", "rho and E take part as rho/E only"});
}

TEST_CASE("repeating quantities that cannot be are refused with the culprit") {
    const auto quantities = make_problem({{"v", "m/s"}, {"l", "m"}, {"g", "gn"}, {"mu", "1"}, {"E", "Pa"}, {"rho", "kg/m^3"}});
    const auto refusal = [&](const std::vector<std::string>& repeating) { return pi_error([&] { find_pi_basis(quantities, repeating); }); };
    CHECK(refusal({"E", "v", "l", "g"}) == "repeating v, l, g: they are dependent (l*g/v^2 is dimensionless); replace one of them");
    CHECK(refusal({"v", "l"}) == "repeating v, l: 2 of 3 needed, mass is missing; add one of E, rho");
    CHECK(refusal({"E", "rho"}) == "repeating E, rho: 2 of 3 needed, they make up too few dimensions; add one of l, g");
    CHECK(refusal({"mu"}) == "repeating mu: it is dimensionless, a group by itself; name another quantity");
    CHECK(refusal({"v", "v"}) == "repeating v: it is there twice; name it once");
    CHECK(refusal({"rh"}) == "\"rh\" is no quantity of the problem; did you mean \"rho\"?");
    CHECK(refusal({"v", "l", "E"}).empty());
}

TEST_CASE("all bases are found once each, and a limit is reported") {
    const auto quantities = tower();
    const PiBases all = find_all_pi_bases(quantities, 100);
    CHECK(all.complete);
    // two of v, a, l, mu_g, not a and mu_g, with rho: five choices, of which two lead to the groups of others
    std::vector<Texts> sets;
    for (const PiBasis& basis : all.bases) sets.push_back(group_texts(basis, quantities));
    CHECK(sets == std::vector<Texts>{{"a*l/v^2", "mu_g/a"}, {"a*l/v^2", "l*mu_g/v^2"}, {"a/mu_g", "l*mu_g/v^2"}});
    const PiBases some = find_all_pi_bases(quantities, 2);
    CHECK(some.bases.size() == 2);
    CHECK_FALSE(some.complete);
    CHECK(find_all_pi_bases(quantities, 3).complete);
}

TEST_CASE("values of groups are those of their formula, to the last bit for units scaled by powers of two, and never overflow on the way") {
    auto quantities = make_problem({{"v", "m/s"}, {"l", "m"}, {"g", "m/s^2"}});
    const PiGroup froude = {2, -1, -1};
    CHECK_FALSE(group_value(froude, quantities).has_value());
    quantities[0].value = 0.424;
    quantities[1].value = 161.5;
    quantities[2].value = 9.80665;
    const double value = *group_value(froude, quantities);
    // square, product, quotient: three roundings of 1.1e-16
    CHECK(value == doctest::Approx(0.424 * 0.424 / (161.5 * 9.80665)).epsilon(5e-16));
    // another unit of length and time: l/16, t/4
    quantities[0].value = 0.424 / 4.0;
    quantities[1].value = 161.5 / 16.0;
    CHECK(*group_value(froude, quantities) == value);
    quantities[0].value = 1e200;
    quantities[1].value = 1e200;
    quantities[2].value = 1e200;
    CHECK(*group_value(froude, quantities) == doctest::Approx(1.0).epsilon(5e-16));
    quantities[1].value = 0.0;
    CHECK_FALSE(group_value(froude, quantities).has_value());
}

}  // namespace musim::scaling::tests
