#include "lsdem/export/exported_blocks.hpp"

#include <nlohmann/json.hpp>

#include "lsdem/response/camera_view.hpp"

namespace musim::lsdem {
namespace {

/// Blocks without places.
std::vector<ExportedBlock> list_entries(const BlockTable& table) {
    const auto shapes = list_drawn_shapes(table.shapes, table.size);
    std::vector<ExportedBlock> blocks;
    for (std::size_t b = 0; b < shapes.size(); ++b) {
        ExportedBlock& block = blocks.emplace_back();
        block.name = table.label(b);
        block.shape = shapes[b];
        block.mass = table.mass[b];
        block.layer = table.layer[b];
    }
    return blocks;
}

/// Name of a scene of JSON text; empty where it has none.
std::string find_scene_name(const std::string& text) {
    const nlohmann::json scene = nlohmann::json::parse(text, nullptr, false);
    const auto name = scene.is_object() ? scene.find("name") : scene.end();
    return name != scene.end() && name->is_string() ? name->get<std::string>() : std::string();
}

}  // namespace

ExportedBlocks list_blocks(const Specimen& specimen, const std::string& name) {
    ExportedBlocks exported{.name = name, .blocks = list_entries(make_block_table(specimen)), .frames = {}, .similitude = {}};
    for (std::size_t b = 0; b < exported.blocks.size(); ++b) {
        exported.blocks[b].position = specimen.model.blocks[b].position;
        exported.blocks[b].orientation = specimen.model.blocks[b].orientation;
    }
    return exported;
}

ExportedBlocks list_blocks(const StoredRun& run, std::optional<double> time) {
    ExportedBlocks exported{
        .name = find_scene_name(run.scene), .blocks = list_entries(run.blocks), .frames = run.frames, .similitude = run.similitude};
    const std::size_t n = exported.blocks.size(), frame = time ? find_frame(run, *time) : 0;
    for (std::size_t b = 0; b < n; ++b) {
        exported.blocks[b].position = run.initial.position[b];
        exported.blocks[b].orientation = run.initial.orientation[b];
        if (!time) continue;
        const Eigen::Vector4d q = run.frames.quaternion[frame * n + b].cast<double>();
        exported.blocks[b].position = run.frames.position[frame * n + b].cast<double>();
        exported.blocks[b].orientation = Quaternion(q[0], q[1], q[2], q[3]);
    }
    return exported;
}

}  // namespace musim::lsdem
