#pragma once

#include <cstddef>
#include <vector>

#include "lsdem/bodies.hpp"
#include "lsdem/contact/contacts.hpp"
#include "lsdem/model.hpp"
#include "lsdem/motion/motion_kernel.hpp"

namespace musim::lsdem::detail {

/// Inertia that blocks are given while a specimen is prepared, so that its time step may be longer than that of a run; see
/// docs/theory/preparation.md, "Mass scaling".
///
/// Where forces balance does not depend on inertia. A contact of stiffness k and dashpot c anywhere on the surface of a block of mass m is
/// stable in steps of dt if m ≥ g·(Λ·k·dt²/4 + Λ_n·c·dt/2), and the contacts of a block add up; g = 2 between two blocks that move against
/// each other, else 1; Λ = λ_max(1 + m·[r]×·I⁻¹·[r]×ᵀ), the mobility at the corner r times m, Λ_n that along one axis. What a block lacks
/// is added, to mass and moments alike, by making all its accelerations smaller: Bodies::free. It is added at rest, so that momenta stay,
/// and goes with the velocity of the block: either takes energy.
class MassScaling {
  public:
    /// Blocks are as heavy as steps of `dt` [s] ask for, from what their contacts ask for in the next step on, or have asked for.
    void begin(const Model& model, double dt, ContactList& list);
    /// Blocks have their own inertia again, and contacts are not asked any more.
    void end(Bodies& bodies, ContactList& list);
    bool is_active() const { return !mobilities_.empty(); }

    /// Demand of the contacts of a new list, per area.
    void price(ContactList& list) const;
    /// Gives blocks [first, last) what their contacts have asked for, at step n before they move on from n − 1/2.
    void give(const TouchList& touches, const ContactList& list, std::size_t first, std::size_t last, Bodies& bodies) const;

  private:
    /// Mobility of one block at its corners, times its mass [-].
    struct Mobility {
        double any = 1.0;                 ///< Λ
        Vector3 along = Vector3::Ones();  ///< Λ_n of forces along each body axis
    };
    static Mobility find_mobility(const Model& model, const Block& block);
    double price_of(const ContactPair& pair) const;
    /// A block takes up inertia and keeps its momentum: its velocity falls by `factor`. What its energy ½ m v_{n−1/2}·(v_{n−1/2} + dt·a) at
    /// step n loses by that is booked. At its old velocity it would hit what it touches with several times the momentum it came with.
    void slow_down(std::size_t i, double factor, const TouchList::Load& load, Bodies& bodies) const;

    double dt_ = 0.0;
    Vector3 gravity_ = Vector3::Zero();
    std::vector<Mobility> mobilities_;  ///< one per block; empty: blocks have their own inertia
};

}  // namespace musim::lsdem::detail
