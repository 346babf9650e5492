#include "lsdem/scene/detail/parse_material.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "lsdem/scene/scene_error.hpp"

namespace musim::lsdem::scene::detail {
namespace {

/// find_material_preset, with the place in front of its message.
const BlockMaterial& find_preset(const std::string& name, const JsonPlace& place) {
    try {
        return find_material_preset(name).material;
    } catch (const SceneError& error) {
        fail(place, error.what());
    }
}

}  // namespace

BlockMaterial parse_material(const nlohmann::json& value, const JsonPlace& place) {
    if (value.is_string()) return find_preset(value.get<std::string>(), place);
    const JsonObject object(value, place, "material");
    BlockMaterial material;
    if (object.has("preset")) {
        material = find_preset(object.text("preset"), object.place("preset"));
        object.read_quantity("density", material.density);
        object.read_quantity("normal_stiffness", material.normal_stiffness);
        object.read_quantity("shear_stiffness", material.shear_stiffness);
        object.read("friction", material.friction);
        object.read("restitution", material.restitution);
    } else {
        material.density = object.quantity<scaling::Density>("density");
        material.normal_stiffness = object.quantity<scaling::Stiffness>("normal_stiffness");
        material.shear_stiffness = object.quantity<scaling::Stiffness>("shear_stiffness");
        material.friction = object.number("friction");
        material.restitution = object.number("restitution");
    }
    object.read("shear_damping_ratio", material.shear_damping_ratio);
    return material;
}

}  // namespace musim::lsdem::scene::detail
