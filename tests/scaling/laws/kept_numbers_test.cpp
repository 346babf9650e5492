#include <doctest/doctest.h>

#include "scaling/laws/group_meaning.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"

namespace musim::scaling::tests {

namespace {

KeptNumbers kept_by(const char* law, std::vector<GivenFactor> given = {}) {
    given.push_back({"l", 0.04});
    return find_kept_numbers(solve_law(*find_scale_law(law), given));
}

void check(const KeptNumbers& kept, bool mu, bool froude, bool cauchy) {
    CHECK(kept.mu == mu);
    CHECK(kept.froude == froude);
    CHECK(kept.cauchy == cauchy);
}

}  // namespace

TEST_CASE("each law keeps the number of the force that governs, the exact one all") {
    check(kept_by("mu"), true, false, false);
    check(kept_by("froude"), false, true, false);
    check(kept_by("cauchy"), false, false, true);
    check(kept_by("exact"), true, true, true);
}

TEST_CASE("a number is kept when no chosen factor is in it") {
    check(kept_by("true_replica"), false, true, true);  // weight and elasticity, any friction
    check(kept_by("centrifuge"), true, true, true);
    check(kept_by("gravity_distorted", {{"a", 2.0}}), false, false, false);
    check(kept_by("restoring_force", {{"F_R", 0.01}}), false, false, false);
    // equal friction by value is no reason: another model of the law may have another
    check(kept_by("froude", {{"mu", 1.0}}), false, true, false);
}

TEST_CASE("what a law requires of groups follows from the numbers that it keeps") {
    const GroupMeaning &shape = find_group_meaning("b/H"), &slip = find_group_meaning("mu^N"), &rigidity = find_group_meaning("kappa_n"),
                       &uplift = find_group_meaning("a/(g*tan(alpha))"), &shear = find_group_meaning("k_s/k_n");
    const KeptNumbers none, weight{.froude = true}, solid{.cauchy = true}, both{.froude = true, .cauchy = true};
    CHECK(shape.is_required_by(none));  // every law has one length
    CHECK_FALSE(slip.is_required_by(none));
    CHECK(slip.is_required_by({.mu = true}));
    CHECK(uplift.is_required_by(weight));
    CHECK_FALSE(uplift.is_required_by(solid));
    CHECK(shear.is_required_by(solid));
    CHECK_FALSE(rigidity.is_required_by(weight));
    CHECK_FALSE(rigidity.is_required_by(solid));
    CHECK(rigidity.is_required_by(both));
}

}  // namespace musim::scaling::tests
