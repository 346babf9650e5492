#pragma once

#include <array>

#include "lsdem/model.hpp"

namespace musim::lsdem {

/// A property of a material, and what two sides that differ in it have together.
struct MaterialField {
    enum class Joint {
        in_series,  ///< springs of half a block each, 2ab/(a + b)
        smaller,
        larger
    };
    double Material::*member;
    Joint joint;
};

/// The properties of a material: its hash, joints and what scenes say of it follow this list, in its order.
inline constexpr std::array kMaterialFields{
    MaterialField{&Material::normal_stiffness, MaterialField::Joint::in_series},
    MaterialField{&Material::shear_stiffness, MaterialField::Joint::in_series},
    MaterialField{&Material::friction, MaterialField::Joint::smaller},
    MaterialField{&Material::restitution, MaterialField::Joint::smaller},
    MaterialField{&Material::shear_damping_ratio, MaterialField::Joint::larger},
};
static_assert(sizeof(Material) == kMaterialFields.size() * sizeof(double), "a member of Material is missing in its list");

}  // namespace musim::lsdem
