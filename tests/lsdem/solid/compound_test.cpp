#include "lsdem/solid/compound.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "lsdem/solid/basic_solids.hpp"
#include "lsdem/solid/convex_hull.hpp"
#include "lsdem/solid/mass_properties.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/solids.hpp"

namespace musim::lsdem {
namespace {

using tests::draw_rotation;
using tests::is_convex_polyhedron;
using tests::make_box_piece;
using tests::relative;

using Parts = std::vector<Polyhedron>;

Polyhedron place(const Solid& solid, const Vector3& position) { return moved(solid, {Matrix3::Identity(), position}).pieces.front(); }

Parts move_parts(const Parts& parts, const Placing& placing) { return moved({parts}, placing).pieces; }

struct NamedParts {
    std::string name;
    Parts parts;
    std::size_t wholes = 0;  ///< largest convex parts
};

/// Bodies of convex parts that touch, none convex itself.
std::vector<NamedParts> make_dented_bodies() {
    return {
        {"L", {make_box_piece({0, 0, 0}, {3, 1, 1}), make_box_piece({0, 0, 1}, {1, 1, 2.5})}, 2},
        {"T", {make_box_piece({-0.5, 0, 0}, {0.5, 1, 2}), make_box_piece({-1.5, 0, 2}, {1.5, 1, 2.75})}, 2},
        {"cross of seven cubes",
         {make_box_piece({-1, -1, -1}, {1, 1, 1}), make_box_piece({1, -1, -1}, {3, 1, 1}), make_box_piece({-3, -1, -1}, {-1, 1, 1}),
          make_box_piece({-1, 1, -1}, {1, 3, 1}), make_box_piece({-1, -3, -1}, {1, -1, 1}), make_box_piece({-1, -1, 1}, {1, 1, 3}),
          make_box_piece({-1, -1, -3}, {1, 1, -1})},
         3},
        {"bracket block with crossed slots",
         {make_box_piece({-2, -2, 0}, {2, 2, 1}), make_box_piece({-2, -2, 1}, {-1, -1, 2}), make_box_piece({1, -2, 1}, {2, -1, 2}),
          make_box_piece({-2, 1, 1}, {-1, 2, 2}), make_box_piece({1, 1, 1}, {2, 2, 2})},
         5},
        {"slab with a stud", {make_box_piece({-2, -2, 0}, {2, 2, 1}), make_box_piece({-0.5, -0.75, 1}, {0.25, 0.5, 1.5})}, 2},
        {"drum on a slab", {make_box_piece({-1, -1, 0}, {1, 1, 0.5}), place(make_drum(0.7, 1.0, 24, 0.7), {0, 0, 1})}, 2},
        {"frustum on a slab", {make_box_piece({-1, -1, 0}, {1, 1, 0.5}), place(make_drum(0.7, 1.0, 6, 0.4), {0.1, 0, 1})}, 2},
        {"hourglass", {place(make_drum(0.7, 1.0, 5, 0.4), {0, 0, -0.5}), place(make_drum(0.4, 1.0, 5, 0.7), {0, 0, 0.5})}, 2},
        {"stairs", {make_box_piece({0, 0, 0}, {3, 1, 1}), make_box_piece({0, 0, 1}, {2, 1, 2}), make_box_piece({0, 0, 2}, {1, 1, 3})}, 3},
    };
}

double find_depth(const Solid& solid, const Vector3& x, double slack = 1e-12) {
    double depth = -std::numeric_limits<double>::infinity();
    for (const Polyhedron& piece : solid.pieces) {
        const bool inside =
            std::all_of(piece.faces.begin(), piece.faces.end(), [&](const Polyhedron::Face& f) { return f.plane.depth(x) >= -slack; });
        if (!inside) continue;
        for (const auto& whole : piece.wholes) {
            double least = std::numeric_limits<double>::infinity();
            for (const Plane& plane : whole) least = std::min(least, plane.depth(x));
            depth = std::max(depth, least);
        }
    }
    return depth;
}

double volume(const Solid& solid) { return compute_mass_properties(solid).volume; }

double find_face_area(const Polyhedron& piece, const Polyhedron::Face& face) {
    const auto loop = piece.loop(face);
    Vector3 twice = Vector3::Zero();
    for (std::size_t i = 2; i < loop.size(); ++i) {
        twice += (piece.corners[loop[i - 1]] - piece.corners[loop[0]]).cross(piece.corners[loop[i]] - piece.corners[loop[0]]);
    }
    return 0.5 * twice.norm();
}

double find_area(const Solid& solid, bool outer) {
    double area = 0.0;
    for (const Polyhedron& piece : solid.pieces) {
        for (const Polyhedron::Face& face : piece.faces) {
            if (face.outer == outer) area += find_face_area(piece, face);
        }
    }
    return area;
}

/// Different largest convex parts of a solid.
std::vector<std::vector<Plane>> collect_wholes(const Solid& solid) {
    std::vector<std::vector<Plane>> wholes;
    for (const Polyhedron& piece : solid.pieces) {
        for (const auto& whole : piece.wholes) {
            if (std::find(wholes.begin(), wholes.end(), whole) == wholes.end()) wholes.push_back(whole);
        }
    }
    return wholes;
}

Vector3 draw_point(const Solid& solid, std::mt19937_64& random) {
    const Bounds bounds = find_bounds(solid);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    while (true) {
        const Vector3 x = bounds.low + Vector3(share(random), share(random), share(random)).cwiseProduct(bounds.size());
        if (contains(solid, x)) return x;
    }
}

Vector3 draw_direction(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    return Vector3(normal(random), normal(random), normal(random)).normalized();
}

/// A box cut into n parts along each axis, with cuts at the cubes of even steps.
Parts cut_box(const Vector3& low, const Vector3& high, int n) {
    const auto at = [&](int i) { return std::pow(static_cast<double>(i) / n, 1.5); };
    Parts parts;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            for (int k = 0; k < n; ++k) {
                const Vector3 from(at(i), at(j), at(k)), to(at(i + 1), at(j + 1), at(k + 1));
                parts.push_back(make_box_piece(low + from.cwiseProduct(high - low), low + to.cwiseProduct(high - low)));
            }
        }
    }
    return parts;
}

}  // namespace

