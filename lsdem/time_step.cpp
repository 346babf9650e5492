#include "lsdem/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "lsdem/block_height.hpp"
#include "lsdem/contact_law.hpp"
#include "lsdem/detail/matrix6.hpp"
#include "lsdem/facing_sides.hpp"
#include "lsdem/solid/bearing_side.hpp"

namespace musim::lsdem {
namespace {

using detail::largest_eigenvalue;
using detail::Matrix6;

/// Stiffness and damping of one side, mass-normalised: the matrices of M^(-1/2) K M^(-1/2) and M^(-1/2) C M^(-1/2).
struct ModeMatrices {
    Matrix6 stiffness = Matrix6::Zero();  ///< [1/s²]
    Matrix6 damping = Matrix6::Zero();    ///< [1/s]

    void add(const ModeMatrices& other, double weight) {
        stiffness += weight * other.stiffness;
        damping += weight * other.damping;
    }
};

/// Body axis that stands most upright at the start: the faces across it carry the load.
Eigen::Index find_upright_axis(const Block& block) {
    Eigen::Index axis = 2;
    block.orientation.toRotationMatrix().row(2).cwiseAbs().maxCoeff(&axis);
    return axis;
}

/// Spread of the stiffness of a face: evenly, or over its nodes by area.
enum class Spread { even, by_nodes };

/// Four points with the area and the second moments of a rectangle.
std::vector<AreaPoint> spread_evenly(const Vector3& half, Eigen::Index axis, double sign) {
    const Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double to_point = 1.0 / std::sqrt(3.0);
    std::vector<AreaPoint> points;
    for (const double along_u : {-to_point, to_point}) {
        for (const double along_v : {-to_point, to_point}) {
            Vector3 place;
            place[axis] = sign * half[axis], place[u] = along_u * half[u], place[v] = along_v * half[v];
            points.push_back({place, half[u] * half[v]});
        }
    }
    return points;
}

/// Points of a face of a block.
std::vector<AreaPoint> find_face_points(const Model& model, const Block& block, Eigen::Index axis, double sign, Spread spread) {
    if (spread == Spread::even) return spread_evenly(half_extents(model, block), axis, sign);
    const BlockNodes nodes = nodes_of(model, block);
    std::vector<AreaPoint> points;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const AreaPoint point{nodes.position(i), std::max(0.0, sign * nodes.area(i)[axis])};
        if (point.area > 0.0) points.push_back(point);
    }
    return points;
}

/// Displacements of points of a block, body frame, by mass-normalised translations and rotations.
class PointMotion {
  public:
    PointMotion(const Model& model, const Block& block) : per_root_mass_(1.0 / std::sqrt(block.mass)) {
        if (block.rotation_locked) return;
        per_root_inertia_ = (block.mass * inertia_over_mass(model, block)).cwiseSqrt().cwiseInverse();
    }

    Eigen::Matrix<double, 3, 6> of(const Vector3& p) const {
        Eigen::Matrix<double, 3, 6> b;
        b.leftCols<3>() = per_root_mass_ * Matrix3::Identity();
        b.rightCols<3>() << 0.0, p.z(), -p.y(), -p.z(), 0.0, p.x(), p.y(), -p.x(), 0.0;
        b.rightCols<3>() = (b.rightCols<3>() * per_root_inertia_.asDiagonal()).eval();
        return b;
    }

