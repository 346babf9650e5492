#include "lsdem/study/detail/side_by_side.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>

namespace musim::lsdem::study::detail {

void run_side_by_side(const std::vector<std::function<void()>>& jobs, int threads, const std::function<void(double)>& on_progress) {
    std::atomic<std::size_t> next{0}, done{0};
    std::exception_ptr failure;
    std::mutex mutex;
    const auto work = [&] {
        for (std::size_t job = next++; job < jobs.size(); job = next++) {
            try {
                jobs[job]();
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (!failure) failure = std::current_exception();
            }
            if (on_progress) on_progress(static_cast<double>(++done) / static_cast<double>(jobs.size()));
        }
    };
    const int wanted = threads > 0 ? threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    {
        std::vector<std::jthread> others;
        for (int t = 1; t < wanted; ++t) others.emplace_back(work);
        work();
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace musim::lsdem::study::detail
