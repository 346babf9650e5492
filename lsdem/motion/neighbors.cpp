#include "lsdem/motion/neighbors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "lsdem/block_height.hpp"
#include "lsdem/contact/box_meeting.hpp"
#include "lsdem/solid/box_gap.hpp"

namespace musim::lsdem {
namespace {

/// World half extents of a block's bounding box [m].
Vector3 world_half(const Matrix3& rotation, const Vector3& half) { return rotation.cwiseAbs() * half; }

/// Cell of a regular grid as a sortable key.
struct CellEntry {
    std::array<std::int64_t, 3> cell;
    std::uint32_t block;
    bool operator<(const CellEntry& other) const { return std::tie(cell, block) < std::tie(other.cell, other.block); }
};

/// Rows of cells, relative to a cell, that hold its neighbors not met before: with the rest of its own row, half of the 26.
constexpr std::array<std::pair<int, int>, 4> kForwardRows{{{0, 1}, {1, -1}, {1, 0}, {1, 1}}};

/// Cell number of a coordinate in cells. A block that has flown off farther than 2^40 cells shares the last one.
std::int64_t find_cell(double place) {
    constexpr double kFarthest = 1099511627776.0;
    return static_cast<std::int64_t>(std::floor(std::clamp(place, -kFarthest, kFarthest)));
}

/// A block stands on the ground by a face whose normal is within 15° of that of the ground [-].
constexpr double kFaceOnGround = 0.966;

/// Notes the axes along which the boxes of a pair meet face to face.
void name_axes(const Bodies& bodies, ContactPair& pair) {
    if (bodies.is_ground(pair.follower)) {
        Eigen::Index upright = 0;
        const double cosine = (bodies.pose[pair.leader].rotation.transpose() * bodies.up()).cwiseAbs().maxCoeff(&upright);
        if (cosine > kFaceOnGround) pair.leader_axis = static_cast<std::uint8_t>(upright);
        return;
    }
    const auto faces = detail::choose_faces({&bodies.pose[pair.leader], &bodies.pose[pair.follower]});
    if (!faces.found) return;
    const auto named = [](const std::array<bool, 3>& along) { return static_cast<std::uint8_t>(along[1] ? 1 : along[2] ? 2 : 0); };
    pair.leader_axis = named(faces.along[0]);
    pair.follower_axis = named(faces.along[1]);
}

/// The order of pairs in the list: by their blocks, whichever leads.
constexpr auto is_before = [](const auto& a, const auto& b) {
    const auto place_of = [](const auto& p) {
        return std::tuple{std::min(p.leader, p.follower), std::max(p.leader, p.follower), p.leader};
    };
    return place_of(a) < place_of(b);
};

/// Copies the history of nodes that stay, both lists ascending; ends nothing: a node that leaves the list is at least a skin away.
void carry_history(const ContactPair& from, const ContactList& old_list, const ContactPair& to, ContactList& list) {
    std::uint32_t o = from.first_node;
    const std::uint32_t old_end = from.first_node + from.node_count;
    for (std::uint32_t n = to.first_node; n < to.first_node + to.node_count; ++n) {
        while (o < old_end && old_list.nodes[o] < list.nodes[n]) ++o;
        if (o < old_end && old_list.nodes[o] == list.nodes[n]) list.history.copy(old_list.history, o, n);
    }
}

}  // namespace

bool leads(const Bodies& bodies, std::uint32_t a, std::uint32_t b) {
    const Vector3 up = bodies.up();
    const double za = bodies.pose[a].position.dot(up), zb = bodies.pose[b].position.dot(up);
    return za < zb || (za == zb && a < b);
}

NeighborSearch::NeighborSearch(const Model& model) : model_(&model) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Block& block : model.blocks) {
        const Vector3 half = half_extents(model, block);
        smallest = std::min(smallest, 2.0 * half.minCoeff());
        reference_.diameter.push_back(2.0 * half.norm());
    }
    skin_ = model.blocks.empty() ? 0.0 : kNeighborSkin * smallest;
}

Interface NeighborSearch::make_pair_interface(BlockPair blocks) const {
    const Block& a = model_->blocks[blocks.leader];
    const double area_a = model_->shapes[a.shape].face_area;
    if (blocks.follower == model_->blocks.size())
        return make_interface(find_joint_of_blocks(*model_, blocks.leader, std::nullopt), a.mass, area_a);
    const Block& b = model_->blocks[blocks.follower];
    const double mass = a.fixed ? b.mass : b.fixed ? a.mass : a.mass * b.mass / (a.mass + b.mass);
    const double area = std::min(area_a, model_->shapes[b.shape].face_area);
    const Interface whole = make_interface(find_joint_of_blocks(*model_, blocks.leader, blocks.follower), mass, area);
    return model_->numerics.contact_nodes == ContactNodes::both ? scaled(whole, 0.5) : whole;
}

