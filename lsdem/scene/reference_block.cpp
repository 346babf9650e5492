#include "lsdem/scene/reference_block.hpp"

#include <numbers>

namespace musim::lsdem {

Triple<scaling::Length> reference_block(const Scene& scene) {
    if (const auto* sphere = std::get_if<SphereShape>(&scene.shape)) {
        const scaling::Length diameter = 2.0 * sphere->radius;
        return {diameter, diameter, diameter};
    }
    if (const auto* list = std::get_if<BlockList>(&scene.structure)) return list->blocks.front().size;
    if (const auto* column = std::get_if<Column>(&scene.structure)) return column->block;
    if (const auto* wall = std::get_if<Wall>(&scene.structure)) return wall->block;
    return std::get<Tower>(scene.structure).block;
}

scaling::Area reference_area(const Scene& scene) {
    if (const auto* sphere = std::get_if<SphereShape>(&scene.shape)) return std::numbers::pi * sphere->radius * sphere->radius;
    const Triple<scaling::Length> block = reference_block(scene);
    return block[0] * block[1];
}

}  // namespace musim::lsdem
