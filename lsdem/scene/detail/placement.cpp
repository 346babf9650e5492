#include "lsdem/scene/detail/placement.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

#include "lsdem/scene/as_listed.hpp"
#include "lsdem/scene/block_heights.hpp"
#include "lsdem/scene/detail/overlap.hpp"
#include "lsdem/scene/detail/scatter_blocks.hpp"
#include "lsdem/scene/detail/wall_courses.hpp"
#include "lsdem/scene/tower_tiling.hpp"

namespace musim::lsdem::detail {

namespace {

/// Part of the height of the lower of two blocks by which centres of two levels differ at least [-].
constexpr double kLevelGap = 0.5;

/// Most blocks of an explicit list whose motion is kept: what a plot can show.
constexpr std::size_t kLargestSpine = 64;

/// Turns a block's wide side from the y to the x axis.
Quaternion quarter_turn() {
    constexpr double kHalfAngle = std::numbers::sqrt2 / 2.0;
    return {kHalfAngle, 0.0, 0.0, kHalfAngle};
}

double layer_height(double height, int layer) { return height * (layer - 0.5); }

Placement place(const Vector3& size, const Vector3& position, int layer) {
    Placement block;
    block.size = block.whole_size = size;
    block.position = position;
    block.layer = block.level = layer;
    return block;
}

void add_to_line(Spine& spine, std::size_t block, int layer) {
    spine.block.push_back(block);
    spine.level.push_back(layer);
}

/// The block of the top layer, which the line does not reach.
void add_top(Spine& spine, std::size_t block, int layer) {
    add_to_line(spine, block, layer);
    spine.has_top = true;
}

/// Places blocks by the frames in which their shapes are drawn.
class ListPlacer {
  public:
    explicit ListPlacer(const Scene& scene) : scene_(scene) {}

    Placement place_entry(const BlockEntry& entry) {
        Placement block = place(Vector3::Zero(), to_vector(entry.position), 0);
        const auto& [w, x, y, z] = entry.quaternion;
        block.orientation = Quaternion(w, x, y, z).normalized();
        block.velocity = to_vector(entry.velocity);
        block.angular_velocity = to_vector(entry.angular_velocity);
        block.fixed = entry.fixed != Held::free;
        block.with_base = entry.fixed == Held::with_base;
        block.rotation_locked = entry.rotation_locked;
        block.material = entry.material;
        if (entry.density) block.density = entry.density->value();
        block.name = entry.name;
        const ShapeEntry* named = scene_.find_shape(entry);
        if (scene_.is_sphere(entry)) {
            const auto& sphere = named != nullptr ? std::get<SphereShape>(named->form) : std::get<SphereShape>(scene_.shape);
            block.size.setConstant(2.0 * sphere.radius.value());
            block.shape = entry.shape;
        } else if (named != nullptr) {
            take_shape(entry.shape, block);
        } else {
            block.size = to_vector(entry.size);
        }
        block.whole_size = block.size;
        return block;
    }

    /// Gives a block, which is where the frame of its shape is, a shape of flat faces.
    void take_shape(const std::string& name, Placement& block) {
        const ShapeEntry& named = scene_.shapes.at(name);
        if (named.mass) block.mass = named.mass->value();
        if (named.is_box()) {
            block.size = to_vector(find_box_size(named));
            const auto& [w, x, y, z] = named.quaternion;
            if (named.quaternion != ShapeEntry{}.quaternion) block.orientation *= Quaternion(w, x, y, z).normalized();
            return;
        }
        const std::shared_ptr<const Shape>& solid = find_or_make(name);
        const Placing body = solid->own.inverse();
        block.position += block.orientation * body.position;
        if (body.rotation != Matrix3::Identity()) block.orientation = (block.orientation * Quaternion(body.rotation)).normalized();
        block.size = 2.0 * solid->half_extents;
        block.shape = name;
        block.solid = solid;
    }

  private:
    const std::shared_ptr<const Shape>& find_or_make(const std::string& name) {
        std::shared_ptr<const Shape>& solid = solids_[name];
        if (!solid) solid = std::make_shared<const Shape>(make_named_shape(scene_, name));
        return solid;
    }

