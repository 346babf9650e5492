#pragma once

#include <cstddef>

#include "lsdem/types.hpp"

/// Forces and displacements that a laboratory puts on a structure beside its weight: a jack, a weight that is filled, a pull.
namespace musim::lsdem {

struct Model;

/// A force, or a displacement by an actuator, that grows in time on a block at a point: from nothing at `start` in proportion to time to
/// the whole at `start + rise`, then it stays. It keeps its direction in the world; the point moves with the block.
///
/// An actuator is a spring and a dashpot between the point, where it is when the load begins, and an end that moves by the displacement;
/// they act along the direction only, and pull as they push:
///
///   F = k·(u(t) − d·(x − x_begin)) + c·d/dt(u − d·x)
struct Load {
    std::size_t block = 0;                 ///< index into Model::blocks
    Vector3 point = Vector3::Zero();       ///< body frame [m]
    Vector3 direction = Vector3::UnitX();  ///< d: world frame, of unit length
    double force = 0.0;                    ///< the whole, along the direction [N]; unused by an actuator
    double displacement = 0.0;             ///< of an actuator's end: the whole, along the direction [m]
    double stiffness = 0.0;                ///< k of an actuator [N/m]; 0: a force
    double start = 0.0;                    ///< [s]
    double rise = 0.0;                     ///< time that it takes to grow [s]

    bool is_actuator() const { return stiffness > 0.0; }
    /// Part of the whole at a time [-].
    double part_at(double time) const;
};

/// A load at one instant.
struct LoadState {
    double force = 0.0;         ///< on the block, along the load's direction [N]
    double displacement = 0.0;  ///< of its point, likewise, world frame, since the load began [m]
};

/// Damping c of an actuator [N·s/m]: critical for the mass m that its point has along the direction while the block is free,
///
///   c = 2·sqrt(k·m),     1/m = 1/M + (r×d)·J⁻¹(r×d),     r the point from the centre of mass, at the start
double find_actuator_damping(const Model& model, const Load& load);

}  // namespace musim::lsdem
