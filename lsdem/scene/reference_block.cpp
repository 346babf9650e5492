#include "lsdem/scene/reference_block.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace musim::lsdem {

Triple<scaling::Length> reference_block(const Scene& scene) {
    if (const auto* sphere = std::get_if<SphereShape>(&scene.shape)) {
        const scaling::Length diameter = 2.0 * sphere->radius;
        return {diameter, diameter, diameter};
    }
    if (const auto* list = std::get_if<BlockList>(&scene.structure))
        return list->blocks.empty() ? Triple<scaling::Length>{} : list->blocks.front().size;
    if (const auto* column = std::get_if<Column>(&scene.structure)) return column->block;
    if (const auto* wall = std::get_if<Wall>(&scene.structure)) return wall->block;
    return std::get<Tower>(scene.structure).block;
}

bool has_several_bases(const Scene& scene) {
    constexpr double kSameBase = 1e-9;  // sizes written in another way
    const auto* list = std::get_if<BlockList>(&scene.structure);
    if (list == nullptr || std::holds_alternative<SphereShape>(scene.shape)) return false;
    const double area = reference_area(scene).value();
    return std::any_of(list->blocks.begin(), list->blocks.end(), [&](const BlockEntry& block) {
        return !(std::abs((block.size[0] * block.size[1]).value() - area) <= kSameBase * area);
    });
}

scaling::Area reference_area(const Scene& scene) {
    if (const auto* sphere = std::get_if<SphereShape>(&scene.shape)) return std::numbers::pi * sphere->radius * sphere->radius;
    const Triple<scaling::Length> block = reference_block(scene);
    return block[0] * block[1];
}

}  // namespace musim::lsdem
