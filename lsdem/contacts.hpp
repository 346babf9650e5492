#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "lsdem/bodies.hpp"
#include "lsdem/contact_law.hpp"
#include "lsdem/model.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Stands for the ground in place of a follower.
inline constexpr std::uint32_t kGround = std::numeric_limits<std::uint32_t>::max();

/// What the nodes of all pairs remember of their contacts, in the follower's frame; structure of arrays, one entry per entry of
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

/// Nodes of one block (the leader) that may touch one other block (the follower) or the ground before the next rebuild of the list.
struct ContactPair {
    std::uint32_t leader = 0;
    std::uint32_t follower = kGround;
    std::uint32_t first_node = 0;  ///< into ContactList::nodes and history
    std::uint32_t node_count = 0;
    Interface law;
};

/// What one pair did in the current step, world frame.
struct PairForce {
    Vector3 force = Vector3::Zero();                   ///< on the leader; the follower gets its opposite [N]
    Vector3 leader_torque = Vector3::Zero();           ///< about the leader's centre of mass [N·m]
    Vector3 follower_torque = Vector3::Zero();         ///< about the follower's centre of mass [N·m]
    double elastic_normal = 0.0, elastic_shear = 0.0;  ///< stored now [J]
    double overlap = 0.0;                              ///< largest of its nodes [m]
    std::uint32_t touching = 0;                        ///< nodes in contact
};

/// Energy a pair has dissipated or taken from the base since the list was built [J].
struct PairWork {
    double friction = 0.0, damping = 0.0, base = 0.0;
};

/// All pairs that may touch before the next rebuild, sorted by (leader, follower), and their nodes.
struct ContactList {
    std::vector<ContactPair> pairs;
    /// Indices into the leader shape's nodes, ascending within a pair; the last one is repeated to fill a group of four.
    std::vector<std::uint32_t> nodes;
    ContactHistory history;
    std::vector<PairForce> forces;    ///< one per pair
    std::vector<std::uint8_t> faces;  ///< one per pair: the faces that met in the last step, see detail::FlatFollower::code
    /// Contacts found in the very first step are taken as they are, initial overlap included.
    bool first_step = true;
    std::vector<PairWork> work;  ///< one per pair
};

/// Where the base was and is.
struct BasePose {
    Vector3 displacement = Vector3::Zero(), previous = Vector3::Zero();  ///< at steps n and n − 1 [m]
};

/// Forces of pairs [first, last) at step n, from the poses at n and n − 1; updates history and work. Pairs are independent of each other.
void compute_contacts(const Model& model, const Bodies& bodies, const BasePose& base, double dt, std::size_t first, std::size_t last,
                      ContactList& list);

}  // namespace musim::lsdem