void NeighborSearch::find_block_pairs(const Bodies& bodies, std::vector<BlockPair>& pairs) const {
    const std::size_t n = bodies.size();
    std::vector<Vector3> half(n);
    Vector3 cell_size = Vector3::Zero();
    for (std::size_t i = 0; i < n; ++i) {
        half[i] = world_half(bodies.pose[i].rotation, bodies.pose[i].half);
        cell_size = cell_size.cwiseMax(2.0 * half[i]);
    }
    cell_size += Vector3::Constant(skin_);

    // no box is larger than a cell, so boxes that meet have centres in the same or in adjacent cells
    std::vector<CellEntry> entries(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (int a = 0; a < 3; ++a) entries[i].cell[static_cast<std::size_t>(a)] = find_cell(bodies.pose[i].position[a] / cell_size[a]);
        entries[i].block = static_cast<std::uint32_t>(i);
    }
    std::sort(entries.begin(), entries.end());

    const auto consider = [&](std::uint32_t i, std::uint32_t j) {
        if (model_->blocks[i].fixed && model_->blocks[j].fixed) return;
        const BodyPose &a = bodies.pose[i], &b = bodies.pose[j];
        const Vector3 offset = b.position - a.position;
        if (!(offset.cwiseAbs().array() <= (half[i] + half[j]).array() + skin_).all()) return;
        const Matrix3 to_a = a.rotation.transpose();
        if (find_gap_of_faces(a.half, b.half, {to_a * b.rotation, to_a * offset}) > skin_) return;
        pairs.push_back({std::min(i, j), std::max(i, j)});
    };
    // each row of three cells along the last axis is contiguous in the sorted list
    for (std::size_t e = 0; e < n; ++e) {
        const CellEntry& entry = entries[e];
        for (std::size_t later = e + 1; later < n; ++later) {
            const CellEntry& other = entries[later];
            if (other.cell[0] != entry.cell[0] || other.cell[1] != entry.cell[1] || other.cell[2] > entry.cell[2] + 1) break;
            consider(entry.block, other.block);
        }
        for (const auto& [dx, dy] : kForwardRows) {
            const CellEntry low{{entry.cell[0] + dx, entry.cell[1] + dy, entry.cell[2] - 1}, 0};
            for (auto it = std::lower_bound(entries.begin(), entries.end(), low); it != entries.end(); ++it) {
                if (it->cell[0] != low.cell[0] || it->cell[1] != low.cell[1] || it->cell[2] > entry.cell[2] + 1) break;
                consider(entry.block, it->block);
            }
        }
    }
}

void NeighborSearch::add_nodes(BlockPair blocks, const Bodies& bodies, ContactList& list) const {
    const BlockNodes nodes = nodes_of(*model_, model_->blocks[blocks.leader]);
    const bool ground = bodies.is_ground(blocks.follower);
    const BodyPose& follower = bodies.pose[blocks.follower];
    const Matrix3 to_follower = follower.rotation.transpose();
    const Matrix3 q = to_follower * bodies.pose[blocks.leader].rotation;
    const Matrix3 q_abs = q.cwiseAbs();
    const Vector3 t = to_follower * (bodies.pose[blocks.leader].position - follower.position);

    const auto first = static_cast<std::uint32_t>(list.nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Vector3 y = q * nodes.position(i) + t;
        if (ground) {
            if (y.z() > skin_) continue;
        } else {
            // a node counts as long as some of its cell lies on the follower, whose edges are rounded
            const Vector3 cell = (1.0 + 2.0 * kEdgeBlend) * nodes.half(i) + nodes.center(i).cwiseAbs();
            const Vector3 reach = follower.half + Vector3::Constant(skin_) + q_abs * cell;
            if ((y.cwiseAbs() - reach).maxCoeff() > 0.0) continue;
        }
        list.nodes.push_back(static_cast<std::uint32_t>(i));
    }
    const auto count = static_cast<std::uint32_t>(list.nodes.size()) - first;
    if (count == 0) return;
    while (list.nodes.size() % 4 != 0) list.nodes.push_back(list.nodes.back());
    list.pairs.push_back({.leader = blocks.leader,
                          .follower = blocks.follower,
                          .first_node = first,
                          .node_count = count,
                          .law = make_pair_interface(blocks)});
}

