#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "lsdem/contact/box_meeting.hpp"
#include "lsdem/contact/main_cells.hpp"

/// Overlap of two boxes that meet face to face, several pairs side by side; the same function as OverlapPieces::cut and sum_load.
///
/// Face a of body X lies against face b of body Y. In the frame of a: x and y in its plane, s the depth below it. Of Y, D is the depth
/// below plane b and d_m that below side plane m; all are affine. Y's own field is min(D, d_m). Each role (X in Y, then Y in X) sums
///     I_g = ∫_{g in Y} min(D, d_m) dS       over X's face a and its four sides,
/// and the force on the second body is half of what the first role gives, less half of the second.
///
/// *Main cell* of a: D below all d_m, a convex polygon of four edges of X ("rim") and four lines D = d_m ("crease"); summed as a fan.
/// *Everything else* is a line integral by the divergence theorem: where φ falls at the rate κ along e, ∫ φ dA = ∮ φ²/(2κ) (ν·e) dl.
/// Lines that cross under a small angle take the place of their crossing from one number, so that no gap opens between them.
namespace musim::lsdem::detail {
constexpr double kLeastCosine = 0.9613;  ///< of the tilt: 16°
constexpr double kMostDepth = 0.05;      ///< of the least half extent
constexpr double kLeastWidth = 8.0;      ///< of the touching area, in depths
constexpr double kLeastMain = 0.3;       ///< part of the load that the main cells bear
/// Terms below this part of size · area are left out [-]: a fraction of what rounding of the positions makes of the load.
constexpr double kNegligible = 4e-17;

/// For a stiffness per area of one; vectors in world axes, about the point half way between the middles of the boxes.
template <class W>
struct LaneOverlap {
    using Lanes = typename W::Real;
    using Lanes3 = Triple<Lanes>;
    Lanes3 force;     ///< on the second body [m³]
    Lanes3 moment;    ///< of it [m⁴]
    Lanes deepest{};  ///< largest depth of a point of one body in the other [m]
    // main cells, half of each body's
    Lanes area{};                      ///< [m²]
    Lanes area_depth{};                ///< ∫ depth [m³]
    Lanes3 area_place;                 ///< ∫ place [m³]
    Lanes3 area_square, area_cross;    ///< ∫ of (xx, yy, zz) and (yz, zx, xy) about the cell's own middle [m⁴]
    typename W::Mask irregular{};      ///< nothing of the above holds: take the exact function
    typename W::Mask corner{};         ///< terms of corners were worth it
    std::array<MainCell<W>, 2> cells;  ///< of both bodies
};

template <class W>
struct Kernel {
    using Lanes = typename W::Real;
    using LaneMask = typename W::Mask;
    using Lanes3 = Triple<Lanes>;
    using Interval = detail::Interval<W>;
    using Cell = MainCell<W>;
    using Edge = typename Cell::Edge;
    using LaneOverlap = detail::LaneOverlap<W>;
    static constexpr double kFar = Interval::kFar;
    MUSIM_WIDE static Lanes all(double value) { return broadcast<Lanes>(value); }
    MUSIM_WIDE static Lanes larger(const Lanes& a, const Lanes& b) { return larger_of<Lanes>(a, b); }
    MUSIM_WIDE static Lanes smaller(const Lanes& a, const Lanes& b) { return smaller_of<Lanes>(a, b); }

    MUSIM_WIDE static Lanes3 scaled(const Lanes3& a, const Lanes& by) { return {a.x * by, a.y * by, a.z * by}; }
    MUSIM_WIDE static Lanes3 combine(const Lanes3& p, const Lanes3& q, const Lanes3& n, const Lanes& x, const Lanes& y, const Lanes& z) {
        return {(p.x * x + q.x * y) + n.x * z, (p.y * x + q.y * y) + n.y * z, (p.z * x + q.z * y) + n.z * z};
    }
    MUSIM_WIDE static Lanes guarded(const Lanes& a) { return Interval::guarded(a); }
    /// Two reciprocals for one division.
    MUSIM_WIDE static void invert(const Lanes& a, const Lanes& b, Lanes& inverse_a, Lanes& inverse_b) {
        const Lanes both = all(1.0) / (a * b);
        inverse_a = b * both, inverse_b = a * both;
    }

    /// ∫ f², ∫ y f² and ∫ f³ of an affine f between two places on a line.
    struct Powers {
        Lanes square, along, cube;
        MUSIM_WIDE Powers(const Lanes& y0, const Lanes& y1, const Lanes& length, const Lanes& f0, const Lanes& f1) {
            const Lanes s0 = f0 * f0, s1 = f1 * f1, mixed = f0 * f1, third = length * all(1.0 / 3.0), quarter = length * all(0.25);
            const Lanes both = (s0 + s1) + mixed;
            square = third * both;
            // (3 s0 + 2 m + s1) = (s0 + m + s1) + (2 s0 + m)
            along = (quarter * all(1.0 / 3.0)) * (both * (y0 + y1) + ((s0 + s0 + mixed) * y0 + (s1 + s1 + mixed) * y1));
            cube = quarter * ((f0 + f1) * (s0 + s1));
        }
    };

    /// X's rim and Y's side planes across one direction in the plane of a: x runs across, y along.
    struct Across {
        Lanes half;  ///< of X
        Lanes side;  ///< half extent of Y between the two side planes
        Lanes at;    ///< d_± = side ∓ (at + by_x x + by_y y − by_s s)
        Lanes by_x, by_y, by_s;
        Lanes depth_by_x;               ///< of D
        Lanes inverse_x, inverse_y;     ///< of by_x; of by_y, guarded
        std::array<Lanes, 2> bisector;  ///< 1/(by_x ∓ by_y of the other direction), guarded
        std::array<Lanes, 2> wedge;     ///< 1/(2 (ζ + g)) of the side planes
        // creases D = d_±: x = at + slope y, lower one first; where the rims x = ∓half cross them: y
        std::array<Lanes, 2> crease_at, crease_slope, crease_inverse;
        std::array<std::array<Lanes, 2>, 2> crossing;  ///< [crease][rim]
    };

