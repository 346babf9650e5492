#include "lsdem/preloads.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lsdem/detail/patch_state.hpp"
#include "lsdem/detail/tilted_kernel.hpp"

namespace musim::lsdem {
namespace {

Matrix3 follower_frame(const ContactPair& pair, const Bodies& bodies) {
    return pair.follower == kGround ? Matrix3(Matrix3::Identity()) : bodies.rotation[pair.follower];
}

const PatchKind& kind_of(const ContactList& list, const ContactPair& pair) {
    return list.patches.kinds[list.patches.groups[pair.patch_group].kind];
}

/// A contact by the faces that the preload names; false when they do not meet.
bool start(const Bodies& bodies, const ContactPair& pair, const Preload& preload, const Vector3& friction, TiltedContact& contact,
           PairTally& tally) {
    const std::size_t l = pair.leader, f = pair.follower;
    const Matrix3 rotation = bodies.rotation[f].transpose() * bodies.rotation[l];
    const Vector3 position = bodies.rotation[f].transpose() * (bodies.position[l] - bodies.position[f]);
    return detail::start_tilted_contact({detail::row_of(bodies.half[l]), detail::row_of(bodies.half[f])}, detail::rows_of(rotation),
                                        detail::row_of(position), pair.law, TiltedFaces::of_code(preload.faces), preload.energy,
                                        {detail::row_of(friction), preload.couple}, contact, tally);
}

}  // namespace

bool Preload::is_sound() const {
    const auto all_finite = [](const std::vector<double>& values) {
        return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
    };
    const std::size_t nodes = traction_u.size();
    const bool as_many = traction_v.size() == nodes && count_p <= nodes && count_q <= nodes && count_p * count_q == nodes;
    return as_many && faces <= TiltedFaces::kCodes && std::isfinite(energy) && friction.allFinite() && std::isfinite(couple) &&
           all_finite(traction_u) && all_finite(traction_v);
}

PreloadMap::PreloadMap(const std::vector<Preload>& preloads) {
    for (const Preload& preload : preloads) {
        const std::uint32_t follower = preload.follower ? static_cast<std::uint32_t>(*preload.follower) : kGround;
        by_pair_[{static_cast<std::uint32_t>(preload.leader), follower}] = &preload;
    }
}

const Preload* PreloadMap::find(std::uint32_t leader, std::uint32_t follower) const {
    const auto found = by_pair_.find({leader, follower});
    return found == by_pair_.end() ? nullptr : found->second;
}

std::vector<Preload> find_preloads(const Bodies& bodies, const ContactList& list) {
    std::vector<Preload> preloads;
    for (std::size_t p = 0; p < list.pairs.size(); ++p) {
        const ContactPair& pair = list.pairs[p];
        const Matrix3 frame = follower_frame(pair, bodies);
        Preload preload;
        preload.leader = pair.leader;
        if (pair.follower != kGround) preload.follower = pair.follower;
        preload.energy = find_elastic(list, p).normal;
        if (!(preload.energy > 0.0)) continue;
        if (pair.is_patch()) {
            detail::PatchLoad load = detail::find_load(list.patches, pair.patch_group, pair.patch_lane);
            const PatchKind& kind = kind_of(list, pair);
            preload.friction = load.friction_u * frame.col(kind.u) + load.friction_v * frame.col(kind.v);
            preload.count_p = static_cast<std::size_t>(list.patches.lattices[kind.lattice].count_p);
            preload.count_q = static_cast<std::size_t>(list.patches.lattices[kind.lattice].count_q);
            preload.traction_u = std::move(load.traction_u);
            preload.traction_v = std::move(load.traction_v);
        } else if (pair.is_overlap()) {
            const OverlapContact& contact = list.overlaps[pair.overlap];
            preload.friction = -contact.shear;
            preload.couple = contact.couple;
        } else if (pair.is_tilted()) {
            const detail::TiltedFriction friction = detail::find_friction(list.tilted[pair.tilted]);
            preload.friction = frame * Eigen::Map<const Vector3>(friction.force.data());
            preload.couple = friction.couple;
            preload.faces = list.tilted[pair.tilted].faces.code();
        }
        preloads.push_back(std::move(preload));
    }
    return preloads;
}

void preload_contacts(const std::vector<Preload>& preloads, const Bodies& bodies, ContactList& list) {
    list.first_step = false;
    const PreloadMap known(preloads);
    for (std::size_t p = 0; p < list.pairs.size(); ++p) {
        const ContactPair& pair = list.pairs[p];
        const Preload* found = known.find(pair.leader, pair.follower);
        if (found == nullptr) continue;
        const Preload& preload = *found;
        const Vector3 friction = follower_frame(pair, bodies).transpose() * preload.friction;
        if (pair.is_patch()) {
            const PatchKind& kind = kind_of(list, pair);
            detail::inherit_load(list.patches, pair.patch_group, pair.patch_lane,
                                 {preload.energy, friction[kind.u], friction[kind.v], preload.traction_u, preload.traction_v});
        } else if (pair.is_overlap()) {
            // with no area before, springs keep their force
            OverlapContact& contact = list.overlaps[pair.overlap];
            contact.touches = true;
            contact.shear = -preload.friction;
            contact.couple = preload.couple;
        } else if (pair.is_tilted()) {
            TiltedContact& contact = list.tilted[pair.tilted];
            if (preload.faces == 0 || !start(bodies, pair, preload, friction, contact, list.tallies[p])) {
                contact.inherited = list.tallies[p].elastic_normal = preload.energy;
            }
        }
    }
}

}  // namespace musim::lsdem