TEST_CASE("a box made of parts is one convex solid with six faces and the box's planes") {
    const Vector3 low(-0.5, 0.25, 1.0), high(1.0, 1.0, 3.0);
    const Polyhedron box = make_box_piece(low, high);
    std::vector<Parts> divisions = {
        {make_box_piece(low, {0.125, 1.0, 3.0}), make_box_piece({0.125, 0.25, 1.0}, high)},
        {make_box_piece(low, {1.0, 1.0, 1.25}), make_box_piece({-0.5, 0.25, 1.25}, {1.0, 1.0, 2.0}),
         make_box_piece({-0.5, 0.25, 2.0}, high)},
        cut_box(low, high, 2),
        cut_box(low, high, 3),
    };
    for (const Parts& parts : divisions) {
        CAPTURE(parts.size());
        const Solid solid = make_compound(parts);
        REQUIRE(solid.is_convex());
        const Polyhedron& whole = solid.pieces.front();
        CHECK(whole.faces.size() == 6);
        CHECK(whole.corners.size() == 8);
        REQUIRE(whole.wholes.size() == 1);
        for (const Polyhedron::Face& face : box.faces) {
            CHECK(std::count_if(whole.wholes[0].begin(), whole.wholes[0].end(), [&](const Plane& plane) {
                      return plane.normal == face.plane.normal && std::abs(plane.offset - face.plane.offset) < 1e-15;
                  }) == 1);
        }
        CHECK(volume(solid) == relative(2.25, 1e-14));
    }
}

TEST_CASE("a turned box of turned parts is one convex solid, too") {
    std::mt19937_64 random(1);
    for (int i = 0; i < 20; ++i) {
        const Solid solid = make_compound(move_parts(cut_box({0, 0, 0}, {1.0, 0.7, 2.0}, 2), {draw_rotation(random), {1.0, 2.0, -0.5}}));
        REQUIRE(solid.is_convex());
        CHECK(solid.pieces.front().faces.size() == 6);
        CHECK(volume(solid) == relative(1.4, 1e-13));
    }
}

TEST_CASE("five boxes around a pinwheel, no two of which are convex, have one whole: the box") {
    const Parts parts = {make_box_piece({0, 0, 0}, {2, 1, 1}), make_box_piece({2, 0, 0}, {3, 2, 1}), make_box_piece({1, 2, 0}, {3, 3, 1}),
                         make_box_piece({0, 1, 0}, {1, 3, 1}), make_box_piece({1, 1, 0}, {2, 2, 1})};
    const Solid solid = make_compound(parts);
    const auto wholes = collect_wholes(solid);
    REQUIRE(wholes.size() == 1);
    CHECK(wholes.front().size() == 6);
    CHECK(volume(solid) == relative(9.0, 1e-14));
    CHECK(find_area(solid, true) == relative(2.0 * 9.0 + 12.0, 1e-14));
    CHECK(find_depth(solid, {1.5, 1.0, 0.5}) == relative(0.5, 1e-14));
}

