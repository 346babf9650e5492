#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace musim::scaling {

/// Does all jobs, `threads` at a time (0: all cores), first come first served; each must write to places of its own. `on_progress`, when
/// given, is called with the fraction done, from any of the threads. When jobs throw, the others are still done, then the exception of the
/// first of them in order is thrown again. Once the program is asked to stop (interruption.hpp) no job is begun any more, and Interrupted
/// is thrown.
void run_side_by_side(const std::vector<std::function<void()>>& jobs, int threads, const std::function<void(double)>& on_progress = {});

/// Cores that this process may use, one at least: no more than its CPU affinity allows, since threads that wait for each other on one core
/// keep it from each other.
int count_usable_cores();

/// Threads of `threads` (0: all cores) that each of so many jobs may use when run_side_by_side does them: those that are left over are
/// shared, one at least.
int threads_of_each(int threads, std::size_t jobs);

}  // namespace musim::scaling
