#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/scene/detail/json_text.hpp"
#include "lsdem/scene/detail/scene_fields.hpp"

/// Parts of a scene from and to JSON. Those that read throw SceneError; files that a part names stand beside `origin`.
namespace musim::lsdem::detail {

/// The block whose base has the stiffnesses of a scene.
struct StiffnessBase {
    scaling::Area area{};           ///< of that base
    scaling::Length height{};       ///< of the block
    bool presets_keep_own = false;  ///< do stiffnesses of a preset belong to the base of its own block, and per area stay what they are?
};

/// Finds the base of a scene when it is first needed: a shape may have to be read from a file for it, and stiffnesses in N/m need none.
class FindStiffnessBase {
  public:
    explicit FindStiffnessBase(const Scene& scene) : scene_(&scene) {}
    explicit FindStiffnessBase(const StiffnessBase& known) : found_(known) {}

    const StiffnessBase& operator()() const;

  private:
    const Scene* scene_ = nullptr;
    mutable std::optional<StiffnessBase> found_;
};

/// "material": the name of a preset, or its properties. Stiffnesses per area become those of the base.
BlockMaterial parse_material(const scaling::JsonReader& value, const FindStiffnessBase& base);
/// "pairs", of materials.
std::vector<PairEntry> parse_pairs(const scaling::JsonReader& list, const FindStiffnessBase& base);
/// "shape".
ShapeSettings parse_shape(const scaling::JsonReader& value);
/// "shapes", by name.
std::map<std::string, ShapeEntry> parse_shapes(const scaling::JsonReader& value, const std::filesystem::path& origin);
/// "structure". `needs_size`: blocks that name no shape say their size, as all but spheres do.
Structure parse_structure(const scaling::JsonReader& value, const std::filesystem::path& origin, bool needs_size);
/// "structures", several.
Assembly parse_structures(const scaling::JsonReader& list, const std::filesystem::path& origin, bool needs_size);
/// "scatter".
Scatter parse_scatter(const scaling::JsonReader& value);
/// "loads".
std::vector<LoadEntry> parse_loads(const scaling::JsonReader& list);
/// "base_motion".
SceneMotion parse_base_motion(const scaling::JsonReader& value, const std::filesystem::path& origin);
SceneMotion parse_tilt(const scaling::JsonReader& value);
/// "motions", one after another.
std::vector<MotionEntry> parse_motions(const scaling::JsonReader& list, const std::filesystem::path& origin);
/// "sensors".
std::vector<SensorEntry> parse_sensors(const scaling::JsonReader& list);

template <class Value>
void read_value(const scaling::JsonReader& json, Value& value) {
    value = json.as<Value>();
}
void read_value(const scaling::JsonReader& json, TilingSettings& tiling);
void read_value(const scaling::JsonReader& json, std::vector<WallOpening>& openings);
void read_value(const scaling::JsonReader& json, WallLintel& lintel);
void read_value(const scaling::JsonReader& json, WallLeaves& leaves);
void read_value(const scaling::JsonReader& json, WallReturns& returns);
void read_value(const scaling::JsonReader& json, std::array<double, 4>& quaternion);
void read_value(const scaling::JsonReader& json, records::SampleQuantity& quantity);
void read_value(const scaling::JsonReader& json, records::ColumnChoices& columns);
void read_value(const scaling::JsonReader& json, records::AtRest& at_rest);
void read_value(const scaling::JsonReader& json, std::array<scaling::Time, 2>& window);
void read_value(const scaling::JsonReader& json, ShapeAxis& axis);
void read_value(const scaling::JsonReader& json, Held& held);
/// Three factors, or one for all.
void read_value(const scaling::JsonReader& json, std::array<double, 3>& scale);
void read_value(const scaling::JsonReader& json, ChosenPart& part);
void read_value(const scaling::JsonReader& json, std::vector<std::array<scaling::Length, 2>>& outline);
void read_value(const scaling::JsonReader& json, std::vector<Triple<scaling::Length>>& points);
void read_value(const scaling::JsonReader& json, std::vector<std::vector<std::uint32_t>>& faces);
void read_value(const scaling::JsonReader& json, std::array<Triple<scaling::Inertia>, 3>& tensor);
void read_value(const scaling::JsonReader& json, std::vector<std::string>& names);
void read_value(const scaling::JsonReader& json, SensorAxes& axes);
/// "none" is nothing.
void read_value(const scaling::JsonReader& json, std::optional<SensorFilter>& filter);
template <class Value>
void read_value(const scaling::JsonReader& json, std::optional<Value>& value) {
    read_value(json, value.emplace());
}

/// Reads the fields of a part; of one that is not `complete`, because a preset gives the rest, none is required.
template <class Part>
void read_fields(const scaling::JsonReader& object, Part& part, bool complete = true) {
    for_each_field(part, [&](const auto& field, auto& value) {
        if (object.has(field.key) || (field.required && complete)) read_value(object[field.key], value);
    });
}

/// Style of quantities in JSON: as SI numbers, which come back bit for bit, or as texts with units for people, to seven digits.
enum class QuantityStyle { si_number, text };

/// A scene as JSON, all settings written out.
nlohmann::ordered_json to_json(const Scene& scene, QuantityStyle style);

}  // namespace musim::lsdem::detail