  private:
    double per_root_mass_;
    Vector3 per_root_inertia_ = Vector3::Zero();
};

/// Points of a block pressed on a rigid plane across `normal`, body frame, through an interface.
ModeMatrices press(const Model& model, const Block& block, const Interface& law, const Vector3& normal,
                   const std::vector<AreaPoint>& points) {
    const PointMotion motion(model, block);
    ModeMatrices sum;
    for (const auto& [p, pressed_area] : points) {
        const double area = pressed_area;
        const Eigen::Matrix<double, 3, 6> b = motion.of(p);
        const auto per_area = [&](double along, double across) {
            const Matrix3 projector = normal * normal.transpose();
            return Matrix3(area * across * (Matrix3::Identity() - projector) + area * along * projector);
        };
        sum.stiffness += b.transpose() * per_area(law.normal_stiffness, law.shear_stiffness) * b;
        sum.damping += b.transpose() * per_area(law.normal_damping, law.shear_damping) * b;
    }
    return sum;
}

/// Face of a block across `axis`, on the side of `sign`, pressed on a rigid plane through an interface.
ModeMatrices face_matrices(const Model& model, const Block& block, const Interface& law, Eigen::Index axis, double sign, Spread spread) {
    return press(model, block, law, Vector3::Unit(axis), find_face_points(model, block, axis, sign, spread));
}

/// Actuators on block i.
ModeMatrices find_actuators(const Model& model, std::size_t i) {
    ModeMatrices sum;
    const Block& block = model.blocks[i];
    for (const Load& load : model.loads) {
        if (load.block != i || !load.is_actuator()) continue;
        const Vector3 direction = block.orientation.conjugate() * load.direction;
        const Eigen::Matrix<double, 6, 1> along = PointMotion(model, block).of(load.point).transpose() * direction;
        sum.stiffness += load.stiffness * along * along.transpose();
        sum.damping += find_actuator_damping(model, load) * along * along.transpose();
    }
    return sum;
}

/// dt for which the largest eigenvalue of K·dt²/4 + C·dt/2 is one.
double solve_limit(const ModeMatrices& modes) {
    const double undamped = 2.0 / std::sqrt(largest_eigenvalue(modes.stiffness));
    const auto stable = [&](double fraction) {
        const double dt = fraction * undamped;
        return largest_eigenvalue(modes.stiffness * (0.25 * dt * dt) + modes.damping * (0.5 * dt)) < 1.0;
    };
    // damping only lowers the limit; its fraction of the undamped one is a pure number, found to 2^-40
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (stable(middle) ? low : high) = middle;
    }
    return low * undamped;
}

/// The stiffest partner a block can meet: largest stiffness, damping and effective mass over all materials and masses of the model.
class Partners {
  public:
    explicit Partners(const Model& model) : model_(model) {
        for (const Block& block : model.blocks) heaviest_ = std::max(heaviest_, block.fixed ? kInfinite : block.mass);
    }

    Interface stiffest(const Block& block) const {
        const double effective = heaviest_ == kInfinite ? block.mass : block.mass * heaviest_ / (block.mass + heaviest_);
        Interface worst;
        for (std::size_t other = 0; other < model_.materials.size(); ++other) {
            const double area = model_.shapes[block.shape].face_area;
            const Interface law = make_interface(find_joint(model_, block.material, other), effective, area);
            worst.normal_stiffness = std::max(worst.normal_stiffness, law.normal_stiffness);
            worst.shear_stiffness = std::max(worst.shear_stiffness, law.shear_stiffness);
            worst.normal_damping = std::max(worst.normal_damping, law.normal_damping);
            worst.shear_damping = std::max(worst.shear_damping, law.shear_damping);
        }
        return worst;
    }

  private:
    static constexpr double kInfinite = std::numeric_limits<double>::infinity();
    const Model& model_;
    double heaviest_ = 0.0;
};

Interface make_ground_interface(const Model& model, const Block& block) {
    return make_interface(find_joint(model, block.material, std::nullopt), block.mass, model.shapes[block.shape].face_area);
}

/// Limit of a block of which two sides bear; `press_side(i, law)`: the matrices of the upper, 0, and the lower one, 1; `held`: those of
/// what holds the block besides.
template <class PressSide>
double block_limit(const Model& model, const Partners& partners, const Block& block, const ModeMatrices& held,
                   const PressSide& press_side) {
    const Interface between = partners.stiffest(block);
    const ModeMatrices top = press_side(0, between), bottom = press_side(1, between);
    ModeMatrices in_stack = held;
    in_stack.add(top, 2.0);
    in_stack.add(bottom, 2.0);
    double limit = solve_limit(in_stack);
    if (model.ground.present) {
        ModeMatrices at_base = held;
        at_base.add(top, 2.0);
        at_base.add(press_side(1, make_ground_interface(model, block)), 1.0);
        limit = std::min(limit, solve_limit(at_base));
    }
    return limit;
}

