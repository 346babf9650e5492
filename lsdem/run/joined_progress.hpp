#pragma once

#include <algorithm>

namespace musim::lsdem {

/// Preparation and runs as one scale from 0 to 1 that never falls.
class JoinedProgress {
  public:
    /// From now on another preparation and its runs, which are this share of all, after those before. At first one is all.
    void begin_part(double share) {
        first_ = next_;
        share_ = share;
        next_ += share;
        prepared_ = 0.0;
    }

    /// From the argument of RunObserver::on_preparation.
    double after_preparing(double part_of_all) {
        prepared_ = std::max(prepared_, part_of_all);
        return advance_to(part_of_all);
    }
    /// From the part of the runs that is done: what the preparation was worth comes before it.
    double after_running(double part_of_runs) { return advance_to(prepared_ + (1.0 - prepared_) * part_of_runs); }

    /// Part of all that a share of the present preparation and its runs is.
    double of_whole_part(double share) const { return share_ * share; }
    /// Part of all that a share of the runs is.
    double of_all(double share_of_runs) const { return share_ * (1.0 - prepared_) * share_of_runs; }

  private:
    double advance_to(double part) { return done_ = std::clamp(first_ + share_ * part, done_, 1.0); }

    double first_ = 0.0, share_ = 1.0, next_ = 0.0;
    double prepared_ = 0.0, done_ = 0.0;
};

}  // namespace musim::lsdem
