#include "lsdem/contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace musim::lsdem {
namespace {

using Row = std::array<double, 3>;

double dot(const Row& a, const Row& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Pose of the leader in the follower's frame, and its change over the last step. Differences of poses, not velocities times dt: their sum
/// over time telescopes, so that a stuck node cannot creep by rounding or by the turning of its lever arm.
struct RelativePose {
    std::array<Row, 3> rotation;  ///< rows: leader's body frame to follower's frame
    Row position;                 ///< leader's origin in the follower's frame [m]
    std::array<Row, 3> rotation_change;
    Row position_change;  ///< [m]

    RelativePose(const Matrix3& q, const Vector3& t, const Matrix3& old_q, const Vector3& old_t) {
        for (int i = 0; i < 3; ++i) {
            const auto r = static_cast<std::size_t>(i);
            position[r] = t[i];
            position_change[r] = t[i] - old_t[i];
            for (int j = 0; j < 3; ++j) {
                const auto c = static_cast<std::size_t>(j);
                rotation[r][c] = q(i, j);
                rotation_change[r][c] = q(i, j) - old_q(i, j);
            }
        }
    }
};

/// Interface with the time step folded in: tractions from displacements.
struct StepLaw {
    double kn, ks, mu, cn, cs;  ///< K_n, K_s [Pa/m], μ [-], C_n/dt, C_s/dt [Pa/m]
    double ks_inverse;          ///< 1/K_s, or zero without shear stiffness

    StepLaw(const Interface& law, double dt)
        : kn(law.normal_stiffness),
          ks(law.shear_stiffness),
          mu(law.friction),
          cn(law.normal_damping / dt),
          cs(law.shear_damping / dt),
          ks_inverse(law.shear_stiffness > 0.0 ? 1.0 / law.shear_stiffness : 0.0) {}
};

/// Energies and extremes over the nodes of one pair.
struct NodeTotals {
    double elastic_normal = 0.0, elastic_shear = 0.0, friction = 0.0, damping = 0.0, overlap = 0.0;
    std::uint32_t touching = 0;
};

/// Force and moment about the follower's origin, in the follower's frame or a cyclic permutation of it.
struct ForceSum {
    Row force{}, moment{};

    [[gnu::always_inline]] void add_at(double x, double y, double z, double fx, double fy, double fz) {
        force[0] += fx, force[1] += fy, force[2] += fz;
        moment[0] += y * fz - z * fy;
        moment[1] += z * fx - x * fz;
        moment[2] += x * fy - y * fx;
    }
};

/// Tractions of one node that is in contact. `Axes` tangential components: two where the normal is an axis of the frame, else three.
template <std::size_t Axes>
struct Traction {
    double pressure = 0.0;
    std::array<double, Axes> shear{};
};

/// What happened at one node since the last step, split along its normal.
template <std::size_t Axes>
struct NodeMotion {
    double overlap = 0.0;        ///< now [m]
    double normal_change = 0.0;  ///< displacement of the leader along the outward normal of the follower [m]
    std::array<double, Axes> tangential_change{};
    double area = 0.0;  ///< acting area now [m²]
};

/// The contact law at one node; `slip` and `viscous` are its history in the tangent plane and are updated. Losses are booked so that the
/// sum of work closes exactly in discrete time: a force works over a step with the mean of its values at both ends.
template <std::size_t Axes>
[[gnu::always_inline]] inline Traction<Axes> apply_law(const StepLaw& law, const NodeMotion<Axes>& node, std::array<double, Axes>& slip,
                                                       std::array<double, Axes>& viscous, double& damping_pressure, NodeTotals& totals) {
    const bool born = damping_pressure == std::numeric_limits<double>::infinity();
    Traction<Axes> traction;
    const double elastic = law.kn * node.overlap;
    traction.pressure = std::max(0.0, elastic - law.cn * node.normal_change);

    // trial: all of the change is elastic; a new contact starts where it is
    std::array<double, Axes> old_slip{}, old_shear{}, change{};
    double shear_squared = 0.0;
    if (!born) {
        old_slip = slip;
        change = node.tangential_change;
    }
    for (std::size_t a = 0; a < Axes; ++a) {
        old_shear[a] = (born ? 0.0 : viscous[a]) - law.ks * old_slip[a];
        slip[a] = old_slip[a] + change[a];
        viscous[a] = -law.cs * change[a];
        traction.shear[a] = viscous[a] - law.ks * slip[a];
        shear_squared += traction.shear[a] * traction.shear[a];
    }
    const double limit = law.mu * traction.pressure;
    const bool slides = shear_squared > limit * limit;
    if (slides) {
        const double scale = limit / std::sqrt(shear_squared);
        for (std::size_t a = 0; a < Axes; ++a) {
            traction.shear[a] *= scale;
            slip[a] = -law.ks_inverse * traction.shear[a];
            viscous[a] = 0.0;
        }
    }

    double work = 0.0, stored = 0.0, stored_before = 0.0;
    for (std::size_t a = 0; a < Axes; ++a) {
        work -= 0.5 * (old_shear[a] + traction.shear[a]) * change[a];
        stored += slip[a] * slip[a];
        stored_before += old_slip[a] * old_slip[a];
    }
    const double tangential_loss = node.area * (work - 0.5 * law.ks * (stored - stored_before));
    (slides ? totals.friction : totals.damping) += tangential_loss;
    const double new_damping_pressure = traction.pressure - elastic;
    totals.damping -= 0.5 * node.area * ((born ? 0.0 : damping_pressure) + new_damping_pressure) * node.normal_change;
    totals.elastic_normal += 0.5 * node.area * elastic * node.overlap;
    totals.elastic_shear += 0.5 * node.area * law.ks * stored;
    totals.overlap = std::max(totals.overlap, node.overlap);
    ++totals.touching;
    damping_pressure = new_damping_pressure;
    return traction;
}

/// A contact that has just ended gives up what its springs and dashpots held; `share` is the area it could act on [m²].
void end_contact(const StepLaw& law, const Row& normal, const Row& change, double share, NodeHistory& history, ViscousTraction* viscous,
                 NodeTotals& totals) {
    double released = 0.0, dashpot = history.damping_pressure * dot(normal, change);
    for (std::size_t i = 0; i < 3; ++i) {
        released += history.slip[i] * (history.slip[i] + change[i]);
        if (viscous != nullptr) dashpot += viscous->value[i] * change[i];
    }
    totals.friction += 0.5 * share * law.ks * released;
    totals.damping -= 0.5 * share * dashpot;
    history = NodeHistory{};
    if (viscous != nullptr) *viscous = ViscousTraction{};
}

ViscousTraction* viscous_of(ContactList& list, std::uint32_t entry) { return list.viscous.empty() ? nullptr : &list.viscous[entry]; }

/// A flat face of the follower: the plane of the ground, or one face of a box. The face of a box is chosen per pair, as the one the leader
/// penetrates least: nodes near an edge of a shared face then push along its normal, not sideways.
struct FlatFollower {
    std::size_t axis = 2;  ///< of the follower's frame, along the normal
    double side = 1.0;     ///< outward normal = side·e_axis
    bool bounded = true;   ///< a face with edges; the ground has none
    Row half{};            ///< half extents of the follower [m]
};

/// Which axis of the leader lies closest to each axis of the follower.
struct AxisMatch {
    std::size_t normal, u, v;

    AxisMatch(const RelativePose& pose, std::size_t k) {
        const auto size = [&](std::size_t row, std::size_t column) { return std::abs(pose.rotation[row][column]); };
        normal = size(k, 0) > size(k, 1) ? 0 : 1;
        if (size(k, 2) > size(k, normal)) normal = 2;
        const std::size_t a = (normal + 1) % 3, b = (normal + 2) % 3, row = (k + 1) % 3;
        u = size(row, a) >= size(row, b) ? a : b;
        v = u == a ? b : a;
    }
};

/// Part of a cell [middle − reach, middle + reach] that lies within ±half, 0...1, and how it changes as the cell moves.
struct Cover {
    double part = 1.0;
    double slope = 0.0;  ///< [1/m]
};

[[gnu::always_inline]] inline Cover find_cover(double middle, double reach, double half) {
    const double above = middle + reach - half, below = -half - (middle - reach);
    if (above <= 0.0 && below <= 0.0) return {};
    const double covered = 2.0 * reach - std::max(above, 0.0) - std::max(below, 0.0);
    if (covered <= 0.0) return {0.0, 0.0};
    const double slope = (below > 0.0 ? 1.0 : 0.0) - (above > 0.0 ? 1.0 : 0.0);
    return {covered / (2.0 * reach), slope / (2.0 * reach)};
}

/// Node arrays of a leader, as seen along the axes of a contact face; plain pointers, so that writing history does not force reloads.
struct NodeView {
    const double *x, *y, *z, *area_x, *area_y, *area_z, *center_x, *center_y, *center_z, *area_of_face, *reach_u, *reach_v;

    NodeView(const SurfaceNodes& nodes, const AxisMatch& match)
        : x(nodes.x.data()),
          y(nodes.y.data()),
          z(nodes.z.data()),
          area_x(nodes.area_x.data()),
          area_y(nodes.area_y.data()),
          area_z(nodes.area_z.data()),
          center_x(nodes.center_x.data()),
          center_y(nodes.center_y.data()),
          center_z(nodes.center_z.data()),
          area_of_face(std::array{area_x, area_y, area_z}[match.normal]),
          reach_u(std::array{nodes.half_x.data(), nodes.half_y.data(), nodes.half_z.data()}[match.u]),
          reach_v(std::array{nodes.half_x.data(), nodes.half_y.data(), nodes.half_z.data()}[match.v]) {}
};

/// Nodes against a flat face. The acting area of a node is its share of the leader's face that looks at the follower, clipped to the
/// follower's face. The springs' energy ½(K_n d² + K_s ξ²) A depends on the pose through A too: its gradient is the edge force below,
/// smaller than the normal force by overlap/spacing, without which the contact is not conservative and slender stacks flutter.
/// Works in the axes (k, u, v) of the face, a cyclic permutation of the follower's.
template <bool Faceted>
void sum_flat_nodes(const SurfaceNodes& nodes, const RelativePose& pose, const FlatFollower& face, const StepLaw& law,
                    const ContactPair& pair, ContactList& list, ForceSum& sum, NodeTotals& totals) {
    const std::size_t k = face.axis, u = (k + 1) % 3, v = (k + 2) % 3;
    const AxisMatch match(pose, k);
    const NodeView view(nodes, match);
    const Row row_k = pose.rotation[k], row_u = pose.rotation[u], row_v = pose.rotation[v];
    const Row turn_k = pose.rotation_change[k], turn_u = pose.rotation_change[u], turn_v = pose.rotation_change[v];
    const Row at{pose.position[k], pose.position[u], pose.position[v]};
    const Row moved{pose.position_change[k], pose.position_change[u], pose.position_change[v]};
    const double side = face.side, half_k = face.half[k], half_u = face.half[u], half_v = face.half[v];
    const bool bounded = face.bounded;
    const double facing_sign = -side * row_k[match.normal] < 0.0 ? -1.0 : 1.0;
    const std::uint32_t* const index = list.nodes.data();
    NodeHistory* const histories = list.history.data();
    ViscousTraction* const tractions = list.viscous.empty() ? nullptr : list.viscous.data();
    ForceSum local;
    NodeTotals local_totals;

    for (std::uint32_t entry = pair.first_node, end = pair.first_node + pair.node_count; entry < end; ++entry) {
        const std::uint32_t i = index[entry];
        NodeHistory& history = histories[entry];
        const Row p{view.x[i], view.y[i], view.z[i]};
        const double y_k = dot(row_k, p) + at[0];
        const double overlap = half_k - side * y_k;
        if (overlap <= 0.0 && !history.touches()) continue;

        const double y_u = dot(row_u, p) + at[1], y_v = dot(row_v, p) + at[2];
        const double change_k = dot(turn_k, p) + moved[0], change_u = dot(turn_u, p) + moved[1], change_v = dot(turn_v, p) + moved[2];
        const double share = Faceted ? facing_sign * view.area_of_face[i]
                                     : -side * (row_k[0] * view.area_x[i] + row_k[1] * view.area_y[i] + row_k[2] * view.area_z[i]);
        Cover cover_u, cover_v;
        const Row center{view.center_x[i], view.center_y[i], view.center_z[i]};
        const double middle_u = y_u + dot(row_u, center), middle_v = y_v + dot(row_v, center);
        if (bounded) {
            cover_u = find_cover(middle_u, view.reach_u[i], half_u);
            cover_v = find_cover(middle_v, view.reach_v[i], half_v);
        }
        const NodeMotion<2> node{overlap, side * change_k, {change_u, change_v}, share * cover_u.part * cover_v.part};
        if (overlap <= 0.0 || node.area <= 0.0) {
            if (history.touches()) {
                Row normal{}, change{};
                normal[k] = side;
                change[k] = change_k, change[u] = change_u, change[v] = change_v;
                end_contact(law, normal, change, share, history, tractions == nullptr ? nullptr : tractions + entry, local_totals);
            }
            continue;
        }

        std::array<double, 2> slip{history.slip[u], history.slip[v]}, viscous{};
        if (tractions != nullptr) viscous = {tractions[entry].value[u], tractions[entry].value[v]};
        const Traction<2> traction = apply_law<2>(law, node, slip, viscous, history.damping_pressure, local_totals);
        history.slip[k] = 0.0, history.slip[u] = slip[0], history.slip[v] = slip[1];
        if (tractions != nullptr) {
            double* const value = tractions[entry].value;
            value[k] = 0.0, value[u] = viscous[0], value[v] = viscous[1];
        }
        local.add_at(y_k, y_u, y_v, node.area * side * traction.pressure, node.area * traction.shear[0], node.area * traction.shear[1]);

        if (cover_u.slope != 0.0 || cover_v.slope != 0.0) {
            const double energy = 0.5 * share * (law.kn * overlap * overlap + law.ks * (slip[0] * slip[0] + slip[1] * slip[1]));
            local.add_at(y_k + dot(row_k, center), middle_u, middle_v, 0.0, -energy * cover_u.slope * cover_v.part,
                         -energy * cover_v.slope * cover_u.part);
        }
    }
    sum.force[k] = local.force[0], sum.force[u] = local.force[1], sum.force[v] = local.force[2];
    sum.moment[k] = local.moment[0], sum.moment[u] = local.moment[1], sum.moment[v] = local.moment[2];
    totals = local_totals;
}

/// Share of a node's faces that looks along −normal, `normal` in the leader's frame: of a faceted shape the face that looks most that way.
double acting_area(const SurfaceNodes& nodes, std::size_t i, const Row& normal, bool faceted) {
    const Row area{nodes.area_x[i], nodes.area_y[i], nodes.area_z[i]};
    if (!faceted) return -dot(normal, area);
    std::size_t axis = std::abs(normal[0]) > std::abs(normal[1]) ? 0 : 1;
    if (std::abs(normal[2]) > std::abs(normal[axis])) axis = 2;
    return normal[axis] < 0.0 ? area[axis] : -area[axis];
}

/// Displacement of leader point `p` relative to the follower over the last step, follower's frame [m].
Row change_of(const RelativePose& pose, const Row& p) {
    Row change;
    for (std::size_t a = 0; a < 3; ++a) change[a] = dot(pose.rotation_change[a], p) + pose.position_change[a];
    return change;
}

/// Nodes against a grid: value and normal at each node, history projected on the tangent plane of today.
void sum_grid_nodes(const SurfaceNodes& nodes, bool faceted, const RelativePose& pose, const GridLevelSet& grid, const StepLaw& law,
                    const ContactPair& pair, ContactList& list, ForceSum& sum, NodeTotals& totals) {
    for (std::uint32_t entry = pair.first_node; entry < pair.first_node + pair.node_count; ++entry) {
        const std::uint32_t i = list.nodes[entry];
        NodeHistory& history = list.history[entry];
        const Row p{nodes.x[i], nodes.y[i], nodes.z[i]};
        Row y;
        for (std::size_t a = 0; a < 3; ++a) y[a] = dot(pose.rotation[a], p) + pose.position[a];
        const Vector3 point{y[0], y[1], y[2]};
        const double overlap = -grid.value(point);
        if (overlap <= 0.0 && !history.touches()) continue;

        const Row change = change_of(pose, p);
        const Vector3 gradient = grid.gradient(point);
        const double norm = gradient.norm();
        Row normal{}, normal_leader{};
        for (std::size_t a = 0; a < 3; ++a) normal[a] = norm > 0.0 ? gradient[static_cast<Eigen::Index>(a)] / norm : 0.0;
        for (std::size_t a = 0; a < 3; ++a)
            normal_leader[a] = pose.rotation[0][a] * normal[0] + pose.rotation[1][a] * normal[1] + pose.rotation[2][a] * normal[2];
        NodeMotion<3> node{overlap, dot(normal, change), {}, acting_area(nodes, i, normal_leader, faceted)};
        ViscousTraction* const traction_before = viscous_of(list, entry);
        if (overlap <= 0.0 || node.area <= 0.0) {
            if (history.touches()) end_contact(law, normal, change, std::abs(node.area), history, traction_before, totals);
            continue;
        }

        Row slip{history.slip[0], history.slip[1], history.slip[2]}, viscous{};
        if (traction_before != nullptr) viscous = {traction_before->value[0], traction_before->value[1], traction_before->value[2]};
        const double slip_off = dot(slip, normal), viscous_off = dot(viscous, normal);
        for (std::size_t a = 0; a < 3; ++a) {
            node.tangential_change[a] = change[a] - node.normal_change * normal[a];
            slip[a] -= slip_off * normal[a];
            viscous[a] -= viscous_off * normal[a];
        }
        const Traction<3> traction = apply_law<3>(law, node, slip, viscous, history.damping_pressure, totals);
        Row f;
        for (std::size_t a = 0; a < 3; ++a) {
            history.slip[a] = slip[a];
            if (traction_before != nullptr) traction_before->value[a] = viscous[a];
            f[a] = node.area * (traction.pressure * normal[a] + traction.shear[a]);
        }
        sum.add_at(y[0], y[1], y[2], f[0], f[1], f[2]);
    }
}

void sum_nodes(const Shape& leader, const RelativePose& pose, const FlatFollower& face, const StepLaw& law, const ContactPair& pair,
               ContactList& list, ForceSum& sum, NodeTotals& totals) {
    if (leader.faceted) {
        sum_flat_nodes<true>(leader.nodes, pose, face, law, pair, list, sum, totals);
    } else {
        sum_flat_nodes<false>(leader.nodes, pose, face, law, pair, list, sum, totals);
    }
}

/// The face of a box that the leader's bounding box penetrates least, and whether it penetrates at all.
bool find_contact_face(const RelativePose& pose, const Vector3& leader_half, FlatFollower& face) {
    double least = -std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < 3; ++a) {
        const Row& row = pose.rotation[a];
        const double reach = std::abs(row[0]) * leader_half[0] + std::abs(row[1]) * leader_half[1] + std::abs(row[2]) * leader_half[2];
        const double gap = std::abs(pose.position[a]) - (face.half[a] + reach);
        if (gap > least) {
            least = gap;
            face.axis = a;
            face.side = pose.position[a] < 0.0 ? -1.0 : 1.0;
        }
    }
    return least < 0.0;
}

/// All nodes of a pair that has moved apart: contacts that were open end.
void end_all_contacts(const Shape& leader, const RelativePose& pose, const FlatFollower& face, const StepLaw& law, const ContactPair& pair,
                      ContactList& list, NodeTotals& totals) {
    Row normal{};
    normal[face.axis] = face.side;
    const Row& along_normal = pose.rotation[face.axis];
    const Row normal_leader{face.side * along_normal[0], face.side * along_normal[1], face.side * along_normal[2]};
    for (std::uint32_t entry = pair.first_node; entry < pair.first_node + pair.node_count; ++entry) {
        if (!list.history[entry].touches()) continue;
        const std::uint32_t i = list.nodes[entry];
        const double share = std::max(0.0, acting_area(leader.nodes, i, normal_leader, leader.faceted));
        const Row change = change_of(pose, {leader.nodes.x[i], leader.nodes.y[i], leader.nodes.z[i]});
        end_contact(law, normal, change, share, list.history[entry], viscous_of(list, entry), totals);
    }
}

Vector3 to_vector(const Row& r) { return {r[0], r[1], r[2]}; }

/// Stores the sums of a pair, turned to the world frame; `frame`: follower's frame to world.
void store(const ForceSum& sum, const NodeTotals& totals, const Matrix3& frame, const Vector3& leader_in_follower, PairForce& result,
           PairWork& work) {
    const Vector3 force = to_vector(sum.force), moment = to_vector(sum.moment);
    result.force = frame * force;
    result.leader_torque = frame * (moment - leader_in_follower.cross(force));
    result.follower_torque = -(frame * moment);
    result.elastic_normal = totals.elastic_normal;
    result.elastic_shear = totals.elastic_shear;
    result.overlap = totals.overlap;
    result.touching = totals.touching;
    work.friction += totals.friction;
    work.damping += totals.damping;
}

void compute_block_contact(const Model& model, const Bodies& bodies, double dt, std::size_t index, ContactList& list) {
    const ContactPair& pair = list.pairs[index];
    const std::size_t l = pair.leader, f = pair.follower;
    const Shape& leader = model.shapes[model.blocks[l].shape];
    const Shape& follower = model.shapes[model.blocks[f].shape];
    const Matrix3 to_follower = bodies.rotation[f].transpose(), to_old_follower = bodies.previous_rotation[f].transpose();
    const Vector3 position = to_follower * (bodies.position[l] - bodies.position[f]);
    const RelativePose pose(to_follower * bodies.rotation[l], position, to_old_follower * bodies.previous_rotation[l],
                            to_old_follower * (bodies.previous_position[l] - bodies.previous_position[f]));
    const StepLaw law(pair.law, dt);
    FlatFollower face{.half = {follower.half_extents.x(), follower.half_extents.y(), follower.half_extents.z()}};
    ForceSum sum;
    NodeTotals totals;
    if (!find_contact_face(pose, leader.half_extents, face)) {
        end_all_contacts(leader, pose, face, law, pair, list, totals);
    } else if (const auto* grid = std::get_if<GridLevelSet>(&follower.level_set)) {
        sum_grid_nodes(leader.nodes, leader.faceted, pose, *grid, law, pair, list, sum, totals);
    } else {
        sum_nodes(leader, pose, face, law, pair, list, sum, totals);
    }
    store(sum, totals, bodies.rotation[f], position, list.forces[index], list.work[index]);
}

void compute_ground_contact(const Model& model, const Bodies& bodies, const BasePose& base, double dt, std::size_t index,
                            ContactList& list) {
    const ContactPair& pair = list.pairs[index];
    const std::size_t l = pair.leader;
    const Shape& leader = model.shapes[model.blocks[l].shape];
    const Vector3 position = bodies.position[l] - base.displacement;
    const RelativePose pose(bodies.rotation[l], position, bodies.previous_rotation[l], bodies.previous_position[l] - base.previous);
    const Vector3 force_before = list.forces[index].force;
    ForceSum sum;
    NodeTotals totals;
    sum_nodes(leader, pose, FlatFollower{.bounded = false}, StepLaw(pair.law, dt), pair, list, sum, totals);
    store(sum, totals, Matrix3::Identity(), position, list.forces[index], list.work[index]);
    list.work[index].base += 0.5 * (force_before + list.forces[index].force).dot(base.displacement - base.previous);
}

}  // namespace

void compute_contacts(const Model& model, const Bodies& bodies, const BasePose& base, double dt, std::size_t first, std::size_t last,
                      ContactList& list) {
    for (std::size_t index = first; index < last; ++index) {
        if (list.pairs[index].follower == kGround) {
            compute_ground_contact(model, bodies, base, dt, index, list);
        } else {
            compute_block_contact(model, bodies, dt, index, list);
        }
    }
}

}  // namespace musim::lsdem
