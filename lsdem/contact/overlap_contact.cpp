#include "lsdem/contact/overlap_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace musim::lsdem {
namespace {

/// Faces that face each other under a smaller cosine than this bear no friction and no dashpot [-]; above, in proportion. So the narrow
/// strips along the edges of a flat contact, which lie at right angles to what they are nearest to, have no part in it.
constexpr double kLeastFacing = 0.3;

/// The mean distance r̄ of the pressure from its middle is no less than this part of √(J/S) [-]: 0.87 for a strip pressed evenly, 0.66 for
/// one pressed like a wedge, less for a part of it. Only decides whether r̄ has to be computed.
constexpr double kLeastReach = 0.3;

double share_of(const OverlapPieces::Piece& piece) { return std::max(0.0, (piece.facing - kLeastFacing) / (1.0 - kLeastFacing)); }

/// A triangle of a piece, about a point.
struct Triangle {
    std::array<Vector3, 3> place;
    double area;
};

/// Calls visit(triangle, first, second, third), the last three indices of vertices, for every triangle of a piece's fan.
template <class Visit>
void for_each_triangle(const OverlapPieces& pieces, const OverlapPieces::Piece& piece, const Vector3& about, const Visit& visit) {
    const OverlapPieces::Vertex* const v = pieces.vertices(piece);
    for (std::size_t i = 1; i + 1 < piece.count; ++i) {
        const Triangle triangle{{v[0].place - about, v[i].place - about, v[i + 1].place - about},
                                0.5 * piece.normal.dot((v[i].place - v[0].place).cross(v[i + 1].place - v[0].place))};
        visit(triangle, std::array<std::size_t, 3>{0, i, i + 1});
    }
}

/// Integral of an affine function and of its product with place.
struct Moments {
    double sum = 0.0;
    Vector3 at = Vector3::Zero();

    void add(const Triangle& triangle, const std::array<double, 3>& value, double weight) {
        const double total = (value[0] + value[1]) + value[2];
        sum += weight * triangle.area / 3.0 * total;
        for (std::size_t i = 0; i < 3; ++i) at += weight * triangle.area / 12.0 * (total + value[i]) * triangle.place[i];
    }
    /// The part where the function is positive.
    void add_positive(const Triangle& triangle, const std::array<double, 3>& value, double weight) {
        const int above = static_cast<int>(value[0] > 0.0) + static_cast<int>(value[1] > 0.0) + static_cast<int>(value[2] > 0.0);
        if (above == 0) return;
        if (above == 3) return add(triangle, value, weight);
        // one vertex is on the other side than the two others
        std::size_t lone = 0;
        while ((value[lone] > 0.0) != (above == 1)) ++lone;
        const std::size_t j = (lone + 1) % 3, k = (lone + 2) % 3;
        const double to_j = value[lone] / (value[lone] - value[j]), to_k = value[lone] / (value[lone] - value[k]);
        const Vector3& at_lone = triangle.place[lone];
        const Triangle corner{{at_lone, at_lone + to_j * (triangle.place[j] - at_lone), at_lone + to_k * (triangle.place[k] - at_lone)},
                              triangle.area * to_j * to_k};
        if (above == 2) add(triangle, value, weight);
        add(corner, {value[lone], 0.0, 0.0}, above == 1 ? weight : -weight);
    }
    void add(const Moments& other) {
        sum += other.sum;
        at += other.at;
    }
};

/// The area over which faces face each other, half of each body's, and how dashpots act there.
struct Spread {
    double area = 0.0;                 ///< S [m²]
    Vector3 middle = Vector3::Zero();  ///< of the area [m]
    double polar = 0.0;                ///< J about the middle, across the normal [m⁴]
    Moments dashpot;                   ///< force along the normal [N], and times place [N·m]
};

/// Sums over one body's faces.
struct HalfSpread {
    double area = 0.0, polar = 0.0;
    Vector3 at = Vector3::Zero();
    Moments dashpot;