    /// One body's faces in the other, and what they sum to.
    struct Role {
        std::array<Across, 2> across;
        Lanes depth_at;  ///< D = depth_at + ... − cosine s
        Lanes cosine, half_normal;
        Lanes below;       ///< 1/(2ζ)
        Lanes negligible;  ///< terms in the sums below this are left out [m³]
        LaneMask corner;
        Lanes deepest{}, shallowest{};
        // sums over face a, first moments along both directions
        Lanes load{};
        std::array<Lanes, 2> load_place{};
        // sums over the sides, upper less lower of each direction: load, its moment along the rim and below it
        std::array<Lanes, 2> side{}, side_along{}, side_below{};
        // main cell about `fan`
        std::array<Lanes, 2> fan;
        Lanes fan_depth;
        Lanes area{}, area_depth{}, area_mixed{};
        std::array<Lanes, 2> area_place{}, area_square{};
    };

    static constexpr double sign_of(std::size_t side) { return side == 0 ? -1.0 : 1.0; }

    /// Creases and where they cross the rims of their own direction.
    MUSIM_WIDE static void find_creases(Role& role, std::size_t k) {
        Across& u = role.across[k];
        const Lanes depth_by_y = role.across[1 - k].depth_by_x;
        invert(u.by_x, guarded(u.by_y), u.inverse_x, u.inverse_y);
        invert(guarded(u.by_x - role.across[1 - k].by_y), guarded(u.by_x + role.across[1 - k].by_y), u.bisector[0], u.bisector[1]);
        invert(role.cosine - u.by_s, role.cosine + u.by_s, u.wedge[0], u.wedge[1]);
        u.wedge[0] *= all(0.5), u.wedge[1] *= all(0.5);
        Lanes plus, minus;
        invert(u.by_x + u.depth_by_x, u.by_x - u.depth_by_x, plus, minus);
        u.crease_at[1] = ((u.side - u.at) - role.depth_at) * plus;
        u.crease_slope[1] = -(u.by_y + depth_by_y) * plus;
        u.crease_at[0] = -((u.side + u.at) - role.depth_at) * minus;
        u.crease_slope[0] = -(u.by_y - depth_by_y) * minus;
        invert(guarded(u.crease_slope[0]), guarded(u.crease_slope[1]), u.crease_inverse[0], u.crease_inverse[1]);
#pragma GCC unroll 2
        for (std::size_t c = 0; c < 2; ++c) {
            u.crossing[c][0] = (-u.half - u.crease_at[c]) * u.crease_inverse[c];
            u.crossing[c][1] = (u.half - u.crease_at[c]) * u.crease_inverse[c];
        }
    }

    /// An edge of the main cell.
    MUSIM_WIDE static Edge cut_main_edge(Role& role, const Lanes& x_at, const Lanes& x_by, const Lanes& d_at, const Lanes& d_by,
                                         const Lanes& d_inverse, Interval part) {
        part.keep(-d_at * d_inverse, d_inverse > all(0.0));
        Edge e{x_at, x_by, part.low, part.high, part.length(), {}, {}};
        const LaneMask there = e.length > all(0.0);
        e.d0 = d_at + d_by * e.y0, e.d1 = d_at + d_by * e.y1;
        role.deepest = larger(role.deepest, choose(there, larger(e.d0, e.d1), all(0.0)));
        role.shallowest = smaller(role.shallowest, choose(there, smaller(e.d0, e.d1), all(1e300)));
        return e;
    }
    /// Adds the triangles between the fan's middle and the edges of one direction.
    MUSIM_WIDE static void add_main_edges(Role& role, std::size_t k, const Cell& cell) {
        Lanes area{}, area_depth{}, mixed{}, place_x{}, place_y{}, square_x{}, square_y{}, load_x{}, load_y{};
        const Lanes fan_x = role.fan[k], fan_y = role.fan[1 - k], fan_depth = role.fan_depth;
        for (std::size_t i = 0; i < cell.count[k]; ++i) {
            const Edge& e = cell.edges[k][i];
            const Lanes y0 = e.y0 - fan_y, y1 = e.y1 - fan_y;
            const Lanes x_fan = (e.x_at + e.x_by * fan_y) - fan_x, x0 = x_fan + e.x_by * y0, x1 = x_fan + e.x_by * y1;
            const Lanes twice = (i & 1U) == 0 ? -(x_fan * e.length) : x_fan * e.length;  // area of the triangle
            const Lanes depth = (fan_depth + e.d0) + e.d1, x = x0 + x1, y = y0 + y1, td = twice * depth, tx = twice * x, ty = twice * y;
            const Lanes t0 = twice * e.d0, t1 = twice * e.d1;
            area += twice;
            area_depth += td;
            place_x += tx, place_y += ty;
            square_x += tx * x - twice * (x0 * x1);
            square_y += ty * y - twice * (y0 * y1);
            mixed += tx * y + twice * (x0 * y0 + x1 * y1);
            load_x += td * x + (t0 * x0 + t1 * x1);
            load_y += td * y + (t0 * y0 + t1 * y1);
        }
        role.area += area, role.area_depth += area_depth, role.area_mixed += mixed;
        role.area_place[k] += place_x, role.area_place[1 - k] += place_y;
        role.area_square[k] += square_x, role.area_square[1 - k] += square_y;
        role.load_place[k] += load_x, role.load_place[1 - k] += load_y;
    }

