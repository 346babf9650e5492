#include "lsdem/bodies.hpp"

#include "lsdem/block_height.hpp"

namespace musim::lsdem {

Bodies::Bodies(const Model& model) {
    const std::size_t n = model.blocks.size();
    for (auto* v : {&velocity, &momentum, &inverse_inertia}) v->resize(n, Vector3::Zero());
    pose.resize(n + 1);
    orientation.resize(n + 1, Quaternion::Identity());
    mass.resize(n);
    inverse_mass.resize(n);
    solid.resize(n + 1);
    fixed.resize(n + 1, 1);
    free.resize(n);
    preparation_loss.resize(n);
    start_position.resize(n + 1, Vector3::Zero());
    start_orientation.resize(n + 1, Quaternion::Identity());
    for (std::size_t i = 0; i < n; ++i) {
        const Block& block = model.blocks[i];
        const Vector3 inertia = block.mass * inertia_over_mass(model, block);
        pose[i].position = start_position[i] = block.position;
        orientation[i] = start_orientation[i] = block.orientation;
        pose[i].rotation = block.orientation.toRotationMatrix();
        mass[i] = block.mass;
        inverse_mass[i] = 1.0 / block.mass;
        pose[i].half = half_extents(model, block);
        pose[i].height_offset = block.height_offset;
        solid[i] = model.shapes[block.shape].solid.get();
        fixed[i] = block.fixed ? 1 : 0;
        free[i] = block.fixed ? 0.0 : 1.0;
        if (block.fixed) continue;
        velocity[i] = block.velocity;
        if (block.rotation_locked) continue;
        inverse_inertia[i] = inertia.cwiseInverse();
        momentum[i] = pose[i].rotation * inertia.cwiseProduct(pose[i].rotation.transpose() * block.angular_velocity);
    }
}

std::vector<Vector3> Bodies::positions() const {
    std::vector<Vector3> all;
    all.reserve(size());
    for (std::size_t i = 0; i < size(); ++i) all.push_back(pose[i].position);
    return all;
}

void Bodies::release(std::size_t i, const Model& model) {
    const Block& block = model.blocks[i];
    pose[i].position = start_position[i] = block.position;
    orientation[i] = start_orientation[i] = block.orientation;
    pose[i].rotation = block.orientation.toRotationMatrix();
    velocity[i] = block.velocity;
    momentum[i] = Vector3::Zero();
    fixed[i] = 0;
    free[i] = 1.0;
    if (!block.rotation_locked) inverse_inertia[i] = (block.mass * inertia_over_mass(model, block)).cwiseInverse();
}

}  // namespace musim::lsdem
