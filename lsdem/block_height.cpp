#include "lsdem/block_height.hpp"

#include <set>

#include "lsdem/detail/shape_parts.hpp"

namespace musim::lsdem {
namespace {

/// Masses of one shape that agree to this part are the same block but for its height: far above rounding, far below any real difference.
constexpr double kSameMass = 1e-9;

}  // namespace

Vector3 half_extents(const Model& model, const Block& block) {
    Vector3 half = model.shapes[block.shape].half_extents;
    half.z() += 0.5 * block.height_offset;
    return half;
}

double height_strain(const Model& model, const Block& block) {
    return block.height_offset / (2.0 * model.shapes[block.shape].half_extents.z());
}

Vector3 inertia_over_mass(const Model& model, const Block& block) {
    if (block.height_offset == 0.0) return model.shapes[block.shape].inertia_over_mass;
    return detail::box_inertia_over_mass(2.0 * half_extents(model, block));
}

std::vector<double> compute_nominal_masses(const Model& model) {
    std::vector<double> masses;
    std::vector<std::set<double>> known(model.shapes.size());
    masses.reserve(model.blocks.size());
    // blocks of the shape's own height keep their mass to the last bit, and others join them
    for (const Block& block : model.blocks) {
        masses.push_back(block.mass);
        if (block.height_offset == 0.0) known[block.shape].insert(block.mass);
    }
    for (std::size_t i = 0; i < masses.size(); ++i) {
        const Block& block = model.blocks[i];
        if (block.height_offset == 0.0) continue;
        const double mass = block.mass / (1.0 + height_strain(model, block));
        const auto near = known[block.shape].lower_bound((1.0 - kSameMass) * mass);
        const bool found = near != known[block.shape].end() && *near <= (1.0 + kSameMass) * mass;
        masses[i] = found ? *near : *known[block.shape].insert(mass).first;
    }
    return masses;
}

BlockNodes nodes_of(const Model& model, const Block& block) { return {model.shapes[block.shape], height_strain(model, block)}; }

}  // namespace musim::lsdem