    /// Main cell of a (not yet divided by the fan's factors), and what belongs to it alone: the sides' loads below its rims (∫ D²/(2ζ)),
    /// the strips beyond its creases (∫ D²/(2 by_x)).
    struct Strips {
        Lanes load{};
        std::array<Lanes, 2> place{};
    };
    MUSIM_WIDE static void add_main_cell(Role& role, Cell& cell, Strips& strips) {
        const Lanes zero{};
        Across &p = role.across[0], &q = role.across[1];
        role.below = all(0.5) / role.cosine;
        role.shallowest = all(1e300);
        find_creases(role, 0);
        find_creases(role, 1);
        auto& edges = cell.edges;
        // corners: creases of both directions cross
        std::array<std::array<Lanes, 2>, 2> determinant;
#pragma GCC unroll 2
        for (std::size_t i = 0; i < 2; ++i) {
            const Lanes one = all(1.0) - p.crease_slope[i] * q.crease_slope[0], two = all(1.0) - p.crease_slope[i] * q.crease_slope[1];
            invert(one, two, determinant[i][0], determinant[i][1]);
        }
        for (std::size_t k = 0; k < 2; ++k) {
            const Across &u = role.across[k], &v = role.across[1 - k];
            const Lanes depth_by_y = v.depth_by_x;
            // rims
            const Lanes rim_inverse = all(1.0) / guarded(depth_by_y), below = role.below;
#pragma GCC unroll 2
            for (std::size_t r = 0; r < 2; ++r) {
                const Lanes x = r == 0 ? -u.half : u.half;
                Interval part{larger(-v.half, v.crease_at[0] + v.crease_slope[0] * x),
                              smaller(v.half, v.crease_at[1] + v.crease_slope[1] * x)};
                part.keep(u.crossing[0][r], u.crease_inverse[0] < zero);
                part.keep(u.crossing[1][r], u.crease_inverse[1] > zero);
                const Edge& e = edges[k][r] = cut_main_edge(role, x, zero, role.depth_at + u.depth_by_x * x, depth_by_y, rim_inverse, part);
                const Powers d(e.y0, e.y1, e.length, e.d0, e.d1);
                const Lanes factor = r == 0 ? -below : below;
                role.side[k] += factor * d.square;
                role.side_along[k] += factor * d.along;
                role.side_below[k] += (factor * below) * (all(2.0 / 3.0) * d.cube);
            }
            // creases
            std::array<Lanes, 2> d_by, d_inverse;
#pragma GCC unroll 2
            for (std::size_t c = 0; c < 2; ++c) d_by[c] = depth_by_y + u.depth_by_x * u.crease_slope[c];
            invert(guarded(d_by[0]), guarded(d_by[1]), d_inverse[0], d_inverse[1]);
            const Lanes beside = all(0.5) * u.inverse_x;
            const bool creased =
                some((magnitude(u.at) + magnitude(u.by_x) * u.half + magnitude(u.by_y) * v.half + magnitude(u.by_s) * role.half_normal >=
                      u.side * all(0.9)));
            cell.count[k] = creased ? 4 : 2;
            if (!creased) {
                edges[k][2] = edges[k][3] = Edge{zero, zero, zero, zero, zero, zero, zero};
                continue;
            }
#pragma GCC unroll 2
            for (std::size_t c = 0; c < 2; ++c) {
                const Lanes y_low =
                    (v.crease_at[0] + v.crease_slope[0] * u.crease_at[c]) * (k == 0 ? determinant[c][0] : determinant[0][c]);
                const Lanes y_high =
                    (v.crease_at[1] + v.crease_slope[1] * u.crease_at[c]) * (k == 0 ? determinant[c][1] : determinant[1][c]);
                Interval part{larger(larger(-v.half, y_low), smaller(u.crossing[c][0], u.crossing[c][1])),
                              smaller(smaller(v.half, y_high), larger(u.crossing[c][0], u.crossing[c][1]))};
                const Edge& e = edges[k][2 + c] = cut_main_edge(role, u.crease_at[c], u.crease_slope[c],
                                                                role.depth_at + u.depth_by_x * u.crease_at[c], d_by[c], d_inverse[c], part);
                const Powers d(e.y0, e.y1, e.length, e.d0, e.d1);
                strips.load += beside * d.square;
                strips.place[1 - k] += beside * d.along;
                strips.place[k] +=
                    beside * ((u.crease_at[c] * d.square + u.crease_slope[c] * d.along) + (all(sign_of(c) * 2.0 / 3.0) * beside) * d.cube);
            }
        }
        // the fan's middle: amid the edges, or on D = 0 next to that if the cell ends there, so that this edge adds nothing
        Lanes rim{}, rim_x{}, rim_y{};
#pragma GCC unroll 4
        for (std::size_t i = 0; i < 4; ++i) {
            const Edge &e = edges[0][i], &f = edges[1][i];
            rim += e.length + f.length;
            const Lanes e_y = e.length * (e.y0 + e.y1), f_x = f.length * (f.y0 + f.y1);
            rim_y += e_y + f.length * (f.x_at + f.x_at) + f.x_by * f_x;
            rim_x += f_x + e.length * (e.x_at + e.x_at) + e.x_by * e_y;
        }
        const Lanes over = all(0.5) / larger(rim, all(1e-100));
        const Lanes x = rim_x * over, y = rim_y * over, depth = (role.depth_at + p.depth_by_x * x) + q.depth_by_x * y;
        const LaneMask open = role.shallowest < all(1e-3) * role.deepest;
        const Lanes back = choose(open, -depth / larger(p.depth_by_x * p.depth_by_x + q.depth_by_x * q.depth_by_x, all(1e-300)), zero);
        role.fan = {x + back * p.depth_by_x, y + back * q.depth_by_x};
        role.fan_depth = choose(open, zero, depth);
        cell.open = open, cell.fan = role.fan, cell.depth_at = role.depth_at, cell.slope = {p.depth_by_x, q.depth_by_x};
        cell.half = {p.half, q.half}, cell.crease_at = {p.crease_at, q.crease_at}, cell.crease_slope = {p.crease_slope, q.crease_slope};
        for (std::size_t k = 0; k < 2; ++k) add_main_edges(role, k, cell);
    }

