#include "lsdem/study/model_errors.hpp"

#include <array>
#include <cmath>

namespace musim::lsdem {
namespace {

/// Unit to which a tolerance of size 1 rounds, the same number of metres at every scale: the error itself.
constexpr double kToleranceUnit = 1e-3;

template <class Property>
void multiply_in_materials(Model& model, Property Material::*property, double factor) {
    for (Material& material : model.materials) material.*property *= factor;
    for (MaterialPair& pair : model.pairs) pair.joint.*property *= factor;
    model.ground.material.*property *= factor;
}

}  // namespace

std::string to_string(ModelError error) {
    constexpr std::array kNames{"normal_stiffness", "shear_stiffness", "friction",           "restitution",  "mass",
                                "gravity",          "record_step",     "absolute_tolerance", "lost_friction"};
    return kNames.at(static_cast<std::size_t>(error));
}

std::vector<ModelError> all_model_errors() {
    std::vector<ModelError> all;
    for (int i = 0; i <= static_cast<int>(ModelError::lost_friction); ++i) all.push_back(static_cast<ModelError>(i));
    return all;
}

void inject(ModelError error, double size, Model& model) {
    const double factor = 1.0 + size;
    switch (error) {
        case ModelError::normal_stiffness:
            return multiply_in_materials(model, &Material::normal_stiffness, factor);
        case ModelError::shear_stiffness:
            return multiply_in_materials(model, &Material::shear_stiffness, factor);
        case ModelError::friction:
            return multiply_in_materials(model, &Material::friction, factor);
        case ModelError::restitution:
            return multiply_in_materials(model, &Material::restitution, factor);
        case ModelError::mass:
            for (Block& block : model.blocks) block.mass *= factor;
            return;
        case ModelError::gravity:
            model.gravity *= factor;
            return;
        case ModelError::record_step:
            for (BaseComponent& along : model.ground.motion.shift) along.dt *= factor;
            for (BaseComponent& about : model.ground.motion.turn) about.dt *= factor;
            return;
        case ModelError::absolute_tolerance:
            for (Block& block : model.blocks) {
                const double unit = size * kToleranceUnit;
                block.position = (block.position.array() / unit).round().matrix() * unit;
            }
            return;
        case ModelError::lost_friction:
            if (!model.preload.empty()) model.preload[model.preload.size() / 2].friction.setZero();
            return;
    }
}

}  // namespace musim::lsdem