    const Scene& scene_;
    std::map<std::string, std::shared_ptr<const Shape>> solids_;
};

/// Places a list of blocks, with its spine.
Arrangement arrange_list(const Scene& scene) {
    Arrangement arrangement;
    ListPlacer placer(scene);
    const auto& list = std::get<BlockList>(scene.structure);
    for (const BlockEntry& entry : list.blocks) arrangement.blocks.push_back(placer.place_entry(entry));
    std::vector<Vector3> position, extent;
    for (const Placement& block : arrangement.blocks) {
        position.push_back(block.position);
        extent.push_back(block.extent());
    }
    const std::vector<int> levels = find_levels(position, extent);
    for (std::size_t i = 0; i < levels.size(); ++i) arrangement.blocks[i].level = levels[i];
    const std::size_t count = list.blocks.size();
    const std::size_t kept = std::min(count, kLargestSpine);
    for (std::size_t k = 0; k < kept; ++k) {
        const std::size_t block = k * count / kept;
        add_to_line(arrangement.spine, block, levels[block]);
    }
    return arrangement;
}

Arrangement arrange(const Column& column) {
    Arrangement arrangement;
    const Vector3 size = to_vector(column.block);
    for (int layer = 1; layer <= column.layers; ++layer) {
        Placement block = place(size, {0.0, 0.0, layer_height(size.z(), layer)}, layer);
        block.rotation_locked = column.rotation_locked;
        if (layer % 2 == 1) add_to_line(arrangement.spine, arrangement.blocks.size(), layer);
        arrangement.blocks.push_back(std::move(block));
    }
    if (column.layers % 2 == 0) add_top(arrangement.spine, arrangement.blocks.size() - 1, column.layers);
    return arrangement;
}

/// Twice the centre of a domino from the middle of the grid [pitches]: whole numbers.
std::array<int, 2> double_center(const Domino& domino, int cells_across) {
    return {2 * domino.i + (domino.along_x ? 2 : 1) - cells_across, 2 * domino.j + (domino.along_x ? 1 : 2) - cells_across};
}

/// The domino whose double centre (x, y) has the lowest rank.
template <class Rank>
std::size_t find_domino(const TowerTiling& tiling, const Rank& rank) {
    const auto rank_of = [&](const Domino& domino) {
        const auto [x, y] = double_center(domino, tiling.cells_across);
        return rank(x, y);
    };
    const auto best = std::min_element(tiling.dominoes.begin(), tiling.dominoes.end(),
                                       [&](const Domino& a, const Domino& b) { return rank_of(a) < rank_of(b); });
    return static_cast<std::size_t>(best - tiling.dominoes.begin());
}

/// The domino of the outer face, on the side of +x, nearest to the x axis.
std::size_t find_spine_domino(const TowerTiling& tiling) {
    return find_domino(tiling, [](int x, int y) { return std::tuple(-x, std::abs(y), y); });
}

/// The domino of a layer nearest to one of another layer; of several, the one farthest out towards +x.
std::size_t find_nearest_domino(const TowerTiling& tiling, const std::array<int, 2>& double_center) {
    return find_domino(tiling, [&](int x, int y) {
        const int dx = x - double_center[0], dy = y - double_center[1];
        return std::tuple(dx * dx + dy * dy, -x, y);
    });
}

Arrangement arrange(const Tower& tower) {
    const TowerTiling odd = tower.tiling_file ? read_tiling(*tower.tiling_file) : make_tower_tiling(tower.tiling);
    const TowerTiling even = rotate_quarter_turn(odd);
    const std::size_t spine = find_spine_domino(odd);
    const Vector3 size = to_vector(tower.block);
    const double pitch = tower.pitch.value_or(default_pitch(tower.block)).value();

    Arrangement arrangement;
    for (int layer = 1; layer <= tower.layers; ++layer) {
        const bool is_odd = layer % 2 == 1;
        if (is_odd) {
            add_to_line(arrangement.spine, arrangement.blocks.size() + spine, layer);
        } else if (layer == tower.layers) {
            const std::size_t above = find_nearest_domino(even, double_center(odd.dominoes[spine], odd.cells_across));
            add_top(arrangement.spine, arrangement.blocks.size() + above, layer);
        }
        for (const Domino& domino : is_odd ? odd.dominoes : even.dominoes) {
            const auto [x, y] = double_center(domino, odd.cells_across);
            Placement block = place(size, {0.5 * x * pitch, 0.5 * y * pitch, layer_height(size.z(), layer)}, layer);
            if (domino.along_x) block.orientation = quarter_turn();
            arrangement.blocks.push_back(std::move(block));
        }
    }
    return arrangement;
}

/// The line goes up the right end of the wall, of its first leaf.
Arrangement arrange(const Wall& wall) {
    const Vector3 whole = to_vector(wall.block);
    Arrangement arrangement;
    std::size_t last = 0;
    const auto end_course = [&](int course) {
        if (course % 2 == 1) add_to_line(arrangement.spine, last, course);
        if (course % 2 == 0 && course == wall.layers) add_top(arrangement.spine, last, course);
    };
    for (const WallBox& box : lay_wall(wall, {"/structure"})) {
        if (!arrangement.blocks.empty() && box.course != arrangement.blocks.back().layer) end_course(box.course - 1);
        if (box.is_line) last = arrangement.blocks.size();
        Placement block = place(box.size, box.position, box.course);
        block.whole_size = whole;
        if (box.along_x) block.orientation = quarter_turn();
        if (box.is_lintel) block.material = wall.lintel.value_or(WallLintel{}).material;
        arrangement.blocks.push_back(std::move(block));
    }
    end_course(wall.layers);
    return arrangement;
}

/// Gives every block its own height, in the order of the list, and lifts each layer until the tallest block of the one below is clear:
/// nothing overlaps, and most blocks hang a little above those they will rest on.
void vary_heights(const HeightVariation& variation, std::vector<Placement>& blocks) {
    const std::vector<double> deviates = draw_deviates(blocks.size(), variation.seed);
    for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].height_offset = deviates[i] * variation.deviation.value();

