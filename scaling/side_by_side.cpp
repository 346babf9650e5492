#include "scaling/side_by_side.hpp"

#if defined(__linux__)
#include <sched.h>
#endif

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>

#include "scaling/interruption.hpp"

namespace musim::scaling {

namespace {

std::size_t count_threads(int threads) { return static_cast<std::size_t>(threads > 0 ? threads : count_usable_cores()); }

}  // namespace

int count_usable_cores() {
#if defined(__linux__)
    cpu_set_t usable;
    if (sched_getaffinity(0, sizeof usable, &usable) == 0) return std::max(1, CPU_COUNT(&usable));
#endif
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void run_side_by_side(const std::vector<std::function<void()>>& jobs, int threads, const std::function<void(double)>& on_progress) {
    std::atomic<std::size_t> next{0}, done{0};
    std::vector<std::exception_ptr> failures(jobs.size());
    const auto work = [&] {
        for (std::size_t job = next++; job < jobs.size(); job = next++) {
            try {
                stop_if_interrupted();
                jobs[job]();
            } catch (...) {
                failures[job] = std::current_exception();
            }
            if (on_progress) on_progress(static_cast<double>(++done) / static_cast<double>(jobs.size()));
        }
    };
    const std::size_t wanted = count_threads(threads);
    {
        std::vector<std::jthread> others;
        for (std::size_t t = 1; t < std::min(wanted, jobs.size()); ++t) others.emplace_back(work);
        work();
    }
    stop_if_interrupted();
    for (const std::exception_ptr& failure : failures) {
        if (failure) std::rethrow_exception(failure);
    }
}

int threads_of_each(int threads, std::size_t jobs) {
    return static_cast<int>(std::max<std::size_t>(1, count_threads(threads) / std::max<std::size_t>(1, jobs)));
}

}  // namespace musim::scaling
