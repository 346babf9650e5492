#include "lsdem/thread_team.hpp"

namespace musim::lsdem {
namespace {

/// Looks before a waiting thread sleeps. About 50 µs here: longer than the serial gap between two phases of a step, short enough to leave
/// the core to others. Affects speed only.
constexpr int kSpins = 20000;

inline void relax() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

}  // namespace

ThreadTeam::ThreadTeam(int threads) {
    workers_.reserve(threads > 1 ? static_cast<std::size_t>(threads - 1) : 0U);
    for (int index = 1; index < threads; ++index) workers_.emplace_back([this, index] { work(index); });
}

ThreadTeam::~ThreadTeam() {
    stop_.store(true, std::memory_order_relaxed);
    start();
    for (std::thread& worker : workers_) worker.join();
}

void ThreadTeam::start() {
    if (workers_.empty()) return;
    busy_.store(static_cast<int>(workers_.size()), std::memory_order_relaxed);
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
}

void ThreadTeam::wait_for_all() {
    for (int spin = 0; spin < kSpins; ++spin) {
        if (busy_.load(std::memory_order_acquire) == 0) return;
        relax();
    }
    for (int left = busy_.load(std::memory_order_acquire); left != 0; left = busy_.load(std::memory_order_acquire)) busy_.wait(left);
}

void ThreadTeam::work(int index) {
    for (std::uint32_t seen = 0;; ++seen) {
        for (int spin = 0; spin < kSpins && round_.load(std::memory_order_acquire) == seen; ++spin) relax();
        while (round_.load(std::memory_order_acquire) == seen) round_.wait(seen);
        if (stop_.load(std::memory_order_relaxed)) return;
        task_(context_, index);
        if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_one();
    }
}

}  // namespace musim::lsdem