/// Limit of a block whose two faces across `axis` bear.
double block_limit(const Model& model, const Partners& partners, const Block& block, const ModeMatrices& held, Eigen::Index axis,
                   Spread spread) {
    return block_limit(model, partners, block, held, [&](int side, const Interface& law) {
        return face_matrices(model, block, law, axis, side == 0 ? 1.0 : -1.0, spread);
    });
}

/// Limit of a solid of which any side bears that may, with the one that faces away from it. `may_bear`: empty for all.
double solid_limit(const Model& model, const Partners& partners, const Block& block, const ModeMatrices& held, const Solid& solid,
                   const std::vector<bool>& may_bear) {
    double limit = std::numeric_limits<double>::infinity();
    const std::vector<BearingSide> sides = find_bearing_sides(solid);
    for (std::size_t s = 0; s < sides.size(); ++s) {
        if (!may_bear.empty() && !may_bear[s]) continue;
        const BearingSide& side = sides[s];
        const BearingSide other = find_bearing_side(solid, -side.normal);
        limit = std::min(limit, block_limit(model, partners, block, held, [&](int i, const Interface& law) {
                             const BearingSide& pressed = i == 0 ? other : side;
                             return press(model, block, law, pressed.normal, pressed.points);
                         }));
    }
    return limit;
}

double block_limit(const Model& model, const Partners& partners, const Block& block, const ModeMatrices& held, Eigen::Index axis,
                   const std::vector<bool>& may_bear) {
    const Solid* const solid = model.shapes[block.shape].solid.get();
    if (solid != nullptr) return solid_limit(model, partners, block, held, *solid, may_bear);
    return block_limit(model, partners, block, held, axis, meets_by_overlap(model, block) ? Spread::even : Spread::by_nodes);
}

/// Area of the largest face of a block, or of the faces of a solid that may bear together [m²].
double find_largest_face(const Model& model, const Block& block) {
    const Solid* const solid = model.shapes[block.shape].solid.get();
    if (solid == nullptr) {
        const Vector3 half = half_extents(model, block);
        return 4.0 * half.prod() / half.minCoeff();
    }
    double largest = 0.0;
    for (const BearingSide& side : find_bearing_sides(*solid)) largest = std::max(largest, side.area());
    return largest;
}

/// Calls visit(block, sides) with a block of every kind that moves: equal ones count once; of blocks that differ in height only, the
/// shortest and the tallest do. With it come the sides that may bear of one of that kind, of those of each block, if any are given.
template <class Visit>
void visit_kinds(const Model& model, const std::vector<std::vector<bool>>& sides, const Visit& visit) {
    struct Extremes {
        const Block *shortest, *tallest;
        std::vector<bool> sides;
    };
    const std::vector<double> nominal_masses = compute_nominal_masses(model);
    std::map<std::tuple<std::size_t, std::size_t, double, bool, Eigen::Index>, Extremes> kinds;
    for (std::size_t i = 0; i < model.blocks.size(); ++i) {
        const Block& block = model.blocks[i];
        if (block.fixed) continue;
        if (!(model.materials[block.material].normal_stiffness > 0.0))
            throw std::invalid_argument("compute_critical_time_step: the normal stiffness must be positive");
        const auto key = std::tuple{block.shape, block.material, nominal_masses[i], block.rotation_locked, find_upright_axis(block)};
        Extremes& known = kinds.try_emplace(key, Extremes{&block, &block, {}}).first->second;
        if (block.height_offset < known.shortest->height_offset) known.shortest = &block;
        if (block.height_offset > known.tallest->height_offset) known.tallest = &block;
        if (sides.empty()) continue;
        known.sides.resize(sides[i].size(), false);
        for (std::size_t f = 0; f < sides[i].size(); ++f) known.sides[f] = known.sides[f] || sides[i][f];
    }
    for (const auto& [key, extremes] : kinds) {
        visit(*extremes.shortest, extremes.sides);
        if (extremes.tallest != extremes.shortest) visit(*extremes.tallest, extremes.sides);
    }
}

