#pragma once

#include <cstdint>
#include <vector>

#include "lsdem/bodies.hpp"
#include "lsdem/contacts.hpp"
#include "lsdem/model.hpp"

namespace musim::lsdem {

/// Extra reach of the neighbor list [fraction of the smallest block edge]. Larger: fewer rebuilds, more candidate nodes; above 0.037 the
/// blocks beside each other in a layer of the papers' tower enter the list before they have moved. Affects speed only, never results.
inline constexpr double kNeighborSkin = 0.03;

/// Finds the pairs and nodes that can touch, and tells when the list has to be made anew.
///
/// Each block may move by skin/2 relative to the base before the list goes stale; the list holds every node that lies within the skin of
/// its follower. So no contact is ever missed, for any motion (checked against brute force by the neighbor-list tests).
class NeighborSearch {
  public:
    explicit NeighborSearch(const Model& model);

    /// Makes the list anew. Contacts that persist keep their leader, history and forces; pairs that leave hand their work to `finished`.
    void rebuild(const Bodies& bodies, const BasePose& base, ContactList& list, PairWork& finished);

    /// Largest distance that any point of block i may have moved relative to the base since the last rebuild [m].
    double compute_drift(std::size_t i, const Bodies& bodies, const BasePose& base) const;
    /// The drift above which the list is stale, skin/2 [m].
    double allowed_drift() const { return 0.5 * skin_; }

  private:
    struct BlockPair {
        std::uint32_t leader, follower;
    };
    void find_block_pairs(const Bodies& bodies, std::vector<BlockPair>& pairs) const;
    void add_pair(BlockPair blocks, const Bodies& bodies, const BasePose& base, ContactList& list) const;
    Interface make_pair_interface(std::uint32_t leader, std::uint32_t follower) const;

    const Model* model_;
    double skin_ = 0.0;
    std::vector<Vector3> built_position_;
    std::vector<Matrix3> built_rotation_;
    Vector3 built_base_ = Vector3::Zero();
    ContactList previous_;  ///< the list before, kept to reuse its memory
};

/// Who leads a new contact: the lower block, as in the papers; at equal height the one listed first.
bool leads(const Bodies& bodies, std::uint32_t a, std::uint32_t b);

}  // namespace musim::lsdem
