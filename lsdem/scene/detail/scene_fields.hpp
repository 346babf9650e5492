#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "lsdem/material_fields.hpp"
#include "lsdem/scene/scene.hpp"
#include "scaling/json_reader.hpp"

/// Fields of the parts of a scene. One list of fields serves reading, writing, checking and scaling; what is unlike others stands in
/// the functions that do these.
namespace musim::lsdem::detail {

/// Range that a value has to be in; the last three are of whole numbers.
enum class Range { any, finite, positive, not_negative, one_or_more, three_or_more, four_or_more };

/// A member, its key in JSON, and what its value has to be. One that is not required keeps its default where the key is missing; an
/// optional without a value is not written.
template <class Part, class Value>
struct Field {
    const char* key;
    Value Part::*member;
    Range range = Range::any;
    bool required = false;
};
template <class Part, class Value>
Field(const char*, Value Part::*, Range = Range::any, bool = false) -> Field<Part, Value>;

inline constexpr bool kRequired = true;

/// The fields of a part, in the order in which they are written.
template <class Part>
inline constexpr auto kFields = std::tuple{};

/// A property of contact that materials have, and pairs of them may have as well; the kernel's, and what makes one of the other.
template <class Value>
struct ContactField {
    const char* key;
    Value BlockMaterial::*of_material;
    std::optional<Value> PairEntry::*of_pair;
    double Material::*lowered;
    Range range = Range::any;
    bool required = false;  ///< of materials

