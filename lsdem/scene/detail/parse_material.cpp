#include "lsdem/scene/detail/parse_material.hpp"

#include <string>

#include "lsdem/scene/detail/json_text.hpp"
#include "lsdem/scene/scene_error.hpp"

namespace musim::lsdem::detail {
namespace {

using scaling::JsonReader;

/// find_material_preset, with the place in front of its message.
const BlockMaterial& find_preset(const JsonReader& value) {
    const std::string name = value.text();
    try {
        return find_material_preset(name).material;
    } catch (const SceneError& error) {
        value.fail(error.what());
    }
}

}  // namespace

BlockMaterial parse_material(const JsonReader& value) {
    if (value.json().is_string()) return find_preset(value);
    const JsonReader object = to_object(value, "material");
    BlockMaterial material;
    if (object.has("preset")) {
        material = find_preset(object["preset"]);
        object.read("density", material.density);
        object.read("normal_stiffness", material.normal_stiffness);
        object.read("shear_stiffness", material.shear_stiffness);
        object.read("friction", material.friction);
        object.read("restitution", material.restitution);
    } else {
        material.density = object.get<scaling::Density>("density");
        material.normal_stiffness = object.get<scaling::Stiffness>("normal_stiffness");
        material.shear_stiffness = object.get<scaling::Stiffness>("shear_stiffness");
        material.friction = object.get<double>("friction");
        material.restitution = object.get<double>("restitution");
    }
    object.read("shear_damping_ratio", material.shear_damping_ratio);
    return material;
}

}  // namespace musim::lsdem::detail
