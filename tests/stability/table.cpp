#include "tests/stability/table.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace musim::lsdem::tests {
namespace {

/// Adds a Markdown row to the file that MUSIM_STABILITY_TABLE names, if any.
void note_row(const std::string& name, const Observation& seen, const std::string& verdict) {
    const std::string row =
        fmt::format("| {} | {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {} |\n", name, seen.steps, seen.closure, seen.gain,
                    seen.drift, seen.kinetic_at_end, seen.reported_overlap, seen.measured_overlap, verdict);
    MESSAGE(row);
    if (const char* path = std::getenv("MUSIM_STABILITY_TABLE")) std::ofstream(path, std::ios::app) << row;
}

/// Rounding of positions, a few hundred edges from the origin at most, in edges [-].
constexpr double kRounding = 1e-12;

/// The demands that a run breaks, by name; empty for none.
std::string find_broken(const Observation& seen, const Demands& demands) {
    std::string broken;
    const auto demand = [&](bool holds, const char* what) { broken += holds ? "" : std::string(broken.empty() ? "" : ", ") + what; };
    // written so that a value that is not a number breaks its demand
    demand(!seen.divergence, "diverged");
    demand(seen.closure <= demands.closure, "balance open");
    demand(seen.gain <= demands.gain, "energy gained");
    demand(seen.drift <= demands.drift, "drifts");
    demand(seen.kinetic_at_end <= demands.kinetic, "does not rest");
    demand(seen.measured_overlap <= demands.overlap, "overlap");
    const bool given = seen.probed_by_nodes
                           ? seen.measured_overlap <= seen.reported_overlap + kUnreportedBetweenNodes
                           : std::min(seen.measured_overlap, kDeepest) <= kWayOverDepth * seen.reported_overlap + kRounding;
    demand(given, "overlap not reported");
    return broken;
}

}  // namespace

void check_sound(const std::string& name, const Observation& seen, const Demands& demands) {
    const std::string broken = find_broken(seen, demands);
    note_row(name, seen, broken.empty() ? "sound" : "**FAILS: " + broken + "**");
    CHECK_MESSAGE(broken.empty(), name, ": ", broken);
}

void check_detected(const std::string& name, const Model& model, const Observation& seen) {
    const bool detected = seen.divergence && seen.divergence->block < model.blocks.size() && seen.divergence->time > 0.0 &&
                          seen.divergence->time <= seen.time;
    note_row(name, seen,
             detected ? fmt::format("detected: block {}, step {}", seen.divergence->block, seen.steps) : "**FAILS: not detected**");
    CHECK_MESSAGE(detected, name);
}

void check_sound_or_detected(const std::string& name, const Model& model, const Observation& seen, const Demands& demands) {
    seen.divergence ? check_detected(name, model, seen) : check_sound(name, seen, demands);
}

}  // namespace musim::lsdem::tests
