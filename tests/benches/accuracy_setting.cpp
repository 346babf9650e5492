#include "tests/benches/accuracy_setting.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "lsdem/time_step.hpp"

namespace musim::lsdem {

Shape make_shape(const AccuracySetting& setting, const Vector3& size, const Vector3& whole) {
    const NodeLattice base = make_node_lattice(whole, setting.nodes_per_face);
    // the same spacing on another size
    const auto count = [](int nodes, double length, double of) {
        return std::max(2, 1 + static_cast<int>(std::lround((nodes - 1) * length / of)));
    };
    const NodeLattice lattice{count(base.nx, size.x(), whole.x()), count(base.ny, size.y(), whole.y()),
                              count(base.nz, size.z(), whole.z())};
    return setting.voxel > 0.0 ? make_grid_box_shape(size, lattice, setting.voxel * whole.minCoeff()) : make_box_shape(size, lattice);
}

void apply(const AccuracySetting& setting, Model& model) {
    model.numerics.face_contact = setting.faces;
    model.numerics.contact_nodes = setting.sides;
    model.numerics.skip_rest = false;
}

double read_thread_time() {
    std::timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

MeteredSimulation::MeteredSimulation(const Model& model, const AccuracySetting& setting)
    : MeteredSimulation(model, setting.safety * compute_critical_time_step(model)) {}

MeteredSimulation::MeteredSimulation(const Model& model, double time_step)
    : simulation_(model, time_step),
      moving_(static_cast<std::uint64_t>(std::count_if(model.blocks.begin(), model.blocks.end(), [](const Block& b) { return !b.fixed; }))),
      start_(read_thread_time()) {}

void MeteredSimulation::add_to(AccuracyOutcome& outcome) const {
    const std::uint64_t steps = simulation_.statistics().steps;
    outcome.steps += steps;
    outcome.block_steps += moving_ * steps;
    outcome.seconds += read_thread_time() - start_;
}

}  // namespace musim::lsdem
