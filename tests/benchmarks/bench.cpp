// Times the kernel on named scenes; CSV on stdout, one line per scene and number of threads. `musim_bench [SCENE]...`

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/benchmarks/bench_scenes.hpp"

namespace {

using musim::lsdem::Model;
using musim::lsdem::PhaseTimes;
using musim::lsdem::Simulation;

/// Repetitions whose median counts; the machine is noisy.
constexpr int kRepetitions = 7;

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + kRepetitions / 2, values.end());
    return values[kRepetitions / 2];
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Time of all cores on this process so far [s].
double core_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Memory of this process now [bytes].
double resident_memory() {
    std::ifstream file("/proc/self/statm");
    double total = 0.0, resident = 0.0;
    file >> total >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Most memory this process has had so far [MB].
double peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Microseconds per block and step, of the whole step and of its phases (wall time, whatever the threads), and of all cores, which other
/// programs on the machine prolong less.
struct Timing {
    std::vector<double> whole, core, contacts, motion, neighbors;
};

void time_scene(const musim::benchmarks::BenchScene& scene, int threads) {
    const double memory_before = resident_memory();
    const auto made = std::chrono::steady_clock::now();
    const Model model = scene.make();
    const double dt = 0.8 * musim::lsdem::compute_critical_time_step(model);
    const auto blocks = static_cast<double>(model.blocks.size());
    Simulation simulation(model, dt, threads);
    const double setup = seconds_since(made), memory = resident_memory() - memory_before;
    if (simulation.threads() != threads) return;
    const auto steps = static_cast<std::uint64_t>(std::max(20.0, scene.block_steps / blocks));
    simulation.advance(std::max(steps / 4, static_cast<std::uint64_t>(scene.settle / dt)));

    Timing timing;
    const double per_block_step = 1e6 / (static_cast<double>(steps) * blocks);
    for (int repetition = 0; repetition < kRepetitions; ++repetition) {
        const PhaseTimes before = simulation.phase_times();
        const auto start = std::chrono::steady_clock::now();
        const double core_start = core_seconds();
        simulation.advance(steps);
        timing.core.push_back((core_seconds() - core_start) * per_block_step);
        timing.whole.push_back(seconds_since(start) * per_block_step);
        const PhaseTimes after = simulation.phase_times();
        timing.contacts.push_back((after.contacts - before.contacts) * per_block_step);
        timing.motion.push_back((after.motion - before.motion) * per_block_step);
        timing.neighbors.push_back((after.neighbors - before.neighbors) * per_block_step);
    }
    const auto contacts = static_cast<double>(simulation.statistics().contacts);
    const double whole = median(timing.whole);
    fmt::print("{},{},{:.0f},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.0f},{:.2f},{:.0f},{:.0f}\n", scene.name, blocks, contacts, threads,
               whole, median(timing.core), median(timing.contacts), median(timing.motion), median(timing.neighbors),
               contacts / blocks / whole, setup, memory / blocks, peak_memory());
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> wanted(argv + 1, argv + argc);
    fmt::print(
        "scene,blocks,contacts,threads,us_per_block_step,us_per_block_step_core,contacts_us,motion_us,neighbors_us,"
        "million_contacts_per_s,setup_s,bytes_per_block,peak_mb_so_far\n");
    for (const auto& scene : musim::benchmarks::make_bench_scenes()) {
        if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), scene.name) == wanted.end()) continue;
        for (const int threads : {1, 2}) time_scene(scene, threads);
    }
    return 0;
}
