#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "lsdem/bodies.hpp"
#include "lsdem/contact/contacts.hpp"
#include "lsdem/contact/overlap_contact.hpp"
#include "lsdem/contact/overlap_lanes.hpp"

/// Pairs of solids, and of a solid and the ground, that meet by their overlap.
namespace musim::lsdem {

/// Computes pairs at step n from the poses at n and n − 1, several side by side: forces, what they remember, tallies and work. Which pairs
/// share a batch changes no bit.
class OverlapBatch {
  public:
    OverlapBatch(const Bodies& bodies, ContactList& list);
    OverlapBatch(const OverlapBatch&) = delete;
    OverlapBatch& operator=(const OverlapBatch&) = delete;
    ~OverlapBatch() = default;

    /// A pair of ContactList::pairs that meets by its overlap; computed now or with others.
    void add(std::size_t index);
    /// Those that still wait. Returns the largest overlap over the height of the leader since the last call [-].
    double compute();

  private:
    static constexpr std::size_t kSize = detail::kLanePairs;
    /// Pairs that wait for each other: enough for lanes full of pairs alike, few enough that what they need stays in the cache.
    static constexpr std::size_t kRoom = 2048;
    static_assert(kRoom % kSize == 0);
    /// A pair's index below its company.
    using Waiting = std::array<std::uint64_t, kRoom>;
    /// Those that are computed side by side.
    struct Group {
        std::size_t count = 0;
        std::array<std::uint32_t, kSize> index;
        std::array<detail::LanePair, kSize> lanes;
        std::array<BodyPose, kSize> sheets;  ///< the ground below a block, where it is the second body
    };
    const std::uint64_t* sort();
    void compute_waiting();
    void place(std::size_t index, Group& group, std::size_t lane);
    void place(const std::uint64_t* waiting, std::size_t count, Group& group);
    void compute(Group& group, const Group& next);
    void compute_exactly(std::size_t index, detail::LanePair& lane);
    void note(std::size_t index, double area);

    const Bodies& bodies_;
    ContactList& list_;
    double deepest_ = 0.0;
    // pairs that wait for company, see OverlapContact::company
    std::size_t waiting_count_ = 0;
    Waiting waiting_, room_for_sort_;
    std::array<Group, 2> groups_;  ///< one of them is computed, and the memory of the other asked for meanwhile
    Group exact_;                  ///< a pair that is computed by itself
    detail::LaneOutput nowhere_;   ///< where what nobody asks for goes
};

/// Where friction and dashpots of a contact act, world axes and origin.
struct MeetingArea {
    double area = 0.0;                 ///< [m²]
    Vector3 normal = Vector3::Zero();  ///< in which the follower is pushed
    Vector3 middle = Vector3::Zero();  ///< [m]
    Matrix3 second = Matrix3::Zero();  ///< moments about its middle [m⁴]
};
/// Calls visit(index of the pair, area) for all pairs that touched at the last step.
void visit_meeting_areas(const Bodies& bodies, const ContactList& list, const std::function<void(std::size_t, const MeetingArea&)>& visit);

/// Energy of the normal springs of a pair at step n: that of its tally, computed exactly where the tally is rough [J].
double find_overlap_energy(const Bodies& bodies, const ContactList& list, std::size_t pair);

/// Puts the exact energies of the normal springs at step n in the place of those in the tallies that are rough: of corners, and of pairs
/// that are not computed side by side. All others are off by 6e-5 of themselves at most, see kRoughly.
void refine_overlap_energies(const Bodies& bodies, ContactList& list);

}  // namespace musim::lsdem
