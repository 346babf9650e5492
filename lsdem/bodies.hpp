#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lsdem/body_pose.hpp"
#include "lsdem/model.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// State of all blocks and, behind the last of them, of the ground, world frame: what contacts read together in one array, other quantities
/// in one each; refers to the model's solids, which it must not outlive. Positions belong to the current step n, momenta to n − 1/2
/// (leapfrog). The ground is the half space z ≤ 0 of its own frame, held and of no finite mass; it has a pose and a step as blocks have.
struct Bodies {
    std::vector<BodyPose> pose;                 ///< at step n; of the ground, too
    std::vector<Quaternion> orientation;        ///< body to world, at step n; of the ground, too
    std::vector<Vector3> velocity;              ///< at step n − 1/2 [m/s]
    std::vector<Vector3> momentum;              ///< angular, about the centre of mass, at step n − 1/2 [kg·m²/s]
    std::vector<double> mass, inverse_mass;     ///< [kg], [1/kg]
    std::vector<Vector3> inverse_inertia;       ///< of the principal axes [1/(kg·m²)]; zero when rotation is locked
    std::vector<Vector3> start_position;        ///< where energy of position and falls are counted from; of the ground, too [m]
    std::vector<Quaternion> start_orientation;  ///< body to world; of the ground, too
    std::vector<const Solid*> solid;            ///< of the model, in the body frame; nothing: a box, round, or the ground
    std::vector<std::uint8_t> fixed;            ///< of the ground, too
    /// Factor of all accelerations: one, zero for a fixed block; in between, a block has inertia added, see detail::MassScaling.
    std::vector<double> free;
    std::vector<double> preparation_loss;  ///< work of Model::velocity_damping and of mass scaling up to step n − 1/2 [J]

    double elapsed = 0.0;                 ///< between the steps n − 1 and n [s]
    Vector3 drawn_up = Vector3::UnitZ();  ///< outward normal of the ground when the simulation was made, world frame

    explicit Bodies(const Model& model);
    std::size_t size() const { return mass.size(); }  ///< number of blocks
    /// The ground in place of a block.
    std::uint32_t ground() const { return static_cast<std::uint32_t>(size()); }
    bool is_ground(std::size_t body) const { return body == size(); }
    /// Nothing: the ground.
    std::optional<std::size_t> as_block(std::uint32_t body) const {
        return is_ground(body) ? std::nullopt : std::optional<std::size_t>(body);
    }
    /// Outward normal of the ground, world frame.
    Vector3 up() const { return pose.back().rotation.col(2); }
    std::vector<Vector3> positions() const;  ///< of all blocks, at step n [m]

    /// Distance that two bodies have travelled together, seen from the ground [m].
    double travel_of(std::uint32_t a, std::uint32_t b) const { return pose[a].step.travel + pose[b].step.travel; }

    Vector3 previous_position(std::size_t i) const { return pose[i].position - pose[i].step.shift; }  ///< at step n − 1 [m]
    /// There.
    Matrix3 previous_rotation(std::size_t i) const { return pose[i].step.turn.conjugate().toRotationMatrix() * pose[i].rotation; }

    /// Reach of block i from its centre along a direction of unit length, world axes [m].
    double find_reach(std::size_t i, const Vector3& direction) const {
        const Vector3 along = pose[i].rotation.transpose() * direction;
        return solid[i] == nullptr ? along.cwiseAbs().dot(pose[i].half) : lsdem::find_reach(*solid[i], along);
    }
    /// Distance of block i from the ground; negative inside it [m].
    double find_height(std::size_t i) const {
        const Vector3 normal = up();
        return (pose[i].position - pose.back().position).dot(normal) - find_reach(i, -normal);
    }

    /// Width of block i along a direction of unit length in its body frame [m].
    double find_extent(std::size_t i, const Vector3& along) const {
        if (solid[i] == nullptr) return 2.0 * along.cwiseAbs().dot(pose[i].half);
        return lsdem::find_reach(*solid[i], along) + lsdem::find_reach(*solid[i], -along);
    }

    /// Lets go of fixed block i: it takes pose, velocity and inertia from its entry in `model`, without spin.
    void release(std::size_t i, const Model& model);

    /// Angular velocity for the angular momentum `l` in the orientation of step n, world frame [rad/s].
    Vector3 spin(std::size_t i, const Vector3& l) const {
        const Matrix3& r = pose[i].rotation;
        return r * inverse_inertia[i].cwiseProduct(r.transpose() * l);
    }
};

}  // namespace musim::lsdem
