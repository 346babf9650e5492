#include "lsdem/contact_law.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using musim::lsdem::tests::relative;

// [SchwagerPoeschel07], tension cut: e = exp(−2ζ acos ζ/sqrt(1 − ζ²)).
TEST_CASE("the damping ratio of a coefficient of restitution is that of a contact that never pulls") {
    struct Row {
        double restitution, ratio;
    };
    constexpr std::array<Row, 4> kTable{{{0.3, 0.497239}, {0.5, 0.255276}, {0.7, 0.122215}, {0.9, 0.034265}}};
    for (const Row& row : kTable) CHECK(std::abs(compute_damping_ratio(row.restitution) - row.ratio) < 5.1e-7);
    CHECK(compute_damping_ratio(1.0) == doctest::Approx(0.0));
    // e = e⁻² is critical damping; 0.397140 is what the textbook's ratio for 0.3 really gives
    CHECK(compute_damping_ratio(std::exp(-2.0)) == relative(1.0, 1e-7));
    CHECK(std::abs(compute_restitution(0.357857) - 0.397140) < 1e-6);
}

TEST_CASE("restitution and damping ratio are inverse to each other") {
    for (const double e : {1e-3, 0.01, 0.1, 0.2, 0.4, 0.8, 0.99, 1.0})
        CHECK(compute_restitution(compute_damping_ratio(e)) == relative(e, 1e-12));
    CHECK_THROWS_AS(compute_damping_ratio(0.0), std::invalid_argument);
    CHECK_THROWS_AS(compute_damping_ratio(1.01), std::invalid_argument);
    CHECK_THROWS_AS(compute_damping_ratio(std::nan("")), std::invalid_argument);
    CHECK_THROWS_AS(compute_restitution(-0.1), std::invalid_argument);
}

TEST_CASE("an interface combines two materials") {
    const Material soft{1e9, 8e8, 0.3, 0.5, 0.0}, hard{3e9, 2e9, 0.6, 0.9, 0.1};
    const Interface law = make_interface(combine(soft, hard), 2.0, 0.5);
    CHECK(law.normal_stiffness == relative(1.5e9, 1e-9));  // 2·1·3/(1 + 3)
    CHECK(law.shear_stiffness == relative(2.0 * 0.8 * 2.0 / 2.8 * 1e9, 1e-9));
    CHECK(law.friction == 0.3);
    // C_n·A = 2ζ sqrt(m_eff K A), with the restitution of the less elastic
    CHECK(law.normal_damping * 0.5 == relative(2.0 * compute_damping_ratio(0.5) * std::sqrt(2.0 * 1.5e9 * 0.5), 1e-9));
    CHECK(law.shear_damping * 0.5 == relative(2.0 * 0.1 * std::sqrt(2.0 * law.shear_stiffness * 0.5), 1e-9));
    CHECK(combine(soft, soft).normal_stiffness == soft.normal_stiffness);
    const Interface half = scaled(law, 0.5);
    CHECK(half.normal_stiffness == 0.5 * law.normal_stiffness);
    CHECK(half.shear_stiffness == 0.5 * law.shear_stiffness);
    CHECK(half.normal_damping == 0.5 * law.normal_damping);
    CHECK(half.shear_damping == 0.5 * law.shear_damping);
    CHECK(half.friction == law.friction);
}

TEST_CASE("of two materials the smoother and the less elastic one counts, and the greater dashpot, whichever is named first") {
    // one is smoother, the other less elastic
    const Material one{1e9, 8e8, 0.3, 0.9, 0.1}, other{3e9, 2e9, 0.6, 0.5, 0.0};
    for (const Material& joint : {combine(one, other), combine(other, one)}) {
        CHECK(joint.normal_stiffness == relative(1.5e9, 1e-12));
        CHECK(joint.shear_stiffness == relative(2.0 * 0.8 * 2.0 / 2.8 * 1e9, 1e-12));
        CHECK(joint.friction == 0.3);
        CHECK(joint.restitution == 0.5);
        CHECK(joint.shear_damping_ratio == 0.1);
    }
    // without shear in either there is none between them
    const Material smooth{1e9, 0.0, 0.0, 0.5, 0.0};
    CHECK(combine(smooth, smooth).shear_stiffness == 0.0);
}

TEST_CASE("a pair in the table meets as it says, in either order, and others as they combine") {
    Model model;
    model.materials = {{1e9, 8e8, 0.3, 0.5, 0.0}, {3e9, 2e9, 0.6, 0.9, 0.1}};
    model.ground.material = model.materials[0];
    const Material glued{5e9, 4e9, 0.9, 0.2, 0.0}, on_ground{1e9, 8e8, 0.7, 0.5, 0.0};
    model.pairs = {{0, 1, glued}, {1, std::nullopt, on_ground}};
    CHECK(find_joint(model, 0, 1).friction == 0.9);
    CHECK(find_joint(model, 1, 0).normal_stiffness == 5e9);
    CHECK(find_joint(model, 1, std::nullopt).friction == 0.7);
    CHECK(find_joint(model, 0, std::nullopt).friction == 0.3);
    CHECK(find_joint(model, 1, 1).friction == 0.6);
}