    void add(const Triangle& triangle, double weight, const Vector3& normal) {
        area += weight * triangle.area;
        Vector3 sum = Vector3::Zero();
        double squares = 0.0;
        for (const Vector3& x : triangle.place) {
            const Vector3 across = x - normal.dot(x) * normal;
            sum += across;
            squares += across.squaredNorm();
            at += weight * triangle.area / 3.0 * x;
        }
        polar += weight * triangle.area / 12.0 * (sum.squaredNorm() + squares);
    }
};

/// `about`: where the pressure acts, near to all that is summed. `rate`: C_n/dt times the part of the step that the contact has lasted.
Spread find_spread(const OverlapPieces& pieces, const PairMotion& motion, const Vector3& normal, const Vector3& about, double stiffness,
                   double rate) {
    // how fast the bodies close, over the step, is affine
    const Vector3 slope = motion.turn[0] * normal - motion.turn[1] * normal;
    const double closing_about = -normal.dot(motion.displacement(about));
    std::array<HalfSpread, 2> half;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const OverlapPieces::Piece& piece = pieces[p];
        const double share = 0.5 * share_of(piece);
        if (!(share > 0.0)) continue;
        HalfSpread& sum = half[piece.of_first ? 0 : 1];
        const OverlapPieces::Vertex* const v = pieces.vertices(piece);
        for_each_triangle(pieces, piece, about, [&](const Triangle& triangle, const std::array<std::size_t, 3>& index) {
            sum.add(triangle, share, normal);
            if (rate == 0.0) return;
            // the dashpot takes off no more than the springs push: max(−K d, C ḋ) = C ḋ + max(0, −(K d + C ḋ))
            std::array<double, 3> closing, pull;
            for (std::size_t i = 0; i < 3; ++i) {
                closing[i] = rate * (closing_about - slope.dot(triangle.place[i]));
                pull[i] = -(stiffness * v[index[i]].depth + closing[i]);
            }
            sum.dashpot.add(triangle, closing, share);
            sum.dashpot.add_positive(triangle, pull, share);
        });
    }
    Spread spread;
    spread.area = half[0].area + half[1].area;
    if (!(spread.area > 0.0)) return spread;
    const Vector3 at = half[0].at + half[1].at, middle = at / spread.area;
    spread.polar = std::max(0.0, (half[0].polar + half[1].polar) - (middle - normal.dot(middle) * normal).squaredNorm() * spread.area);
    spread.middle = about + middle;
    spread.dashpot.add(half[0].dashpot);
    spread.dashpot.at += half[1].dashpot.at;
    spread.dashpot.sum += half[1].dashpot.sum;
    return spread;
}

/// ln x of a normal number x > 0, in sums, products and quotients only, so that it has the same bits everywhere.
double natural_log(double x) {
    int exponent = 0;
    double mantissa = std::frexp(x, &exponent);
    if (mantissa < std::numbers::sqrt2 / 2.0) mantissa *= 2.0, --exponent;
    const double t = (mantissa - 1.0) / (mantissa + 1.0), t2 = t * t;
    double series = 0.0;
    for (int n = 21; n >= 1; n -= 2) series = series * t2 + 1.0 / n;  // |t| < 0.172: below 1e-17 beyond
    return 2.0 * t * series + exponent * std::numbers::ln2;
}

/// ∫ d r over a polygon in a plane, r the distance from the origin: the triangles between the origin and its sides, in closed form.
/// `depth_at_origin`: d there, as it goes on from the polygon.
double integrate_distance(std::size_t count, const Vector3* place, const double* depth, double depth_at_origin, const Vector3& normal) {
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = i + 1 == count ? 0 : i + 1;
        const Vector3 side = place[next] - place[i];
        const double length = side.norm();
        if (!(length > 0.0)) continue;
        const Vector3 along = side / length;
        const double away = normal.dot(place[i].cross(along)), s0 = along.dot(place[i]), s1 = s0 + length;
        if (away == 0.0) continue;
        const double r0 = std::sqrt(away * away + s0 * s0), r1 = std::sqrt(away * away + s1 * s1);
        // s + r without cancellation
        const double e0 = s0 > 0.0 ? s0 + r0 : away * away / (r0 - s0), e1 = s1 > 0.0 ? s1 + r1 : away * away / (r1 - s1);
        const double of_r = 0.5 * ((s1 * r1 - s0 * r0) + away * away * (e0 > 0.0 ? natural_log(e1 / e0) : 0.0));
        const double slope = (depth[next] - depth[i]) / length;
        const double of_depth_r = (depth[i] - slope * s0) * of_r + slope * ((r1 * r1 * r1 - r0 * r0 * r0) / 3.0);
        sum += away * (depth_at_origin / 12.0 * of_r + 0.25 * of_depth_r);
    }
    return sum;
}

