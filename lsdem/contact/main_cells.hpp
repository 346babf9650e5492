#pragma once

#include <array>
#include <cstddef>
#include <numbers>

#include "lsdem/contact/contact_step.hpp"
#include "lsdem/detail/wide.hpp"

/// The part of a face of one box over which a face of the other is nearest, and what friction and dashpots ask of it: the functions
/// `find_pull` and `find_reach` of contact_area.hpp for pairs side by side.
namespace musim::lsdem::detail {

/// A part of a line.
template <class W>
struct Interval {
    using Real = typename W::Real;
    using Mask = typename W::Mask;
    static constexpr double kTiny = 1e-30;  ///< slopes below this are that
    static constexpr double kFar = 1e300;   ///< no bound

    Real low, high;
    /// Away from zero, so that a reciprocal and its cube stay finite.
    MUSIM_WIDE static Real guarded(const Real& a) {
        return choose(magnitude(a) < broadcast<Real>(kTiny), choose(a < Real{}, broadcast<Real>(-kTiny), broadcast<Real>(kTiny)), a);
    }
    /// Keeps what lies beyond `at`: above where `above` says so, else below.
    MUSIM_WIDE void keep(const Real& at, const Mask& above) {
        low = larger_of<Real>(low, choose(above, at, broadcast<Real>(-kFar)));
        high = smaller_of<Real>(high, choose(above, broadcast<Real>(kFar), at));
    }
    /// Keeps where c0 + c1 t > 0.
    MUSIM_WIDE void clip(const Real& c0, const Real& c1) {
        const Real slope = guarded(c1);
        keep(-c0 / slope, slope > Real{});
    }
    MUSIM_WIDE Real length() const { return larger_of<Real>(high - low, Real{}); }
};

/// In the plane of the face, from its middle: x along one direction, y along the other. A convex polygon of edges of the face ("rim"), of
/// lines D = d_m ("crease"), and of the line D = 0, where it is `open`.
template <class W>
struct MainCell {
    using Real = typename W::Real;
    using Mask = typename W::Mask;
    using Vector = Triple<Real>;

    /// Upper or lower in its direction: x = x_at + x_by y between y0 and y1, with D there.
    struct Edge {
        Real x_at, x_by, y0, y1, length, d0, d1;
    };
    std::array<std::array<Edge, 4>, 2> edges;  ///< of each direction: rims, creases; lower, upper
    std::array<std::array<bool, 4>, 2> live;   ///< there in some lane
    Real bounds;                               ///< which edges there are: 1, 2, 4, 8 of the first direction, 16 to 128 of the second
    std::array<Vector, 2> along;               ///< the directions, world axes
    Vector normal, middle;                     ///< outward; from the point half way between the bodies [m]
    Real depth_at;                             ///< D in the middle of the face [m]
    std::array<Real, 2> slope;                 ///< of D
    std::array<Real, 2> fan;                   ///< a point amid the edges, on D = 0 where it is open [m]
    Mask open;
    Real load;    ///< ∫ D [m³]
    Real spread;  ///< mean square distance of its points from its middle along the direction in which that is more [m²]

    /// The edge D = 0, in the sense of the others.
    struct Closing {
        std::array<Real, 2> from, to;
        Mask there;
    };
    Closing closing;  ///< where `open` in some lane
    /// Calls visit(from, to, depth from, depth to, sign, there) for all edges; sign 1 for counter-clockwise in (first, second direction).
    template <class Visit>
    MUSIM_WIDE void for_each_edge(const Visit& visit) const {
        for (std::size_t k = 0; k < 2; ++k) {
            for (std::size_t i = 0; i < 4; ++i) {
                if (!live[k][i]) continue;
                const Edge& e = edges[k][i];
                const Real x0 = e.x_at + e.x_by * e.y0, x1 = e.x_at + e.x_by * e.y1;
                const double sign = ((i & 1U) == 0) == (k == 0) ? -1.0 : 1.0;
                const Mask there = e.length > Real{};
                if (k == 0) {
                    visit({x0, e.y0}, {x1, e.y1}, e.d0, e.d1, sign, there);
                } else {
                    visit({e.y0, x0}, {e.y1, x1}, e.d0, e.d1, sign, there);
                }
            }
        }
        if (some(open)) visit(closing.from, closing.to, Real{}, Real{}, 1.0, closing.there);
    }
};

/// ∫ d r over the triangle between the origin and an edge, r the distance from the origin, where d is affine with `depth_at_origin`.
template <class W>
MUSIM_WIDE typename W::Real integrate_distance(const std::array<typename W::Real, 2>& from, const std::array<typename W::Real, 2>& to,
                                               const typename W::Real& depth_from, const typename W::Real& depth_to,
                                               const typename W::Real& depth_at_origin) {
    using Real = typename W::Real;
    const Real zero{}, dx = to[0] - from[0], dy = to[1] - from[1], length_squared = dx * dx + dy * dy;
    const Real r0 = square_root(from[0] * from[0] + from[1] * from[1]), r1 = square_root(to[0] * to[0] + to[1] * to[1]);
    // an edge of the length of rounding may have none when it is projected
    const Real length = square_root(length_squared), over = choose(length_squared > zero, length * (1.0 / length_squared), zero);
    const Real along_x = over * dx, along_y = over * dy;
    const Real away = from[0] * along_y - from[1] * along_x, squared = away * away;
    const Real s0 = along_x * from[0] + along_y * from[1], s1 = s0 + length;
    // (s1 + r1) / (s0 + r0) ≥ 1 without cancellation
    const Real m0 = magnitude(s0) + r0, m1 = magnitude(s1) + r1, product = m0 * m1;
    const auto after = s0 > zero, before = s1 <= zero;
    const Real above = choose(after, m1, choose(before, m0, product));
    const Real below = choose(after, m0, choose(before, m1, larger_of<Real>(squared, 1e-60 * product)));
    const Real of_r = 0.5 * ((s1 * r1 - s0 * r0) + squared * log_of_ratio<W>(above, below));
    const Real slope = over * (depth_to - depth_from);
    const Real of_depth_r = (depth_from - slope * s0) * of_r + slope * ((r1 * r1 * r1 - r0 * r0 * r0) * (1.0 / 3.0));
    return away * ((1.0 / 12.0) * (depth_at_origin * of_r) + 0.25 * of_depth_r);
}

/// Questions of a contact's step to both main cells.
template <class W>
struct MainCells {
    using Real = typename W::Real;
    using Mask = typename W::Mask;
    using Vector = Triple<Real>;
    using Step = ContactStep<W>;
    using Point = std::array<Real, 2>;

