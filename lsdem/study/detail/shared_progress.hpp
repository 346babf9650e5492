#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <numeric>
#include <vector>

namespace musim::lsdem::study::detail {

/// Progress of several jobs side by side as one fraction: their mean.
class SharedProgress {
  public:
    /// `tell` may be empty; it must outlive this.
    SharedProgress(std::size_t jobs, const std::function<void(double)>& tell) : done_(jobs, 0.0), tell_(tell) {}

    /// From any thread.
    void update(std::size_t job, double fraction) {
        const std::lock_guard lock(mutex_);
        done_[job] = fraction;
        if (tell_) tell_(std::accumulate(done_.begin(), done_.end(), 0.0) / static_cast<double>(done_.size()));
    }

  private:
    std::vector<double> done_;
    const std::function<void(double)>& tell_;
    std::mutex mutex_;
};

}  // namespace musim::lsdem::study::detail