/// r̄, the mean distance of the pressure from where it acts, across the normal [m].
double find_reach(const OverlapPieces& pieces, const Vector3& normal, const Vector3& about) {
    std::array<double, 2> distance{}, load{};
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const OverlapPieces::Piece& piece = pieces[p];
        const double share = share_of(piece);
        const double sign = piece.of_first ? 1.0 : -1.0, cosine = sign * piece.normal.dot(normal);
        if (!(share > 0.0) || !(cosine > 0.0)) continue;
        const OverlapPieces::Vertex* const v = pieces.vertices(piece);
        std::array<Vector3, OverlapPieces::kMostCorners> place;
        std::array<double, OverlapPieces::kMostCorners> depth;
        for (std::size_t i = 0; i < piece.count; ++i) {
            const Vector3 x = v[i].place - about;
            place[i] = x - normal.dot(x) * normal;
            depth[i] = v[i].depth;
        }
        // the point of the piece's plane that lies over the origin
        const Vector3 to_first = v[0].place - about;
        const Vector3 over = piece.normal.dot(to_first) / piece.normal.dot(normal) * normal;
        const double at_origin = v[0].depth - piece.nearest_normal.dot(over - to_first);
        const std::size_t body = piece.of_first ? 0 : 1;
        distance[body] += share * sign * integrate_distance(piece.count, place.data(), depth.data(), at_origin, normal);
        Moments sum;
        for_each_triangle(pieces, piece, about, [&](const Triangle& triangle, const std::array<std::size_t, 3>& index) {
            sum.add(triangle, {v[index[0]].depth, v[index[1]].depth, v[index[2]].depth}, share * cosine);
        });
        load[body] += sum.sum;
    }
    const double total = load[0] + load[1];
    return total > 0.0 ? std::max(0.0, (distance[0] + distance[1]) / total) : 0.0;
}

/// Turns a vector with the mean turn of both bodies over the step, without changing its length.
Vector3 carried(const Vector3& v, const PairMotion& motion) {
    const Vector3 half = 0.25 * (motion.turned(0) + motion.turned(1));
    const Vector3 across = half.cross(v);
    return v + 2.0 / (1.0 + half.squaredNorm()) * (across + half.cross(across));
}

/// Friction of a contact: a force across the normal at `arm` from where the pressure acts, and a couple about the normal.
struct Friction {
    Vector3 force;
    double couple;
};

/// The limit of friction as a whole: |f|² + (m/r̄)² ≤ (μN)², m about where the pressure acts [GoyalRuinaPapadopoulos91].
struct Limit {
    double force, reach;
    Vector3 arm;  ///< of the friction's force from where the pressure acts [m]
    Vector3 normal;

    double about_pressure(const Friction& friction) const { return friction.couple + normal.dot(arm.cross(friction.force)); }
    /// How far beyond the limit, 0 on it, in squares of it.
    double excess(const Friction& friction) const {
        const double turning = about_pressure(friction) / reach;
        return (friction.force.squaredNorm() + turning * turning) / (force * force) - 1.0;
    }
    /// Back to the limit: first along the slip that it goes with, which is normal to the limit, then in proportion. The first makes the
    /// slip of a steady slide what the bodies do, the second makes the limit hold.
    void hold(double stiffness, double turning_stiffness, Friction& friction) const {
        const double beyond = excess(friction);
        if (!(beyond > 0.0)) return;
        const Vector3 slip = friction.force / (force * force);
        const double turn = about_pressure(friction) / (force * force * reach * reach);
        const Vector3 change = -stiffness * (slip + turn * normal.cross(arm));
        const double couple_change = -turning_stiffness * turn;
        const double slope = 2.0 * (slip.dot(change) + turn * (couple_change + normal.dot(arm.cross(change))));
        if (slope < 0.0) {
            const double part = beyond / -slope;
            friction.force += part * change;
            friction.couple += part * couple_change;
        }
        const double left = excess(friction);
        if (!(left > 0.0)) return;
        const double scale = 1.0 / std::sqrt(1.0 + left);
        friction.force *= scale;
        friction.couple *= scale;
    }
};

}  // namespace

