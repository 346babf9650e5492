#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "lsdem/bodies.hpp"
#include "lsdem/contact/box_meeting.hpp"
#include "lsdem/contact/contact_area.hpp"
#include "lsdem/contact/contacts.hpp"
#include "lsdem/contact/overlap_contact.hpp"
#include "lsdem/detail/prefetch.hpp"

/// Boxes that meet face to face, several pairs side by side: overlap, dashpots and friction, the functions of overlap.hpp, contact_area.hpp
/// and overlap_contact.hpp, to rounding. The step is compiled for AVX-512, for AVX2 and for plain x86-64, same bits; pairs do not depend on
/// each other.
namespace musim::lsdem::detail {

/// Pairs that one call computes at most, and of how many the number has to be a multiple.
inline constexpr std::size_t kLanePairs = 32, kMostLanes = 8;
constexpr std::size_t round_up_to_lanes(std::size_t count) { return (count + kMostLanes - 1) / kMostLanes * kMostLanes; }

/// Results of a contact's step.
struct LaneOutput {
    OverlapContact contact;
    PairForce force;
    PairTally tally;
    PairWork work;
};

/// Two boxes, the first the leader, and where to find and put what their contact is made from.
struct LanePair {
    BoxMeeting meeting;
    const Interface* law;
    OverlapContact* contact;
    PairForce* force;
    PairTally* tally;
    PairWork* work;
    double area = 0.0;       ///< found: of the main cells, half of each body's, or of all faces inside the other body [m²]
    bool irregular = false;  ///< found: nothing is computed, take the exact function

    /// Asks for all of it.
    [[gnu::always_inline]] void prefetch() const {
        detail::prefetch(meeting.a);
        detail::prefetch(meeting.b);
        detail::prefetch(contact);
        detail::prefetch(force);
        detail::prefetch(tally);
        detail::prefetch(work);
    }
    void put_into(LaneOutput& output) { contact = &output.contact, force = &output.force, tally = &output.tally, work = &output.work; }
};

/// Forces of `count` pairs at step n, what they remember, tallies and work; of those that are irregular `nowhere`. `first_step`: the step
/// before is none, so nothing has slipped. `next`: pairs whose turn comes after these, whose memory is asked for meanwhile.
void compute_lane_pairs(LanePair* pairs, std::size_t count, double dt, bool first_step, LaneOutput& nowhere,
                        std::span<const LanePair> next);

/// Memory that the exact function keeps from one pair to the next.
struct ExactRoom {
    PlacedPair placed;
    OverlapPieces pieces;
};
/// The same for one pair of any two solids, by the exact function.
void compute_exact_pair(LanePair& pair, const MeetingSolids& solids, double dt, bool first_step, ExactRoom& room);

/// Overlap alone, without a step, for a stiffness per area of one; about the point half way between the middles of the boxes.
struct LaneFinding {
    Vector3 force;                    ///< on the second body [m³]
    Vector3 moment;                   ///< of it [m⁴]
    double deepest;                   ///< largest depth of a point of one body in the other [m]
    double energy;                    ///< but for a part overlap²/area of it [m⁴]
    double area;                      ///< over which faces face each other, see ContactArea [m²]
    Vector3 area_place;               ///< ∫ place [m³]
    Vector3 area_square, area_cross;  ///< ∫ of (xx, yy, zz) and (yz, zx, xy) about the cell's own middle [m⁴]
    bool irregular;                   ///< nothing of the above holds
    bool operator==(const LaneFinding&) const = default;
};
/// Overlaps of `count` pairs.
void compute_overlaps(const BoxMeeting* pairs, std::size_t count, LaneFinding* found);

// the same for machines with AVX-512, where others have those of AVX2, which nobody calls; and for those without AVX2, and other processors
void compute_pairs_512(LanePair* pairs, std::size_t count, double dt, bool first_step, LaneOutput& nowhere, std::span<const LanePair> next);
void compute_pairs_plain(LanePair* pairs, std::size_t count, double dt, bool first_step, LaneOutput& nowhere,
                         std::span<const LanePair> next);
void find_overlaps_512(const BoxMeeting* pairs, std::size_t count, LaneFinding* found);
void find_overlaps_plain(const BoxMeeting* pairs, std::size_t count, LaneFinding* found);

}  // namespace musim::lsdem::detail