    const std::array<MainCell<W>, 2>& cells;
    Vector shift;  ///< of the pair's origin from the point half way between the bodies [m]
    Real share;    ///< of the faces in friction and dashpots, half of each body's [-]
    Real depth;    ///< mean of both cells [m]
    Vector depth_slope;

    /// A convex region reaches no farther from its middle in any direction than this times the root of its second moment over its area:
    /// 2√2 for a triangle [-].
    static constexpr double kReachOfConvex = 2.9;

    MUSIM_WIDE Mask may_pull(const typename Step::Geometry& geometry, const typename Step::Pressure& dashpot, const Real& stiffness) const {
        const Vector slope = stiffness * depth_slope + dashpot.slope;
        const Real square = larger_of<Real>(dot(slope, geometry.second_times(slope)), Real{}), middle = stiffness * depth + dashpot.at;
        return (middle < Real{}) | (geometry.area * (middle * middle) < (kReachOfConvex * kReachOfConvex) * square);
    }

    MUSIM_WIDE typename Step::PressureSum find_pull(const typename Step::Pressure& dashpot, const Real& stiffness) const {
        typename Step::PressureSum both;
        for (const MainCell<W>& cell : cells) {
            const Vector middle = (cell.middle - shift) - dashpot.about;
            const Real at = -(stiffness * cell.depth_at + (dashpot.at + dot(dashpot.slope, middle)));
            const Point slope{-(stiffness * cell.slope[0] + dot(dashpot.slope, cell.along[0])),
                              -(stiffness * cell.slope[1] + dot(dashpot.slope, cell.along[1]))};
            const auto [sum, first] = integrate_positive(cell, at, slope);
            both.sum += share * sum;
            both.at = both.at + share * (sum * middle + (first[0] * cell.along[0] + first[1] * cell.along[1]));
        }
        return both;
    }

    /// For each cell the larger of two bounds, of the cells the lesser [m]. A load L [m³] of depths up to d, seen along the normal, is
    /// nowhere closer to a point than in a disc of the area L/d about it: r̄ ≥ 2/3 √(L/(π d)). And the region under an affine depth over a
    /// convex area is convex, so that the root of the load per length along a direction is concave: on either side of its median the mean
    /// distance is no less than that of a cone's load with its tip at the end, a quarter of the way. So r̄ ≥ w/8, w the width of the area
    /// along that direction, and w² ≥ 12 times the mean square distance, with equality for a rectangle.
    MUSIM_WIDE Real least_reach(const Vector& normal, const typename Step::Geometry& geometry) const {
        constexpr double kRounding = 1.0 - 1e-9, kOfDisc = 4.0 / (9.0 * std::numbers::pi) * kRounding;
        constexpr double kOfWidth = 12.0 / 64.0 * kRounding;
        const Real of_load = kOfDisc * (1.0 / geometry.deepest);
        const auto squared = [&](const MainCell<W>& cell) MUSIM_WIDE_LAMBDA {
            const Real facing = magnitude(dot(normal, cell.normal));
            return facing * larger_of<Real>(of_load * cell.load, (kOfWidth * facing) * cell.spread);
        };
        return square_root(larger_of<Real>(smaller_of<Real>(squared(cells[0]), squared(cells[1])), Real{}));
    }

