#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

#include "lsdem/contact/overlap.hpp"
#include "lsdem/solid/convex_hull.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// A body and where it stands: origin at `center`, body to world by `rotation`.
struct Body {
    Solid solid;
    Matrix3 rotation = Matrix3::Identity();
    Vector3 center = Vector3::Zero();

    PlacedSolid placed() const {
        PlacedSolid result;
        place(solid, rotation, center, result);
        return result;
    }
    /// Moved by a small turn about its own centre, or by a shift.
    Body turned(const Vector3& by) const { return {solid, Eigen::AngleAxisd(by.norm(), by.normalized()) * rotation, center}; }
    Body shifted(const Vector3& by) const { return {solid, rotation, center + by}; }
};

Solid make_solid(const std::vector<Vector3>& corners) { return {{make_convex_hull(corners)}}; }

Solid box(const Vector3& size) {
    std::vector<Vector3> corners;
    for (int c = 0; c < 8; ++c) {
        corners.push_back(
            0.5 * Vector3((c & 1) != 0 ? size.x() : -size.x(), (c & 2) != 0 ? size.y() : -size.y(), (c & 4) != 0 ? size.z() : -size.z()));
    }
    return make_solid(corners);
}

Solid tetrahedron(double size) {
    return make_solid({size * Vector3(1, 1, 1), size * Vector3(1, -1, -1), size * Vector3(-1, 1, -1), size * Vector3(-1, -1, 1)});
}

Solid wedge(double size) {
    return make_solid({size * Vector3(-1, -1, -0.5), size * Vector3(1, -1, -0.5), size * Vector3(0, -1, 0.8), size * Vector3(-1, 1, -0.5),
                       size * Vector3(1, 1, -0.5), size * Vector3(0, 1, 0.8)});
}

Solid hexagonal_prism(double size) {
    std::vector<Vector3> corners;
    for (int i = 0; i < 6; ++i) {
        for (const double z : {-0.7, 0.7})
            corners.emplace_back(size * std::cos(i * std::numbers::pi / 3), size * std::sin(i * std::numbers::pi / 3), size * z);
    }
    return make_solid(corners);
}

OverlapLoad load_of(const Body& a, const Body& b) {
    OverlapPieces pieces;
    pieces.cut(a.placed(), b.placed());
    return sum_load(pieces);
}

double energy_of(const Body& a, const Body& b) {
    const PlacedSolid at = a.placed(), bt = b.placed();
    OverlapPieces pieces;
    pieces.cut(at, bt);
    return compute_overlap_energy(at, bt, pieces);
}

/// Half spaces at + slope·x ≥ 0.
struct HalfSpace {
    double at;
    Vector3 slope;
    double operator()(const Vector3& x) const { return at + slope.dot(x); }
};

/// ∫ f dV over the convex body where all half spaces are positive: its corners are found as common points of three planes, its volume is
/// cut into tetrahedra about its middle.
double integrate(const std::vector<HalfSpace>& body, const HalfSpace& f, double size) {
    const double tolerance = 1e-11 * size;
    std::vector<std::vector<Vector3>> faces(body.size());
    for (std::size_t i = 0; i < body.size(); ++i) {
        for (std::size_t j = i + 1; j < body.size(); ++j) {
            for (std::size_t k = j + 1; k < body.size(); ++k) {
                Matrix3 m;
                m << body[i].slope.transpose(), body[j].slope.transpose(), body[k].slope.transpose();
                if (std::abs(m.determinant()) < 1e-9) continue;
                const Vector3 x = m.inverse() * Vector3(-body[i].at, -body[j].at, -body[k].at);
                if (std::any_of(body.begin(), body.end(), [&](const HalfSpace& h) { return h(x) < -tolerance; })) continue;
                for (const std::size_t face : {i, j, k}) faces[face].push_back(x);
            }
        }
    }
    Vector3 middle = Vector3::Zero();
    double count = 0.0;
    for (const auto& face : faces) {
        for (const Vector3& x : face) middle += x, count += 1.0;
    }
    if (count == 0.0) return 0.0;
    middle /= count;
    double sum = 0.0;
    for (std::size_t p = 0; p < body.size(); ++p) {
        auto& face = faces[p];
        if (face.size() < 3) continue;
        const Vector3 n = body[p].slope.normalized(), e = n.unitOrthogonal(), g = n.cross(e);
        Vector3 center = Vector3::Zero();
        for (const Vector3& x : face) center += x / static_cast<double>(face.size());
        std::sort(face.begin(), face.end(), [&](const Vector3& a, const Vector3& b) {
            return std::atan2(g.dot(a - center), e.dot(a - center)) < std::atan2(g.dot(b - center), e.dot(b - center));
        });
        for (std::size_t i = 0; i < face.size(); ++i) {
            const Vector3 &a = face[i], &b = face[(i + 1) % face.size()];
            const double volume = std::abs((a - middle).dot((b - middle).cross(center - middle))) / 6.0;
            sum += volume * 0.25 * (f(a) + f(b) + f(center) + f(middle));
        }
    }
    return sum;
}

