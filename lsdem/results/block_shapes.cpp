#include "lsdem/results/block_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "lsdem/block_height.hpp"

namespace musim::lsdem {
namespace {

/// Times that each edge of the icosahedron is halved.
constexpr int kHalvings = 2;

/// A ball: round, and as wide along all axes.
bool is_ball(const Shape& shape) {
    const Vector3& half = shape.half_extents;
    return !shape.solid && !shape.faceted && half.x() == half.y() && half.y() == half.z();
}

/// Shape of a block; nothing of a box.
std::shared_ptr<const BlockShape> make_shape(const Model& model, const Block& block, const std::string& name) {
    const Shape& shape = model.shapes[block.shape];
    if (shape.solid) {
        const double height = 1.0 + height_strain(model, block);
        return std::make_shared<const BlockShape>(
            BlockShape{name, height == 1.0 ? *shape.solid : stretched(*shape.solid, {1.0, 1.0, height}), 0.0});
    }
    if (!is_ball(shape)) return nullptr;
    const double radius = shape.half_extents.x();
    return std::make_shared<const BlockShape>(BlockShape{name, make_ball_facets(radius), radius});
}

using Triangle = std::vector<std::uint32_t>;

/// Corners and faces of an icosahedron about the origin.
std::pair<std::vector<Vector3>, std::vector<Triangle>> make_icosahedron() {
    const double golden = 0.5 * (1.0 + std::sqrt(5.0));
    std::vector<Vector3> corners;
    for (const double a : {-1.0, 1.0}) {
        for (const double b : {-golden, golden}) {
            corners.emplace_back(0.0, a, b);
            corners.emplace_back(a, b, 0.0);
            corners.emplace_back(b, 0.0, a);
        }
    }
    // three corners that are neighbours of each other, an edge of length 2 apart, make a face
    const auto are_near = [&](std::size_t a, std::size_t b) { return (corners[a] - corners[b]).squaredNorm() < 5.0; };
    std::vector<Triangle> faces;
    for (std::uint32_t a = 0; a < corners.size(); ++a) {
        for (std::uint32_t b = a + 1; b < corners.size(); ++b) {
            for (std::uint32_t c = b + 1; c < corners.size() && are_near(a, b); ++c) {
                if (!are_near(b, c) || !are_near(c, a)) continue;
                const bool outward = (corners[b] - corners[a]).cross(corners[c] - corners[a]).dot(corners[a]) > 0.0;
                faces.push_back(outward ? Triangle{a, b, c} : Triangle{a, c, b});
            }
        }
    }
    return {corners, faces};
}

}  // namespace

const BlockShape* BlockShapes::find(std::size_t block) const {
    return block < of_block.size() && of_block[block] >= 0 ? list[static_cast<std::size_t>(of_block[block])].get() : nullptr;
}

BlockShapes list_block_shapes(const Model& model, const std::vector<std::string>& names) {
    BlockShapes shapes;
    std::map<std::pair<std::size_t, double>, int> known;  // by shape and height
    std::vector<int> of_block;
    for (const Block& block : model.blocks) {
        const auto [found, is_new] = known.try_emplace({block.shape, block.height_offset}, -1);
        if (is_new) {
            const std::string name = block.shape < names.size() ? names[block.shape] : std::string();
            if (auto shape = make_shape(model, block, name)) {
                found->second = static_cast<int>(shapes.list.size());
                shapes.list.push_back(std::move(shape));
            }
        }
        of_block.push_back(found->second);
    }
    if (shapes.any()) shapes.of_block = std::move(of_block);
    return shapes;
}

std::vector<std::shared_ptr<const BlockShape>> list_drawn_shapes(const BlockShapes& shapes, const std::vector<Vector3>& size) {
    std::map<std::array<double, 3>, std::shared_ptr<const BlockShape>> boxes;
    std::vector<std::shared_ptr<const BlockShape>> drawn;
    for (std::size_t b = 0; b < size.size(); ++b) {
        if (shapes.find(b) != nullptr) {
            drawn.push_back(shapes.list[static_cast<std::size_t>(shapes.of_block[b])]);
            continue;
        }
        auto& box = boxes[{size[b].x(), size[b].y(), size[b].z()}];
        if (!box) box = std::make_shared<const BlockShape>(BlockShape{{}, make_box_solid(size[b]), 0.0});
        drawn.push_back(box);
    }
    return drawn;
}

Solid make_ball_facets(double radius) {
    auto [corners, faces] = make_icosahedron();
    for (int halving = 0; halving < kHalvings; ++halving) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        std::vector<Vector3>& places = corners;
        const auto find_middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(places.size()));
            if (is_new) places.push_back(0.5 * (places[a] + places[b]));
            return found->second;
        };
        std::vector<Triangle> finer;
        for (const Triangle& face : faces) {
            const std::uint32_t ab = find_middle(face[0], face[1]), bc = find_middle(face[1], face[2]), ca = find_middle(face[2], face[0]);
            finer.insert(finer.end(), {{face[0], ab, ca}, {face[1], bc, ab}, {face[2], ca, bc}, {ab, bc, ca}});
        }
        faces = std::move(finer);
        for (Vector3& corner : corners) corner.normalize();
    }
    for (Vector3& corner : corners) corner *= radius;
    return {{make_polyhedron(std::move(corners), faces)}};
}

}  // namespace musim::lsdem