    /// Divides the fan's sums by their factors and moves them from its middle to that of a; adds the strips.
    MUSIM_WIDE static void finish_main_cell(Role& role, const Strips& strips) {
        role.load = role.area_depth * all(1.0 / 6.0);
        role.area_depth = role.load;
        const Lanes safe = larger(role.area, all(1e-300));  // twice the area
        role.area_mixed *= all(1.0 / 24.0);
        const std::array<Lanes, 2> middle{role.area_place[0] / (all(3.0) * safe), role.area_place[1] / (all(3.0) * safe)};
        role.area *= all(0.5);
        role.area_mixed -= role.area * (middle[0] * middle[1]);
        for (std::size_t k = 0; k < 2; ++k) {
            role.load_place[k] = (role.load_place[k] * all(1.0 / 24.0) + role.fan[k] * role.load) + strips.place[k];
            role.area_square[k] = role.area_square[k] * all(1.0 / 12.0) - role.area * (middle[k] * middle[k]);
            role.area_place[k] = role.area * (middle[k] + role.fan[k]);
        }
        role.load += strips.load;
    }

    /// A side plane m of Y along a rim: d = at + by y + by_s s.
    struct SidePlane {
        Lanes at, by, by_s;
        Lanes inverse, wedge;  ///< 1/by, 1/(2(ζ + by_s))
        MUSIM_WIDE Lanes operator()(const Lanes& y) const { return at + by * y; }
    };
    MUSIM_WIDE static SidePlane own_plane(const Across& u, const Lanes& x, std::size_t side) {
        const Lanes at = u.at + u.by_x * x;
        return side == 0 ? SidePlane{u.side + at, u.by_y, -u.by_s, u.inverse_y, u.wedge[0]}
                         : SidePlane{u.side - at, -u.by_y, u.by_s, -u.inverse_y, u.wedge[1]};
    }
    MUSIM_WIDE static SidePlane end_plane(const Across& v, const Lanes& x, std::size_t side) {
        const Lanes at = v.at + v.by_y * x;
        return side == 0 ? SidePlane{v.side + at, v.by_x, -v.by_s, v.inverse_x, v.wedge[0]}
                         : SidePlane{v.side - at, -v.by_x, v.by_s, -v.inverse_x, v.wedge[1]};
    }

    /// The part of rim `r` of direction k on which plane m is the nearest, `part`: its share in the side's load (D²/(2ζ) − (D − d)²/(2(ζ +
    /// g))) and in the strip of face a that ends there (d²/(2 by_x)), if m runs along the rim: m = 0, 1, else 2.
    MUSIM_WIDE static void add_rim_part(Role& role, std::size_t k, std::size_t r, std::size_t m, const SidePlane& plane, const Lanes& x,
                                        const Lanes& d_at, const Lanes& d_by, Interval part, const LaneMask& where) {
        const Lanes zero{};
        part.keep(-plane.at * plane.inverse, plane.inverse > zero);
        const Lanes y0 = part.low, y1 = part.high, rest = choose(where, part.length(), zero);
        const Lanes p0 = larger(plane(y0), zero), p1 = larger(plane(y1), zero), e0 = d_at + d_by * y0, e1 = d_at + d_by * y1;
        const Powers full(y0, y1, rest, e0, e1), gap(y0, y1, rest, e0 - p0, e1 - p1);
        const Lanes one = role.below, two = plane.wedge;
        const Lanes sign = all(sign_of(r));
        role.side[k] += sign * (one * full.square - two * gap.square);
        role.side_along[k] += sign * (one * full.along - two * gap.along);
        role.side_below[k] += sign * (all(2.0 / 3.0) * (one * one * full.cube - two * two * gap.cube));
        if (m == 2) return;
        const Powers d(y0, y1, rest, p0, p1);
        const Lanes beside = all(-sign_of(r) * sign_of(m) * 0.5) * role.across[k].inverse_x;
        role.load += beside * d.square;
        role.load_place[1 - k] += beside * d.along;
        role.load_place[k] += beside * (x * d.square + (all(sign_of(m) / 3.0) * role.across[k].inverse_x) * d.cube);
    }

    /// Where plane m ends on the side below the rim: the line d_m = 0 at s = −d_m(y)/g. There D² g/(2ζ(ζ + g)) dy.
    MUSIM_WIDE static void add_side_line(Role& role, std::size_t k, std::size_t r, const SidePlane& plane, const SidePlane& other_low,
                                         const SidePlane& other_high, const Lanes& d_at, const Lanes& d_by, Interval part,
                                         const LaneMask& where) {
        const Lanes zero{};
        const LaneMask up = plane.by_s > zero;
        const Lanes g = larger(magnitude(plane.by_s), all(1e-18));
        const Lanes a0 = choose(up, -plane.at, plane.at), a1 = choose(up, -plane.by, plane.by);  // g s
        const Lanes w0 = g * d_at - role.cosine * a0, w1 = g * d_by - role.cosine * a1;          // g D
        part.keep(-plane.at * plane.inverse, (plane.inverse > zero) ^ up);
        part.clip(w0, w1);
        if (some(role.corner)) {
            const auto clip_end = [&](const SidePlane& end) MUSIM_WIDE_LAMBDA {
                const Lanes slope = guarded(g * end.by + end.by_s * a1), at = -(g * end.at + end.by_s * a0) / slope;
                const LaneMask above = slope > zero;
                part.keep(choose(role.corner, at, choose(above, all(-kFar), all(kFar))), above);
            };
            clip_end(other_low), clip_end(other_high);
        }
        const Lanes length = choose(where, part.length(), zero);
        const Lanes over = all(1.0) / g;
        const Lanes s0 = over * larger(a0 + a1 * part.low, zero), s1 = over * larger(a0 + a1 * part.high, zero);
        const Lanes d0 = over * larger(w0 + w1 * part.low, zero), d1 = over * larger(w0 + w1 * part.high, zero);
        const Powers along_y(part.low, part.high, length, d0, d1), along_s(s0, s1, length, d0, d1);
        const Lanes wedge = role.cosine + plane.by_s, both = all(2.0) * (role.below * plane.wedge);
        const Lanes factor = (all(sign_of(r)) * g) * both;
        role.side[k] += factor * along_y.square;
        role.side_along[k] += factor * along_y.along;
        role.side_below[k] += factor * (along_s.along + (role.cosine + wedge) * (all(2.0 / 3.0) * both) * along_y.cube);
    }

