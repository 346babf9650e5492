#include "lsdem/contact/contact_area.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <random>

#include "lsdem/contact/contact_step.hpp"
#include "lsdem/contact/overlap_contact.hpp"
#include "tests/lsdem/contact/placed_boxes.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Two boxes in any pose, a corner or an edge of one in the other.
Boxes any_boxes(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    const auto any_rotation = [&] {
        const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
        return Quaternion(w, x, y, z).normalized().toRotationMatrix();
    };
    Boxes boxes;
    boxes.a.half = {0.15, 0.1, 0.075}, boxes.b.half = {0.12, 0.1, 0.09};
    boxes.a.rotation = any_rotation(), boxes.b.rotation = any_rotation();
    const double x = normal(random), y = normal(random), z = normal(random);
    boxes.b.position = 0.2 * Vector3(x, y, z).normalized();
    return boxes;
}

}  // namespace

TEST_CASE("the least reach of friction is no more than its reach about any point") {
    std::mt19937_64 random(4);
    int touching = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const OverlapPieces pieces = any_boxes(random).cut();
        const OverlapGeometry geometry = find_overlap_geometry(pieces);
        if (!geometry.touches()) continue;
        ++touching;
        const Vector3 normal = geometry.load.force.normalized();
        const double least = find_least_reach(pieces, normal, geometry.load.deepest);
        for (const Vector3& about : {geometry.pressed(), Vector3(geometry.pressed() + geometry.area.arm)}) {
            const double reach = find_reach(pieces, normal, about);
            CHECK(least <= reach);
            CHECK((least > 0.0) == (reach > 0.0));
        }
    }
    CHECK(touching > 100);
}

// Depths over the image of such a face across the push change without bound, so that rounding would choose the reach.
TEST_CASE("the reach of friction does not jump when a face comes to lie along the push") {
    std::mt19937_64 random(3);
    int faces = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const OverlapPieces pieces = any_boxes(random).cut();
        const OverlapGeometry geometry = find_overlap_geometry(pieces);
        if (!geometry.touches()) continue;
        for (const OverlapPieces::Piece& piece : pieces) {
            if (!(detail::share_of_facing(piece.facing) > 0.0)) continue;
            ++faces;
            const Vector3 along = (geometry.load.force - geometry.load.force.dot(piece.normal) * piece.normal).normalized();
            const auto reach_at = [&](double tilt) {
                return find_reach(pieces, (along + tilt * piece.normal).normalized(), geometry.pressed());
            };
            const double reach = reach_at(0.0);
            for (const double tilt : {-1e-9, -1e-12, 1e-12, 1e-9}) CHECK(std::abs(reach_at(tilt) - reach) <= 1e-6 * reach);
        }
    }
    CHECK(faces > 300);
}