OverlapForces compute_overlap_contact(const OverlapPieces& pieces, const PairMotion& motion, const Interface& law, double dt,
                                      bool first_step, double stored_shear, OverlapContact& contact) {
    const OverlapContact before = contact;
    contact = OverlapContact{};
    OverlapForces result;
    const OverlapLoad load = sum_load(pieces);
    const double push = law.normal_stiffness * load.force.norm();
    if (push > 0.0) {
        contact.touches = true;
        const Vector3 normal = load.force.normalized();
        // where the pressure acts: the point of the force's line nearest to the origin
        const Vector3 pressed = normal.cross(load.moment) / load.force.norm();
        const double sunk = -normal.dot(motion.displacement(pressed));
        const bool lasts = before.touches;
        const double part = !lasts && sunk > load.deepest ? load.deepest / sunk : 1.0;
        const Spread spread = find_spread(pieces, motion, normal, pressed, law.normal_stiffness, part * law.normal_damping / dt);

        contact.area = spread.area;
        contact.polar = spread.polar;
        contact.normal = normal;
        contact.place = spread.area > 0.0 ? spread.middle : pressed;
        const Vector3 arm = contact.place - pressed;
        contact.damping.force = spread.dashpot.sum * normal;
        contact.damping.couple = (spread.dashpot.at - spread.dashpot.sum * arm).cross(normal);

        // springs of friction: a smaller area keeps its slip, a larger one its force, so that neither gives energy
        const double stiffness = law.shear_stiffness * spread.area, turning_stiffness = law.shear_stiffness * spread.polar;
        const double kept = spread.area < before.area ? spread.area / before.area : 1.0;
        const double kept_turn = spread.polar < before.polar ? spread.polar / before.polar : 1.0;
        const Vector3 shear = carried(before.shear, motion), slipped = motion.displacement(contact.place);
        const double slip_part = first_step ? 0.0 : part;
        const Vector3 slip = slip_part * (slipped - normal.dot(slipped) * normal);
        const double turn = slip_part * normal.dot(motion.turned(1) - motion.turned(0));
        const double viscous = law.shear_stiffness > 0.0 ? law.shear_damping / (law.shear_stiffness * dt) : 0.0;
        Friction springs{kept * (shear - normal.dot(shear) * normal) - stiffness * slip,
                         kept_turn * before.couple - turning_stiffness * turn};
        Friction drag{-viscous * stiffness * slip, -viscous * turning_stiffness * turn};
        Friction friction{springs.force + drag.force, springs.couple + drag.couple};

        Limit limit{law.friction * std::max(0.0, push + spread.dashpot.sum), 0.0, arm - normal.dot(arm) * normal, normal};
        if (limit.force > 0.0 && spread.polar > 0.0) {
            limit.reach = kLeastReach * std::sqrt(spread.polar / spread.area);
            if (limit.excess(friction) > 0.0) {
                limit.reach = find_reach(pieces, normal, pressed);
                const double beyond = limit.reach > 0.0 ? limit.excess(friction) : 0.0;
                if (beyond > 0.0) {
                    // dashpots give up their share, in proportion
                    limit.hold(stiffness, turning_stiffness, friction);
                    const double left = 1.0 / std::sqrt(1.0 + beyond);
                    drag = {left * drag.force, left * drag.couple};
                    springs = {friction.force - drag.force, friction.couple - drag.couple};
                }
            }
        }
        if (!(limit.force > 0.0 && limit.reach > 0.0)) springs = friction = drag = {Vector3::Zero(), 0.0};
        contact.shear = springs.force;
        contact.couple = springs.couple;
        contact.friction = {friction.force, friction.couple * normal};
        contact.drag = {drag.force, drag.couple * normal};
        if (stiffness > 0.0) result.elastic_shear += 0.5 * springs.force.squaredNorm() / stiffness;
        if (turning_stiffness > 0.0) result.elastic_shear += 0.5 * springs.couple * springs.couple / turning_stiffness;

        const Vector3 at_middle = contact.damping.force + friction.force;
        result.force = law.normal_stiffness * load.force + at_middle;
        result.moment =
            law.normal_stiffness * load.moment + contact.place.cross(at_middle) + contact.damping.couple + contact.friction.couple;
        result.overlap = load.deepest;
        result.area = load.area;
    }

    // losses: what acts works over a step with the mean of its values at both ends
    const Vector3 turned = motion.turned(1) - motion.turned(0);
    const Vector3 moved = motion.displacement(contact.place), moved_before = motion.displacement_of_previous(before.place);
    const auto loss = [&](const PlacedWrench& last, const PlacedWrench& now) {
        return -0.5 * (last.force.dot(moved_before) + now.force.dot(moved) + (last.couple + now.couple).dot(turned));
    };
    const double dragged = loss(before.drag, contact.drag);
    result.work.damping = loss(before.damping, contact.damping) + dragged;
    result.work.friction = (loss(before.friction, contact.friction) - dragged) - (result.elastic_shear - stored_shear);
    return result;
}

}  // namespace musim::lsdem