    /// On the side below the rim, the line on which planes m and n are equally near: D − d falls at different rates on its two sides.
    MUSIM_WIDE static void add_side_bisector(Role& role, std::size_t k, std::size_t r, const SidePlane& m, const SidePlane& n,
                                             const Lanes& y, const Lanes& inverse, const Lanes& half, const Lanes& d_at, const Lanes& d_by,
                                             const LaneMask& where) {
        const Lanes zero{}, differ = n.by_s - m.by_s, lean = -differ * inverse;  // y + lean s
        const Lanes gap_at = (d_at + d_by * y) - m(y), gap_by = (d_by - m.by) * lean - (role.cosine + m.by_s);
        Interval part{zero, -gap_at / gap_by};
        part.clip(m(y), m.by * lean + m.by_s);
        part.clip(half - y, -lean);
        part.clip(half + y, lean);
        const Lanes length = choose(where, part.length(), zero);
        const Powers gap(part.low, part.high, length, gap_at + gap_by * part.low, gap_at + gap_by * part.high);
        const Lanes factor =
            all(-0.5 * sign_of(r)) * ((differ * differ) * magnitude(inverse)) / ((role.cosine + m.by_s) * (role.cosine + n.by_s));
        role.side[k] += factor * gap.square;
        role.side_along[k] += factor * (y * gap.square + lean * gap.along);
        role.side_below[k] +=
            factor * (gap.along + all(1.0 / 3.0) * ((all(1.0) / (role.cosine + m.by_s)) + all(1.0) / (role.cosine + n.by_s)) * gap.cube);
    }

    /// What rim `r` of direction k sees.
    struct Rim {
        Lanes x, d_at, d_by, half;
        std::array<SidePlane, 2> own, end;                       ///< along it, and across its ends; lower, upper
        std::array<std::array<Lanes, 2>, 2> meet, meet_inverse;  ///< [own][end]: where both are equally near; 1 / (slope of end − own)
        MUSIM_WIDE Rim(const Role& role, std::size_t k, std::size_t r) {
            const Across &u = role.across[k], &v = role.across[1 - k];
            x = r == 0 ? -u.half : u.half, half = v.half;
            d_at = role.depth_at + u.depth_by_x * x, d_by = v.depth_by_x;
            // of by_x ∓ by_y
#pragma GCC unroll 2
            for (std::size_t i = 0; i < 2; ++i) own[i] = own_plane(u, x, i), end[i] = end_plane(v, x, i);
#pragma GCC unroll 2
            for (std::size_t i = 0; i < 2; ++i) {
#pragma GCC unroll 2
                for (std::size_t j = 0; j < 2; ++j) {
                    // slopes: end ∓by_x, own ∓by_y
                    meet_inverse[i][j] = j == 0 ? v.bisector[i] : -v.bisector[1 - i];
                    meet[i][j] = (own[i].at - end[j].at) * meet_inverse[i][j];
                }
            }
        }
        /// Of `part`, where own plane i is nearer than those of the ends.
        MUSIM_WIDE Interval nearer_own(std::size_t i, Interval part) const {
            part.keep(meet[i][0], meet_inverse[i][0] > all(0.0));
            part.keep(meet[i][1], meet_inverse[i][1] > all(0.0));
            return part;
        }
        MUSIM_WIDE Interval nearer_end(std::size_t j, Interval part) const {
            part.keep(meet[0][j], meet_inverse[0][j] < all(0.0));
            part.keep(meet[1][j], meet_inverse[1][j] < all(0.0));
            return part;
        }
    };

    /// Where side plane m along rim r is nearer than b: the other side of the crease.
    MUSIM_WIDE static Interval beyond_crease(const Across& u, const Lanes& along, std::size_t r, std::size_t m) {
        Interval part{-along, along};
        part.keep(u.crossing[m][r], m == 0 ? u.crease_inverse[0] > all(0.0) : u.crease_inverse[1] < all(0.0));
        return part;
    }
    MUSIM_WIDE static LaneMask touches(const SidePlane& plane, const Interval& part) {
        return (part.low < part.high) & (larger(plane(part.low), plane(part.high)) > all(0.0));
    }

    /// Flush edges: rims that run along side plane m of Y at less than the depth.
    MUSIM_WIDE static void add_flush_rim(Role& role, std::size_t k, std::size_t r, std::size_t m, const LaneMask& where) {
        const Across &u = role.across[k], &v = role.across[1 - k];
        const SidePlane plane = own_plane(u, r == 0 ? -u.half : u.half, m);
        const Interval part = beyond_crease(u, v.half, r, m);
        LaneMask touching = touches(plane, part);
        const Lanes g = magnitude(plane.by_s), reach = magnitude(plane.by) * v.half + (all(1.1) * g) * role.deepest;
        LaneMask ends = (magnitude(plane.at) < reach) & ((g * v.half) * (role.deepest * role.deepest) > role.negligible);
        touching &= where, ends &= where;
        if (!some(touching | ends)) return;
        const Rim rim(role, k, r);
        if (some(touching)) add_rim_part(role, k, r, m, plane, rim.x, rim.d_at, rim.d_by, rim.nearer_own(m, part), touching);
        if (some(ends)) add_side_line(role, k, r, plane, rim.end[0], rim.end[1], rim.d_at, rim.d_by, Interval{-v.half, v.half}, ends);
    }