TEST_CASE("pieces of compounds are convex, do not overlap, fill the parts, and their inner faces cover one another") {
    std::mt19937_64 random(2);
    for (const NamedParts& body : make_dented_bodies()) {
        CAPTURE(body.name);
        for (int i = 0; i < 2; ++i) {
            const Placing placing = i == 0 ? Placing{} : Placing{draw_rotation(random), {0.3, 0.4, 0.5}};
            const Solid solid = make_compound(move_parts(body.parts, placing));
            for (const Polyhedron& piece : solid.pieces) CHECK(is_convex_polyhedron(piece, 1e-14));
            CHECK(volume(solid) == relative(volume({body.parts}), 1e-13));
            const Vector3 centre = placing * compute_mass_properties({body.parts}).centre;
            CHECK((compute_mass_properties(solid).centre - centre).norm() < 1e-13);
            // inner faces in pairs: their vectors of area cancel, and no direction has more on one side
            Vector3 sum = Vector3::Zero();
            for (const Polyhedron& piece : solid.pieces) {
                for (const Polyhedron::Face& face : piece.faces) {
                    if (!face.outer) sum += find_face_area(piece, face) * face.plane.normal;
                }
            }
            CHECK(sum.norm() < 1e-13);
            CHECK(collect_wholes(solid).size() == body.wholes);
            for (int k = 0; k < 200; ++k) {
                const Vector3 x = draw_point(solid, random);
                int holding = 0;
                for (const Polyhedron& piece : solid.pieces) holding += contains({{piece}}, x) ? 1 : 0;
                CHECK(holding == 1);
            }
        }
    }
}

TEST_CASE("the outer faces of compounds have the area of their surface") {
    const auto area = [](const Parts& parts) { return find_area(make_compound(parts), true); };
    const std::vector<NamedParts> bodies = make_dented_bodies();
    CHECK(area(bodies[0].parts) == relative(2.0 * 4.5 + 1.0 * 11.0, 1e-14));
    CHECK(area(bodies[1].parts) == relative(2.0 * 4.25 + 1.0 * (1.0 + 4.0 + 2.0 + 1.5 + 3.0), 1e-14));
    CHECK(area(bodies[2].parts) == relative(30.0 * 4.0, 1e-14));
    CHECK(area(bodies[3].parts) == relative(2.0 * 16.0 + 16.0 + 4.0 * 4.0, 1e-14));
}

TEST_CASE("depth in a compound is continuous, as large as a ball's radius at most, and nothing inside is at the surface") {
    std::mt19937_64 random(3);
    for (const NamedParts& body : make_dented_bodies()) {
        CAPTURE(body.name);
        const Solid solid = make_compound(move_parts(body.parts, {draw_rotation(random), {0.3, 0.4, 0.5}}));
        for (int i = 0; i < 2000; ++i) {
            const Vector3 x = draw_point(solid, random);
            const double depth = find_depth(solid, x);
            REQUIRE(depth >= 0.0);
            // a ball of this radius lies in the solid, so that nothing nearer is missing
            REQUIRE(contains(solid, x + 0.999 * depth * draw_direction(random)));
            // the steepest slope is one
            const Vector3 y = x + 1e-3 * draw_direction(random);
            if (contains(solid, y) && contains(solid, 0.5 * (x + y)))
                REQUIRE(std::abs(find_depth(solid, y) - depth) <= 1e-3 * (1.0 + 1e-9));
        }
        // points of inner faces lie inside
        for (const Polyhedron& piece : solid.pieces) {
            for (const Polyhedron::Face& face : piece.faces) {
                if (face.outer) continue;
                Vector3 middle = Vector3::Zero();
                for (const std::uint32_t c : piece.loop(face)) middle += piece.corners[c] / static_cast<double>(face.count);
                CHECK(find_depth(solid, middle) > 1e-3);
            }
        }
    }
}

