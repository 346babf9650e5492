#include "lsdem/contact/contacts.hpp"

#include <algorithm>
#include <cmath>

#include "lsdem/block_height.hpp"
#include "lsdem/contact/flat_nodes.hpp"
#include "lsdem/contact/grid_nodes.hpp"
#include "lsdem/contact/overlap_pairs.hpp"
#include "lsdem/detail/prefetch.hpp"

namespace musim::lsdem {

void ContactHistory::reset(std::size_t entries, bool with_viscous) {
    for (auto& axis : slip) axis.assign(entries, 0.0);
    damping_pressure.assign(entries, kNoContact);
    late.assign(entries, 0.0);
    for (auto& axis : viscous) axis.assign(with_viscous ? entries : 0, 0.0);
}

void ContactHistory::end(std::size_t entry) {
    damping_pressure[entry] = kNoContact;
    late[entry] = 0.0;
    for (auto& axis : slip) axis[entry] = 0.0;
    if (!has_viscous()) return;
    for (auto& axis : viscous) axis[entry] = 0.0;
}

void ContactHistory::copy(const ContactHistory& from, std::size_t from_entry, std::size_t entry) {
    damping_pressure[entry] = from.damping_pressure[from_entry];
    late[entry] = from.late[from_entry];
    for (std::size_t a = 0; a < 3; ++a) slip[a][entry] = from.slip[a][from_entry];
    if (!has_viscous() || !from.has_viscous()) return;
    for (std::size_t a = 0; a < 3; ++a) viscous[a][entry] = from.viscous[a][from_entry];
}

namespace {

using detail::FlatFollower;
using detail::PairSums;
using detail::RelativePose;
using detail::Row;
using detail::row_of;
using detail::StepLaw;

/// A normal of the leader decides only when it shows an overlap smaller by this part [-]. Any small number will do: it keeps two nearly
/// equal overlaps from changing places by rounding.
constexpr double kLeaderPrecedence = 0.05;

/// Component of largest size in row `r` or column `c` of a rotation.
std::size_t largest_in_row(const RelativePose& pose, std::size_t r) { return detail::largest_axis(pose.rotation[r]); }
std::size_t largest_in_column(const RelativePose& pose, std::size_t c) {
    return detail::largest_axis({pose.rotation[0][c], pose.rotation[1][c], pose.rotation[2][c]});
}

/// The faces of two boxes that meet: those across the face normal, of either box, along which the boxes overlap least, and the face of the
/// other box that looks at it. False when a normal separates the boxes.
bool find_contact_faces(const RelativePose& pose, const Vector3& leader_half, FlatFollower& face) {
    double widest_gap = -std::numeric_limits<double>::infinity();
    const auto& q = pose.rotation;
    for (std::size_t a = 0; a < 3; ++a) {
        const double reach = std::abs(q[a][0]) * leader_half[0] + std::abs(q[a][1]) * leader_half[1] + std::abs(q[a][2]) * leader_half[2];
        const double gap = std::abs(pose.position[a]) - (face.half[a] + reach);
        if (gap <= widest_gap) continue;
        widest_gap = gap;
        face.axis = a;
        face.leader_axis = largest_in_row(pose, a);
    }
    const Row in_leader = pose.in_leader_frame(pose.position);
    for (std::size_t a = 0; a < 3; ++a) {
        const double reach = std::abs(q[0][a]) * face.half[0] + std::abs(q[1][a]) * face.half[1] + std::abs(q[2][a]) * face.half[2];
        const double gap = std::abs(in_leader[a]) - (leader_half[static_cast<Eigen::Index>(a)] + reach);
        // the follower's own normal has precedence: in flat contact both say the same, up to rounding and tilt
        if (gap <= (1.0 - kLeaderPrecedence) * widest_gap) continue;
        widest_gap = gap;
        face.axis = largest_in_column(pose, a);
        face.leader_axis = a;
    }
    face.side = pose.position[face.axis] < 0.0 ? -1.0 : 1.0;
    return widest_gap < 0.0;
}

/// Can the blocks of a pair not have met since it was found apart? `next_check`: see ContactList; zero of a pair that meets by nodes.
bool known_apart(const ContactPair& pair, double next_check, const Bodies& bodies) {
    return next_check > 0.0 && bodies.travel_of(pair.leader, pair.follower) < next_check;
}

/// Stores the sums of a pair, turned to the world frame; `frame`: follower's frame to world.
void store(const PairSums& sums, const Matrix3& frame, const Vector3& leader_in_follower, PairForce& result, PairTally& tally,
           PairWork& work) {
    const Vector3 force{sums.force[0], sums.force[1], sums.force[2]}, moment{sums.moment[0], sums.moment[1], sums.moment[2]};
    result.force = frame * force;
    result.leader_torque = frame * (moment - leader_in_follower.cross(force));
    result.follower_torque = -(frame * moment);
    tally = sums.tally;
    work += sums.work;
}

/// Books what a pair gives up when its contact starts anew, at other faces: of the stored energy, what its last force does not return over
/// the second half of the step from n − 1 to n.
void drop_elastic(const Bodies& bodies, const ContactPair& pair, const PairForce& last, const PairTally& stored, PairWork& work) {
    // the turn of a block over the step, as a vector: sin θ is close enough to θ
    const auto turn = [&](std::size_t i) {
        const Quaternion& step = bodies.pose[i].step.turn;
        return Vector3((2.0 * step.w()) * step.vec());
    };
    const std::size_t l = pair.leader, f = pair.follower;
    double done = last.force.dot(bodies.pose[l].step.shift) + last.leader_torque.dot(turn(l));
    done += last.follower_torque.dot(turn(f)) - last.force.dot(bodies.pose[f].step.shift);
    work.damping += stored.elastic_normal - 0.5 * done;
    work.friction += stored.elastic_shear;
}

/// Notes the faces that meet. When they are others than a step ago, all contacts of the pair give up what they held.
void start_new_faces(const Bodies& bodies, const FlatFollower& face, std::size_t index, ContactList& list) {
    if (list.faces[index] == face.code()) return;
    list.faces[index] = face.code();
    const ContactPair& pair = list.pairs[index];
    drop_elastic(bodies, pair, list.forces[index], list.tallies[index], list.work[index]);
    for (std::size_t entry = pair.first_node; entry < pair.first_node + pair.node_count; ++entry) list.history.end(entry);
}

/// Pose of the leader in the frame of the follower.
RelativePose find_pose(const Bodies& bodies, const ContactPair& pair) {
    const std::size_t l = pair.leader, f = pair.follower;
    const Matrix3 to_follower = bodies.pose[f].rotation.transpose(), to_old_follower = bodies.previous_rotation(f).transpose();
    return {to_follower * bodies.pose[l].rotation, to_follower * (bodies.pose[l].position - bodies.pose[f].position),
            to_old_follower * bodies.previous_rotation(l), to_old_follower * (bodies.previous_position(l) - bodies.previous_position(f))};
}

/// A pair that meets by nodes.
void compute_node_contact(const Model& model, const Bodies& bodies, std::size_t index, ContactList& list) {
    const ContactPair& pair = list.pairs[index];
    const std::size_t l = pair.leader, f = pair.follower;
    const bool on_ground = bodies.is_ground(f);
    const Shape& leader = model.shapes[model.blocks[l].shape];
    const RelativePose pose = find_pose(bodies, pair);
    FlatFollower face;
    face.bounded = !on_ground;
    if (on_ground) {
        face.leader_axis = largest_in_row(pose, face.axis);
    } else {
        face.half = row_of(bodies.pose[f].half);
        if (!find_contact_faces(pose, bodies.pose[l].half, face) && list.tallies[index].touching == 0) {
            list.forces[index] = PairForce{};
            list.tallies[index] = PairTally{};
            return;
        }
    }
    // a smooth leader has one face only: were it named by an axis, a contact that rolls would begin anew every quarter turn
    if (!leader.faceted) face.leader_axis = 0;
    const detail::NodeContact contact{
        .leader = nodes_of(model, model.blocks[l]), .pose = pose, .law = StepLaw(pair.law, bodies.elapsed), .pair = pair, .list = list};
    const auto* const grid = on_ground ? nullptr : std::get_if<GridLevelSet>(&model.shapes[model.blocks[f].shape].level_set);
    if (grid == nullptr) start_new_faces(bodies, face, index, list);
    const PairSums sums =
        grid == nullptr ? detail::sum_flat_nodes(contact, face) : detail::sum_grid_nodes(contact, *grid, bodies.pose[f].height_offset);
    store(sums, bodies.pose[f].rotation, {pose.position[0], pose.position[1], pose.position[2]}, list.forces[index], list.tallies[index],
          list.work[index]);
}

/// So many pairs before its turn a pair is asked for. Affects speed only.
constexpr std::size_t kAhead = 16;

/// Area over which a pair that meets by nodes touches, or more [m²]: which nodes do is not asked, any may be all of a face.
double find_touching_area(const Model& model, const Bodies& bodies, const ContactList& list, std::size_t index) {
    const ContactPair& pair = list.pairs[index];
    if (list.tallies[index].touching == 0) return 0.0;
    const auto face_of = [&](std::size_t block) { return model.shapes[model.blocks[block].shape].face_area; };
    return bodies.is_ground(pair.follower) ? face_of(pair.leader) : std::max(face_of(pair.leader), face_of(pair.follower));
}

}  // namespace

double compute_pairs(const Model& model, const Bodies& bodies, std::size_t first, std::size_t last, ContactList& list,
                     OverlapBatch& overlaps) {
    // what may touch, first of all, so that the memory of each can be prefetched
    std::size_t end = first;
    for (std::size_t index = first; index < last; ++index) {
        if (!known_apart(list.pairs[index], list.next_check[index], bodies)) list.active[end++] = static_cast<std::uint32_t>(index);
    }
    double deepest = 0.0;
    for (std::size_t i = first; i < end; ++i) {
        if (i + kAhead < end) {
            const ContactPair& next = list.pairs[list.active[i + kAhead]];
            if (next.is_overlap()) detail::prefetch(&list.overlaps[next.overlap].touches);
        }
        const std::size_t index = list.active[i];
        const ContactPair& pair = list.pairs[index];
        if (pair.is_overlap()) {
            overlaps.add(index);
            continue;
        }
        compute_node_contact(model, bodies, index, list);
        if (list.demand.wanted) list.demand.ask(index, find_touching_area(model, bodies, list, index));
        const double height = 2.0 * model.shapes[model.blocks[pair.leader].shape].half_extents.z();
        deepest = std::max(deepest, list.tallies[index].overlap / height);
    }
    return deepest;
}

ContactTotals sum_contacts(const ContactList& list) {
    ContactTotals totals;
    for (std::size_t p = 0; p < list.pairs.size(); ++p) {
        const PairTally& tally = list.tallies[p];
        totals.elastic_normal += tally.elastic_normal;
        totals.elastic_shear += tally.elastic_shear;
        if (tally.touching > 0) ++totals.contacts;
        if (!list.pairs[p].is_overlap()) totals.nodes += tally.touching;
        totals.work += list.work[p];
    }
    return totals;
}

std::size_t count_apart(const Bodies& bodies, const ContactList& list) {
    std::size_t count = 0;
    for (std::size_t p = 0; p < list.pairs.size(); ++p) count += known_apart(list.pairs[p], list.next_check[p], bodies) ? 1 : 0;
    return count;
}

void clear_losses(ContactList& list) { std::fill(list.work.begin(), list.work.end(), PairWork{}); }

void add_losses(const Bodies& bodies, const ContactList& list, Losses& losses) {
    for (std::size_t p = 0; p < list.pairs.size(); ++p) {
        const ContactPair& pair = list.pairs[p];
        (bodies.is_ground(pair.follower) ? losses.ground : losses.block[pair.leader]) += list.work[p];
    }
}

}  // namespace musim::lsdem