    MUSIM_WIDE Real find_reach(const Vector& normal, const Vector& about) const {
        // two directions across the normal
        const Vector sideways = Step::across(normal, cells[0].along[0]);
        const Vector e = (1.0 / square_root(dot(sideways, sideways))) * sideways, f = cross(normal, e);
        Real distance{}, load{};
        double outward = 1.0;
        for (const MainCell<W>& cell : cells) {
            // the point of the face's plane that lies over the origin, along the normal
            const Real cosine = dot(normal, cell.normal);
            const Vector to_origin = about - (cell.middle - shift);
            const Vector over = to_origin - (dot(to_origin, cell.normal) / cosine) * normal;
            const Point origin{dot(over, cell.along[0]), dot(over, cell.along[1])};
            const Real depth_at_origin = cell.depth_at + (cell.slope[0] * origin[0] + cell.slope[1] * origin[1]);
            const Point first{dot(e, cell.along[0]), dot(f, cell.along[0])}, second{dot(e, cell.along[1]), dot(f, cell.along[1])};
            const auto project = [&](const Point& p) MUSIM_WIDE_LAMBDA {
                const Real x = p[0] - origin[0], y = p[1] - origin[1];
                return Point{first[0] * x + second[0] * y, first[1] * x + second[1] * y};
            };
            Real sum{};
            cell.for_each_edge([&](const Point& from, const Point& to, const Real& depth_from, const Real& depth_to, double sign,
                                   const Mask& there) MUSIM_WIDE_LAMBDA {
                const Real part = integrate_distance<W>(project(from), project(to), depth_from, depth_to, depth_at_origin);
                sum += sign * choose(there, part, Real{});
            });
            const Real facing = outward * cosine, part = share_of_facing(facing);
            distance += part * magnitude(sum);
            load += (part * facing) * cell.load;
            outward = -1.0;
        }
        return choose(load > Real{}, distance / load, Real{});
    }

  private:
    struct Positive {
        Real sum;
        Point first;
    };
    /// ∫ f and the first moments of f over the part of a cell where f = at + slope·x is positive. That part is summed as a fan; where it
    /// ends inside the cell, from a point on f = 0, so that this edge adds nothing.
    MUSIM_WIDE static Positive integrate_positive(const MainCell<W>& cell, const Real& at, const Point& slope) {
        const Real zero{};
        const auto value = [&](const Point& p) MUSIM_WIDE_LAMBDA { return (at + slope[0] * p[0]) + slope[1] * p[1]; };
        Real least = broadcast<Real>(Interval<W>::kFar), most = -least;
        cell.for_each_edge([&](const Point& from, const Point& to, const Real& /*depth*/, const Real& /*depth*/, double /*sign*/,
                               const Mask& there) MUSIM_WIDE_LAMBDA {
            const Real f0 = value(from), f1 = value(to);
            least = choose(there, smaller_of<Real>(least, smaller_of<Real>(f0, f1)), least);
            most = choose(there, larger_of<Real>(most, larger_of<Real>(f0, f1)), most);
        });
        if (!some(most > zero)) return {zero, {zero, zero}};
        const Real of_fan = value(cell.fan), steepness = slope[0] * slope[0] + slope[1] * slope[1];
        const Mask ends = least < zero;
        const Real back = choose(ends & (steepness > zero), -of_fan / steepness, zero);
        const Point fan{cell.fan[0] + back * slope[0], cell.fan[1] + back * slope[1]};
        const Real top = choose(ends, zero, of_fan);
        Real sum{};
        Point first{};
        cell.for_each_edge([&](const Point& from, const Point& to, const Real& /*depth*/, const Real& /*depth*/, double sign,
                               const Mask& there) MUSIM_WIDE_LAMBDA {
            const Real f0 = value(from), f1 = value(to);
            const Mask starts = f0 > zero, stops = f1 > zero;
            if (!some(there & (starts | stops))) return;
            const Real crossing = f0 / (f0 - f1);
            const Real low = choose(starts, zero, crossing), high = choose(stops, broadcast<Real>(1.0), crossing);
            const Real dx = to[0] - from[0], dy = to[1] - from[1], x = from[0] - fan[0], y = from[1] - fan[1];
            const Real twice = choose(there & (starts | stops), sign * ((high - low) * (x * dy - y * dx)), zero);
            const Real x0 = x + low * dx, y0 = y + low * dy, x1 = x + high * dx, y1 = y + high * dy;
            const Real v0 = larger_of<Real>(f0, zero), v1 = larger_of<Real>(f1, zero), total = (top + v0) + v1;
            sum += twice * total;
            first[0] += choose(starts | stops, twice * ((total + v0) * x0 + (total + v1) * x1), zero);
            first[1] += choose(starts | stops, twice * ((total + v0) * y0 + (total + v1) * y1), zero);
        });
        sum *= 1.0 / 6.0;
        return {sum, {(1.0 / 24.0) * first[0] + fan[0] * sum, (1.0 / 24.0) * first[1] + fan[1] * sum}};
    }
};

}  // namespace musim::lsdem::detail
