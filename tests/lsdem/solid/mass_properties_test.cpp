#include "lsdem/solid/mass_properties.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "lsdem/solid/basic_solids.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/solids.hpp"

namespace musim::lsdem {
namespace {

using tests::draw_rotation;
using tests::make_box_piece;
using tests::relative;

constexpr double kUnit = std::numeric_limits<double>::epsilon();

/// A solid and its moments in closed form.
struct KnownSolid {
    std::string name;
    Solid solid;
    double volume = 0.0;
    Vector3 centre = Vector3::Zero();
    Matrix3 second = Matrix3::Zero();  ///< mean of x xᵀ about the centre [m²]
};

Matrix3 to_inertia(const Matrix3& second) { return second.trace() * Matrix3::Identity() - second; }

Matrix3 diagonal(double x, double y, double z) { return Vector3(x, y, z).asDiagonal(); }

/// Sum of boxes from low to high.
KnownSolid make_known_boxes(const std::string& name, const std::vector<std::pair<Vector3, Vector3>>& boxes) {
    KnownSolid known{.name = name, .solid = {}};
    Vector3 first = Vector3::Zero();
    Matrix3 second = Matrix3::Zero();
    for (const auto& box : boxes) {
        const Vector3 size = box.second - box.first, middle = 0.5 * (box.first + box.second);
        known.solid.pieces.push_back(make_box_piece(box.first, box.second));
        known.volume += size.prod();
        first += size.prod() * middle;
        second += size.prod() * (Matrix3((size.cwiseAbs2() / 12.0).asDiagonal()) + middle * middle.transpose());
    }
    known.centre = first / known.volume;
    known.second = second / known.volume - known.centre * known.centre.transpose();
    return known;
}

KnownSolid make_known_tetrahedron(const std::string& name, const std::vector<Vector3>& corners) {
    KnownSolid known{.name = name, .solid = {{make_polyhedron(corners, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})}}};
    known.volume = (corners[1] - corners[0]).dot((corners[2] - corners[0]).cross(corners[3] - corners[0])) / 6.0;
    for (const Vector3& corner : corners) known.centre += 0.25 * corner;
    for (const Vector3& corner : corners) known.second += 0.05 * (corner - known.centre) * (corner - known.centre).transpose();
    return known;
}

/// Square of side a below, b above, height h, from its middle on: integrals of powers of the side over the height.
KnownSolid make_known_frustum(double a, double b, double h) {
    const std::vector<Eigen::Vector2d> outline = {{-a / 2.0, -a / 2.0}, {a / 2.0, -a / 2.0}, {a / 2.0, a / 2.0}, {-a / 2.0, a / 2.0}};
    KnownSolid known{.name = "frustum", .solid = make_prism(outline, h, b / a)};
    const double s = a * a + a * b + b * b;
    known.volume = h * s / 3.0;
    const double above = h * (a * a + 2.0 * a * b + 3.0 * b * b) / (4.0 * s);  // of the centre over the base
    known.centre = {0.0, 0.0, above - h / 2.0};
    const double x = (a * a * a * a + a * a * a * b + a * a * b * b + a * b * b * b + b * b * b * b) / (20.0 * s);
    const double z = h * h * (a * a + 3.0 * a * b + 6.0 * b * b) / (10.0 * s) - above * above;
    known.second = diagonal(x, x, z);
    return known;
}

/// Area and second moment of a regular polygon of n corners at radius R: n/2 R² sin(2π/n), area R² (2 + cos(2π/n))/12.
KnownSolid make_known_drum(double radius, double height, int flats) {
    KnownSolid known{.name = "drum of " + std::to_string(flats), .solid = make_drum(radius, height, flats, radius)};
    const double turn = 2.0 * std::numbers::pi / flats;
    known.volume = 0.5 * flats * radius * radius * std::sin(turn) * height;
    const double x = radius * radius * (2.0 + std::cos(turn)) / 12.0;
    known.second = diagonal(x, x, height * height / 12.0);
    return known;
}

KnownSolid make_known_octahedron(const Vector3& half) {
    const std::vector<Vector3> corners = {{half.x(), 0, 0},  {-half.x(), 0, 0}, {0, half.y(), 0},
                                          {0, -half.y(), 0}, {0, 0, half.z()},  {0, 0, -half.z()}};
    KnownSolid known{
        .name = "octahedron",
        .solid = {{make_polyhedron(corners, {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}})}}};
    known.volume = 4.0 / 3.0 * half.prod();
    known.second = Vector3(half.cwiseAbs2() / 10.0).asDiagonal();
    return known;
}

