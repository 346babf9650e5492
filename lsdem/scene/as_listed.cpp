#include "lsdem/scene/as_listed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "lsdem/scene/detail/placement.hpp"
#include "lsdem/scene/detail/turn_about.hpp"
#include "lsdem/scene/named_shape.hpp"

namespace musim::lsdem {
namespace {

using scaling::Length;
using Turn = std::array<double, 4>;
using detail::turn_about;

constexpr std::array kAbutments{"abutment 1", "abutment 2"};

/// Product: first b, then a.
Turn after(const Turn& a, const Turn& b) {
    return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

/// A vector turned about z.
template <class Quantity>
Triple<Quantity> turn_about_z(const Turn& turn, const Triple<Quantity>& v) {
    const double n = turn[0] * turn[0] + turn[3] * turn[3];
    const double c = (turn[0] * turn[0] - turn[3] * turn[3]) / n, s = 2.0 * turn[0] * turn[3] / n;
    return {c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]};
}

/// Names head columns of tables: those of shapes may have letters that these may not.
std::string to_name(std::string text) {
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20 || std::string_view("\x7f,;\"'/\\").find(c) != std::string_view::npos) c = '_';
    }
    return text;
}

/// Makes the blocks of structures, and the shapes that they need, in a scene.
class Lister {
  public:
    explicit Lister(const Scene& scene) : scene_(scene), listed_(scene) {}

    Scene list() {
        if (const auto* assembly = std::get_if<Assembly>(&scene_.structure)) {
            for (std::size_t k = 0; k < assembly->structures.size(); ++k) add(assembly->structures[k], k);
        } else if (const auto* column = std::get_if<ShapeColumn>(&scene_.structure)) {
            add(*column);
        } else if (const auto* arch = std::get_if<Arch>(&scene_.structure)) {
            add(*arch);
        }
        listed_.structure = std::move(list_);
        return std::move(listed_);
    }

  private:
    void add(const PlacedStructure& placed, std::size_t number) {
        prefix_ = (placed.name.empty() ? fmt::format("structure {}", number) : placed.name) + " ";
        const std::size_t first = list_.blocks.size();
        std::visit([&](const auto& structure) { add(structure); }, placed.structure);
        const Turn turn = turn_about(2, placed.turn.value());
        for (std::size_t b = first; b < list_.blocks.size(); ++b) {
            BlockEntry& block = list_.blocks[b];
            block.name = prefix_ + (block.name.empty() ? std::to_string(b - first) : block.name);
            if (turn[3] != 0.0) {
                block.position = turn_about_z(turn, block.position);
                block.velocity = turn_about_z(turn, block.velocity);
                block.angular_velocity = turn_about_z(turn, block.angular_velocity);
                block.quaternion = after(turn, block.quaternion);
            }
            for (std::size_t axis = 0; axis < 3; ++axis) block.position[axis] += placed.place[axis];
        }
    }

    void add(const BlockList& list) { list_.blocks.insert(list_.blocks.end(), list.blocks.begin(), list.blocks.end()); }

    /// Boxes of a column, a tower or a wall, where they stand.
    template <class Layered>
    void add(const Layered& layered) {
        Scene alone = scene_;
        alone.structure = layered;
        for (const detail::Placement& block : detail::arrange_boxes(alone).blocks) {
            BlockEntry& entry = list_.blocks.emplace_back();
            if constexpr (requires { layered.shape; }) entry.shape = layered.shape;
            const Vector3 size = block.own_size();
            for (int axis = 0; axis < 3; ++axis) {
                const auto k = static_cast<std::size_t>(axis);
                if (entry.shape.empty()) entry.size[k] = Length::from_value(size[axis]);
                entry.position[k] = Length::from_value(block.position[axis]);
            }
            const Quaternion& q = block.orientation;
            entry.quaternion = {q.w(), q.x(), q.y(), q.z()};
            entry.rotation_locked = block.rotation_locked;
            entry.material = block.material;
        }
    }

