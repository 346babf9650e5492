// Times the kernel on named scenes; CSV on stdout, one line per scene and number of threads. `musim_bench [SCENE]...`

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "lsdem/simulation.hpp"
#include "lsdem/time_step.hpp"
#include "tests/benchmarks/bench_scenes.hpp"

namespace {

using musim::lsdem::PhaseTimes;
using musim::lsdem::Simulation;

/// Repetitions whose median counts; the machine is noisy.
constexpr int kRepetitions = 5;
/// Block steps of one repetition: about half a second of work.
constexpr double kBlockSteps = 4e5;

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + kRepetitions / 2, values.end());
    return values[kRepetitions / 2];
}

/// Microseconds per block and step, of the whole step and of its phases (wall time, whatever the threads).
struct Timing {
    std::vector<double> whole, contacts, motion, neighbors;
};

void time_scene(const musim::benchmarks::BenchScene& scene, int threads) {
    const double dt = 0.8 * musim::lsdem::compute_critical_time_step(scene.model);
    const auto blocks = static_cast<double>(scene.model.blocks.size());
    const auto steps = static_cast<std::uint64_t>(std::max(20.0, kBlockSteps / blocks));
    Simulation simulation(scene.model, dt, threads);
    if (simulation.threads() != threads) return;
    simulation.advance(steps / 4);

    Timing timing;
    const double per_block_step = 1e6 / (static_cast<double>(steps) * blocks);
    for (int repetition = 0; repetition < kRepetitions; ++repetition) {
        const PhaseTimes before = simulation.phase_times();
        const auto start = std::chrono::steady_clock::now();
        simulation.advance(steps);
        const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
        const PhaseTimes after = simulation.phase_times();
        timing.whole.push_back(wall.count() * per_block_step);
        timing.contacts.push_back((after.contacts - before.contacts) * per_block_step);
        timing.motion.push_back((after.motion - before.motion) * per_block_step);
        timing.neighbors.push_back((after.neighbors - before.neighbors) * per_block_step);
    }
    fmt::print("{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}\n", scene.name, scene.model.blocks.size(),
               simulation.statistics().contact_nodes, threads, median(timing.whole), median(timing.whole) * threads,
               median(timing.contacts), median(timing.motion), median(timing.neighbors));
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> wanted(argv + 1, argv + argc);
    fmt::print("scene,blocks,contact_nodes,threads,us_per_block_step,us_per_block_step_core,contacts_us,motion_us,neighbors_us\n");
    for (const auto& scene : musim::benchmarks::make_bench_scenes()) {
        if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), scene.name) == wanted.end()) continue;
        for (const int threads : {1, 2}) time_scene(scene, threads);
    }
    return 0;
}
