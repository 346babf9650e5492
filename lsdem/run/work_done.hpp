#pragma once

#include <algorithm>
#include <cmath>

#include "lsdem/run/prepare.hpp"

namespace musim::lsdem::detail {

/// Work of a preparation and what follows it, reported to an observer as the part that is done, which never falls.
class WorkDone {
  public:
    /// The part goes to on_progress of the observer, which must outlive this.
    WorkDone(const RunObserver& observer, const WorkToFollow& to_follow) : observer_(observer), to_follow_(to_follow) {}
    /// Work that is done [block steps], and that is left of the preparation.
    void report(double done, const PreparationWork& left) {
        const double alike = 1.0 + to_follow_.preparations;
        const double all = alike * (done + left.most) + to_follow_.block_steps;
        part_ = std::max(part_, done / all);
        if (observer_.on_preparation_spare && std::isfinite(all)) observer_.on_preparation_spare(alike * (left.most - left.least) / all);
        if (observer_.on_progress) observer_.on_progress(part_);
    }

  private:
    const RunObserver& observer_;
    WorkToFollow to_follow_;
    double part_ = 0.0;
};

}  // namespace musim::lsdem::detail
