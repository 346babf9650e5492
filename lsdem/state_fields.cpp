#include "lsdem/state_fields.hpp"

#include <algorithm>

namespace musim::lsdem {

void exchange(Archive& archive, Bodies& b) {
    archive(b.position, b.previous_position, b.rotation, b.previous_rotation, b.orientation, b.velocity, b.momentum, b.travel,
            b.preparation_loss, b.free, b.start_position, b.start_orientation);
}

void exchange(Archive& archive, BasePose& base) { archive(base.displacement, base.previous); }

void exchange(Archive& archive, NeighborSearch::Reference& reference) { archive(reference.position, reference.orientation); }

void exchange(Archive& archive, PairWork& work) { archive(work.friction, work.damping); }

void exchange(Archive& archive, Losses& losses) { archive(losses.block, losses.ground); }

void exchange(Archive& archive, Divergence& d) { archive(d.kind, d.block, d.time); }

static void exchange(Archive& archive, Interface& law) {
    archive(law.normal_stiffness, law.shear_stiffness, law.friction, law.normal_damping, law.shear_damping);
}

static void exchange(Archive& archive, ContactPair& p) {
    archive(p.leader, p.follower, p.first_node, p.node_count, p.patch_group, p.patch_lane, p.tilted, p.overlap, p.leader_axis,
            p.follower_axis, p.law);
}

static void exchange(Archive& archive, ContactHistory& h) { archive(h.slip, h.damping_pressure, h.late, h.viscous); }

static void exchange(Archive& archive, PairForce& f) { archive(f.force, f.leader_torque, f.follower_torque); }

static void exchange(Archive& archive, PairTally& t) { archive(t.elastic_normal, t.elastic_shear, t.overlap, t.touching); }

static void exchange(Archive& archive, TiltedFaces& f) { archive(f.k, f.n, f.side); }

static void exchange(Archive& archive, PlacedForce& f) { archive(f.force, f.by_place); }

static void exchange(Archive& archive, TiltedContact& c) {
    archive(c.touches, c.faces, c.inherited, c.late, c.area, c.polar, c.slip, c.twist, c.place);
    archive(c.shear, c.drag, c.couple, c.couple_drag, c.elastic, c.damping);
}

static void exchange(Archive& archive, PlacedWrench& w) { archive(w.force, w.couple); }

static void exchange(Archive& archive, OverlapContact& c) {
    archive(c.touches, c.area, c.polar, c.shear, c.couple, c.place, c.friction, c.drag, c.damping);
}

static void exchange(Archive& archive, PatchLattice& lattice) {
    archive(lattice.spacing, lattice.count_p, lattice.count_q);
    if (!archive.loads()) return;
    // the slips of at least one patch with as many nodes follow
    const bool fits = lattice.count_p >= 2 && lattice.count_q >= 2 &&
                      static_cast<std::size_t>(lattice.count_p) <= archive.remaining() / static_cast<std::size_t>(lattice.count_q);
    if (!fits || lattice.spacing > PatchSpacing::lobatto) Archive::fail("a lattice of nodes is impossible");
    lattice = make_patch_lattice(lattice.count_p, lattice.count_q, lattice.spacing);
}

static void exchange(Archive& archive, PatchLength& l) { archive(l.nominal, l.per_offset); }

static void exchange(Archive& archive, PatchKind& k) {
    archive(k.k, k.u, k.v, k.n, k.p, k.q, k.bounded, k.viscous, k.side, k.face_k, k.half_u, k.half_v, k.face_n, k.half_p, k.half_q);
    archive(k.spacing_p, k.spacing_q, k.height, k.spacing, k.lattice, k.law);
}

static void exchange(Archive& archive, PatchGroup& g) {
    archive(g.kind, g.count, g.pair, g.leader, g.follower, g.first_slot, g.leader_offset, g.follower_offset, g.damping);
}

static void exchange(Archive& archive, PatchList& p) {
    archive(p.lattices, p.kinds, p.groups, p.state, p.next_look, p.slip_u, p.slip_v);
    p.due.resize(p.groups.size());
}

void exchange(Archive& archive, ContactList& l) {
    archive(l.pairs, l.nodes, l.history, l.forces, l.patches, l.tilted, l.overlaps, l.node_pairs, l.ground_pairs, l.tallies, l.trusted_gap,
            l.next_look, l.faces, l.first_step, l.demand.wanted, l.demand.asked, l.work);
    l.due.resize(l.node_pairs.size());
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
    expect(pair.leader < blocks && (pair.follower < blocks || pair.follower == kGround));
    const std::size_t first = pair.first_node, end = first + pair.node_count;
    // nodes come in fours
    expect(pair.node_count == 0 || (first % 4 == 0 && (end + 3) / 4 * 4 <= list.nodes.size()));
    const std::size_t of_shape = model.shapes[model.blocks[pair.leader].shape].nodes.size();
    for (std::size_t n = first; n < end; ++n) expect(list.nodes[n] < of_shape);
    if (pair.is_patch()) expect(pair.patch_group < list.patches.groups.size() && pair.patch_lane < PatchGroup::kSize);
    if (pair.is_tilted()) expect(pair.tilted < list.tilted.size() && pair.follower != kGround && !pair.is_patch());
    if (pair.is_overlap()) expect(pair.overlap < list.overlaps.size() && !pair.is_patch() && !pair.is_tilted());
    expect(pair.leader_axis <= 3 && pair.follower_axis <= 3);
}

void check_patches(const Model& model, const ContactList& list) {
    const PatchList& patches = list.patches;
    for (const PatchKind& kind : patches.kinds) {
        expect(kind.lattice < patches.lattices.size() && kind.spacing <= PatchSpacing::lobatto);
        expect(std::max({kind.k, kind.u, kind.v, kind.n, kind.p, kind.q}) < 3);
    }
    expect_size(patches.groups.size() * patch_field::count * PatchGroup::kSize, patches.state);
    expect_size(patches.groups.size() * PatchGroup::kSize, patches.next_look);
    expect_size(patches.slip_u.size(), patches.slip_v);
    for (const PatchGroup& group : patches.groups) {
        expect(group.kind < patches.kinds.size() && group.count <= PatchGroup::kSize);
        expect(group.first_slot + PatchGroup::kSize * patches.slots(group) <= patches.slip_u.size());
        for (std::size_t lane = 0; lane < PatchGroup::kSize; ++lane) {
            const std::uint32_t follower = group.follower[lane];
            expect(group.pair[lane] < list.pairs.size() && group.leader[lane] < model.blocks.size());
            expect(patches.kinds[group.kind].bounded ? follower < model.blocks.size() : follower == kGround);
        }
    }
}

}  // namespace

