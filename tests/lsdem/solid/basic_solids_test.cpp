#include "lsdem/solid/basic_solids.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "lsdem/solid/mass_properties.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/solids.hpp"

namespace musim::lsdem {
namespace {

using tests::relative;

using Corners2 = std::vector<Eigen::Vector2d>;

const Corners2 kTrapezoid = {{-0.4, 0.0}, {0.4, 0.0}, {0.3, 0.5}, {-0.3, 0.5}};

}  // namespace

TEST_CASE("a prism has the outline's sides and two ends, and the volume of its outline times its length") {
    const Solid prism = make_prism(kTrapezoid, 1.5);
    CHECK(tests::is_convex_polyhedron(prism.pieces.front(), 1e-15));
    CHECK(prism.pieces.front().faces.size() == 6);
    CHECK(compute_mass_properties(prism).volume == relative(0.7 * 0.5 * 1.5, 1e-14));
    CHECK(find_bounds(prism).low == Vector3(-0.4, 0.0, -0.75));
    CHECK(find_bounds(prism).high == Vector3(0.4, 0.5, 0.75));
}

TEST_CASE("a tapered prism is a frustum about the origin of its outline") {
    constexpr double kTaper = 0.25;
    const Solid frustum = make_prism(kTrapezoid, 1.5, kTaper);
    CHECK(tests::is_convex_polyhedron(frustum.pieces.front(), 1e-15));
    // h/3 (A + sqrt(A B) + B) with B = taper² A
    CHECK(compute_mass_properties(frustum).volume == relative(0.35 * 0.5 * (1.0 + kTaper + kTaper * kTaper), 1e-14));
    CHECK(find_support(frustum, {1.0, -1e-3, 10.0}) == Vector3(0.1, 0.0, 0.75));
}

TEST_CASE("a prism of a rectangle is the box") {
    const Corners2 rectangle = {{-0.5, -0.25}, {0.5, -0.25}, {0.5, 0.25}, {-0.5, 0.25}};
    const Solid prism = make_prism(rectangle, 2.0), box = make_box_solid({1.0, 0.5, 2.0});
    for (const Polyhedron::Face& face : prism.pieces.front().faces) {
        bool found = false;
        for (const Polyhedron::Face& own : box.pieces.front().faces) found = found || own.plane == face.plane;
        CHECK(found);
    }
}

TEST_CASE("outlines that bound no convex area are refused, with the corner") {
    const auto refused = [](const Corners2& outline, const char* message) {
        CHECK_THROWS_WITH_AS(make_prism(outline, 1.0), message, std::invalid_argument);
    };
    refused({{0, 0}, {1, 0}}, "outline of a prism: it has 2 corners; three or more are needed");
    refused({{0, 0}, {0, 1}, {1, 0}}, "outline of a prism: it runs clockwise; give its corners counter-clockwise");
    refused({{0, 0}, {2, 0}, {1, 0.2}, {1, 2}}, "outline of a prism: it is not convex at corner 2; make a compound of convex parts");
    refused({{0, 0}, {1, 0}, {2, 0}, {1, 2}}, "outline of a prism: corner 1 lies within a straight side; leave it out");
    refused({{0, 0}, {2, 0}, {2, 1}, {2, 1}}, "outline of a prism: corners 2 and 3 are one");
    refused({{0, 0}, {2, 0}, {1, 0}, {1, 1}}, "outline of a prism: it turns back at corner 1");
    Corners2 star;
    for (int i = 0; i < 5; ++i) star.emplace_back(std::cos(0.8 * std::numbers::pi * i), std::sin(0.8 * std::numbers::pi * i));
    refused(star, "outline of a prism: its sides cross");
    CHECK_THROWS_WITH_AS(make_prism(kTrapezoid, 0.0), "the length of a prism must be positive", std::invalid_argument);
    CHECK_THROWS_WITH_AS(make_prism(kTrapezoid, 1.0, -1.0), "the taper of a prism must be positive", std::invalid_argument);
}

TEST_CASE("a drum's corners lie on its circles, and its volume is that of the round drum times sin(2π/n) n/(2π)") {
    for (const int flats : {3, 4, 5, 8, 24, 25, 200}) {
        CAPTURE(flats);
        const Solid drum = make_drum(0.5, 0.3, flats, 0.5);
        const Polyhedron& piece = drum.pieces.front();
        CHECK(tests::is_convex_polyhedron(piece, 1e-15));
        CHECK(piece.faces.size() == static_cast<std::size_t>(flats) + 2);
        for (const Vector3& corner : piece.corners) CHECK(corner.head<2>().norm() == relative(0.5, 2e-16));
        const double turn = 2.0 * std::numbers::pi / flats;
        const double round = std::numbers::pi * 0.25 * 0.3;
        CHECK(compute_mass_properties(drum).volume == relative(round * std::sin(turn) / turn, 1e-13));
        // the first flat looks along x
        CHECK(piece.faces[2].plane.normal == Vector3::UnitX());
        CHECK(piece.faces[2].plane.offset == relative(0.5 * std::cos(turn / 2.0), 4e-16));
    }
}

TEST_CASE("a drum is symmetric to the last bit") {
    const Polyhedron drum = make_drum(0.7, 1.0, 24, 0.5).pieces.front();
    for (const Vector3& corner : drum.corners) {
        for (const Vector3& image : {Vector3(-corner.x(), corner.y(), corner.z()), Vector3(corner.x(), -corner.y(), corner.z()),
                                     Vector3(corner.y(), corner.x(), corner.z())}) {
            CHECK(std::count(drum.corners.begin(), drum.corners.end(), image) == 1);
        }
    }
}

TEST_CASE("a tapered drum is a frustum") {
    const Solid drum = make_drum(0.5, 0.9, 24, 0.4);
    CHECK(tests::is_convex_polyhedron(drum.pieces.front(), 1e-15));
    const double area = 12.0 * std::sin(std::numbers::pi / 12.0);  // of radius 1
    CHECK(compute_mass_properties(drum).volume == relative(area * 0.3 * (0.25 + 0.2 + 0.16), 1e-13));
}

TEST_CASE("drums without size or with too few flats are refused") {
    CHECK_THROWS_WITH_AS(make_drum(0.5, 1.0, 2, 0.5), "a drum has from 3 to 100000 flats, not 2", std::invalid_argument);
    CHECK_THROWS_WITH_AS(make_drum(0.5, 1.0, 24, 0.0), "the top radius of a drum must be positive", std::invalid_argument);
    CHECK_THROWS_WITH_AS(make_drum(-0.5, 1.0, 24, 0.5), "the radius of a drum must be positive", std::invalid_argument);
    CHECK_THROWS_WITH_AS(make_drum(0.5, 0.0, 24, 0.5), "the height of a drum must be positive", std::invalid_argument);
}

}  // namespace musim::lsdem
