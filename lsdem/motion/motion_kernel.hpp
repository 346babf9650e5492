#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lsdem/bodies.hpp"
#include "lsdem/contact/contacts.hpp"
#include "lsdem/detail/prefetch.hpp"
#include "lsdem/detail/shared_work.hpp"
#include "lsdem/detail/velocity_decay.hpp"
#include "lsdem/motion/neighbors.hpp"

namespace musim::lsdem::detail {

/// The pairs of every block and of the ground, in the order of the list, and the loads on it, so that sums run in one order whatever the
/// threads.
class TouchList {
  public:
    /// `loaded`: the block of each load, whose force stands behind those of the pairs.
    void rebuild(std::size_t blocks, const std::vector<ContactPair>& pairs, const std::vector<std::uint32_t>& loaded);

    struct Load {
        Vector3 force, torque;  ///< [N], about the centre of mass [N·m]
    };
    /// Sum of all contacts and loads on body i.
    Load sum(std::size_t i, const std::vector<PairForce>& forces) const {
        Load load{Vector3::Zero(), Vector3::Zero()};
        for (std::size_t t = begin_[i]; t < begin_[i + 1]; ++t) {
            const PairForce& pair = forces[touches_[t].pair];
            if (touches_[t].leads) {
                load.force += pair.force;
                load.torque += pair.leader_torque;
            } else {
                load.force -= pair.force;
                load.torque += pair.follower_torque;
            }
        }
        return load;
    }

    /// Sum of a number of each pair over the pairs of block i.
    double sum(std::size_t i, const std::vector<double>& of_pairs) const {
        double total = 0.0;
        for (std::size_t t = begin_[i]; t < begin_[i + 1]; ++t) {
            if (touches_[t].pair < of_pairs.size()) total += of_pairs[touches_[t].pair];
        }
        return total;
    }

    /// Asks for the forces that `sum` of block i will add up.
    void prefetch(std::size_t i, const std::vector<PairForce>& forces) const {
        for (std::size_t t = begin_[i]; t < begin_[i + 1]; ++t) detail::prefetch(&forces[touches_[t].pair]);
    }

  private:
    /// One pair as seen from one of its blocks.
    struct Touch {
        std::uint32_t pair;
        bool leads;
    };
    std::vector<std::size_t> begin_;  ///< per block, into touches_
    std::vector<Touch> touches_;
};

/// Forces that move blocks in one step, and the drift beyond which neighbors are searched anew. The objects that it refers to must outlive
/// it.
struct Leap {
    const TouchList& touches;                    ///< the pairs of every block
    const std::vector<PairForce>& forces;        ///< of these pairs
    const NeighborSearch::Reference& reference;  ///< where blocks stood when neighbors were searched
    Vector3 gravity = Vector3::Zero();           ///< [m/s²]
    double h = 0.0;                              ///< length of the step [s]
    double kick = 0.0;                           ///< from the middle of the step before to that of this one; h, of equal steps [s]
    VelocityDecay decay{0.0, 0.0};               ///< over `kick`
    bool prepares = false;                       ///< there is damping or mass scaling, whose work is booked
    bool is_turned = false;                      ///< the ground turns, or has done so
};

/// One leapfrog step of the blocks of a share, several side by side; compiled for AVX-512, for AVX2 and for plain x86-64, same bits. Bodies
/// hold the poses of step n as the previous ones, but that of the ground, which has taken its step; the new ones are written. Returns the
/// largest distance that any point of them may have moved against the ground since the neighbor list was made [m]; infinite when a position
/// is not a number.
double move_blocks(const Leap& leap, const Share& share, Bodies& bodies);

// the same for machines with AVX-512
double move_blocks_512(const Leap& leap, const Share& share, Bodies& bodies);

}  // namespace musim::lsdem::detail