    // layer by layer from the base, as the list has them
    double bottom = 0.0, tallest = 0.0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (i > 0 && blocks[i].layer != blocks[i - 1].layer) bottom += std::exchange(tallest, 0.0);
        const double height = blocks[i].own_size().z();
        tallest = std::max(tallest, height);
        blocks[i].position.z() = bottom + 0.5 * height;
    }
}

}  // namespace

Vector3 Placement::extent() const {
    if (solid) return find_bounds(*solid->solid, {orientation.toRotationMatrix(), position}).size();
    return orientation.toRotationMatrix().cwiseAbs() * own_size();
}

std::vector<int> find_levels(const std::vector<Vector3>& position, const std::vector<Vector3>& extent) {
    std::vector<std::size_t> order(position.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return position[a].z() < position[b].z(); });
    std::vector<int> levels(position.size(), 0);
    int level = 0;
    std::size_t first = 0;
    for (const std::size_t b : order) {
        const double lower = std::min(extent[first].z(), extent[b].z());
        if (level == 0 || position[b].z() - position[first].z() >= kLevelGap * lower) ++level, first = b;
        levels[b] = level;
    }
    return levels;
}

Arrangement arrange_boxes(const Scene& scene) {
    Arrangement arrangement;
    std::visit(
        [&](const auto& structure) {
            if constexpr (requires { structure.height_deviation; }) arrangement = arrange(structure);
        },
        scene.structure);
    if (const auto variation = find_height_variation(scene)) vary_heights(*variation, arrangement.blocks);
    return arrangement;
}

namespace {

/// As arrange(), without the scatter of sizes and places.
Arrangement arrange_as_drawn(const Scene& scene) {
    if (is_listed(scene)) return arrange_list(as_listed(scene));
    Arrangement arrangement = arrange_boxes(scene);
    const auto* tower = std::get_if<Tower>(&scene.structure);
    if (tower == nullptr || tower->shape.empty()) return arrangement;
    ListPlacer placer(scene);
    for (Placement& block : arrangement.blocks) {
        placer.take_shape(tower->shape, block);
        block.whole_size = block.size;
    }
    return arrangement;
}

}  // namespace

Arrangement arrange(const Scene& scene) {
    Arrangement arrangement = arrange_as_drawn(scene);
    scatter_blocks(scene, arrangement.blocks);
    return arrangement;
}

std::vector<Body> make_bodies(const Scene& scene, const std::vector<Placement>& blocks) {
    const bool has_spheres = std::holds_alternative<SphereShape>(scene.shape);
    std::vector<Body> bodies;
    bodies.reserve(blocks.size());
    for (const Placement& block : blocks) {
        const Solid* const solid = block.solid ? block.solid->solid.get() : nullptr;
        const bool round = has_spheres || (!block.shape.empty() && solid == nullptr);
        bodies.push_back({0.5 * block.own_size(), block.position, block.orientation.toRotationMatrix(), round, block.fixed, solid});
    }
    return bodies;
}

}  // namespace musim::lsdem::detail
