#include "tests/stability/observe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lsdem/block_height.hpp"
#include "lsdem/scene/detail/overlap.hpp"
#include "lsdem/scene/scene.hpp"
#include "lsdem/time_step.hpp"

namespace musim::lsdem::tests {
namespace {

double smallest_edge(const Model& model) {
    double edge = std::numeric_limits<double>::infinity();
    for (const Block& block : model.blocks) edge = std::min(edge, 2.0 * half_extents(model, block).minCoeff());
    return edge;
}

double greatest_height(const Model& model) {
    double height = 0.0;
    for (const Block& block : model.blocks) height = std::max(height, 2.0 * half_extents(model, block).z());
    return height;
}

/// Deepest overlap of two boxes, or of a box and the ground, from the poses alone [m].
double measure_overlap(const Simulation& simulation) {
    const Model& model = simulation.model();
    std::vector<lsdem::detail::Body> bodies;
    double deepest = 0.0;
    for (std::size_t i = 0; i < model.blocks.size(); ++i) {
        const Block& block = model.blocks[i];
        const Matrix3 axes = simulation.orientation(i).toRotationMatrix();
        bodies.push_back({half_extents(model, block), simulation.position(i), axes, false, block.fixed});
        if (!model.ground.present || block.fixed) continue;
        const double lowest = simulation.position(i).z() - axes.row(2).cwiseAbs().dot(bodies.back().half);
        deepest = std::max(deepest, simulation.base().displacement.z() - lowest);
    }
    const auto overlap = lsdem::detail::find_deepest_overlap(bodies);
    return overlap ? std::max(deepest, overlap->depth) : deepest;
}

/// Energies of a run, looked at now and then.
class EnergyWatch {
  public:
    explicit EnergyWatch(const Energy& start) : start_(start), least_(start.mechanical() - start.base_work) {}

    void look(const Energy& now) {
        const double released = std::abs(now.gravitational - start_.gravitational);
        in_play_ = std::max(in_play_, now.kinetic + released + now.elastic_normal + now.elastic_shear + now.friction_loss +
                                          now.damping_loss + std::abs(now.base_work));
        unbalanced_ = std::max(unbalanced_, std::abs(now.balance() - start_.balance()));
        const double kept = now.mechanical() - now.base_work;
        gained_ = std::max(gained_, kept - least_);
        least_ = std::min(least_, kept);
        kinetic_ = now.kinetic;
    }

    void report(Observation& seen) const {
        if (in_play_ == 0.0) return;
        seen.closure = unbalanced_ / in_play_;
        seen.gain = gained_ / in_play_;
        seen.kinetic_at_end = kinetic_ / in_play_;
    }

  private:
    Energy start_;
    double least_, in_play_ = 0.0, unbalanced_ = 0.0, gained_ = 0.0, kinetic_ = 0.0;
};

}  // namespace

double default_time_step(const Model& model) { return lsdem::TimeSettings{}.safety * compute_critical_time_step(model); }

Observation observe(const Model& model, double time_step, double duration, int samples,
                    const std::function<void(const Simulation&)>& look) {
    Simulation simulation(model, time_step);
    const auto steps = static_cast<std::uint64_t>(std::llround(duration / time_step));
    const auto count = static_cast<std::uint64_t>(samples);
    const double edge = smallest_edge(model);
    Observation seen;
    EnergyWatch energies(simulation.energy());
    energies.look(simulation.energy());
    if (look) look(simulation);
    Kinematics middle = simulation.kinematics();
    Vector3 middle_base = simulation.base().displacement;
    for (std::uint64_t sample = 0; sample < count && !simulation.divergence(); ++sample) {
        simulation.advance(steps * (sample + 1) / count - steps * sample / count);
        energies.look(simulation.energy());
        seen.measured_overlap = std::max(seen.measured_overlap, measure_overlap(simulation) / edge);
        if (look) look(simulation);
        if (sample + 1 == 3 * count / 4) middle = simulation.kinematics(), middle_base = simulation.base().displacement;
    }
    const Vector3 base = simulation.base().displacement - middle_base;
    for (std::size_t i = 0; i < model.blocks.size(); ++i)
        seen.drift = std::max(seen.drift, (simulation.position(i) - middle.position[i] - base).norm() / edge);
    energies.report(seen);
    seen.probed_by_nodes =
        !std::all_of(model.blocks.begin(), model.blocks.end(), [&](const Block& block) { return meets_by_overlap(model, block); });
    seen.divergence = simulation.divergence();
    seen.time = simulation.time();
    seen.steps = simulation.statistics().steps;
    seen.reported_overlap = simulation.statistics().max_overlap_over_height * greatest_height(model) / edge;
    return seen;
}

}  // namespace musim::lsdem::tests
