#include "lsdem/solid/basic_solids.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace musim::lsdem {
namespace {

/// A corner of an outline lies off the line through its neighbours by at least this part of the sides' lengths [-].
constexpr double kLeastTurn = 1e-9;

[[noreturn]] void refuse_outline(const std::string& why) { throw std::invalid_argument("outline of a prism: " + why); }

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Does a side run upward, or, where level, to the right?
bool runs_up(const Eigen::Vector2d& side) { return side.y() > 0.0 || (side.y() == 0.0 && side.x() > 0.0); }

void check_outline(std::span<const Eigen::Vector2d> outline) {
    const std::size_t n = outline.size();
    if (n < 3) refuse_outline("it has " + std::to_string(n) + " corners; three or more are needed");
    const auto side = [&](std::size_t i) -> Eigen::Vector2d { return outline[(i + 1) % n] - outline[i % n]; };
    double twice_area = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        if (!outline[i].allFinite()) refuse_outline("corner " + std::to_string(i) + " is not finite");
        if (!(side(i).norm() > 0.0)) refuse_outline("corners " + std::to_string(i) + " and " + std::to_string((i + 1) % n) + " are one");
        twice_area += cross(outline[i] - outline[0], side(i));
    }
    if (twice_area < 0.0) refuse_outline("it runs clockwise; give its corners counter-clockwise");
    int rounds = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector2d before = side(i + n - 1), after = side(i);
        const double turn = cross(before, after) / (before.norm() * after.norm());
        if (turn < -kLeastTurn) refuse_outline("it is not convex at corner " + std::to_string(i) + "; make a compound of convex parts");
        if (turn <= kLeastTurn) {
            const bool straight = before.dot(after) > 0.0;
            refuse_outline((straight ? "corner " + std::to_string(i) + " lies within a straight side; leave it out"
                                     : "it turns back at corner " + std::to_string(i)));
        }
        if (runs_up(after) && !runs_up(before)) ++rounds;
    }
    // sides that turn left at every corner go round once, or cross one another
    if (rounds != 1) refuse_outline("its sides cross");
}

/// Cosine and sine of `part`/`whole` of a turn: the same bits on any machine, and the symmetry of a turn to the last bit.
std::pair<double, double> find_direction(int part, int whole) {
    if (8 * part > whole) {
        if (2 * part > whole) {  // beyond half a turn
            const auto [c, s] = find_direction(whole - part, whole);
            return {c, -s};
        }
        if (4 * part > whole) {
            const auto [c, s] = find_direction(whole - 2 * part, 2 * whole);
            return {-c, s};
        }
        const auto [c, s] = find_direction(whole - 4 * part, 4 * whole);
        return {s, c};
    }
    // series in half the angle, at most π/8, with terms to 1e-18: cos = 1 - 2 sin² of the half has no rounding near 1
    const double half = std::numbers::pi * static_cast<double>(part) / static_cast<double>(whole), x = half * half;
    constexpr int kTerms = 8;
    double sine = 1.0, cosine = 1.0;
    for (int k = kTerms; k > 0; --k) {
        sine = 1.0 - x * sine / static_cast<double>(2 * k * (2 * k + 1));
        cosine = 1.0 - x * cosine / static_cast<double>(2 * k * (2 * k - 1));
    }
    sine *= half;
    return {1.0 - 2.0 * sine * sine, 2.0 * sine * cosine};
}

/// The solid between two like outlines at z = -length/2 and +length/2.
Solid make_frustum(std::span<const Eigen::Vector2d> below, std::span<const Eigen::Vector2d> above, double length) {
    const auto n = static_cast<std::uint32_t>(below.size());
    std::vector<Vector3> corners;
    for (const Eigen::Vector2d& p : below) corners.emplace_back(p.x(), p.y(), -0.5 * length);
    for (const Eigen::Vector2d& p : above) corners.emplace_back(p.x(), p.y(), 0.5 * length);
    std::vector<std::vector<std::uint32_t>> faces(2, std::vector<std::uint32_t>(n));
    std::iota(faces[0].rbegin(), faces[0].rend(), 0U);
    std::iota(faces[1].begin(), faces[1].end(), n);
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t next = (i + 1) % n;
        faces.push_back({i, next, next + n, i + n});
    }
    return {{make_polyhedron(std::move(corners), faces)}};
}

void check_positive(double value, const char* what) {
    if (!(value > 0.0) || !std::isfinite(value)) throw std::invalid_argument(std::string(what) + " must be positive");
}

}  // namespace

Solid make_prism(std::span<const Eigen::Vector2d> outline, double length, double taper) {
    check_outline(outline);
    check_positive(length, "the length of a prism");
    check_positive(taper, "the taper of a prism");
    std::vector<Eigen::Vector2d> above(outline.begin(), outline.end());
    for (Eigen::Vector2d& p : above) p *= taper;
    return make_frustum(outline, above, length);
}

Solid make_drum(double radius, double height, int flats, double top_radius) {
    check_positive(radius, "the radius of a drum");
    check_positive(top_radius, "the top radius of a drum");
    check_positive(height, "the height of a drum");
    constexpr int kMostFlats = 100000;  // for numbers of corners and their doubles in an int
    if (flats < 3 || flats > kMostFlats) {
        throw std::invalid_argument("a drum has from 3 to " + std::to_string(kMostFlats) + " flats, not " + std::to_string(flats));
    }
    std::vector<Eigen::Vector2d> below, above;
    for (int i = 0; i < flats; ++i) {
        // corners half a flat beside its middle: the last one before the first flat's, so that its corners are the first two
        const auto [c, s] = find_direction((2 * i + 2 * flats - 1) % (2 * flats), 2 * flats);
        below.emplace_back(radius * c, radius * s);
        above.emplace_back(top_radius * c, top_radius * s);
    }
    return make_frustum(below, above, height);
}

}  // namespace musim::lsdem