    /// Terms of the third order along a rim: at its ends, where it crosses Y's side planes, and about Y's corners.
    MUSIM_WIDE static void add_rim_ends(Role& role, std::size_t k, std::size_t r, bool leaning) {
        const Across& v = role.across[1 - k];
        const Rim rim(role, k, r);
        const Lanes slack = -role.deepest, third = (role.deepest * role.deepest) * role.deepest;
#pragma GCC unroll 2
        for (std::size_t j = 0; j < 2; ++j) {
            const SidePlane& plane = rim.end[j];
            const Lanes crease = v.crease_at[j] + v.crease_slope[j] * rim.x;
            const Interval part =
                rim.nearer_end(j, {j == 0 ? -v.half : larger(-v.half, crease), j == 0 ? smaller(v.half, crease) : v.half});
            const LaneMask touching = role.corner & touches(plane, part);
            if (some(touching)) add_rim_part(role, k, r, 2, plane, rim.x, rim.d_at, rim.d_by, part, touching);
            if (!leaning) continue;
            const Lanes y = -plane.at * plane.inverse;
            const LaneMask near = role.corner & (magnitude(y) < v.half - slack) & (rim.d_at + rim.d_by * y > slack) &
                                  (rim.own[0](y) > slack) & (rim.own[1](y) > slack);
            const LaneMask leans = near & ((plane.by_s * plane.by_s) * third > role.negligible);
            if (some(leans)) add_side_line(role, k, r, plane, rim.own[0], rim.own[1], rim.d_at, rim.d_by, Interval{-v.half, v.half}, leans);
#pragma GCC unroll 2
            for (std::size_t i = 0; i < 2; ++i) {
                const SidePlane& own = rim.own[i];
                const Lanes at = rim.meet[i][j], differ = plane.by_s - own.by_s;
                const LaneMask meets = role.corner & ((differ * differ) * third > role.negligible) & (magnitude(at) < v.half - slack) &
                                       (rim.d_at + rim.d_by * at > own(at)) & (own(at) > slack);
                if (some(meets)) add_side_bisector(role, k, r, own, plane, at, rim.meet_inverse[i][j], v.half, rim.d_at, rim.d_by, meets);
            }
        }
    }

    /// Corners of Y seen in X: from the corner, at d = 0, the strips of two side planes share a bisector.
    MUSIM_WIDE static void add_bisectors(Role& role) {
        const Lanes zero{};
        const Across &p = role.across[0], &q = role.across[1];
        const Lanes determinant = p.by_x * q.by_x - p.by_y * q.by_y, inverse = all(1.0) / determinant;
#pragma GCC unroll 2
        for (std::size_t i = 0; i < 2; ++i) {
#pragma GCC unroll 2
            for (std::size_t j = 0; j < 2; ++j) {
                // p.by_x x + p.by_y y = a, q.by_y x + q.by_x y = b at the corner; both less by ±d along the bisector
                const Lanes si = all(sign_of(i)), sj = all(sign_of(j)), a = si * p.side - p.at, b = sj * q.side - q.at;
                const Lanes x0 = (a * q.by_x - b * p.by_y) * inverse, y0 = (b * p.by_x - a * q.by_y) * inverse;
                const Lanes x1 = (sj * p.by_y - si * q.by_x) * inverse, y1 = (si * q.by_y - sj * p.by_x) * inverse;
                const Lanes d0 = (role.depth_at + p.depth_by_x * x0) + q.depth_by_x * y0, d1 = p.depth_by_x * x1 + q.depth_by_x * y1;
                const Lanes top = d0 / (all(1.0) - d1);
                const LaneMask near =
                    role.corner & (top > zero) & (magnitude(x0) < p.half + all(4.0) * top) & (magnitude(y0) < q.half + all(4.0) * top);
                if (!some(near)) continue;
                // inside the rims
                const std::size_t same = i == j ? 0 : 1;
                const Lanes inverse_x = determinant * q.bisector[same],
                            inverse_y = determinant * p.bisector[same];  // 1/x1, 1/y1 but for the sign
                const Lanes middle_x = (si * x0) * inverse_x, middle_y = (sj * y0) * inverse_y;
                const Lanes room_x = magnitude(p.half * inverse_x), room_y = magnitude(q.half * inverse_y);
                const Interval part{larger(zero, larger(middle_x - room_x, middle_y - room_y)),
                                    smaller(top, smaller(middle_x + room_x, middle_y + room_y))};
                const Lanes length = choose(near, part.length(), zero);
                const Powers d(part.low, part.high, length, part.low, part.high);  // ∫ d², ∫ d³, ∫ d³
                const Lanes of_p = -sj * y1 * (all(0.5) * p.inverse_x), of_q = -si * x1 * (all(0.5) * q.inverse_x);
                const Lanes along_x = x0 * d.square + x1 * d.cube, along_y = y0 * d.square + y1 * d.cube;
                role.load += (of_p + of_q) * d.square;
                role.load_place[0] += (of_p + of_q) * along_x + of_p * ((all(1.0 / 3.0) * si) * p.inverse_x) * d.cube;
                role.load_place[1] += (of_p + of_q) * along_y + of_q * ((all(1.0 / 3.0) * sj) * q.inverse_x) * d.cube;
            }
        }
    }

    /// A box with its axes named: two in the plane of the face, and the face's outward normal.
    struct FaceAxes {
        Lanes3 p, q, n, position;
        Lanes half_p, half_q, half_n;
    };
    static constexpr std::array<std::uint8_t, 5> kNext{0, 1, 2, 0, 1};  ///< axes in turn
    template <class Pairs>
    MUSIM_WIDE static FaceAxes gather_box(const Pairs& pairs, BoxMeeting::Box BoxMeeting::*which) {
        const auto vector = [&](const auto& from) MUSIM_WIDE_LAMBDA {
            return Lanes3{gather_lanes<Lanes>([&](std::size_t lane) MUSIM_WIDE_LAMBDA { return from(pairs(lane).*which)[0]; }),
                          gather_lanes<Lanes>([&](std::size_t lane) MUSIM_WIDE_LAMBDA { return from(pairs(lane).*which)[1]; }),
                          gather_lanes<Lanes>([&](std::size_t lane) MUSIM_WIDE_LAMBDA { return from(pairs(lane).*which)[2]; })};
        };
        const auto axis = [&](std::size_t i) MUSIM_WIDE_LAMBDA {
            return vector([i](const BoxMeeting::Box& box)
                              MUSIM_WIDE_LAMBDA { return box.rotation + 3 * std::size_t{kNext[box.axis + i]}; });
        };
        const auto half = [&](std::size_t i) MUSIM_WIDE_LAMBDA {
            return gather_lanes<Lanes>([&](std::size_t lane) MUSIM_WIDE_LAMBDA {
                const BoxMeeting::Box& box = pairs(lane).*which;
                return box.half[kNext[box.axis + i]];
            });
        };
        const Lanes sign = gather_lanes<Lanes>([&](std::size_t lane) MUSIM_WIDE_LAMBDA { return (pairs(lane).*which).sign; });
        return {axis(1),
                axis(2),
                scaled(axis(0), sign),
                vector([](const BoxMeeting::Box& box) MUSIM_WIDE_LAMBDA { return box.position; }),
                half(1),
                half(2),
                half(0)};
    }