/// Parallelepiped of edges u, v, w about the origin.
KnownSolid make_known_oblique(const Vector3& u, const Vector3& v, const Vector3& w) {
    std::vector<Vector3> corners;
    for (unsigned c = 0; c < 8; ++c) {
        corners.push_back(((c & 1U) != 0 ? 0.5 : -0.5) * u + ((c & 2U) != 0 ? 0.5 : -0.5) * v + ((c & 4U) != 0 ? 0.5 : -0.5) * w);
    }
    KnownSolid known{
        .name = "oblique prism",
        .solid = {{make_polyhedron(corners, {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}})}}};
    known.volume = u.dot(v.cross(w));
    known.second = (u * u.transpose() + v * v.transpose() + w * w.transpose()) / 12.0;
    return known;
}

/// Right triangle of legs a along x and b along y from the origin, prism of length l.
KnownSolid make_known_wedge(double a, double b, double l) {
    const std::vector<Eigen::Vector2d> outline = {{0.0, 0.0}, {a, 0.0}, {0.0, b}};
    KnownSolid known{.name = "wedge", .solid = make_prism(outline, l)};
    known.volume = 0.5 * a * b * l;
    known.centre = {a / 3.0, b / 3.0, 0.0};
    known.second << a * a / 18.0, -a * b / 36.0, 0.0, -a * b / 36.0, b * b / 18.0, 0.0, 0.0, 0.0, l * l / 12.0;
    return known;
}

std::vector<KnownSolid> make_known_solids() {
    return {
        make_known_boxes("box", {{{-0.3, -0.7, -1.1}, {0.3, 0.7, 1.1}}}),
        make_known_boxes("L", {{{0.0, 0.0, 0.0}, {3.0, 1.0, 1.5}}, {{0.0, 1.0, 0.0}, {1.0, 2.5, 1.5}}}),
        make_known_boxes("T", {{{-1.5, 0.0, 0.0}, {1.5, 1.0, 0.8}}, {{-0.5, 0.0, 0.8}, {0.5, 1.0, 2.3}}}),
        make_known_tetrahedron("tetrahedron at an axis corner", {{0, 0, 0}, {1.3, 0, 0}, {0, 0.7, 0}, {0, 0, 0.9}}),
        make_known_tetrahedron("tetrahedron", {{0.1, -0.2, 0.3}, {1.2, 0.1, 0.2}, {0.4, 1.1, -0.1}, {0.3, 0.5, 1.7}}),
        make_known_frustum(1.0, 0.6, 1.4),
        make_known_drum(0.8, 0.5, 24),
        make_known_drum(0.8, 1.5, 7),
        make_known_octahedron({0.5, 0.8, 1.1}),
        make_known_oblique({1.0, 0.1, 0.0}, {0.3, 0.9, 0.1}, {0.5, 0.4, 1.2}),
        make_known_wedge(0.9, 1.4, 1.1),
    };
}

void check_moments(const KnownSolid& known, const Placing& placing, double tolerance) {
    const MassProperties found = compute_mass_properties(moved(known.solid, placing));
    const double size = std::cbrt(known.volume);
    CHECK(found.volume == relative(known.volume, tolerance));
    CHECK((found.centre - placing * known.centre).norm() <= tolerance * size);
    const Matrix3 inertia = to_inertia(placing.rotation * known.second * placing.rotation.transpose());
    CHECK((found.inertia_over_mass - inertia).norm() <= tolerance * inertia.norm());
}

}  // namespace

TEST_CASE("volume, centre and inertia of known solids agree to 1e-13") {
    for (const KnownSolid& known : make_known_solids()) {
        CAPTURE(known.name);
        check_moments(known, {}, 1e-13);
    }
}

TEST_CASE("mass properties follow a solid wherever it is and however it is turned") {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    for (const KnownSolid& known : make_known_solids()) {
        CAPTURE(known.name);
        for (const double far : {0.0, 1.0, 30.0, 1e3, 1e6}) {
            for (int i = 0; i < 5; ++i) {
                const Placing placing{draw_rotation(random), far * Vector3(place(random), place(random), place(random))};
                // corners are rounded to a part of their distance from the origin; a width, of half a metre at least, is off by twice
                // that, inertia by twice the relative error of a width, along each of three axes
                const double rounding = 0.5 * kUnit * placing.position.cwiseAbs().maxCoeff();
                check_moments(known, placing, 1e-13 + 3.0 * 2.0 * 2.0 * rounding / 0.5);
            }
        }
    }
}

TEST_CASE("a far origin costs no digits where corners are exact there") {
    // edges are multiples of 2⁻⁸ m, so that corners 2²⁰ m away have no rounding
    const KnownSolid known = make_known_boxes("L", {{{0.0, 0.0, 0.0}, {3.0, 1.0, 1.5}}, {{0.0, 1.0, 0.0}, {1.0, 2.5, 1.5}}});
    Solid far = known.solid;
    const Vector3 offset(0x1p20, -0x1p20, 0x1p19);
    for (Polyhedron& piece : far.pieces) {
        for (Vector3& corner : piece.corners) corner += offset;
    }
    const MassProperties found = compute_mass_properties(far);
    CHECK(found.volume == relative(known.volume, 1e-14));
    CHECK((found.centre - offset - known.centre).norm() <= kUnit * offset.norm());
    // the centre's rounding enters by its square
    CHECK((found.inertia_over_mass - to_inertia(known.second)).norm() <= 1e-14 * known.second.norm());
}

