#include "lsdem/scene/reference_block.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "lsdem/scene/as_listed.hpp"
#include "lsdem/scene/named_shape.hpp"

namespace musim::lsdem {

namespace {

using scaling::Area;
using scaling::Length;

const SphereShape* find_sphere(const Scene& scene, const BlockEntry& block) {
    const ShapeEntry* named = scene.find_shape(block);
    return named != nullptr ? std::get_if<SphereShape>(&named->form) : std::get_if<SphereShape>(&scene.shape);
}

/// Base and height of the blocks of a list, by the shape that they name.
class ListBases {
  public:
    explicit ListBases(const Scene& scene) : scene_(scene) {}

    Area find_area(const BlockEntry& block) {
        if (const SphereShape* sphere = find_sphere(scene_, block)) return std::numbers::pi * sphere->radius * sphere->radius;
        if (const ShapeEntry* named = scene_.find_shape(block); named != nullptr && !named->is_box()) return find_or_make(block.shape).area;
        const Triple<Length> size = find_block(block);
        return size[0] * size[1];
    }
    Triple<Length> find_block(const BlockEntry& block) {
        if (const SphereShape* sphere = find_sphere(scene_, block)) {
            const Length diameter = 2.0 * sphere->radius;
            return {diameter, diameter, diameter};
        }
        const ShapeEntry* named = scene_.find_shape(block);
        if (named == nullptr) return block.size;
        return named->is_box() ? find_box_size(*named) : find_or_make(block.shape).block;
    }

  private:
    struct Base {
        Area area{};
        Triple<Length> block{};
    };

    const Base& find_or_make(const std::string& name) {
        const auto [entry, is_new] = bases_.try_emplace(name);
        if (is_new) {
            const Shape shape = make_named_shape(scene_, name);
            const Vector3 extent = find_bounds(*shape.solid, shape.own.inverse()).size();
            const double part = std::sqrt(shape.face_area / (extent.x() * extent.y()));
            entry->second = {
                Area::from_value(shape.face_area),
                {Length::from_value(part * extent.x()), Length::from_value(part * extent.y()), Length::from_value(extent.z())}};
        }
        return entry->second;
    }

    const Scene& scene_;
    std::map<std::string, Base> bases_;
};

}  // namespace

Triple<scaling::Length> find_block_size(const Scene& scene, const BlockEntry& block) { return ListBases(scene).find_block(block); }

Triple<scaling::Length> reference_block(const Scene& scene) {
    if (is_listed(scene)) {
        const Scene listed = as_listed(scene);
        const auto& list = std::get<BlockList>(listed.structure);
        return list.blocks.empty() ? Triple<scaling::Length>{} : find_block_size(listed, list.blocks.front());
    }
    if (const auto* column = std::get_if<Column>(&scene.structure)) return column->block;
    if (const auto* wall = std::get_if<Wall>(&scene.structure)) return wall->block;
    return std::get<Tower>(scene.structure).block;
}

bool has_several_bases(const Scene& scene) {
    constexpr double kSameBase = 1e-9;  // sizes written in another way
    if (!is_listed(scene)) return false;
    const Scene listed = as_listed(scene);
    const auto* list = &std::get<BlockList>(listed.structure);
    if (list->blocks.empty()) return false;
    ListBases bases(listed);
    const double area = bases.find_area(list->blocks.front()).value();
    return std::any_of(list->blocks.begin(), list->blocks.end(),
                       [&](const BlockEntry& block) { return !(std::abs(bases.find_area(block).value() - area) <= kSameBase * area); });
}

scaling::Area reference_area(const Scene& scene) {
    if (is_listed(scene)) {
        const Scene listed = as_listed(scene);
        const auto& list = std::get<BlockList>(listed.structure);
        if (!list.blocks.empty()) return ListBases(listed).find_area(list.blocks.front());
    }
    const Triple<scaling::Length> block = reference_block(scene);
    return block[0] * block[1];
}

}  // namespace musim::lsdem
