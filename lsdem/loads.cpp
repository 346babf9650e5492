#include "lsdem/loads.hpp"

#include <algorithm>
#include <cmath>

#include "lsdem/block_height.hpp"
#include "lsdem/model.hpp"

namespace musim::lsdem {

double Load::part_at(double time) const { return std::clamp((time - start) / rise, 0.0, 1.0); }

double find_actuator_damping(const Model& model, const Load& load) {
    const Block& block = model.blocks[load.block];
    double per_mass = 1.0 / block.mass;
    if (!block.rotation_locked) {
        const Vector3 lever = load.point.cross(block.orientation.conjugate() * load.direction);
        per_mass += lever.cwiseAbs2().dot((block.mass * inertia_over_mass(model, block)).cwiseInverse());
    }
    return 2.0 * std::sqrt(load.stiffness / per_mass);
}

}  // namespace musim::lsdem