/// Part by which the balance of energy may be open, and by which energy may grow, when a face lands flat [-], with ω its frequency on a
/// rigid plane and ζ its damping ratio: touching within a step h leaves (ωh)²/4 open, parting gains (ωh)²/4 − 2ζωh. Below the 1e-2 and
/// 1e-3 that a fall is to keep, and at no number that ratios of faces come to.
constexpr double kLandingOpen = 0.0091, kLandingGain = 0.0008;

/// Largest ωh of a face that lands [-]. Of one or two blocks each landing is to keep to the limits; what N/2 landings at random leave open
/// is sqrt(2/N) of that in the mean, of the energy of all.
double find_landing_phase(double damping_ratio, std::size_t moving_blocks) {
    const double room = std::sqrt(std::max(1.0, 0.5 * static_cast<double>(moving_blocks)));
    const double four = 4.0 * damping_ratio;
    return std::min(2.0 * std::sqrt(kLandingOpen * room), four + std::sqrt(four * four + 4.0 * kLandingGain * room));
}

/// Faces that land use no more than this part of their limit [-]; not one, since faces with four times the area have just half the limit.
constexpr double kLandingMargin = 0.95;

/// The part of the limit that a structure that stands is taken to use, as scenes do by default [-].
constexpr double kStandingPart = 0.8;

/// The highest coefficient of restitution of two blocks, or of a block and the ground [-].
double find_highest_restitution(const Model& model) {
    double highest = 0.0;
    for (const Material& material : model.materials) highest = std::max(highest, material.restitution);
    for (const MaterialPair& pair : model.pairs) highest = std::max(highest, pair.joint.restitution);
    return highest;
}

}  // namespace

double compute_critical_time_step(const Model& model) {
    const Partners partners(model);
    double limit = std::numeric_limits<double>::infinity();
    const std::vector<std::vector<bool>> facing = find_facing_sides(model);
    visit_kinds(model, facing, [&](const Block& block, const std::vector<bool>& sides) {
        limit = std::min(limit, block_limit(model, partners, block, {}, find_upright_axis(block), sides));
    });
    for (const Load& load : model.loads) {
        const Block& block = model.blocks[load.block];
        if (block.fixed || !load.is_actuator()) continue;
        const std::vector<bool> sides = facing.empty() ? std::vector<bool>{} : facing[load.block];
        const ModeMatrices held = find_actuators(model, load.block);
        limit = std::min(limit, block_limit(model, partners, block, held, find_upright_axis(block), sides));
    }
    if (!std::isfinite(limit)) throw std::invalid_argument("compute_critical_time_step: the model has no moving block");
    return limit;
}

std::optional<double> find_critical_time_step(const Model& model) {
    try {
        return compute_critical_time_step(model);
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
}

int compute_landing_halvings(const Model& model) {
    const std::optional<double> limit = find_critical_time_step(model);
    if (!limit) return 0;
    const Partners partners(model);
    double lying = *limit, squared_frequency = 0.0;
    visit_kinds(model, {}, [&](const Block& block, const std::vector<bool>& /*sides*/) {
        // round bodies show the same face to all sides
        if (!model.shapes[block.shape].faceted) return;
        const Shape& shape = model.shapes[block.shape];
        for (Eigen::Index axis = 0; axis < (shape.solid != nullptr ? 1 : 3); ++axis) {
            lying = std::min(lying, block_limit(model, partners, block, {}, axis, {}));
        }
        double stiffness = partners.stiffest(block).normal_stiffness;
        if (model.ground.present) stiffness = std::max(stiffness, make_ground_interface(model, block).normal_stiffness);
        const double largest_face = find_largest_face(model, block);
        squared_frequency = std::max(squared_frequency, stiffness * largest_face / block.mass);
    });
    const auto moving = std::count_if(model.blocks.begin(), model.blocks.end(), [](const Block& block) { return !block.fixed; });
    const double phase = find_landing_phase(compute_damping_ratio(find_highest_restitution(model)), static_cast<std::size_t>(moving));
    const double by_stability = *limit / (kLandingMargin * lying),
                 by_balance = kStandingPart * *limit * std::sqrt(squared_frequency) / phase;
    int halvings = 0;
    for (double parts = std::max(by_stability, by_balance); parts > 1.0; parts *= 0.5) ++halvings;
    return squared_frequency > 0.0 ? halvings : 0;
}

}  // namespace musim::lsdem