bool NeighborSearch::add_overlap(BlockPair blocks, const Bodies& bodies, ContactList& list) const {
    const auto can = [&](std::uint32_t block) { return bodies.is_ground(block) || meets_by_overlap(*model_, model_->blocks[block]); };
    if (!can(blocks.leader) || !can(blocks.follower)) return false;
    const bool is_exact = bodies.solid[blocks.leader] != nullptr || bodies.solid[blocks.follower] != nullptr;
    list.pairs.push_back({.leader = blocks.leader,
                          .follower = blocks.follower,
                          .first_node = static_cast<std::uint32_t>(list.nodes.size()),
                          .overlap = static_cast<std::uint32_t>(list.overlaps.size()),
                          .is_exact = is_exact,
                          .law = make_pair_interface(blocks)});
    if (!is_exact) name_axes(bodies, list.pairs.back());
    list.overlaps.emplace_back();
    return true;
}

void NeighborSearch::rebuild(const Bodies& bodies, ContactList& list, Losses& finished) {
    const BodyPose& ground = bodies.pose.back();
    const Matrix3 to_ground = ground.rotation.transpose();
    const Quaternion turn = bodies.orientation.back().conjugate();
    reference_.position.clear(), reference_.orientation.clear();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        reference_.position.emplace_back(to_ground * (bodies.pose[i].position - ground.position));
        reference_.orientation.push_back(turn * bodies.orientation[i]);
    }

    std::swap(list, previous_);
    list.pairs.clear();
    list.nodes.clear();
    list.overlaps.clear();
    const auto had = [&](std::uint32_t leader, std::uint32_t follower) {
        return std::binary_search(previous_.pairs.begin(), previous_.pairs.end(), BlockPair{leader, follower}, is_before);
    };

    // directed pairs, sorted; a pair that persists keeps its leader
    std::vector<BlockPair> found, directed;
    find_block_pairs(bodies, found);
    for (const BlockPair& p : found) {
        const bool both = model_->numerics.contact_nodes == ContactNodes::both;
        const bool first_leads = had(p.leader, p.follower) || (!had(p.follower, p.leader) && leads(bodies, p.leader, p.follower));
        if (both || first_leads) directed.push_back({p.leader, p.follower});
        if (both || !first_leads) directed.push_back({p.follower, p.leader});
    }
    if (model_->ground.present) {
        for (std::uint32_t i = 0; i < bodies.size(); ++i) {
            if (bodies.fixed[i] == 0 && bodies.find_height(i) <= skin_) directed.push_back({i, bodies.ground()});
        }
    }
    std::sort(directed.begin(), directed.end(), is_before);
    for (const BlockPair& p : directed) {
        if (!add_overlap(p, bodies, list)) add_nodes(p, bodies, list);
    }

    list.history.reset(list.nodes.size(), std::any_of(list.pairs.begin(), list.pairs.end(),
                                                      [](const ContactPair& pair) { return pair.law.shear_damping > 0.0; }));
    list.forces.assign(list.pairs.size(), PairForce{});
    list.tallies.assign(list.pairs.size(), PairTally{});
    list.active.resize(list.pairs.size());
    list.trusted_gap = model_->numerics.skip_apart ? kTrustedGap : 0.0;
    list.next_check.assign(list.pairs.size(), 0.0);
    list.faces.assign(list.pairs.size(), 0);
    list.first_step = previous_.first_step;
    list.work.assign(list.pairs.size(), PairWork{});
    list.demand.wanted = previous_.demand.wanted;
    list.demand.asked.assign(list.demand.wanted ? list.pairs.size() : 0, 0.0);
    auto old = previous_.pairs.begin();
    for (std::size_t p = 0; p < list.pairs.size(); ++p) {
        const ContactPair& pair = list.pairs[p];
        while (old != previous_.pairs.end() && is_before(*old, pair)) ++old;
        if (old == previous_.pairs.end() || is_before(pair, *old)) continue;
        const auto o = static_cast<std::size_t>(old - previous_.pairs.begin());
        list.forces[p] = previous_.forces[o];
        if (list.demand.wanted) list.demand.asked[p] = previous_.demand.asked[o];
        list.tallies[p] = previous_.tallies[o];
        list.next_check[p] = previous_.next_check[o];
        list.faces[p] = previous_.faces[o];
        if (pair.is_overlap()) {
            list.overlaps[pair.overlap] = previous_.overlaps[old->overlap];
        } else {
            carry_history(*old, previous_, pair, list);
        }
    }
    add_losses(bodies, previous_, finished);
}

}  // namespace musim::lsdem