TEST_CASE("mass properties at powers of four in length agree to the last bit") {
    std::mt19937_64 random(2);
    for (const KnownSolid& known : make_known_solids()) {
        CAPTURE(known.name);
        const Solid solid = moved(known.solid, {draw_rotation(random), {0.3, 0.1, -0.2}});
        const MassProperties own = compute_mass_properties(solid);
        const PrincipalAxes axes = find_principal_axes(own.inertia_over_mass);
        for (const double factor : {0x1p-6, 0x1p-2, 0x1p4}) {
            const MassProperties scaled = compute_mass_properties(stretched(solid, Vector3::Constant(factor)));
            CHECK(scaled.volume == factor * factor * factor * own.volume);
            CHECK(scaled.centre == factor * own.centre);
            CHECK(scaled.inertia_over_mass == factor * factor * own.inertia_over_mass);
            const PrincipalAxes scaled_axes = find_principal_axes(scaled.inertia_over_mass);
            CHECK(scaled_axes.axes == axes.axes);
            CHECK(scaled_axes.moments == factor * factor * axes.moments);
        }
    }
}

TEST_CASE("a body whose own axes are principal keeps them, whatever the rounding") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> noise(-1e-13, 1e-13);
    for (const Vector3& moments : {Vector3(1.0, 2.0, 2.5), Vector3(1.0, 1.0, 1.7), Vector3(2.0, 1.0, 1.0), Vector3(1.0, 1.0, 1.0)}) {
        for (int i = 0; i < 20; ++i) {
            Matrix3 tensor = moments.asDiagonal();
            for (Eigen::Index r = 0; r < 3; ++r) {
                for (Eigen::Index c = 0; c < 3; ++c) tensor(r, c) += noise(random);
            }
            const PrincipalAxes found = find_principal_axes(tensor);
            CHECK(found.axes == Matrix3::Identity());
            CHECK((found.moments - moments).norm() < 1e-12);
        }
    }
}

TEST_CASE("principal axes are right-handed, diagonalise the tensor, and are the nearest to the frame's own") {
    std::mt19937_64 random(4);
    for (int i = 0; i < 1000; ++i) {
        const Matrix3 turn = draw_rotation(random);
        const Vector3 moments(1.0, 1.3 + 0.3 * (i % 3), 2.0);
        const PrincipalAxes found = find_principal_axes(turn * moments.asDiagonal() * turn.transpose());
        CHECK((found.axes.transpose() * found.axes - Matrix3::Identity()).norm() < 1e-14);
        CHECK(found.axes.determinant() == relative(1.0, 1e-14));
        const Matrix3 diagonal_form = found.axes.transpose() * turn * moments.asDiagonal() * turn.transpose() * found.axes;
        CHECK((diagonal_form - Matrix3(found.moments.asDiagonal())).norm() < 1e-11);
        // 24 right-handed orders and signs of the true axes: none is nearer
        for (const auto& order :
             {Vector3(0, 1, 2), Vector3(1, 2, 0), Vector3(2, 0, 1), Vector3(1, 0, 2), Vector3(0, 2, 1), Vector3(2, 1, 0)}) {
            for (unsigned signs = 0; signs < 8; ++signs) {
                Matrix3 axes;
                for (Eigen::Index k = 0; k < 3; ++k) {
                    axes.col(k) = ((signs >> k & 1U) != 0 ? -1.0 : 1.0) * turn.col(static_cast<Eigen::Index>(order[k]));
                }
                if (axes.determinant() > 0.0) CHECK(axes.trace() <= found.axes.trace() + 1e-8);
            }
        }
    }
}

TEST_CASE("rounding does not choose between two turns of the axes that are equally near") {
    // an L of equal legs: its principal axes lie at 45° to the legs, and a turn to the left is as near as one to the right
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> noise(-1e-14, 1e-14);
    const Solid angle = make_known_boxes("L", {{{0, 0, 0}, {3, 1, 1}}, {{0, 1, 0}, {1, 3, 1}}}).solid;
    const PrincipalAxes expected = find_principal_axes(compute_mass_properties(angle).inertia_over_mass);
    CHECK(std::abs(expected.axes(0, 0)) == relative(std::sqrt(0.5), 1e-12));
    for (int i = 0; i < 50; ++i) {
        Solid rounded = angle;
        for (Polyhedron& piece : rounded.pieces) {
            for (Vector3& corner : piece.corners) corner += Vector3(noise(random), noise(random), noise(random));
        }
        const PrincipalAxes found = find_principal_axes(compute_mass_properties(rounded).inertia_over_mass);
        CHECK((found.axes - expected.axes).norm() < 1e-12);
    }
}

}  // namespace musim::lsdem
