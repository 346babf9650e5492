#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "lsdem/model.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// Stands for the ground in place of a block.
inline constexpr std::uint32_t kGround = std::numeric_limits<std::uint32_t>::max();

/// What a block did over the last step, in world axes: one line of the cache, as kernels read it.
struct alignas(64) BodyStep {
    Quaternion turn = Quaternion::Identity();  ///< from the pose at step n − 1 to that at n
    Vector3 shift = Vector3::Zero();           ///< of the centre [m]
    /// Length of the way that no point of the block has exceeded, seen from the base, up to step n: grows and never falls [m].
    double travel = 0.0;
};

/// State of all blocks, one array per quantity, world frame. Positions belong to the current step n, momenta to n − 1/2 (leapfrog).
struct Bodies {
    std::vector<Vector3> position;              ///< at step n [m]
    std::vector<Matrix3> rotation;              ///< body to world, at step n
    std::vector<Quaternion> orientation;        ///< the same
    std::vector<BodyStep> step;                 ///< from n − 1 to n
    std::vector<Vector3> velocity;              ///< at step n − 1/2 [m/s]
    std::vector<Vector3> momentum;              ///< angular, about the centre of mass, at step n − 1/2 [kg·m²/s]
    std::vector<double> mass, inverse_mass;     ///< [kg], [1/kg]
    std::vector<Vector3> inverse_inertia;       ///< of the principal axes [1/(kg·m²)]; zero when rotation is locked
    std::vector<Vector3> half;                  ///< half extents, the own height included, body frame [m]
    std::vector<double> height_offset;          ///< Δ, see Block [m]
    std::vector<Vector3> start_position;        ///< where energy of position and falls are counted from [m]
    std::vector<Quaternion> start_orientation;  ///< body to world
    std::vector<std::uint8_t> fixed;
    /// Factor of all accelerations: one, zero for a fixed block; in between, a block has inertia added, see detail::MassScaling.
    std::vector<double> free;
    std::vector<double> preparation_loss;  ///< work of Model::velocity_damping and of mass scaling up to step n − 1/2 [J]

    explicit Bodies(const Model& model);
    std::size_t size() const { return mass.size(); }

    /// How far two blocks have travelled together, or one against the ground [m].
    double travel_of(std::uint32_t a, std::uint32_t b) const { return b == kGround ? step[a].travel : step[a].travel + step[b].travel; }

    Vector3 previous_position(std::size_t i) const { return position[i] - step[i].shift; }  ///< at step n − 1 [m]
    Matrix3 previous_rotation(std::size_t i) const { return step[i].turn.conjugate().toRotationMatrix() * rotation[i]; }  ///< there

    /// Lets go of fixed block i: it takes pose, velocity and inertia from its entry in `model`, without spin.
    void release(std::size_t i, const Model& model);

    /// Angular velocity for the angular momentum `l` in the orientation of step n, world frame [rad/s].
    Vector3 spin(std::size_t i, const Vector3& l) const {
        const Matrix3& r = rotation[i];
        return r * inverse_inertia[i].cwiseProduct(r.transpose() * l);
    }
};

}  // namespace musim::lsdem
