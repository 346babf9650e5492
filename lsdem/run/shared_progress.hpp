#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

namespace musim::lsdem::detail {

/// Progress of several jobs side by side as one fraction: their mean, weighted by the work of each.
class SharedProgress {
  public:
    /// `report` may be empty; it must outlive this.
    SharedProgress(std::size_t jobs, const std::function<void(double)>& report) : SharedProgress(std::vector<double>(jobs, 1.0), report) {}
    /// `work`: of every job, in any unit.
    SharedProgress(std::vector<double> work, const std::function<void(double)>& report)
        : work_(std::move(work)), all_(std::accumulate(work_.begin(), work_.end(), 0.0)), done_(work_.size(), 0.0), report_(report) {}

    /// From any thread.
    void update(std::size_t job, double fraction) {
        const std::lock_guard lock(mutex_);
        done_[job] = fraction;
        if (report_ && all_ > 0.0) report_(std::inner_product(done_.begin(), done_.end(), work_.begin(), 0.0) / all_);
    }

  private:
    std::vector<double> work_;
    double all_;
    std::vector<double> done_;
    const std::function<void(double)>& report_;
    std::mutex mutex_;
};

}  // namespace musim::lsdem::detail
