#include "lsdem/scene/detail/unlikely_values.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "scaling/json_reader.hpp"
#include "scaling/unlikely.hpp"

namespace musim::lsdem::detail {
namespace {

using scaling::JsonPlace;

/// The words found so far, one of each kind.
class UnlikelyValues {
  public:
    enum class Kind { density, friction, length_factor, edge };

    void add(Kind kind, const JsonPlace& place, const std::optional<std::string>& words) {
        std::optional<std::string>& found = found_.at(static_cast<std::size_t>(kind));
        if (words && !found) found = fmt::format("{}: {}", place.text, *words);
    }

    void add_material(const BlockMaterial& material, const JsonPlace& place) {
        add(Kind::density, place.at("density"), scaling::describe_unlikely_density(material.density));
        add(Kind::friction, place.at("friction"), scaling::describe_unlikely_friction(material.friction));
    }

    void add_friction(const std::optional<double>& friction, const JsonPlace& place) {
        if (friction) add(Kind::friction, place.at("friction"), scaling::describe_unlikely_friction(*friction));
    }

    void add_size(const Triple<scaling::Length>& size, const JsonPlace& place) {
        for (std::size_t k = 0; k < size.size(); ++k) add(Kind::edge, place.at(k), scaling::describe_unlikely_edge(size[k]));
    }

    void add_motion(const SceneMotion& motion, const JsonPlace& place) {
        const auto* record = std::get_if<RecordMotion>(&motion.source);
        if (record == nullptr || !record->scale) return;
        const auto length = record->scale->set.find("l");
        if (length == record->scale->set.end()) return;
        add(Kind::length_factor, place.at("scale").at("length"), scaling::describe_unlikely_length_factor(length->second));
    }

    void list(std::vector<std::string>& words) const {
        for (const std::optional<std::string>& each : found_) {
            if (each) words.push_back(*each);
        }
    }

  private:
    std::array<std::optional<std::string>, 4> found_;
};

void add_structure(const Structure& structure, const JsonPlace& place, UnlikelyValues& values) {
    if (const auto* list = std::get_if<BlockList>(&structure)) {
        for (std::size_t k = 0; k < list->blocks.size(); ++k) values.add_size(list->blocks[k].size, place.at("blocks").at(k).at("size"));
        return;
    }
    std::visit(
        [&](const auto& kind) {
            if constexpr (requires { kind.block; }) values.add_size(kind.block, place.at("block"));
        },
        structure);
}

}  // namespace

std::vector<std::string> find_unlikely_values(const Scene& scene) {
    const JsonPlace root{scene.place() + ": /"};
    std::vector<std::string> words;
    if (scene.gravity[2].value() > 0.0) {
        words.push_back(fmt::format(
            "{}: points upwards (z is up; one value alone is a magnitude, downwards); write its magnitude alone, or a negative z",
            root.at("gravity").text));
    }
    UnlikelyValues values;
    values.add_material(scene.material, root.at("material"));
    for (const auto& [name, material] : scene.materials) values.add_material(material, root.at("materials").at(name));
    for (std::size_t k = 0; k < scene.pairs.size(); ++k) values.add_friction(scene.pairs[k].friction, root.at("pairs").at(k));
    values.add_friction(scene.ground.friction, root.at("ground"));
    add_structure(scene.structure, root.at("structure"), values);
    values.add_motion(scene.base_motion, root.at("base_motion"));
    for (std::size_t k = 0; k < scene.motions.size(); ++k) {
        values.add_motion(scene.motions[k].base_motion, root.at("motions").at(k).at("base_motion"));
    }
    values.list(words);
    return words;
}

}  // namespace musim::lsdem::detail
