#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <utility>
#include <vector>

#include "lsdem/types.hpp"

namespace musim::lsdem::detail {

/// Velocities of one run, sample by sample. While one thread runs and adds to it, others that run the same in other units read what is
/// there, and wait for what is not yet.
class VelocityTape {
  public:
    /// One that a run is to fill.
    VelocityTape() = default;
    /// One that is complete.
    explicit VelocityTape(std::vector<std::vector<Vector3>> samples) : ended_(true), complete_(true) {
        for (std::vector<Vector3>& velocities : samples) samples_.push_back(std::move(velocities));
    }

    void add(std::vector<Vector3> velocities) {
        {
            const std::lock_guard lock(mutex_);
            samples_.push_back(std::move(velocities));
        }
        changed_.notify_all();
    }

    /// Nothing more comes. `complete`: the run got to its end and was not cut short by an error.
    void end(bool complete) {
        {
            const std::lock_guard lock(mutex_);
            ended_ = true;
            complete_ = complete;
        }
        changed_.notify_all();
    }

    /// Those of a sample, valid as long as the tape; nullptr when it ended before.
    const std::vector<Vector3>* wait_for(std::size_t sample) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return ended_ || sample < samples_.size(); });
        return sample < samples_.size() ? &samples_[sample] : nullptr;
    }

    /// Waits for the end; did the run get there?
    bool wait_for_end() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return ended_; });
        return complete_;
    }

    /// All samples of one that has ended.
    std::vector<std::vector<Vector3>> samples() const { return {samples_.begin(), samples_.end()}; }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::vector<Vector3>> samples_;  ///< a deque: what is read stays where it is while more comes
    bool ended_ = false, complete_ = false;
};

}  // namespace musim::lsdem::detail
