#include "lsdem/calibration/block_sample.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace musim::lsdem {
namespace {

void require_positive(double value, const char* what) {
    if (!(value > 0.0) || !std::isfinite(value))
        throw std::invalid_argument(fmt::format("block: the {} is {} (must be positive); correct it", what, value));
}

}  // namespace

BlockSample make_sample(const MaterialPreset& preset) {
    const BlockMaterial& m = preset.material;
    const auto& block = preset.reference_block;
    return {.size = {block[0].value(), block[1].value(), block[2].value()},
            .density = m.density.value(),
            .normal_stiffness = m.normal_stiffness.value(),
            .shear_stiffness = m.shear_stiffness.value(),
            .friction = m.friction,
            .ground_friction = m.friction,
            .restitution = m.restitution,
            .shear_damping_ratio = m.shear_damping_ratio,
            .gravity = scaling::kStandardGravity.value()};
}

BlockSample turned(BlockSample sample) {
    std::swap(sample.size.x(), sample.size.y());
    return sample;
}

Model make_model(const BlockSample& sample) {
    for (const double edge : sample.size) require_positive(edge, "edge length");
    require_positive(sample.density, "density");
    require_positive(sample.normal_stiffness, "normal stiffness");
    require_positive(sample.shear_stiffness, "shear stiffness");
    require_positive(sample.gravity, "gravity");
    if (!(sample.restitution > 0.0) || sample.restitution > 1.0)
        throw std::invalid_argument(fmt::format("block: the restitution is {} (must be in (0, 1]); correct it", sample.restitution));
    if (!(sample.friction >= 0.0) || !(sample.ground_friction >= 0.0))
        throw std::invalid_argument("block: a friction coefficient is negative; correct it");

    Model model;
    model.shapes.push_back(make_box_shape(sample.size, {2, 2, 2}));
    model.materials.push_back(
        {sample.normal_pressure(), sample.shear_pressure(), sample.friction, sample.restitution, sample.shear_damping_ratio});
    model.ground.material = model.materials.front();
    model.ground.material.friction = sample.ground_friction;
    model.pairs.push_back({.first = 0, .second = {}, .joint = model.ground.material});
    model.gravity = {0.0, 0.0, -sample.gravity};
    return model;
}

Block make_block(const BlockSample& sample, const Vector3& position, const Quaternion& orientation) {
    Block block;
    block.mass = sample.mass();
    block.position = position;
    block.orientation = orientation;
    return block;
}

}  // namespace musim::lsdem