void check_restored(const Model& model, const Bodies& bodies, const NeighborSearch::Reference& reference, const ContactList& list,
                    const Losses& losses) {
    const std::size_t blocks = model.blocks.size(), pairs = list.pairs.size(), entries = list.nodes.size();
    expect_size(blocks, bodies.position, bodies.previous_position, bodies.rotation, bodies.previous_rotation, bodies.orientation,
                bodies.velocity, bodies.momentum, bodies.travel, bodies.preparation_loss, bodies.free, bodies.start_position,
                bodies.start_orientation, reference.position, reference.orientation, losses.block);
    expect_size(list.demand.wanted ? pairs : 0, list.demand.asked);
    expect_size(pairs, list.forces, list.tallies, list.next_look, list.faces, list.work);
    const ContactHistory& history = list.history;
    expect_size(entries, history.damping_pressure, history.late, history.slip[0], history.slip[1], history.slip[2]);
    expect_size(history.has_viscous() ? entries : 0, history.viscous[0], history.viscous[1], history.viscous[2]);
    for (const ContactPair& pair : list.pairs) check_pair(model, list, pair);
    check_patches(model, list);
    for (const TiltedContact& contact : list.tilted) expect(contact.faces.k < 3 && contact.faces.n < 3);
    for (const std::uint32_t pair : list.node_pairs) expect(pair < pairs && !list.pairs[pair].is_patch());
    for (const std::uint32_t pair : list.ground_pairs) expect(pair < pairs && list.pairs[pair].follower == kGround);
}

}  // namespace musim::lsdem