/// ½ ∫ (d_a + d_b) dV as a sum over all cells in which one plane of a and one of b are nearest.
double energy_by_tetrahedra(const PlacedSolid& a, const PlacedSolid& b, double size) {
    const auto planes = [](const PlacedSolid& solid) {
        std::vector<HalfSpace> result;
        const PlacedPiece& piece = solid.pieces().front();
        for (std::size_t k = 0; k < piece.face_count; ++k) result.push_back({piece.offset[k], -piece.normal[k]});
        return result;
    };
    const std::vector<HalfSpace> of_a = planes(a), of_b = planes(b);
    const auto sum_over_cells = [&](const std::vector<HalfSpace>& own, const std::vector<HalfSpace>& others) {
        double sum = 0.0;
        for (std::size_t i = 0; i < own.size(); ++i) {
            std::vector<HalfSpace> cell = others;
            cell.push_back(own[i]);
            for (std::size_t k = 0; k < own.size(); ++k) {
                if (k != i) cell.push_back({own[k].at - own[i].at, own[k].slope - own[i].slope});
            }
            sum += integrate(cell, own[i], size);
        }
        return sum;
    };
    return 0.5 * (sum_over_cells(of_a, of_b) + sum_over_cells(of_b, of_a));
}

struct Random {
    std::mt19937_64 engine{7};
    double operator()() { return std::uniform_real_distribution<double>(-1.0, 1.0)(engine); }
    Vector3 vector() { return {(*this)(), (*this)(), (*this)()}; }
    Matrix3 rotation() {
        return Eigen::Quaterniond(Eigen::Vector4d((*this)(), (*this)(), (*this)(), (*this)())).normalized().toRotationMatrix();
    }
};

/// b is moved towards a along a random direction until the bodies overlap by about `depth`.
Body moved_to_overlap(const Body& a, const Body& b, const Vector3& direction, double depth) {
    double near = 0.0, far = 10.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (near + far);
        (load_of(a, b.shifted(middle * direction)).deepest > depth ? near : far) = middle;
    }
    return b.shifted(near * direction);
}

std::vector<std::array<Body, 2>> random_pairs() {
    Random random;
    std::vector<std::array<Body, 2>> pairs;
    const std::vector<Solid> solids{box({0.32, 0.66, 1.0}), wedge(0.4), tetrahedron(0.4), hexagonal_prism(0.4)};
    for (const Solid& solid : solids) {
        for (int i = 0; i < 12; ++i) {
            const Body a{solids[0], random.rotation()}, b{solid, random.rotation()};
            pairs.push_back({a, moved_to_overlap(a, b, random.vector().normalized(), i % 2 == 0 ? 0.05 : 0.002)});
        }
    }
    // flat, turned and slightly tilted
    for (const double tilt : {0.0, 1e-3, 0.05}) {
        for (const double twist : {0.0, 0.2, std::numbers::pi / 2}) {
            const Body a{solids[0]};
            Body b{solids[0],
                   (Eigen::AngleAxisd(tilt, Vector3(0.6, 0.8, 0.0)) * Eigen::AngleAxisd(twist, Vector3::UnitZ())).toRotationMatrix()};
            pairs.push_back({a, moved_to_overlap(a, b.shifted({0.11, -0.07, 0.0}), Vector3::UnitZ(), 0.01)});
        }
    }
    return pairs;
}

}  // namespace

// [vanDerHavenFragkopoulosElliott23] the energy, summed over tetrahedra of all its cells; 1e-8: the sum's own corners are taken as
// one within 1e-11 of the size, over overlaps of 2e-3 of it
TEST_CASE("the energy of an overlap is half the integral of both depths over it") {
    for (const auto& [a, b] : random_pairs()) {
        const double expected = energy_by_tetrahedra(a.placed(), b.placed(), 1.0);
        REQUIRE(expected > 0.0);
        CHECK(energy_of(a, b) == relative(expected, 1e-8));
    }
}

TEST_CASE("force and moment of an overlap are minus the gradient of its energy") {
    constexpr double kStep = 1e-5;  // [size of a body]; central differences of an energy with a continuous slope: off by a part step/depth
    for (const auto& [a, b] : random_pairs()) {
        const OverlapLoad load = load_of(a, b);
        const Vector3 moment = load.moment - b.center.cross(load.force);
        const double size = load.force.norm(), allowed = 3.0 * kStep / load.deepest * size + 1e-9 * size;
        for (int axis = 0; axis < 3; ++axis) {
            const Vector3 by = kStep * Vector3::Unit(axis);
            const double push = -(energy_of(a, b.shifted(by)) - energy_of(a, b.shifted(-by))) / (2.0 * kStep);
            const double twist = -(energy_of(a, b.turned(by)) - energy_of(a, b.turned(-by))) / (2.0 * kStep);
            CHECK(std::abs(push - load.force[axis]) < allowed);
            CHECK(std::abs(twist - moment[axis]) < allowed);
        }
    }
}

