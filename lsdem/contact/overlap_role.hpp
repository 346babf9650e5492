#pragma once

#include <array>
#include <cstddef>

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

/// Inputs and sums of a role, its main cell, and what belongs to that alone.
template <class W>
struct OverlapRole {
    using Lanes = typename W::Real;
    using LaneMask = typename W::Mask;
    using Lanes3 = Triple<Lanes>;
    using Interval = detail::Interval<W>;
    using Cell = MainCell<W>;
    using Edge = typename Cell::Edge;
    static constexpr double kFar = Interval::kFar;
    MUSIM_WIDE static Lanes all(double value) { return broadcast<Lanes>(value); }
    MUSIM_WIDE static Lanes larger(const Lanes& a, const Lanes& b) { return larger_of<Lanes>(a, b); }
    MUSIM_WIDE static Lanes smaller(const Lanes& a, const Lanes& b) { return smaller_of<Lanes>(a, b); }

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
        Lanes depth_by_x;  ///< of D
        Lanes inverse_x;   ///< of by_x
        // creases D = d_±: x = at + slope y, lower one first; where the rims x = ∓half cross them: y
        std::array<Lanes, 2> crease_at, crease_slope, crease_inverse;
        std::array<std::array<Lanes, 2>, 2> crossing;  ///< [crease][rim]
        // once edges are flush or corners count
        Lanes inverse_y;                ///< of by_y, guarded
        std::array<Lanes, 2> bisector;  ///< 1/(by_x ∓ by_y of the other direction), guarded
        std::array<Lanes, 2> wedge;     ///< 1/(2 (ζ + g)) of the side planes
    };

    /// One body's faces in the other, and what they sum to.
    struct Role {
        std::array<Across, 2> across;
        Lanes depth_at;  ///< D = depth_at + ... − cosine s
        Lanes cosine, half_normal;
        Lanes below;       ///< 1/(2ζ)
        Lanes negligible;  ///< terms in the sums below this are left out [m³]
        LaneMask corner;
        LaneMask sides_face{};  ///< a side of X faces one of Y that is nearest to it: area that no main cell has
        Lanes deepest{}, shallowest{};
        Lanes energy{};  ///< ∫ of Y's field over the overlap [m⁴]
        // sums over face a, first moments along both directions
        Lanes load{};
        std::array<Lanes, 2> load_place{};
        // sums over the sides, upper less lower of each direction: load, its moment along the rim and below it
        std::array<Lanes, 2> side{}, side_along{}, side_below{};
        // main cell about its fan's middle
        Lanes fan_depth;
        Lanes area{}, area_depth{}, area_mixed{};
        std::array<Lanes, 2> area_place{}, area_square{};
    };

    static constexpr double sign_of(std::size_t side) { return side == 0 ? -1.0 : 1.0; }

    /// Creases and where they cross the rims of their own direction.
    MUSIM_WIDE static void find_creases(Role& role, std::size_t k) {
        Across& u = role.across[k];
        const Lanes depth_by_y = role.across[1 - k].depth_by_x;
        u.inverse_x = all(1.0) / u.by_x;
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

    /// Side planes, which only flush edges and corners need.
    MUSIM_WIDE static void find_side_planes(Role& role) {
        for (std::size_t k = 0; k < 2; ++k) {
            Across& u = role.across[k];
            const Lanes other = role.across[1 - k].by_y;
            u.inverse_y = all(1.0) / guarded(u.by_y);
            invert(guarded(u.by_x - other), guarded(u.by_x + other), u.bisector[0], u.bisector[1]);
            invert(role.cosine - u.by_s, role.cosine + u.by_s, u.wedge[0], u.wedge[1]);
            u.wedge[0] *= all(0.5), u.wedge[1] *= all(0.5);
        }
    }

    /// Edge i of direction k of the main cell, where D > 0. Is it there in some lane?
    MUSIM_WIDE static bool cut_main_edge(Role& role, Cell& cell, std::size_t k, std::size_t i, const Lanes& x_at, const Lanes& x_by,
                                         const Lanes& d_at, const Lanes& d_by, const Interval& part) {
        const Lanes zero{};
        bool& live = cell.live[k][i];
        live = some(part.low < part.high);
        if (!live) return false;
        Edge& e = cell.edges[k][i];
        e.x_at = x_at, e.x_by = x_by;
        e.y0 = part.low, e.y1 = part.high;
        e.d0 = d_at + d_by * e.y0, e.d1 = d_at + d_by * e.y1;
        const LaneMask crosses = smaller(e.d0, e.d1) < zero;
        if (some(crosses)) {
            const Lanes slope = guarded(d_by), end = -d_at / slope;
            const LaneMask rises = slope > zero;
            e.y0 = choose(crosses, choose(rises, larger(e.y0, end), e.y0), e.y0);
            e.y1 = choose(crosses, choose(rises, e.y1, smaller(e.y1, end)), e.y1);
            e.d0 = d_at + d_by * e.y0, e.d1 = d_at + d_by * e.y1;
        }
        e.length = larger(e.y1 - e.y0, zero);
        const LaneMask there = e.length > zero;
        role.deepest = larger(role.deepest, choose(there, larger(e.d0, e.d1), all(0.0)));
        role.shallowest = smaller(role.shallowest, choose(there, smaller(e.d0, e.d1), all(1e300)));
        live = some(there);
        cell.bounds += choose(there, all(static_cast<double>(1U << (4 * k + i))), zero);
        return live;
    }
    /// Adds the triangles between the fan's middle and the edges of one direction.
    MUSIM_WIDE static void add_main_edges(Role& role, std::size_t k, const Cell& cell) {
        Lanes area{}, mixed{}, place_x{}, place_y{}, square_x{}, square_y{};
        const Lanes fan_x = cell.fan[k], fan_y = cell.fan[1 - k];
        for (std::size_t i = 0; i < 4; ++i) {
            if (!cell.live[k][i]) continue;
            const Edge& e = cell.edges[k][i];
            const bool is_rim = i < 2;
            const Lanes y0 = e.y0 - fan_y, y1 = e.y1 - fan_y, y = y0 + y1;
            const Lanes x_fan = (is_rim ? e.x_at : e.x_at + e.x_by * fan_y) - fan_x;
            const Lanes twice = (i & 1U) == 0 ? -(x_fan * e.length) : x_fan * e.length;  // area of the triangle
            const Lanes ty = twice * y;
            area += twice;
            place_y += ty;
            square_y += ty * y - twice * (y0 * y1);
            if (is_rim) {
                const Lanes tx = twice * x_fan, three = all(3.0) * tx;
                place_x += tx + tx;
                square_x += three * x_fan;
                mixed += three * y;
            } else {
                const Lanes x0 = x_fan + e.x_by * y0, x1 = x_fan + e.x_by * y1, x = x0 + x1, tx = twice * x;
                place_x += tx;
                square_x += tx * x - twice * (x0 * x1);
                mixed += tx * y + twice * (x0 * y0 + x1 * y1);
            }
        }
        role.area += area, role.area_mixed += mixed;
        role.area_place[k] += place_x, role.area_place[1 - k] += place_y;
        role.area_square[k] += square_x, role.area_square[1 - k] += square_y;
    }

    /// Where an open cell ends, on D = 0.
    MUSIM_WIDE static void find_closing(const Role& role, Cell& cell) {
        const std::array<Lanes, 2> step{-cell.slope[1], cell.slope[0]};
        Interval part{all(-kFar), all(kFar)};
#pragma GCC unroll 2
        for (std::size_t k = 0; k < 2; ++k) {
            const Across& u = role.across[k];
            part.clip(u.half - cell.fan[k], -step[k]);
            part.clip(u.half + cell.fan[k], step[k]);
            const Lanes to_lower = cell.fan[k] - (u.crease_at[0] + u.crease_slope[0] * cell.fan[1 - k]);
            const Lanes to_upper = (u.crease_at[1] + u.crease_slope[1] * cell.fan[1 - k]) - cell.fan[k];
            part.clip(to_lower, step[k] - u.crease_slope[0] * step[1 - k]);
            part.clip(to_upper, u.crease_slope[1] * step[1 - k] - step[k]);
        }
        cell.closing = {{cell.fan[0] + part.high * step[0], cell.fan[1] + part.high * step[1]},
                        {cell.fan[0] + part.low * step[0], cell.fan[1] + part.low * step[1]},
                        cell.open & (part.low < part.high)};
    }
    /// The fan's middle: amid the edges, or on D = 0 next to that if the cell ends there, so that this edge adds nothing.
    MUSIM_WIDE static void find_middle(Role& role, Cell& cell) {
        const Lanes zero{};
        const Across &p = role.across[0], &q = role.across[1];
        Lanes rim{}, rim_x{}, rim_y{};
        const auto add_to_middle = [&](std::size_t k, Lanes& across, Lanes& along) MUSIM_WIDE_LAMBDA {
            for (std::size_t i = 0; i < 4; ++i) {
                if (!cell.live[k][i]) continue;
                const Edge& e = cell.edges[k][i];
                const Lanes twice = e.length * (e.y0 + e.y1);
                rim += e.length;
                along += twice;
                across += e.length * (e.x_at + e.x_at) + e.x_by * twice;
            }
        };
        add_to_middle(0, rim_x, rim_y), add_to_middle(1, rim_y, rim_x);
        const Lanes over = all(0.5) / larger(rim, all(1e-100));
        const Lanes x = rim_x * over, y = rim_y * over, depth = (role.depth_at + p.depth_by_x * x) + q.depth_by_x * y;
        const LaneMask open = role.shallowest < all(1e-3) * role.deepest;
        const Lanes back = choose(open, -depth / larger(p.depth_by_x * p.depth_by_x + q.depth_by_x * q.depth_by_x, all(1e-300)), zero);
        role.fan_depth = choose(open, zero, depth);
        cell.open = open, cell.fan = {x + back * p.depth_by_x, y + back * q.depth_by_x};
        cell.depth_at = role.depth_at, cell.slope = {p.depth_by_x, q.depth_by_x};
        if (some(open)) find_closing(role, cell);
    }

    /// Main cell of a (not yet divided by the fan's factors), and what belongs to it alone: the sides' loads below its rims (∫ D²/(2ζ)),
    /// the strips beyond its creases (∫ D²/(2 by_x)). Energies below strips and rims: of cubes of D.
    struct Strips {
        Lanes load{}, energy{};
        std::array<Lanes, 2> place{};
    };
    MUSIM_WIDE static void add_main_cell(Role& role, Cell& cell) {
        const Lanes zero{};
        Strips strips;
        Across &p = role.across[0], &q = role.across[1];
        role.below = all(0.5) / role.cosine;
        role.shallowest = all(1e300);
        find_creases(role, 0);
        find_creases(role, 1);
        cell.bounds = zero;
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
            const Lanes below = role.below;
#pragma GCC unroll 2
            for (std::size_t r = 0; r < 2; ++r) {
                const Lanes x = r == 0 ? -u.half : u.half;
                Interval part{larger(-v.half, v.crease_at[0] + v.crease_slope[0] * x),
                              smaller(v.half, v.crease_at[1] + v.crease_slope[1] * x)};
                part.keep(u.crossing[0][r], u.crease_inverse[0] < zero);
                part.keep(u.crossing[1][r], u.crease_inverse[1] > zero);
                if (!cut_main_edge(role, cell, k, r, x, zero, role.depth_at + u.depth_by_x * x, depth_by_y, part)) continue;
                const Edge& e = cell.edges[k][r];
                const Powers d(e.y0, e.y1, e.length, e.d0, e.d1);
                const Lanes factor = r == 0 ? -below : below;
                role.side[k] += factor * d.square;
                role.side_along[k] += factor * d.along;
                role.side_below[k] += (factor * below) * (all(2.0 / 3.0) * d.cube);
                strips.energy += (factor * u.depth_by_x) * (all(1.0 / 3.0) * d.cube);
            }
            // creases
            const Lanes beside = all(0.5) * u.inverse_x;
#pragma GCC unroll 2
            for (std::size_t c = 0; c < 2; ++c) {
                const Lanes y_low =
                    (v.crease_at[0] + v.crease_slope[0] * u.crease_at[c]) * (k == 0 ? determinant[c][0] : determinant[0][c]);
                const Lanes y_high =
                    (v.crease_at[1] + v.crease_slope[1] * u.crease_at[c]) * (k == 0 ? determinant[c][1] : determinant[1][c]);
                Interval part{larger(larger(-v.half, y_low), smaller(u.crossing[c][0], u.crossing[c][1])),
                              smaller(smaller(v.half, y_high), larger(u.crossing[c][0], u.crossing[c][1]))};
                if (!cut_main_edge(role, cell, k, 2 + c, u.crease_at[c], u.crease_slope[c], role.depth_at + u.depth_by_x * u.crease_at[c],
                                   depth_by_y + u.depth_by_x * u.crease_slope[c], part)) {
                    continue;
                }
                const Edge& e = cell.edges[k][2 + c];
                const Powers d(e.y0, e.y1, e.length, e.d0, e.d1);
                strips.load += beside * d.square;
                strips.energy += (u.inverse_x * (all(1.0 / 3.0) - all(sign_of(c) / 6.0) * u.by_s)) * d.cube;
                strips.place[1 - k] += beside * d.along;
                strips.place[k] +=
                    beside * ((u.crease_at[c] * d.square + u.crease_slope[c] * d.along) + (all(sign_of(c) * 2.0 / 3.0) * beside) * d.cube);
            }
        }
        find_middle(role, cell);
        for (std::size_t k = 0; k < 2; ++k) add_main_edges(role, k, cell);
        finish_main_cell(role, cell, strips);
    }

    /// Divides the fan's sums by their factors and moves them from its middle to that of a; adds the strips.
    MUSIM_WIDE static void finish_main_cell(Role& role, Cell& cell, const Strips& strips) {
        role.area *= all(0.5), role.area_mixed *= all(1.0 / 24.0);
        const Lanes over = all(1.0) / larger(role.area, all(1e-300));
        std::array<Lanes, 2> middle;
        for (std::size_t k = 0; k < 2; ++k) {
            role.area_place[k] *= all(1.0 / 6.0), role.area_square[k] *= all(1.0 / 12.0);
            middle[k] = role.area_place[k] * over;
        }
        // of D, which is affine, by the moments of the cell
        const Lanes x = role.across[0].depth_by_x, y = role.across[1].depth_by_x;
        role.area_depth = role.fan_depth * role.area + (x * role.area_place[0] + y * role.area_place[1]);
        role.load = role.area_depth + strips.load;
        for (std::size_t k = 0; k < 2; ++k) {
            const Lanes along = k == 0 ? x : y, across = k == 0 ? y : x;
            const Lanes about_fan = role.fan_depth * role.area_place[k] + (along * role.area_square[k] + across * role.area_mixed);
            role.load_place[k] = (about_fan + cell.fan[k] * role.area_depth) + strips.place[k];
        }
        role.area_mixed -= role.area * (middle[0] * middle[1]);
        for (std::size_t k = 0; k < 2; ++k) {
            role.area_square[k] -= role.area * (middle[k] * middle[k]);
            role.area_place[k] = role.area * (middle[k] + cell.fan[k]);
        }
        cell.load = role.area_depth, cell.spread = larger(role.area_square[0], role.area_square[1]) * over;
        const Lanes leaning = (x * x) * role.area_square[0] + (y * y) * role.area_square[1] + all(2.0) * ((x * y) * role.area_mixed);
        const Lanes square = role.area_depth * role.area_depth * over + leaning;
        role.energy = all(0.5) * (role.cosine * square) + strips.energy;
    }
};

}  // namespace musim::lsdem::detail