    constexpr auto field_of_material() const { return Field{key, of_material, range, required}; }
    constexpr auto field_of_pair() const { return Field{key, of_pair, range}; }
};

template <class Value>
ContactField(const char*, Value BlockMaterial::*, std::optional<Value> PairEntry::*, double Material::*, Range = Range::any, bool = false)
    -> ContactField<Value>;

/// In the order of kMaterialFields.
inline constexpr auto kContactFields = std::tuple{
    ContactField{"normal_stiffness", &BlockMaterial::normal_stiffness, &PairEntry::normal_stiffness, &Material::normal_stiffness,
                 Range::positive},
    ContactField{"shear_stiffness", &BlockMaterial::shear_stiffness, &PairEntry::shear_stiffness, &Material::shear_stiffness,
                 Range::positive},
    ContactField{"friction", &BlockMaterial::friction, &PairEntry::friction, &Material::friction, Range::not_negative, kRequired},
    ContactField{"restitution", &BlockMaterial::restitution, &PairEntry::restitution, &Material::restitution, Range::any, kRequired},
    ContactField{"shear_damping_ratio", &BlockMaterial::shear_damping_ratio, &PairEntry::shear_damping_ratio,
                 &Material::shear_damping_ratio, Range::not_negative},
};

/// Does every property of the kernel's material have its field, in the same order?
constexpr bool name_all_of_material() {
    return std::apply(
        [](const auto&... field) {
            std::size_t k = 0;
            return sizeof...(field) == kMaterialFields.size() && ((field.lowered == kMaterialFields[k++].member) && ...);
        },
        kContactFields);
}
static_assert(name_all_of_material(), "scenes have no field for a property of Material");

template <>
inline constexpr auto kFields<BlockMaterial> = std::apply(
    [](const auto&... field) {
        return std::tuple{Field{"density", &BlockMaterial::density, Range::positive, kRequired}, field.field_of_material()...};
    },
    kContactFields);
/// Behind its two names.
template <>
inline constexpr auto kFields<PairEntry> = std::apply([](const auto&... field) { return std::tuple{field.field_of_pair()...}; },
                                                      kContactFields);
template <>
inline constexpr auto kFields<BoxShape> = std::tuple{Field{"nodes_per_face", &BoxShape::nodes_per_face, Range::four_or_more}};
template <>
inline constexpr auto kFields<GridShape> = std::tuple{
    Field{"nodes_per_face", &GridShape::nodes_per_face, Range::four_or_more},
    Field{"voxel", &GridShape::voxel, Range::positive, kRequired},
};
template <>
inline constexpr auto kFields<SphereShape> = std::tuple{
    Field{"radius", &SphereShape::radius, Range::positive, kRequired},
    Field{"nodes", &SphereShape::nodes, Range::one_or_more},
    Field{"voxel", &SphereShape::voxel, Range::positive, kRequired},
};
template <>
inline constexpr auto kFields<BoxForm> = std::tuple{Field{"size", &BoxForm::size, Range::positive, kRequired}};
template <>
inline constexpr auto kFields<PrismForm> = std::tuple{
    Field{"outline", &PrismForm::outline, Range::finite, kRequired},
    Field{"axis", &PrismForm::axis},
    Field{"length", &PrismForm::length, Range::positive, kRequired},
    Field{"taper", &PrismForm::taper, Range::positive},
};
template <>
inline constexpr auto kFields<CylinderForm> = std::tuple{
    Field{"radius", &CylinderForm::radius, Range::positive, kRequired},
    Field{"height", &CylinderForm::height, Range::positive, kRequired},
    Field{"flats", &CylinderForm::flats, Range::three_or_more},
    Field{"top_radius", &CylinderForm::top_radius, Range::positive},
};
template <>
inline constexpr auto kFields<PolyhedronForm> = std::tuple{
    Field{"vertices", &PolyhedronForm::vertices, Range::finite, kRequired},
    Field{"faces", &PolyhedronForm::faces},
};
/// Behind the file.
template <>
inline constexpr auto kFields<MeshForm> = std::tuple{
    Field{"unit", &MeshForm::unit, Range::any, kRequired},
    Field{"part", &MeshForm::part},
};
template <>
inline constexpr auto kFields<CompoundPart> = std::tuple{
    Field{"shape", &CompoundPart::shape, Range::any, kRequired},
    Field{"position", &CompoundPart::position, Range::finite},
    Field{"quaternion", &CompoundPart::quaternion},
};
/// Behind the parts, or the file.
template <>
inline constexpr auto kFields<CompoundForm> = std::tuple{Field{"unit", &CompoundForm::unit}};
/// Behind those of its form; spheres have none of these.
template <>
inline constexpr auto kFields<ShapeEntry> = std::tuple{
    Field{"scale", &ShapeEntry::scale, Range::positive}, Field{"mirror", &ShapeEntry::mirror},
    Field{"quaternion", &ShapeEntry::quaternion},        Field{"mass", &ShapeEntry::mass, Range::positive},
    Field{"centre", &ShapeEntry::centre, Range::finite}, Field{"inertia", &ShapeEntry::inertia, Range::finite},
};
/// Between the size or the shape, and material and name.
template <>
inline constexpr auto kFields<BlockEntry> = std::tuple{
    Field{"position", &BlockEntry::position, Range::finite, kRequired},
    Field{"quaternion", &BlockEntry::quaternion},
    Field{"velocity", &BlockEntry::velocity, Range::finite},
    Field{"angular_velocity", &BlockEntry::angular_velocity, Range::finite},
    Field{"fixed", &BlockEntry::fixed},
    Field{"rotation_locked", &BlockEntry::rotation_locked},
    Field{"density", &BlockEntry::density, Range::positive},
};
template <>
inline constexpr auto kFields<Column> = std::tuple{
    Field{"layers", &Column::layers, Range::one_or_more},
    Field{"block", &Column::block, Range::positive, kRequired},
    Field{"rotation_locked", &Column::rotation_locked},
    Field{"height_deviation", &Column::height_deviation, Range::not_negative},
    Field{"seed", &Column::seed},
};
template <>
inline constexpr auto kFields<TilingSettings> = std::tuple{
    Field{"cells_across", &TilingSettings::cells_across},
    Field{"inner_radius", &TilingSettings::inner_radius},
    Field{"outer_radius", &TilingSettings::outer_radius},
};
template <>
inline constexpr auto kFields<Tower> = std::tuple{
    Field{"layers", &Tower::layers, Range::one_or_more},
    Field{"block", &Tower::block, Range::positive, kRequired},
    Field{"pitch", &Tower::pitch, Range::positive},
    Field{"tiling", &Tower::tiling},
    Field{"height_deviation", &Tower::height_deviation, Range::not_negative},
    Field{"seed", &Tower::seed},
};
template <>
inline constexpr auto kFields<WallOpening> = std::tuple{
    Field{"from", &WallOpening::from, Range::not_negative, kRequired},
    Field{"width", &WallOpening::width, Range::positive, kRequired},
    Field{"sill", &WallOpening::sill},
    Field{"courses", &WallOpening::courses, Range::one_or_more, kRequired},
};
/// Before its material.
template <>
inline constexpr auto kFields<WallLintel> = std::tuple{Field{"bearing", &WallLintel::bearing, Range::positive}};
template <>
inline constexpr auto kFields<WallLeaves> = std::tuple{
    Field{"gap", &WallLeaves::gap, Range::not_negative, kRequired},
    Field{"headers_every", &WallLeaves::headers_every},
};
template <>
inline constexpr auto kFields<WallReturns> = std::tuple{Field{"left", &WallReturns::left}, Field{"right", &WallReturns::right}};
template <>
inline constexpr auto kFields<Wall> = std::tuple{
    Field{"layers", &Wall::layers, Range::one_or_more},
    Field{"blocks_per_layer", &Wall::blocks_per_layer, Range::one_or_more},
    Field{"block", &Wall::block, Range::positive, kRequired},
    Field{"pitch", &Wall::pitch, Range::positive},
    Field{"openings", &Wall::openings},
    Field{"lintel", &Wall::lintel},
    Field{"leaves", &Wall::leaves},
    Field{"returns", &Wall::returns},
    Field{"height_deviation", &Wall::height_deviation, Range::not_negative},
    Field{"seed", &Wall::seed},
};
template <>
inline constexpr auto kFields<ShapeColumn> = std::tuple{Field{"blocks", &ShapeColumn::blocks, Range::any, kRequired}};
template <>
inline constexpr auto kFields<Arch> = std::tuple{
    Field{"radius", &Arch::radius, Range::positive, kRequired},
    Field{"thickness", &Arch::thickness, Range::positive, kRequired},
    Field{"depth", &Arch::depth, Range::positive, kRequired},
    Field{"embrace", &Arch::embrace, Range::positive, kRequired},
    Field{"voussoirs", &Arch::voussoirs, Range::one_or_more, kRequired},
    Field{"abutments", &Arch::abutments},
};
/// Behind those of the structure.
template <>
inline constexpr auto kFields<PlacedStructure> = std::tuple{
    Field{"place", &PlacedStructure::place, Range::finite},
    Field{"turn", &PlacedStructure::turn, Range::finite},
};
template <>
inline constexpr auto kFields<Scatter> = std::tuple{
    Field{"size", &Scatter::size, Range::not_negative},
    Field{"place", &Scatter::place, Range::not_negative},
    Field{"friction", &Scatter::friction, Range::not_negative},
    Field{"seed", &Scatter::seed},
};
/// Between the record with its components, and the files of its response and its scale.
template <>
inline constexpr auto kFields<RecordMotion> = std::tuple{
    Field{"unit", &RecordMotion::unit},
    Field{"quantity", &RecordMotion::quantity},
    Field{"dt", &RecordMotion::dt, Range::positive},
    Field{"sensitivity", &RecordMotion::sensitivity, Range::positive},
    Field{"columns", &RecordMotion::columns},
    Field{"skip", &RecordMotion::skip},
    Field{"window", &RecordMotion::window},
    Field{"highpass", &RecordMotion::highpass_corner, Range::positive},
    Field{"at_rest", &RecordMotion::at_rest},
    Field{"apparent_velocity", &RecordMotion::apparent_velocity, Range::positive},
};
template <>
inline constexpr auto kFields<StepSignal> = std::tuple{Field{"velocity", &StepSignal::velocity, Range::finite, kRequired}};
template <>
inline constexpr auto kFields<SineSignal> = std::tuple{
    Field{"amplitude", &SineSignal::amplitude, Range::finite, kRequired},
    Field{"frequency", &SineSignal::frequency, Range::positive, kRequired},
    Field{"cycles", &SineSignal::cycles, Range::positive, kRequired},
};
template <>
inline constexpr auto kFields<HalfSineSignal> = std::tuple{
    Field{"amplitude", &HalfSineSignal::amplitude, Range::finite, kRequired},
    Field{"duration", &HalfSineSignal::duration, Range::positive, kRequired},
};
template <>
inline constexpr auto kFields<RickerSignal> = std::tuple{
    Field{"amplitude", &RickerSignal::amplitude, Range::finite, kRequired},
    Field{"frequency", &RickerSignal::frequency, Range::positive, kRequired},
};
template <>
inline constexpr auto kFields<SyntheticSignal> = std::tuple{
    Field{"pga", &SyntheticSignal::pga, Range::positive, kRequired},
    Field{"pgv", &SyntheticSignal::pgv, Range::positive, kRequired},
    Field{"duration", &SyntheticSignal::duration, Range::positive, kRequired},
    Field{"dt", &SyntheticSignal::dt, Range::positive, kRequired},
    Field{"seed", &SyntheticSignal::seed},
};
template <>
inline constexpr auto kFields<RockingSignal> = std::tuple{
    Field{"angle", &RockingSignal::angle, Range::positive, kRequired},
    Field{"frequency", &RockingSignal::frequency, Range::positive, kRequired},
    Field{"cycles", &RockingSignal::cycles, Range::positive, kRequired},
};
/// Behind its axis.
template <>
inline constexpr auto kFields<TiltMotion> = std::tuple{
    Field{"rate", &TiltMotion::rate, Range::positive, kRequired},
    Field{"until", &TiltMotion::until, Range::positive},
};
/// Behind those of the source.
template <>
inline constexpr auto kFields<SceneMotion> = std::tuple{Field{"pivot", &SceneMotion::pivot, Range::finite}};
/// Behind those of the signal and its direction.
template <>
inline constexpr auto kFields<SignalMotion> = std::tuple{
    Field{"start", &SignalMotion::start, Range::not_negative},
    Field{"dt", &SignalMotion::dt, Range::positive},
};
template <>
inline constexpr auto kFields<MotionFactors> = std::tuple{
    Field{"time", &MotionFactors::time, Range::positive},
    Field{"velocity", &MotionFactors::velocity, Range::positive},
    Field{"velocity_vertical", &MotionFactors::velocity_vertical, Range::positive},
};
/// Behind its name and motion.
template <>
inline constexpr auto kFields<MotionEntry> = std::tuple{
    Field{"duration", &MotionEntry::duration, Range::positive},
    Field{"settle", &MotionEntry::settle},
    Field{"repeat", &MotionEntry::repeat},
};
/// Behind its name and block.
template <>
inline constexpr auto kFields<LoadEntry> = std::tuple{
    Field{"point", &LoadEntry::point, Range::finite},
    Field{"force", &LoadEntry::force, Range::finite},
    Field{"displacement", &LoadEntry::displacement, Range::finite},
    Field{"stiffness", &LoadEntry::stiffness, Range::positive},
    Field{"start", &LoadEntry::start, Range::not_negative},
    Field{"rise", &LoadEntry::rise, Range::positive, kRequired},
};
template <>
inline constexpr auto kFields<GroundSettings> = std::tuple{
    Field{"present", &GroundSettings::present},
    Field{"friction", &GroundSettings::friction, Range::not_negative},
};
template <>
inline constexpr auto kFields<OutputSettings> = std::tuple{
    Field{"spine_rate", &OutputSettings::spine_rate, Range::not_negative},
    Field{"frame_rate", &OutputSettings::frame_rate, Range::positive},
};
template <>
inline constexpr auto kFields<SensorFilter> = std::tuple{
    Field{"corner", &SensorFilter::corner, Range::positive},
    Field{"order", &SensorFilter::order, Range::one_or_more},
};
/// Behind its name, kind and bodies; before the normal of a joint.
template <>
inline constexpr auto kFields<SensorEntry> = std::tuple{
    Field{"point", &SensorEntry::point, Range::finite},
    Field{"axes", &SensorEntry::axes},
    Field{"quaternion", &SensorEntry::quaternion},
    Field{"relative", &SensorEntry::relative},
    Field{"gravity", &SensorEntry::gravity},
    Field{"rate", &SensorEntry::rate, Range::positive, kRequired},
    Field{"filter", &SensorEntry::filter},
};

/// Has a part fields of its own?
template <class Part>
inline constexpr bool kHasFields = std::tuple_size_v<std::remove_const_t<decltype(kFields<Part>)>> > 0;

/// Calls `visit(field, value)` for every field of a part.
template <class Part, class Visit>
void for_each_field(Part& part, const Visit& visit) {
    std::apply([&](const auto&... field) { (visit(field, part.*field.member), ...); }, kFields<std::remove_const_t<Part>>);
}

/// Names of variants in JSON, in their order.
inline constexpr std::array kStructureKinds{"blocks", "column", "tower", "wall", "column", "arch"};
/// Their keys, as the schema calls them.
inline constexpr std::array kStructureKeys{"blocks", "column", "tower", "wall", "shape_column", "arch"};
inline constexpr std::array kShapeKinds{"box", "prism", "cylinder", "polyhedron", "mesh", "compound", "sphere"};
inline constexpr std::array kShapeAxes{"x", "y", "z"};
inline constexpr std::array kSignalKinds{"step", "sine", "half_sine", "ricker", "synthetic", "rocking"};

/// The alternative of a variant at a position, with its defaults.
template <class Variant, std::size_t... I>
Variant make_alternative(std::size_t index, std::index_sequence<I...> /*all*/) {
    Variant variant;
    ((I == index ? void(variant.template emplace<I>()) : void()), ...);
    return variant;
}
template <class Variant>
Variant make_alternative(std::size_t index) {
    return make_alternative<Variant>(index, std::make_index_sequence<std::variant_size_v<Variant>>());
}

}  // namespace musim::lsdem::detail
