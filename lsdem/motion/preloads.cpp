#include "lsdem/motion/preloads.hpp"

#include <cstdint>
#include <map>
#include <utility>

namespace musim::lsdem {

std::vector<Preload> find_preloads(const Bodies& bodies, const ContactList& list) {
    std::vector<Preload> preloads;
    for (const ContactPair& pair : list.pairs) {
        if (!pair.is_overlap() || !list.overlaps[pair.overlap].touches) continue;
        const OverlapContact& contact = list.overlaps[pair.overlap];
        preloads.push_back({.leader = pair.leader,
                            .follower = bodies.as_block(pair.follower),
                            .friction = -contact.sliding.total(),
                            .couple = contact.turning.total()});
    }
    return preloads;
}

void preload_contacts(const std::vector<Preload>& preloads, const Bodies& bodies, ContactList& list) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, const Preload*> by_pair;
    for (const Preload& preload : preloads) {
        const std::uint32_t follower = preload.follower ? static_cast<std::uint32_t>(*preload.follower) : bodies.ground();
        by_pair[{static_cast<std::uint32_t>(preload.leader), follower}] = &preload;
    }
    const auto find = [&](std::uint32_t leader, std::uint32_t follower) {
        const auto found = by_pair.find({leader, follower});
        return found == by_pair.end() ? nullptr : found->second;
    };
    for (const ContactPair& pair : list.pairs) {
        if (!pair.is_overlap()) continue;
        const Preload* const as_given = find(pair.leader, pair.follower);
        const Preload* const preload = as_given != nullptr ? as_given : find(pair.follower, pair.leader);
        if (preload == nullptr) continue;
        // of a load that begins all is core, and new area leaves springs their force
        OverlapContact& contact = list.overlaps[pair.overlap];
        contact.touches = true;
        contact.sliding.in_core = as_given != nullptr ? -preload->friction : preload->friction;
        contact.turning.in_core = preload->couple;
    }
}

}  // namespace musim::lsdem
