#include "lsdem/scene/detail/parse_structure.hpp"

#include "lsdem/scene/detail/json_text.hpp"
#include "lsdem/scene/tower_tiling.hpp"

namespace musim::lsdem::detail {

using scaling::JsonReader;

ShapeSettings parse_shape(const JsonReader& value) {
    const JsonReader object = to_object(value, "shape");
    const bool sphere = to_choice(object["kind"], {"box", "sphere"}) == 1;
    if (sphere) {
        SphereShape shape;
        shape.radius = object.get<scaling::Length>("radius");
        shape.voxel = object.get<scaling::Length>("voxel");
        object.read("nodes", shape.nodes);
        return shape;
    }
    BoxShape box;
    object.read("nodes_per_face", box.nodes_per_face);
    const bool grid = object.has("level_set") && to_choice(object["level_set"], {"box", "grid"}) == 1;
    if (!grid) return box;
    return GridShape{box.nodes_per_face, object.get<scaling::Length>("voxel")};
}

namespace {

BlockEntry parse_block(const JsonReader& value, bool needs_size) {
    const JsonReader object = to_object(value, "block");
    BlockEntry block;
    if (needs_size || object.has("size")) block.size = object.get<Triple<scaling::Length>>("size");
    block.position = object.get<Triple<scaling::Length>>("position");
    if (object.has("quaternion")) {
        const JsonReader list = object["quaternion"];
        if (!list.json().is_array() || list.json().size() != 4) list.fail("four numbers (w, x, y, z) are wanted; correct the list");
        for (std::size_t k = 0; k < 4; ++k) block.quaternion[k] = list.entries()[k].number();
    }
    object.read("velocity", block.velocity);
    object.read("angular_velocity", block.angular_velocity);
    object.read("fixed", block.fixed);
    object.read("rotation_locked", block.rotation_locked);
    object.read("material", block.material);
    return block;
}

TilingSettings find_preset_tiling(const JsonReader& name) {
    try {
        return find_tiling_preset(name.text());
    } catch (const SceneError& error) {
        name.fail(error.what());
    }
}

void parse_tiling_choice(const JsonReader& tower, const std::filesystem::path& origin, Tower& result) {
    if (!tower.has("tiling")) return;
    const JsonReader value = tower["tiling"];
    if (value.json().is_string()) {
        result.tiling = find_preset_tiling(value);
        return;
    }
    const JsonReader object = to_object(value, "tiling");
    object.read("cells_across", result.tiling.cells_across);
    object.read("inner_radius", result.tiling.inner_radius);
    object.read("outer_radius", result.tiling.outer_radius);
    if (object.has("file")) result.tiling_file = resolve(object.get<std::string>("file"), origin);
}

BlockList parse_block_list(const JsonReader& object, bool needs_size) {
    const JsonReader entries = object["blocks"];
    if (!entries.json().is_array()) entries.fail("a list [ ... ] of blocks is wanted; correct the value");
    BlockList list;
    for (const JsonReader& entry : entries.entries()) list.blocks.push_back(parse_block(entry, needs_size));
    return list;
}

template <class Layered>
void read_heights(const JsonReader& object, Layered& structure) {
    object.read("height_deviation", structure.height_deviation);
    object.read("seed", structure.seed);
}

Column parse_column(const JsonReader& object) {
    Column column;
    column.block = object.get<Triple<scaling::Length>>("block");
    object.read("layers", column.layers);
    object.read("rotation_locked", column.rotation_locked);
    read_heights(object, column);
    return column;
}

Wall parse_wall(const JsonReader& object) {
    Wall wall;
    wall.block = object.get<Triple<scaling::Length>>("block");
    object.read("layers", wall.layers);
    object.read("blocks_per_layer", wall.blocks_per_layer);
    wall.pitch = object.find<scaling::Length>("pitch");
    read_heights(object, wall);
    return wall;
}

Tower parse_tower(const JsonReader& object, const std::filesystem::path& origin) {
    Tower tower;
    tower.block = object.get<Triple<scaling::Length>>("block");
    object.read("layers", tower.layers);
    tower.pitch = object.find<scaling::Length>("pitch");
    parse_tiling_choice(object, origin, tower);
    read_heights(object, tower);
    return tower;
}

}  // namespace

Structure parse_structure(const JsonReader& value, const std::filesystem::path& origin, bool needs_size) {
    const std::string kind = read_kind(value, "kind", {"blocks", "column", "tower", "wall"});
    const JsonReader object = to_object(value, kind);
    if (kind == "blocks") return parse_block_list(object, needs_size);
    if (kind == "column") return parse_column(object);
    if (kind == "wall") return parse_wall(object);
    return parse_tower(object, origin);
}

}  // namespace musim::lsdem::detail
