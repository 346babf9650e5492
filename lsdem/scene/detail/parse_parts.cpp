#include <fmt/format.h>

#include <cmath>

#include "lsdem/scene/detail/block_table.hpp"
#include "lsdem/scene/detail/scene_parts.hpp"
#include "lsdem/scene/reference_block.hpp"
#include "lsdem/scene/scene_key.hpp"
#include "records/error.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"

namespace musim::lsdem::detail {
namespace {

using scaling::JsonReader;

/// find_material_preset, with the place in front of its message.
const MaterialPreset& find_preset(const JsonReader& value) {
    const std::string name = value.text();
    try {
        return find_material_preset(name);
    } catch (const SceneError& error) {
        value.fail(error.what());
    }
}

/// A preset with the stiffnesses of the base; of a stone those of the solid in that block.
BlockMaterial parse_preset(const JsonReader& value, const FindStiffnessBase& find_base) {
    const MaterialPreset& preset = find_preset(value);
    BlockMaterial material = preset.material;
    if (preset.is_stone() || find_base().presets_keep_own) {
        double ratio = find_base().area / (preset.reference_block[0] * preset.reference_block[1]);
        if (preset.is_stone()) ratio *= preset.reference_block[2] / find_base().height;
        material.normal_stiffness *= ratio;
        material.shear_stiffness *= ratio;
    }
    return material;
}

/// Reads what a stiffness per area is over the base, where there is one.
template <class Value>
void read_per_area(const JsonReader& object, const std::string& key, const FindStiffnessBase& find_base, Value& stiffness) {
    const std::string per_area = key + "_per_area";
    if (!object.has(per_area)) return;
    const JsonReader value = object[per_area];
    if (object.has(key)) value.fail(fmt::format("\"{}\" is given as well (either says how stiff it is); leave one of the two out", key));
    const auto given = value.quantity<scaling::StiffnessPerArea>();
    if (!(given.value() > 0.0) || !std::isfinite(given.value()))
        value.fail(fmt::format("{:.6g} Pa/m (must be positive); correct the value", given.value()));
    stiffness = scaling::Stiffness::from_value(given.value() * find_base().area.value());
}

BlockEntry parse_block(const JsonReader& value, bool needs_size) {
    const JsonReader object = to_object(value, "block");
    BlockEntry block;
    object.read("shape", block.shape);
    if (!block.shape.empty() && object.has("size")) {
        object["size"].fail("the block names a \"shape\", which has its size; leave one of the two out");
    }
    if ((needs_size && block.shape.empty()) || object.has("size")) block.size = object.get<Triple<scaling::Length>>("size");
    read_fields(object, block);
    // another way to write it
    if (object.find<bool>("with_base").value_or(false)) block.fixed = Held::with_base;
    object.read("material", block.material);
    object.read("name", block.name);
    return block;
}

/// Blocks of the list, then those of the table.
BlockList parse_block_list(const JsonReader& object, const std::filesystem::path& origin, bool needs_size) {
    BlockList list;
    const bool has_table = object.has("file");
    if (object.has("blocks") || !has_table) {
        const JsonReader entries = object["blocks"];
        if (!entries.json().is_array()) entries.fail("a list [ ... ] of blocks is wanted; correct the value");
        for (const JsonReader& entry : entries.entries()) list.blocks.push_back(parse_block(entry, needs_size));
    }
    if (!has_table) {
        if (object.has("unit")) object["unit"].fail("it is that of a \"file\", and there is none; leave it out");
        return list;
    }
    const std::filesystem::path file = resolve(object.get<std::string>("file"), origin);
    const SceneRules rules;
    for (const BlockRow& row : read_block_table(file, object.find<std::string>("unit"))) {
        const JsonReader entry(row.entry, rules, fmt::format("{}:{}: /", file.string(), row.line));
        list.blocks.push_back(parse_block(entry, needs_size));
    }
    return list;
}

RecordScale parse_record_scale(const JsonReader& value, const std::filesystem::path& origin) {
    const JsonReader object = to_object(value, "scale");
    RecordScale scale;
    object.read("law", scale.law);
    for (const scaling::ChosenScale& chosen : scaling::kChosenScales) {
        if (object.has(chosen.name)) object.read(chosen.name, scale.set[chosen.quantity]);
    }
    if (object.has("set")) {
        const JsonReader set = object["set"];
        if (!set.json().is_object()) set.fail(R"(an object of factors is wanted; write {"F_R": "1/500"})");
        for (const auto& [name, unused] : set.json().items()) {
            const JsonReader factor = set.at(name);
            if (!scale.set.emplace(name, factor.number()).second) factor.fail("the factor is given twice; give it once");
        }
    }
    if (scaling::find_scale_law(scale.law)) return scale;
    if (scale.law.find_first_of("./") == std::string::npos) object.at("law").fail(scaling::no_such_law(scale.law) + ", or a law file");
    scale.law = resolve(scale.law, origin).string();
    return scale;
}

RecordMotion parse_record(const JsonReader& object, const std::filesystem::path& origin) {
    RecordMotion motion;
    motion.file = resolve(object.get<std::string>("record"), origin);
    const JsonReader components = to_object(object["components"], "components");
    for (std::size_t axis = 0; axis < kMotionAxes.size(); ++axis) motion.components[axis] = components.find<std::string>(kMotionAxes[axis]);
    read_fields(object, motion);
    if (object.has("station_xml")) motion.station_xml = resolve(object.get<std::string>("station_xml"), origin);
    if (object.has("scale")) motion.scale = parse_record_scale(object["scale"], origin);
    return motion;
}

SignalMotion parse_signal(const JsonReader& value) {
    const std::size_t kind = read_kind(value, "signal", {kSignalKinds.begin(), kSignalKinds.end()});
    const JsonReader object = to_object(value, kSignalKinds[kind]);
    SignalMotion motion{.signal = make_alternative<Signal>(kind), .dt = {}};
    std::visit([&](auto& signal) { read_fields(object, signal); }, motion.signal);
    const bool turns = std::holds_alternative<RockingSignal>(motion.signal);
    motion.axis = turns ? 4 : 0;
    if (object.has("direction")) {
        const auto* const first = kMotionAxes.begin() + (turns ? 3 : 0);
        motion.axis = to_choice(object["direction"], {first, first + 3}) + (turns ? 3 : 0);
    }
    read_fields(object, motion);
    // the time step of a synthetic record is its own
    if (std::holds_alternative<SyntheticSignal>(motion.signal)) motion.dt.reset();
    return motion;
}

}  // namespace

void read_value(const JsonReader& json, std::array<double, 4>& quaternion) {
    if (!json.json().is_array() || json.json().size() != 4) json.fail("four numbers (w, x, y, z) are wanted; correct the list");
    for (std::size_t k = 0; k < 4; ++k) quaternion[k] = json.entries()[k].number();
}

void read_value(const JsonReader& json, TilingSettings& tiling) {
    if (!json.json().is_string()) return read_fields(to_object(json, "tiling"), tiling);
    try {
        tiling = find_tiling_preset(json.text());
    } catch (const SceneError& error) {
        json.fail(error.what());
    }
}

void read_value(const JsonReader& json, std::vector<WallOpening>& openings) {
    if (!json.json().is_array()) json.fail("a list [ ... ] of openings is wanted; correct the value");
    for (const JsonReader& entry : json.entries()) read_fields(to_object(entry, "opening"), openings.emplace_back());
}

void read_value(const JsonReader& json, WallLintel& lintel) {
    const JsonReader object = to_object(json, "lintel");
    read_fields(object, lintel);
    object.read("material", lintel.material);
}

void read_value(const JsonReader& json, WallLeaves& leaves) { read_fields(to_object(json, "leaves"), leaves); }

void read_value(const JsonReader& json, WallReturns& returns) { read_fields(to_object(json, "returns"), returns); }

void read_value(const JsonReader& json, records::SampleQuantity& quantity) {
    const std::vector<std::string> names{"acceleration", "velocity", "displacement", "angular acceleration", "angular velocity", "angle"};
    quantity = *records::find_sample_quantity(names[to_choice(json, names)]);
}

void read_value(const JsonReader& json, records::ColumnChoices& columns) {
    try {
        if (json.json().is_string()) {
            columns = records::parse_column_choices(json.text());
            return;
        }
        if (!json.json().is_object()) json.fail(R"(names with their columns are wanted; write {"time": 2, "x": 3})");
        columns.clear();
        for (const auto& [name, unused] : json.json().items()) {
            const JsonReader column = json.at(name);
            const bool is_title = column.json().is_string();
            columns.push_back({name, is_title ? column.text() : std::to_string(column.as<std::size_t>())});
        }
        records::check_column_choices(columns);
    } catch (const records::ReadError& error) {
        json.fail(error.worded(scene_key));
    }
}

void read_value(const JsonReader& json, records::AtRest& at_rest) {
    if (json.json().is_boolean()) {
        at_rest = json.json().get<bool>() ? records::AtRest::home : records::AtRest::as_given;
    } else if (json.json() == "displaced") {
        at_rest = records::AtRest::displaced;
    } else {
        json.fail("true (ends at rest where it began), \"displaced\" (at rest elsewhere) or false (as given) is wanted; write one of them");
    }
}

void read_value(const JsonReader& json, Held& held) {
    if (json.json().is_boolean()) {
        held = json.json().get<bool>() ? Held::in_place : Held::free;
    } else if (json.json() == "base") {
        held = Held::with_base;
    } else {
        json.fail("true (held in place), \"base\" (held to the base, with which it moves) or false is wanted; write one of them");
    }
}

void read_value(const JsonReader& json, std::array<scaling::Time, 2>& window) {
    if (!json.json().is_array() || json.json().size() != 2) json.fail("a list of two times is wanted; write [\"225 s\", \"265 s\"]");
    const std::vector<JsonReader> times = json.entries();
    window = {times[0].quantity<scaling::Time>(), times[1].quantity<scaling::Time>()};
}

const StiffnessBase& FindStiffnessBase::operator()() const {
    if (!found_) found_ = StiffnessBase{reference_area(*scene_), reference_block(*scene_)[2], has_several_bases(*scene_)};
    return *found_;
}

BlockMaterial parse_material(const JsonReader& value, const FindStiffnessBase& find_base) {
    if (value.json().is_string()) return parse_preset(value, find_base);
    const JsonReader object = to_object(value, "material");
    const bool has_preset = object.has("preset");
    BlockMaterial material = has_preset ? parse_preset(object["preset"], find_base) : BlockMaterial{};
    read_fields(object, material, !has_preset);
    read_per_area(object, "normal_stiffness", find_base, material.normal_stiffness);
    read_per_area(object, "shear_stiffness", find_base, material.shear_stiffness);
    for (const char* key : {"normal_stiffness", "shear_stiffness"}) {
        if (!has_preset && !object.has(std::string(key) + "_per_area")) object[key];  // which says what is missing
    }
    return material;
}

std::vector<PairEntry> parse_pairs(const JsonReader& list, const FindStiffnessBase& find_base) {
    if (!list.json().is_array()) list.fail("a list [ ... ] of pairs is wanted; correct the value");
    std::vector<PairEntry> pairs;
    for (const JsonReader& value : list.entries()) {
        const JsonReader object = to_object(value, "pair");
        const JsonReader names = object["of"];
        if (!names.json().is_array() || names.json().size() != 2) names.fail("two names of materials are wanted; correct the list");
        PairEntry& pair = pairs.emplace_back();
        for (std::size_t k = 0; k < 2; ++k) pair.of[k] = names.entries()[k].text();
        read_fields(object, pair);
        read_per_area(object, "normal_stiffness", find_base, pair.normal_stiffness);
        read_per_area(object, "shear_stiffness", find_base, pair.shear_stiffness);
    }
    return pairs;
}

ShapeSettings parse_shape(const JsonReader& value) {
    const JsonReader object = to_object(value, "shape");
    const bool sphere = to_choice(object["kind"], {"box", "sphere"}) == 1;
    const bool grid = !sphere && object.has("level_set") && to_choice(object["level_set"], {"box", "grid"}) == 1;
    ShapeSettings shape = BoxShape{};
    if (grid) shape = GridShape{};
    if (sphere) shape = SphereShape{};
    std::visit([&](auto& settings) { read_fields(object, settings); }, shape);
    return shape;
}

PlacedStructure parse_placed_structure(const JsonReader& value, const std::filesystem::path& origin, bool needs_size) {
    // a column of shapes is of the kind "column" as well
    std::size_t kind = read_kind(value, "kind", {"blocks", "column", "tower", "wall", "arch"});
    if (kind == 4) kind = 5;
    if (kind == 1 && value.json().contains("blocks")) kind = 4;
    const JsonReader object = to_object(value, kStructureKeys[kind]);
    PlacedStructure placed;
    auto& structure = placed.structure = make_alternative<OneStructure>(kind);
    if (auto* list = std::get_if<BlockList>(&structure)) *list = parse_block_list(object, origin, needs_size);
    std::visit([&](auto& settings) { read_fields(object, settings); }, structure);
    if (auto* tower = std::get_if<Tower>(&structure)) {
        object.read("shape", tower->shape);
        const bool has_file = object.has("tiling") && object["tiling"].json().is_object() && object["tiling"].has("file");
        if (has_file) tower->tiling_file = resolve(object["tiling"].get<std::string>("file"), origin);
    }
    object.read("name", placed.name);
    read_fields(object, placed);
    return placed;
}

Structure parse_structure(const JsonReader& value, const std::filesystem::path& origin, bool needs_size) {
    PlacedStructure placed = parse_placed_structure(value, origin, needs_size);
    const Json& json = value.json();
    if (json.contains("name") || json.contains("place") || json.contains("turn")) return Assembly{{std::move(placed)}};
    return std::visit([](auto& structure) -> Structure { return std::move(structure); }, placed.structure);
}

Assembly parse_structures(const JsonReader& list, const std::filesystem::path& origin, bool needs_size) {
    if (!list.json().is_array() || list.json().empty()) {
        list.fail("a list [ ... ] of structures is wanted; write at least one, or \"structure\" instead");
    }
    Assembly assembly;
    for (const JsonReader& value : list.entries()) assembly.structures.push_back(parse_placed_structure(value, origin, needs_size));
    return assembly;
}

Scatter parse_scatter(const JsonReader& value) {
    Scatter scatter;
    read_fields(to_object(value, "scatter"), scatter);
    return scatter;
}

std::vector<LoadEntry> parse_loads(const JsonReader& list) {
    if (!list.json().is_array()) list.fail("a list [ ... ] of loads is wanted; correct the value");
    std::vector<LoadEntry> loads;
    for (const JsonReader& value : list.entries()) {
        const JsonReader object = to_object(value, "load");
        LoadEntry& load = loads.emplace_back();
        object.read("name", load.name);
        const JsonReader block = object["block"];
        load.block = block.json().is_string() ? block.text() : std::to_string(block.as<std::size_t>());
        read_fields(object, load);
    }
    return loads;
}

namespace {

/// Keys that every motion may have besides those of its source.
void read_more(const JsonReader& value, SceneMotion& motion) {
    if (value.json().contains("pivot")) motion.pivot = value.get<Triple<scaling::Length>>("pivot");
    if (!value.json().contains("factors")) return;
    const JsonReader factors = to_object(value.at("factors"), "factors");
    read_fields(factors, motion.factors);
    if (!factors.has("velocity_vertical")) motion.factors.velocity_vertical = motion.factors.velocity;
}

}  // namespace

SceneMotion parse_base_motion(const JsonReader& value, const std::filesystem::path& origin) {
    const Json& json = value.json();
    SceneMotion motion;
    if (!json.is_object() || json.contains("record") == json.contains("signal")) {
        value.fail("an object with either a \"record\" or a \"signal\" is wanted; add one of them, or leave base_motion out");
    }
    if (json.contains("record")) {
        motion.source = parse_record(to_object(value, "record"), origin);
    } else {
        motion.source = parse_signal(value);
    }
    read_more(value, motion);
    return motion;
}

SceneMotion parse_tilt(const JsonReader& value) {
    const JsonReader object = to_object(value, "tilt");
    TiltMotion tilt;
    if (object.has("about")) tilt.about = to_choice(object["about"], {"x", "y"});
    read_fields(object, tilt);
    SceneMotion motion;
    motion.source = tilt;
    read_more(value, motion);
    return motion;
}

std::vector<MotionEntry> parse_motions(const JsonReader& list, const std::filesystem::path& origin) {
    if (!list.json().is_array() || list.json().empty()) {
        list.fail("a list [ ... ] of motions is wanted; write at least one, or \"base_motion\" instead");
    }
    std::vector<MotionEntry> motions;
    for (const JsonReader& value : list.entries()) {
        const JsonReader object = to_object(value, "motion");
        MotionEntry& entry = motions.emplace_back();
        object.read("name", entry.name);
        entry.base_motion = parse_base_motion(object["base_motion"], origin);
        read_fields(object, entry);
    }
    return motions;
}

}  // namespace musim::lsdem::detail