TEST_CASE("bodies that change places push each other by the same bits") {
    for (const auto& [a, b] : random_pairs()) {
        const OverlapLoad one = load_of(a, b), other = load_of(b, a);
        CHECK(one.force == -other.force);
        CHECK(one.moment == -other.moment);
        CHECK(energy_of(a, b) == energy_of(b, a));
    }
}

// J1: F = K S d, E = K S d²/2, to d/size
TEST_CASE("flat faces store what springs over their common area store") {
    const double depth = 1e-4;
    const Body a{box({0.4, 0.6, 1.0})}, b{box({0.4, 0.6, 1.0}), Matrix3::Identity(), {0.1, 0.2, 1.0 - depth}};
    const double area = 0.3 * 0.4;
    const OverlapLoad load = load_of(a, b);
    CHECK(load.force.z() == relative(area * depth, 4.0 * depth / 0.3));
    CHECK(energy_of(a, b) == relative(0.5 * area * depth * depth, 4.0 * depth / 0.3));
    CHECK(load.area == relative(area, 4.0 * depth / 0.3));
}

// J2: an edge of length L that stands in a face at t: F = c K L d²/(2 tan t), c = (1 + 1/(sin t + cos t))/(2 cos² t)
TEST_CASE("an edge in a face bears its share of Winkler's load") {
    const double depth = 1e-4, length = 0.6;
    const Body a{box({4.0, 4.0, 1.0})};
    for (const double degrees : {1.0, 5.0, 30.0, 45.0}) {
        const double t = degrees * std::numbers::pi / 180.0,
                     c = (1.0 + 1.0 / (std::sin(t) + std::cos(t))) / (2.0 * std::cos(t) * std::cos(t));
        const Matrix3 rotation = Eigen::AngleAxisd(t, Vector3::UnitY()).toRotationMatrix();
        const double lowest = 0.5 * (0.4 * std::sin(t) + 1.0 * std::cos(t));
        const Body b{box({0.4, length, 1.0}), rotation, {0.0, 0.0, 0.5 + lowest - depth}};
        // c is of an endless edge: the end faces take part over a length of the overlap; at 1 degree the block's width ends the wedge
        CHECK(load_of(a, b).force.z() == relative(c * length * depth * depth / (2.0 * std::tan(t)), 3.0 * depth / length));
    }
}

// J3: a cube's corner, space diagonal upright, in a face: F = (√3 + 1)/4 K d³
TEST_CASE("a cube's corner in a face bears its closed form") {
    const double depth = 1e-3;
    const Matrix3 rotation = Eigen::Quaterniond::FromTwoVectors(Vector3(1, 1, 1).normalized(), Vector3::UnitZ()).toRotationMatrix();
    const Body a{box({4.0, 4.0, 1.0})}, b{box({1.0, 1.0, 1.0}), rotation, {0.0, 0.0, 0.5 + 0.5 * std::sqrt(3.0) - depth}};
    CHECK(load_of(a, b).force.z() == relative((std::sqrt(3.0) + 1.0) / 4.0 * depth * depth * depth, 1e-9));
}

TEST_CASE("the half space is the face of a block that is large enough") {
    Random random;
    for (const Solid& solid : {box({0.32, 0.66, 1.0}), wedge(0.4), tetrahedron(0.4), hexagonal_prism(0.4)}) {
        for (int i = 0; i < 8; ++i) {
            Body b{solid, random.rotation()};
            double lowest = 0.0;
            for (const Vector3& corner : solid.pieces.front().corners) lowest = std::min(lowest, (b.rotation * corner).z());
            b.center.z() = -lowest - 0.01;
            const Body slab{box({20.0, 20.0, 4.0}), Matrix3::Identity(), {0.0, 0.0, -2.0}};
            PlacedSolid ground;
            place_half_space(Matrix3::Identity(), Vector3::Zero(), 1.0, ground);
            OverlapPieces pieces;
            pieces.cut(ground, b.placed());
            const OverlapLoad load = sum_load(pieces), expected = load_of(slab, b);
            CHECK((load.force - expected.force).norm() < 1e-10 * expected.force.norm());
            CHECK((load.moment - expected.moment).norm() < 1e-10 * expected.force.norm());
            CHECK(compute_overlap_energy(ground, b.placed(), pieces) == relative(energy_of(slab, b), 1e-9));
        }
    }
}

TEST_CASE("the force is continuous where sides become flush and where faces tilt through parallel") {
    const double depth = 1e-3;
    const Body a{box({0.4, 0.6, 1.0})};
    // from flush to shifted by two overlaps, and from a tilt to the opposite one: no step of the path changes the force by more than its
    // share of the path, with a slope of a few times K times the area
    Vector3 before = Vector3::Zero();
    for (int i = -200; i <= 200; ++i) {
        const double s = 2.0 * depth * i / 200.0;
        const Body b{box({0.4, 0.6, 1.0}), Eigen::AngleAxisd(0.02 * s, Vector3::UnitY()).toRotationMatrix(), {s, 0.0, 1.0 - depth}};
        const Vector3 force = load_of(a, b).force;
        if (i > -200) CHECK((force - before).norm() < 3.0 * 0.24 * 0.01 * depth + 1e-12);
        before = force;
    }
}
