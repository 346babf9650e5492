#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "lsdem/bodies.hpp"
#include "lsdem/contact/overlap_contact.hpp"
#include "lsdem/contact_law.hpp"
#include "lsdem/losses.hpp"
#include "lsdem/model.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Memory that the nodes of all pairs have of their contacts, in the follower's frame; structure of arrays, one entry per entry of
/// ContactList::nodes. The history is the largest stream of a step.
struct ContactHistory {
    std::array<std::vector<double>, 3> slip;  ///< ξ, elastic part of the slip, tangential [m]
    /// Pressure of the normal dashpot at the last step [Pa]; infinite while the node is not in contact.
    std::vector<double> damping_pressure;
    /// Overlap that was already there when the contact was noticed [m]; it carries no force, so that noticing late cannot create energy.
    std::vector<double> late;
    /// Traction of the tangential dashpot at the last step [Pa]; empty when no interface has one.
    std::array<std::vector<double>, 3> viscous;

    static constexpr double kNoContact = std::numeric_limits<double>::infinity();
    bool touches(std::size_t entry) const { return damping_pressure[entry] != kNoContact; }
    bool has_viscous() const { return !viscous[0].empty(); }

    /// All entries without contact.
    void reset(std::size_t entries, bool with_viscous);
    void end(std::size_t entry);
    void copy(const ContactHistory& from, std::size_t from_entry, std::size_t entry);
};

/// The edge of a follower's face is rounded over this part of a node's cell [-]: the area of a node falls to zero with a continuous slope,
/// from where its cell starts to reach over the edge to where it has left by this much more. With a sharp edge, blocks stacked edge on edge
/// sit on a kink of their own energy, and rounding alone would decide which way it pushes (seen as 2e-7 of the velocities between two
/// scales). Blocks that share an edge keep their full area; elsewhere the area of a boundary row is off by half of this.
inline constexpr double kEdgeBlend = 0.1;

class OverlapBatch;

/// Two bodies, a block and another or the ground, that may touch before the next rebuild of the list: boxes that meet by their overlap, or
/// those nodes of the one (the leader) that may touch the other (the follower).
struct ContactPair {
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    std::uint32_t leader = 0;
    std::uint32_t follower = 0;    ///< the ground never leads
    std::uint32_t first_node = 0;  ///< into ContactList::nodes and history
    std::uint32_t node_count = 0;
    std::uint32_t overlap = kNone;  ///< into ContactList::overlaps, when the pair meets by its overlap
    bool is_exact = false;          ///< one of both is no box: the exact function alone knows their overlap
    /// Body axes of both along which faces met, or were to meet, when the pair was listed; 3 for no face on a face. Of the ground none.
    std::uint8_t leader_axis = 3, follower_axis = 3;
    Interface law;

    bool is_overlap() const { return overlap != kNone; }
};

/// Forces of one pair in the current step, world frame.
struct PairForce {
    Vector3 force = Vector3::Zero();            ///< on the leader; the follower gets its opposite [N]
    Vector3 leader_torque = Vector3::Zero();    ///< about the leader's centre of mass [N·m]
    Vector3 follower_torque = Vector3::Zero();  ///< about the follower's centre of mass, or the origin of the ground's frame [N·m]
};

/// State of one pair now.
struct PairTally {
    double elastic_normal = 0.0, elastic_shear = 0.0;  ///< stored [J]
    double overlap = 0.0;                              ///< largest [m]
    std::uint32_t touching = 0;                        ///< nodes in contact; of boxes that overlap, one
    bool rough = false;                                ///< see refine_overlap_energies
};

/// Inertia that contacts ask their blocks to have while a specimen is prepared, see detail::MassScaling.
struct InertiaDemand {
    bool wanted = false;
    std::vector<double> per_area;  ///< one per pair [kg/m²]
    std::vector<double> asked;     ///< one per pair: the same times the area over which it touches now [kg]

    void ask(std::size_t pair, double area) { asked[pair] = area * per_area[pair]; }
};

/// A pair that is found apart is passed over until its two blocks have together travelled this part of the gap [-]: a quarter of what they
/// would have to. Affects speed only, never results.
inline constexpr double kTrustedGap = 0.25;

/// All pairs that may touch before the next rebuild, sorted by their blocks' numbers, and their nodes.
struct ContactList {
    std::vector<ContactPair> pairs;
    /// Indices into the leader shape's nodes, ascending within a pair; the last one is repeated to fill a group of four.
    std::vector<std::uint32_t> nodes;
    ContactHistory history;
    std::vector<PairForce> forces;         ///< one per pair
    std::vector<OverlapContact> overlaps;  ///< see ContactPair::overlap
    std::vector<PairTally> tallies;        ///< one per pair
    double trusted_gap = kTrustedGap;      ///< zero: every pair is looked at in every step [-]
    std::vector<std::uint32_t> active;     ///< room for one entry per pair: those that a step has to look at, per thread
    std::vector<double> next_check;        ///< one per pair: Bodies::travel_of both blocks below which they cannot meet [m]
    std::vector<std::uint8_t> faces;       ///< one per pair: the faces that met in the last step, see detail::FlatFollower::code
    /// Contacts found in the very first step are taken as they are, initial overlap included.
    bool first_step = true;
    InertiaDemand demand;
    std::vector<PairWork> work;  ///< one per pair, since the list was built
};

/// Elastic energy of all pairs, their losses since the list was built [J], and how much touches.
struct ContactTotals {
    double elastic_normal = 0.0, elastic_shear = 0.0;
    PairWork work;
    std::size_t contacts = 0;  ///< pairs
    std::size_t nodes = 0;     ///< of pairs that meet by nodes
};
ContactTotals sum_contacts(const ContactList& list);

/// Number of pairs that are known to be apart, see kTrustedGap.
std::size_t count_apart(const Bodies& bodies, const ContactList& list);

/// Adds what all pairs have dissipated since the list was built, in the order of the list.
void add_losses(const Bodies& bodies, const ContactList& list, Losses& losses);

/// Forgets the losses of all pairs.
void clear_losses(ContactList& list);

/// Forces of pairs [first, last) at step n, from the poses at n and n − 1; updates history and work. Pairs are independent of each other.
/// Boxes that overlap go to `overlaps`, which may leave some to wait for others. Returns the largest overlap of those that meet by nodes,
/// over the height of the leader's shape [-].
double compute_pairs(const Model& model, const Bodies& bodies, std::size_t first, std::size_t last, ContactList& list,
                     OverlapBatch& overlaps);

}  // namespace musim::lsdem