    void add(const ShapeColumn& column) {
        std::map<std::string, int> count, number;
        for (const std::string& name : column.blocks) ++count[name];
        Length top{};
        for (const std::string& name : column.blocks) {
            const DrawnSolid drawn = make_drawn_solid(scene_, name);
            const Bounds bounds = find_bounds(drawn.solid);
            BlockEntry& entry = list_.blocks.emplace_back();
            entry.shape = name;
            entry.name = to_name(count[name] > 1 ? fmt::format("{} {}", name, ++number[name]) : name);
            entry.position[2] = top - Length::from_value(drawn.origin.z() + bounds.low.z());
            top += Length::from_value(bounds.high.z() - bounds.low.z());
        }
    }

    void add(const Arch& arch) {
        const Length inner = arch.radius - 0.5 * arch.thickness, outer = arch.radius + 0.5 * arch.thickness;
        const double part = arch.embrace.value() / arch.voussoirs, half = 0.5 * arch.embrace.value();
        const double c = std::cos(0.5 * part), s = std::sin(0.5 * part);
        const std::string voussoir = add_shape(
            "voussoir",
            PrismForm{.outline = {{-s * outer, -c * outer}, {s * outer, -c * outer}, {s * inner, -c * inner}, {-s * inner, -c * inner}},
                      .axis = ShapeAxis::y,
                      .length = arch.depth,
                      .taper = 1.0});
        // height of the middle above the lowest point of the springings
        const double rise = std::cos(half);
        const Length foot = arch.abutments ? arch.thickness : Length{}, middle = foot - rise * (rise > 0.0 ? inner : outer);
        for (int k = 0; k < arch.voussoirs; ++k) {
            BlockEntry& entry = list_.blocks.emplace_back();
            entry.shape = voussoir;
            entry.name = fmt::format("voussoir {}", k + 1);
            entry.position[2] = middle;
            entry.quaternion = turn_about(1, (k + 0.5 - 0.5 * arch.voussoirs) * part + 0.5 * std::numbers::pi);
        }
        if (!arch.abutments) return;
        const Length ground{}, in = std::sin(half) * inner, out = std::sin(half) * outer, top = middle + rise * inner,
                               crest = middle + rise * outer;
        const std::string left = add_shape("left abutment", PrismForm{.outline = {{ground, -out}, {crest, -out}, {top, -in}, {ground, -in}},
                                                                      .axis = ShapeAxis::y,
                                                                      .length = arch.depth,
                                                                      .taper = 1.0});
        const std::string right = add_shape("right abutment", PrismForm{.outline = {{ground, in}, {top, in}, {crest, out}, {ground, out}},
                                                                        .axis = ShapeAxis::y,
                                                                        .length = arch.depth,
                                                                        .taper = 1.0});
        for (std::size_t side = 0; side < 2; ++side) {
            BlockEntry& entry = list_.blocks.emplace_back();
            entry.shape = side == 0 ? left : right;
            entry.name = kAbutments[side];
            entry.fixed = Held::with_base;
        }
    }

    /// Name of a shape that is made for a structure, none of the scene's own.
    std::string add_shape(const std::string& name, const PrismForm& form) {
        std::string key = prefix_ + name;
        while (listed_.shapes.contains(key)) key += '*';
        listed_.shapes[key].form = form;
        return key;
    }

    const Scene& scene_;
    Scene listed_;
    BlockList list_;
    std::string prefix_;  ///< before the names of a structure's shapes and blocks
};

}  // namespace

bool is_listed(const Scene& scene) {
    return !std::holds_alternative<Column>(scene.structure) && !std::holds_alternative<Tower>(scene.structure) &&
           !std::holds_alternative<Wall>(scene.structure);
}

Scene as_listed(const Scene& scene) {
    if (!is_listed(scene) || std::holds_alternative<BlockList>(scene.structure)) return scene;
    return Lister(scene).list();
}

}  // namespace musim::lsdem
