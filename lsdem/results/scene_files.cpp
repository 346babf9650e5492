#include "lsdem/results/scene_files.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <variant>

#include "lsdem/results/checksum.hpp"
#include "records/error.hpp"
#include "scaling/regular_file.hpp"

namespace musim::lsdem {
namespace {

namespace fs = std::filesystem;

std::string name_file_content(const fs::path& path) {
    const std::optional<std::string> bytes = scaling::read_regular_file(path);
    if (!bytes) throw records::ReadError(fmt::format("{}: cannot be read (a file that the scene names); check the path", path.string()));
    return detail::name_content(*bytes);
}

}  // namespace

Scene rename_files(Scene scene, const std::function<std::string(const fs::path&)>& name) {
    const auto rename_record = [&](SceneMotion& motion) {
        auto* const record = std::get_if<RecordMotion>(&motion.source);
        if (record == nullptr) return;
        record->file = name(record->file);
        if (record->station_xml) record->station_xml = name(*record->station_xml);
    };
    rename_record(scene.base_motion);
    for (auto& entry : scene.motions) rename_record(entry.base_motion);
    const auto rename_tiling = [&](auto& structure) {
        if (auto* tower = std::get_if<Tower>(&structure); tower != nullptr && tower->tiling_file) {
            tower->tiling_file = name(*tower->tiling_file);
        }
    };
    rename_tiling(scene.structure);
    if (auto* assembly = std::get_if<Assembly>(&scene.structure)) {
        for (PlacedStructure& placed : assembly->structures) rename_tiling(placed.structure);
    }
    if (scene.preparation && scene.preparation->specimen) scene.preparation->specimen = name(*scene.preparation->specimen);
    return scene;
}

Scene with_file_contents(const Scene& scene) { return rename_files(scene, name_file_content); }

}  // namespace musim::lsdem