TEST_CASE("depth below the faces of an L is that of its two bars") {
    const Solid solid = make_compound(make_dented_bodies()[0].parts);
    CHECK(find_depth(solid, {0.5, 0.5, 0.5}) == relative(0.5, 1e-14));
    CHECK(find_depth(solid, {0.9, 0.5, 1.0}) == relative(0.1, 1e-14));  // below the upright's side
    CHECK(find_depth(solid, {1.1, 0.5, 0.9}) == relative(0.1, 1e-13));  // below the foot's top
    CHECK(find_depth(solid, {0.4, 0.5, 1.0}) == relative(0.4, 1e-14));  // in the face between the parts
    CHECK(find_depth(solid, {1.0, 0.5, 0.6}) == relative(0.4, 1e-14));  // below the reflex edge
}

TEST_CASE("compounds at powers of four in length agree to the last bit") {
    std::mt19937_64 random(4);
    for (const NamedParts& body : make_dented_bodies()) {
        CAPTURE(body.name);
        const Parts parts = move_parts(body.parts, {draw_rotation(random), {0.3, 0.4, 0.5}});
        const Solid solid = make_compound(parts);
        const Vector3 factors = Vector3::Constant(0x1p-6);
        CHECK(make_compound(stretched({parts}, factors).pieces) == stretched(solid, factors));
    }
}

TEST_CASE("gaps of a part in a thousand million between parts count as none") {
    const Solid solid = make_compound(Parts{make_box_piece({0, 0, 0}, {1, 1, 1}), make_box_piece({1 + 4e-10, 0, 0}, {2, 1, 1})});
    CHECK(solid.is_convex());
    CHECK(solid.pieces.front().faces.size() == 6);
    CHECK(volume(solid) == relative(2.0, 1e-9));
}

TEST_CASE("parts of six digits hang together where touching allows for these") {
    std::mt19937_64 random(5);
    for (int i = 0; i < 10; ++i) {
        Parts parts;
        for (const Polyhedron& part : move_parts(make_dented_bodies()[1].parts, {draw_rotation(random), {0.3, 0.4, 0.5}})) {
            std::vector<Vector3> corners = part.corners;
            for (Vector3& corner : corners) corner = (1e6 * corner).array().round() / 1e6;
            parts.push_back(make_convex_hull(corners));
        }
        CHECK_THROWS_AS(make_compound(parts), std::invalid_argument);
        const Solid solid = make_compound(parts, 1e-5);
        CHECK(collect_wholes(solid).size() == 2);
        CHECK(find_area(solid, true) == relative(2.0 * 4.25 + 11.5, 1e-5));
        for (const Polyhedron& piece : solid.pieces) CHECK(piece.faces.size() == 6);
    }
}

TEST_CASE("one part is itself") {
    const Polyhedron drum = make_drum(0.5, 1.0, 24, 0.4).pieces.front();
    CHECK(make_compound(Parts{drum}).pieces == Parts{drum});
}

TEST_CASE("parts that overlap, hang loose or are too many are refused") {
    const auto refused = [](const Parts& parts, const char* message) {
        CHECK_THROWS_WITH_AS(make_compound(parts), message, std::invalid_argument);
    };
    refused({}, "a compound has no parts");
    refused({make_box_piece({0, 0, 0}, {1, 1, 1}), make_box_piece({1, 0, 0}, {2, 1, 1}), make_box_piece({0.5, 0, 0.75}, {1.5, 1, 2})},
            "parts 0 and 2 overlap by 0.25 m; a compound's parts touch by faces");
    const char* loose = "part 2 does not hang together with part 0: no face of it touches one of the parts that do";
    refused({make_box_piece({0, 0, 0}, {1, 1, 1}), make_box_piece({1, 0, 0}, {2, 1, 1}), make_box_piece({2.1, 0, 0}, {3, 1, 1})}, loose);
    // along an edge only, and at a corner only
    refused({make_box_piece({0, 0, 0}, {1, 1, 1}), make_box_piece({1, 0, 0}, {2, 1, 1}), make_box_piece({2, 1, 0}, {3, 2, 1})}, loose);
    refused({make_box_piece({0, 0, 0}, {1, 1, 1}), make_box_piece({1, 0, 0}, {2, 1, 1}), make_box_piece({2, 1, 1}, {3, 2, 2})}, loose);
    Parts studs = {make_box_piece({0, 0, 0}, {17, 17, 1})};
    for (int i = 0; i < 8; ++i) {
        for (int j = 0; j < 8; ++j) studs.push_back(make_box_piece({2.0 * i + 1, 2.0 * j + 1, 1}, {2.0 * i + 2, 2.0 * j + 2, 2}));
    }
    CHECK_THROWS_AS(make_compound(studs), std::invalid_argument);
}

}  // namespace musim::lsdem
