#pragma once

#include <cstdint>
#include <vector>

#include "lsdem/bodies.hpp"
#include "lsdem/contact/contacts.hpp"
#include "lsdem/model.hpp"

namespace musim::lsdem {

/// Extra reach of the neighbor list [fraction of the smallest block edge]. Larger: fewer rebuilds, more candidate nodes; above 0.037 the
/// blocks beside each other in a layer of the papers' tower enter the list before they have moved. Affects speed only, never results.
inline constexpr double kNeighborSkin = 0.03;

/// Finds the pairs and nodes that can touch.
///
/// Each block may move by skin/2 against the ground before the list goes stale; the list holds every node that lies within the skin of
/// its follower. So no contact is ever missed, for any motion (checked against brute force by the neighbor-list tests).
class NeighborSearch {
  public:
    explicit NeighborSearch(const Model& model);

    /// Makes the list anew. Contacts that persist keep their leader, history and forces; what all pairs have dissipated so far goes to
    /// `finished`, which has an entry per block.
    void rebuild(const Bodies& bodies, ContactList& list, Losses& finished);

    /// Where every block was when the list was made, seen from the ground. A point of block i has moved since by no more than
    ///   |Δx| + 2 R |Δq|,   R = half its diagonal: a turn by θ moves it by 2 R sin(θ/2), and |Δq| = 2 sin(θ/4).
    struct Reference {
        std::vector<Vector3> position;        ///< in the frame of the ground [m]
        std::vector<Quaternion> orientation;  ///< body to that frame
        std::vector<double> diameter;         ///< 2 R [m]
    };
    const Reference& reference() const { return reference_; }
    Reference& reference() { return reference_; }
    /// The drift above which the list is stale, skin/2 [m].
    double allowed_drift() const { return 0.5 * skin_; }

  private:
    struct BlockPair {
        std::uint32_t leader, follower;
    };
    void find_block_pairs(const Bodies& bodies, std::vector<BlockPair>& pairs) const;
    /// Lists the pair as one that meets by nodes, if any may touch.
    void add_nodes(BlockPair blocks, const Bodies& bodies, ContactList& list) const;
    /// Lists the pair as boxes that meet by their overlap, if that is how the model has them meet.
    bool add_overlap(BlockPair blocks, const Bodies& bodies, ContactList& list) const;
    Interface make_pair_interface(BlockPair blocks) const;

    const Model* model_;
    double skin_ = 0.0;
    Reference reference_;
    ContactList previous_;  ///< the list before, kept to reuse its memory
};

/// Who leads a new contact: the block that is lower above the ground, as in the papers; at equal height the one listed first.
bool leads(const Bodies& bodies, std::uint32_t a, std::uint32_t b);

}  // namespace musim::lsdem
