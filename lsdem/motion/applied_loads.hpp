#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lsdem/archive.hpp"
#include "lsdem/bodies.hpp"
#include "lsdem/contact/contacts.hpp"
#include "lsdem/loads.hpp"

namespace musim::lsdem {

/// Loads of a simulation. Their forces stand behind those of the pairs, where blocks find them beside their contacts; a model without loads
/// pays nothing for them.
class AppliedLoads {
  public:
    explicit AppliedLoads(const Model& model);

    bool empty() const { return loads_.empty(); }
    std::size_t size() const { return loads_.size(); }
    /// Blocks that they act on, load by load.
    std::vector<std::uint32_t> blocks() const;

    /// None has begun, and no work is done: the run starts from these poses.
    void restart(const Bodies& bodies);
    /// Forces at `time`, a step of `h` [s] after the last ones, into `forces`, one for each load; books their work on the way there.
    void apply(const Bodies& bodies, double time, double h, std::span<PairForce> forces);

    /// The time up to which no load changes, from `time` on [s]: `time` itself while one grows, infinite when none does any more.
    double still_until(double time) const;
    double work() const { return work_; }  ///< done on the blocks since the start [J]
    void forget_work() { work_ = 0.0; }
    std::vector<LoadState> states() const;

    friend void exchange(Archive& archive, AppliedLoads& loads);

  private:
    struct Applied {
        Load load;
        double damping = 0.0;  ///< of an actuator [N·s/m]
        bool has_begun = false;
        Vector3 origin = Vector3::Zero();  ///< of its point when it began, world frame [m]
        Vector3 place = Vector3::Zero();   ///< of its point at step n [m]
        double force = 0.0;                ///< at step n, along its direction [N]
    };
    friend void exchange(Archive& archive, Applied& applied);

    std::vector<Applied> loads_;
    double work_ = 0.0;
};

}  // namespace musim::lsdem
