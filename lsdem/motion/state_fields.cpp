#include "lsdem/motion/state_fields.hpp"

namespace musim::lsdem {

void exchange(Archive& archive, Bodies& b) {
    for (BodyPose& pose : b.pose) archive(pose.position, pose.rotation, pose.step.turn, pose.step.shift, pose.step.travel);
    archive(b.orientation, b.velocity, b.momentum, b.preparation_loss, b.free, b.start_position, b.start_orientation, b.elapsed,
            b.drawn_up);
}

void exchange(Archive& archive, NeighborSearch::Reference& reference) { archive(reference.position, reference.orientation); }

void exchange(Archive& archive, PairWork& work) { archive(work.friction, work.damping); }

void exchange(Archive& archive, Losses& losses) { archive(losses.block, losses.ground); }

void exchange(Archive& archive, Divergence& d) { archive(d.kind, d.block, d.time); }

void exchange(Archive& archive, Overstiff& o) { archive(o.block, o.time, o.used); }

void exchange(Archive& archive, Leaving& l) { archive(l.block, l.time, l.substeps); }

static void exchange(Archive& archive, Interface& law) {
    archive(law.normal_stiffness, law.shear_stiffness, law.friction, law.normal_damping, law.shear_damping);
}

static void exchange(Archive& archive, ContactPair& p) {
    archive(p.leader, p.follower, p.first_node, p.node_count, p.overlap, p.leader_axis, p.follower_axis, p.law);
}

static void exchange(Archive& archive, ContactHistory& h) { archive(h.slip, h.damping_pressure, h.late, h.viscous); }

static void exchange(Archive& archive, PairForce& f) { archive(f.force, f.leader_torque, f.follower_torque); }

static void exchange(Archive& archive, PairTally& t) { archive(t.elastic_normal, t.elastic_shear, t.overlap, t.touching, t.rough); }

template <class Value>
static void exchange(Archive& archive, FrictionSprings<Value>& s) {
    archive(s.area, s.core, s.in_core, s.in_rest);
}

static void exchange(Archive& archive, OverlapContact& c) {
    archive(c.touches, c.sliding, c.turning, c.lightest, c.place, c.couple, c.dashpot_force, c.dashpot_couple);
}

void exchange(Archive& archive, ContactList& l) {
    archive(l.pairs, l.nodes, l.history, l.forces, l.overlaps, l.tallies, l.trusted_gap, l.next_check, l.faces, l.first_step,
            l.demand.wanted, l.demand.asked, l.work);
    l.active.resize(l.pairs.size());
}

namespace {

void expect(bool holds) {
    if (!holds) Archive::fail("it contradicts itself");
}

template <class... Vectors>
void expect_size(std::size_t size, const Vectors&... vectors) {
    expect(((vectors.size() == size) && ...));
}

void check_pair(const Model& model, const ContactList& list, const ContactPair& pair) {
    const std::size_t blocks = model.blocks.size();
    expect(pair.leader < blocks && pair.follower <= blocks);
    const std::size_t first = pair.first_node, end = first + pair.node_count;
    // nodes come in fours
    expect(pair.node_count == 0 || (first % 4 == 0 && (end + 3) / 4 * 4 <= list.nodes.size()));
    const std::size_t of_shape = model.shapes[model.blocks[pair.leader].shape].nodes.size();
    for (std::size_t n = first; n < end; ++n) expect(list.nodes[n] < of_shape);
    if (pair.is_overlap()) expect(pair.overlap < list.overlaps.size());
    expect(pair.leader_axis <= 3 && pair.follower_axis <= 3);
}

}  // namespace

void check_restored(const Model& model, const Bodies& bodies, const NeighborSearch::Reference& reference, const ContactList& list,
                    const Losses& losses) {
    const std::size_t blocks = model.blocks.size(), pairs = list.pairs.size(), entries = list.nodes.size();
    expect_size(blocks, bodies.velocity, bodies.momentum, bodies.preparation_loss, bodies.free, reference.position, reference.orientation,
                losses.block);
    expect_size(blocks + 1, bodies.orientation, bodies.start_position, bodies.start_orientation);
    expect_size(list.demand.wanted ? pairs : 0, list.demand.asked);
    expect_size(pairs + model.loads.size(), list.forces);
    expect_size(pairs, list.tallies, list.next_check, list.faces, list.work);
    const ContactHistory& history = list.history;
    expect_size(entries, history.damping_pressure, history.late, history.slip[0], history.slip[1], history.slip[2]);
    expect_size(history.has_viscous() ? entries : 0, history.viscous[0], history.viscous[1], history.viscous[2]);
    for (const ContactPair& pair : list.pairs) check_pair(model, list, pair);
}

}  // namespace musim::lsdem
