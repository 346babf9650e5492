#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "lsdem/archive.hpp"
#include "lsdem/base_motion.hpp"
#include "lsdem/bodies.hpp"
#include "lsdem/motion/motion_kernel.hpp"

namespace musim::lsdem {

/// The base: it moves the ground, and the blocks that are held to it, and bears what pushes them.
class CarryingBase {
  public:
    /// `carried`: the blocks that are held to it.
    CarryingBase(const BaseComponents& motion, std::vector<std::size_t> carried) : motion_(motion), carried_(std::move(carried)) {}

    const BaseMotion& motion() const { return motion_; }
    /// Takes another motion, which goes on from where the ground is. Throws std::invalid_argument, and then changes nothing.
    void begin(const BaseComponents& motion) { motion_ = BaseMotion(motion); }
    /// The motion begins, at t = 0, where the ground is.
    void restart(const Bodies& bodies);

    /// Where the motion has the ground at `time`: its pose, but not its step.
    void put_ground(double time, Bodies& bodies) const;
    /// Takes the ground over a step of `h` [s], which ends at `time`; without a time it stands.
    void move_ground(std::optional<double> time, double h, Bodies& bodies) const;
    /// Gives the carried blocks the velocity by which they stay with the ground over its step.
    void push_carried(Bodies& bodies) const;
    /// Turns the carried blocks with the ground, after their step.
    void turn_carried(Bodies& bodies) const;

    /// Sums up what pushes the ground and the carried blocks, and adds the work of the step: force times shift plus couple times turn, with
    /// the means of both ends of the step.
    void bear(const detail::TouchList& touches, const std::vector<PairForce>& forces, const Bodies& bodies);
    const Vector3& force() const { return force_; }    ///< on the blocks [N]
    const Vector3& couple() const { return couple_; }  ///< on the blocks, about the origin of the ground's frame, world axes [N·m]
    double work() const { return work_; }              ///< done on the blocks [J]
    void forget_work() { work_ = 0.0; }

    Vector3 displacement(const Bodies& bodies) const;  ///< of the pivot since the motion began [m]
    Quaternion turn(const Bodies& bodies) const;       ///< of the ground since the motion began
    Vector3 pivot_place() const;                       ///< where the pivot is without its displacement, world frame [m]
    /// Has the ground been turned, or will this motion turn it?
    bool is_turned() const { return motion_.turns() || !unturned_.vec().isZero(0.0); }
    bool carries(std::size_t block) const;

    void exchange(Archive& archive);

  private:
    Quaternion orientation_at_begin() const { return motion_.turn(0.0) * unturned_; }

    BaseMotion motion_;
    std::vector<std::size_t> carried_;
    Vector3 origin_ = Vector3::Zero();              ///< of the ground's frame, without the displacement of the motion [m]
    Quaternion unturned_ = Quaternion::Identity();  ///< orientation of the ground without the turn of the motion
    Vector3 force_ = Vector3::Zero(), couple_ = Vector3::Zero();
    double work_ = 0.0;
};

}  // namespace musim::lsdem