    MUSIM_WIDE static Lanes3 combine_middle(const FaceAxes& x, const Lanes3& c, double half) {
        return broadcast<Lanes>(half) * c + x.half_n * x.n;
    }
    /// World axes: force on and moment about the middle of X by what pushes X's faces, and the main cell.
    struct RoleLoad {
        Lanes3 force, moment;
    };
    MUSIM_WIDE static RoleLoad turn_to_world(const Role& role, const FaceAxes& x, const Lanes& handed) {
        RoleLoad load;
        load.force = combine(x.p, x.q, x.n, role.side[0], role.side[1], role.load);
        const Lanes z0 = role.half_normal * role.side[0] - role.side_below[0], z1 = role.half_normal * role.side[1] - role.side_below[1];
        load.moment = scaled(
            combine(x.p, x.q, x.n, role.load_place[1] - z1, z0 - role.load_place[0], role.side_along[1] - role.side_along[0]), handed);
        return load;
    }

    /// As many pairs as there are lanes, which do not depend on each other.
    template <class Pairs>
    MUSIM_WIDE static void compute_any(const Pairs& pairs, LaneOverlap& result) {
        const Lanes zero{};
        const FaceAxes a = gather_box(pairs, &BoxMeeting::a);
        FaceAxes b = gather_box(pairs, &BoxMeeting::b);
        // b's axes in its face take names and signs from those of a that they are closest to
        {
            const Lanes pp = dot(b.p, a.p), pq = dot(b.p, a.q), qp = dot(b.q, a.p), qq = dot(b.q, a.q);
            const LaneMask swap = magnitude(pp) + magnitude(qq) < magnitude(pq) + magnitude(qp);
            const Lanes sign_p = choose(choose(swap, qp, pp) < zero, all(-1.0), all(1.0)),
                        sign_q = choose(choose(swap, pq, qq) < zero, all(-1.0), all(1.0));
            const Lanes3 p = b.p;
            const Lanes half_p = b.half_p;
            b.p = scaled(choose(swap, b.q, p), sign_p);
            b.q = scaled(choose(swap, p, b.q), sign_q);
            b.half_p = choose(swap, b.half_q, half_p);
            b.half_q = choose(swap, half_p, b.half_q);
        }
        // a's p, q, n are right-handed for sign 1, b's then left-handed
        const Lanes handed_a = gather_lanes<Lanes>([&](std::size_t lane) MUSIM_WIDE_LAMBDA { return pairs(lane).a.sign; }),
                    handed_b = -handed_a;

        const Lanes3 c{b.position.x - a.position.x, b.position.y - a.position.y, b.position.z - a.position.z};
        const Lanes pp = dot(a.p, b.p), pq = dot(a.p, b.q), pn = dot(a.p, b.n), qp = dot(a.q, b.p), qq = dot(a.q, b.q), qn = dot(a.q, b.n),
                    np = dot(a.n, b.p), nq = dot(a.n, b.q), cosine = -dot(a.n, b.n);
        std::array<Role, 2> roles;
        {
            Role& x = roles[0];
            x.cosine = cosine, x.half_normal = a.half_n;
            x.depth_at = (b.half_n + dot(c, b.n)) + a.half_n * cosine;
            Across &u = x.across[0], &v = x.across[1];
            u.half = a.half_p, u.side = b.half_p, u.by_x = pp, u.by_y = qp, u.by_s = np, u.at = np * a.half_n - dot(c, b.p),
            u.depth_by_x = -pn;
            v.half = a.half_q, v.side = b.half_q, v.by_x = qq, v.by_y = pq, v.by_s = nq, v.at = nq * a.half_n - dot(c, b.q),
            v.depth_by_x = -qn;
        }
        {
            Role& x = roles[1];
            x.cosine = cosine, x.half_normal = b.half_n;
            x.depth_at = (a.half_n - dot(c, a.n)) + b.half_n * cosine;
            Across &u = x.across[0], &v = x.across[1];
            u.half = b.half_p, u.side = a.half_p, u.by_x = pp, u.by_y = pq, u.by_s = pn, u.at = pn * b.half_n + dot(c, a.p),
            u.depth_by_x = -np;
            v.half = b.half_q, v.side = a.half_q, v.by_x = qq, v.by_y = qp, v.by_s = qn, v.at = qn * b.half_n + dot(c, a.q),
            v.depth_by_x = -nq;
        }
        for (std::size_t i = 0; i < 2; ++i) {
            Strips strips;
            add_main_cell(roles[i], result.cells[i], strips);
            finish_main_cell(roles[i], strips);
            result.cells[i].load = roles[i].area_depth;
        }
        result.cells[0].along = {a.p, a.q}, result.cells[0].normal = a.n, result.cells[0].middle = combine_middle(a, c, -0.5);
        result.cells[1].along = {b.p, b.q}, result.cells[1].normal = b.n, result.cells[1].middle = combine_middle(b, c, 0.5);
        // a sheet of no thickness, as the ground is given, has no far face
        const Lanes thick_a = choose(a.half_n > zero, a.half_n, a.half_p), thick_b = choose(b.half_n > zero, b.half_n, b.half_p);
        const Lanes deepest = larger(roles[0].deepest, roles[1].deepest), area = all(0.5) * (roles[0].area + roles[1].area);
        const Lanes least = smaller(smaller(smaller(a.half_p, a.half_q), thick_a), smaller(smaller(b.half_p, b.half_q), thick_b));
        const Lanes size = smaller(larger(a.half_p, a.half_q), larger(b.half_p, b.half_q));
        const Lanes negligible = all(kNegligible) * (size * area);
        const LaneMask corner = (deepest * deepest) * deepest > negligible;
        result.corner = corner;
        for (Role& role : roles) {
            role.deepest = deepest, role.corner = corner, role.negligible = negligible;
            for (std::size_t k = 0; k < 2; ++k) {
#pragma GCC unroll 2
                for (std::size_t r = 0; r < 2; ++r) add_flush_rim(role, k, r, r, ~LaneMask{});
                // a rim crosses the side plane of the other side where the touching area ends in a tip
                const Across &u = role.across[k], &v = role.across[1 - k];
                const LaneMask opposite = (u.side + u.by_x * u.half) - magnitude(u.at) < magnitude(u.by_y) * v.half + all(1.1) * deepest;
                if (!some(opposite)) continue;
#pragma GCC unroll 2
                for (std::size_t r = 0; r < 2; ++r) add_flush_rim(role, k, r, 1 - r, opposite);
            }
            if (!some(corner)) continue;
            // the lines in which two planes of Y meet X's sides lean with the tilt; what that makes is of the second order in it
            const Lanes lean = magnitude(role.across[0].by_s) + magnitude(role.across[1].by_s);
            const bool leaning = some(corner & ((lean * lean) * ((deepest * deepest) * deepest) > negligible));
            for (std::size_t k = 0; k < 2; ++k) {
#pragma GCC unroll 2
                for (std::size_t r = 0; r < 2; ++r) add_rim_ends(role, k, r, leaning);
            }
            add_bisectors(role);
        }

        // how far the touching area reaches across
        LaneMask apart = LaneMask{}, narrow = LaneMask{}, minor = LaneMask{};
        for (const Role& role : roles) {
            for (std::size_t k = 0; k < 2; ++k) {
                const Across &u = role.across[k], &v = role.across[1 - k];
                const Lanes reach = (u.half * magnitude(u.by_x) + v.half * magnitude(u.by_y)) + u.side, width = reach - magnitude(u.at);
                apart |= reach + role.half_normal * magnitude(u.by_s) < magnitude(u.at - role.half_normal * u.by_s);
                narrow |= width < all(kLeastWidth) * deepest;
            }
            const Lanes most = (role.depth_at + magnitude(role.across[0].depth_by_x) * role.across[0].half) +
                               magnitude(role.across[1].depth_by_x) * role.across[1].half;
            apart |= most <= zero;
            minor |= ~(role.area_depth >= all(kLeastMain) * ((role.load + magnitude(role.side[0])) + magnitude(role.side[1])));
        }
        const LaneMask fits = (cosine > all(kLeastCosine)) & (deepest < all(kMostDepth) * least) & ~narrow & ~minor &
                              (roles[0].area > zero) & (roles[1].area > zero);
        result.irregular = ~fits & ~(apart & (cosine > all(kLeastCosine)));

        const RoleLoad of_a = turn_to_world(roles[0], a, handed_a), of_b = turn_to_world(roles[1], b, handed_b);
        // pairs that are apart give nothing, whatever was summed up
        const Lanes half = choose(fits, all(0.5), zero);
        const Lanes3 fa = of_a.force, fb = of_b.force;
        result.force = {half * (fa.x - fb.x), half * (fa.y - fb.y), half * (fa.z - fb.z)};
        const Lanes3 f{half * (fa.x + fb.x), half * (fa.y + fb.y), half * (fa.z + fb.z)};
        result.moment = {half * ((of_a.moment.x - of_b.moment.x) - (c.y * f.z - c.z * f.y)),
                         half * ((of_a.moment.y - of_b.moment.y) - (c.z * f.x - c.x * f.z)),
                         half * ((of_a.moment.z - of_b.moment.z) - (c.x * f.y - c.y * f.x))};
        result.deepest = choose(fits, deepest, zero);
        result.area = choose(fits, area, zero);
        result.area_depth = half * (roles[0].area_depth + roles[1].area_depth);
        const auto place = [&](const Role& role, const FaceAxes& x) MUSIM_WIDE_LAMBDA {
            return combine(x.p, x.q, x.n, role.area_place[0], role.area_place[1], role.half_normal * role.area);
        };
        const Lanes3 place_a = place(roles[0], a), place_b = place(roles[1], b);
        const Lanes shift = all(0.25) * (roles[1].area - roles[0].area);
        result.area_place = {half * (place_a.x + place_b.x) + shift * c.x, half * (place_a.y + place_b.y) + shift * c.y,
                             half * (place_a.z + place_b.z) + shift * c.z};
        const auto square = [&](const Role& role, const FaceAxes& x, const Lanes Lanes3::*i, const Lanes Lanes3::*j) MUSIM_WIDE_LAMBDA {
            return half * ((role.area_square[0] * (x.p.*i * x.p.*j) + role.area_square[1] * (x.q.*i * x.q.*j)) +
                           role.area_mixed * (x.p.*i * x.q.*j + x.q.*i * x.p.*j));
        };
        constexpr auto X = &Lanes3::x, Y = &Lanes3::y, Z = &Lanes3::z;
        const auto sum = [&](const Lanes Lanes3::*i, const Lanes Lanes3::*j)
                             MUSIM_WIDE_LAMBDA { return square(roles[0], a, i, j) + square(roles[1], b, i, j); };
        result.area_square = {sum(X, X), sum(Y, Y), sum(Z, Z)};
        result.area_cross = {sum(Y, Z), sum(Z, X), sum(X, Y)};
    }
};

}  // namespace musim::lsdem::detail
