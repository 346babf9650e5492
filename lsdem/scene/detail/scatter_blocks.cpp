#include "lsdem/scene/detail/scatter_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "lsdem/scene/block_heights.hpp"
#include "lsdem/scene/detail/overlap.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/random_bits.hpp"

namespace musim::lsdem::detail {
namespace {

/// A similar twin of a limit is at the limit too, up to rounding [-].
constexpr double kRounding = 1e-12;

/// Quantities that are drawn independently of each other.
enum class Drawn : std::uint64_t { first_edge, second_edge, place_x, place_y };

std::vector<double> draw(Drawn quantity, std::size_t count, std::uint64_t seed) {
    return draw_deviates(count, scaling::random_bits(seed, static_cast<std::uint64_t>(quantity)));
}

std::string describe(double meters) { return scaling::format_quantity(scaling::Length::from_value(meters), 4); }

void require_small(const Scene& scene, const char* key, double deviation, double most, double shortest) {
    if (deviation <= (1.0 + kRounding) * most * shortest) return;
    throw SceneError(
        fmt::format("{}: /scatter/{}: {} (more than 1/{:.0f} of {}, the shortest edge of a block: a block of the far tail would "
                    "be none of the same wall); use at most {}",
                    scene.place(), key, describe(deviation), 1.0 / most, describe(shortest), describe(most * shortest)));
}

/// The two edges of a box that are not its most upright one; the lower index counts where two are as upright.
std::array<Eigen::Index, 2> find_flat_edges(const Placement& block) {
    Eigen::Index upright = 0;
    block.orientation.toRotationMatrix().row(2).cwiseAbs().maxCoeff(&upright);
    return {upright == 0 ? 1 : 0, upright == 2 ? 1 : 2};
}

/// The shortest of what `edge_of` says of the blocks; infinite where there is none [m].
template <class EdgeOf>
double find_shortest(const std::vector<Placement>& blocks, const EdgeOf& edge_of) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const Placement& block : blocks) shortest = std::min(shortest, edge_of(block));
    return shortest;
}

/// Is it a box, that is not held?
bool has_edges(const Placement& block, bool spheres) { return !block.fixed && block.solid == nullptr && block.shape.empty() && !spheres; }

void vary_sizes(const Scene& scene, double deviation, std::uint64_t seed, std::vector<Placement>& blocks) {
    const bool spheres = std::holds_alternative<SphereShape>(scene.shape);
    // the deviation of the absolute value of a normal deviate
    const double spread = std::sqrt(1.0 - 2.0 / std::numbers::pi);
    const std::array deviates{draw(Drawn::first_edge, blocks.size(), seed), draw(Drawn::second_edge, blocks.size(), seed)};
    require_small(scene, "size", deviation, kMostSizeDeviation, find_shortest(blocks, [&](const Placement& block) {
                      const auto [first, second] = find_flat_edges(block);
                      return has_edges(block, spheres) ? std::min(block.size[first], block.size[second])
                                                       : std::numeric_limits<double>::infinity();
                  }));
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        Placement& block = blocks[i];
        if (!has_edges(block, spheres)) continue;
        const std::array<Eigen::Index, 2> edges = find_flat_edges(block);
        for (std::size_t k = 0; k < 2; ++k) {
            const double factor = 1.0 - std::abs(deviates[k][i]) * deviation / (spread * block.size[edges[k]]);
            block.size[edges[k]] *= factor;
            block.whole_size[edges[k]] *= factor;
        }
    }
}

/// A body's bounds along the world's axes.
struct Bounded {
    const Body* body;
    Vector3 low, high;
    std::size_t block;
};

/// Half the gap from each block to the nearest one beside it, no more than `reach` [m].
std::vector<double> find_rooms(const std::vector<Placement>& blocks, const std::vector<Body>& bodies, double reach) {
    std::vector<Bounded> sorted;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const Vector3 half = 0.5 * blocks[i].extent();
        sorted.push_back({&bodies[i], bodies[i].center - half, bodies[i].center + half, i});
        if (blocks[i].solid == nullptr) continue;
        const Bounds bounds = find_bounds(*blocks[i].solid->solid, {bodies[i].axes, bodies[i].center});
        sorted.back().low = bounds.low, sorted.back().high = bounds.high;
    }
    std::sort(sorted.begin(), sorted.end(),
              [](const Bounded& a, const Bounded& b) { return std::pair(a.low.x(), a.block) < std::pair(b.low.x(), b.block); });
    std::vector<double> rooms(blocks.size(), reach);
    for (std::size_t k = 0; k < sorted.size(); ++k) {
        const Bounded& a = sorted[k];
        for (std::size_t other = k + 1; other < sorted.size() && sorted[other].low.x() <= a.high.x() + 2.0 * reach; ++other) {
            const Bounded& b = sorted[other];
            if (std::max(a.low.y(), b.low.y()) > std::min(a.high.y(), b.high.y()) + 2.0 * reach) continue;
            // one that lies on the other may slide on it
            const double touching = kTouchingTolerance * 2.0 * std::min(a.body->half.minCoeff(), b.body->half.minCoeff());
            if (std::max(a.low.z(), b.low.z()) > std::min(a.high.z(), b.high.z()) - touching) continue;
            const double room = 0.5 * std::max(-compute_overlap(*a.body, *b.body), 0.0);
            rooms[a.block] = std::min(rooms[a.block], room);
            rooms[b.block] = std::min(rooms[b.block], room);
        }
    }
    return rooms;
}

void vary_places(const Scene& scene, double deviation, std::uint64_t seed, std::vector<Placement>& blocks) {
    require_small(scene, "place", deviation, kMostPlaceDeviation, find_shortest(blocks, [](const Placement& block) {
                      return block.fixed ? std::numeric_limits<double>::infinity() : block.extent().head<2>().minCoeff();
                  }));
    const double reach = std::numbers::sqrt2 * kMostDeviates * deviation;
    const std::vector<double> rooms = find_rooms(blocks, make_bodies(scene, blocks), reach);
    const std::vector<double> x = draw(Drawn::place_x, blocks.size(), seed), y = draw(Drawn::place_y, blocks.size(), seed);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (blocks[i].fixed) continue;
        const Vector3 wanted = deviation * Vector3(x[i], y[i], 0.0);
        const double length = wanted.norm();
        blocks[i].position += length > rooms[i] ? Vector3(wanted * (rooms[i] / length)) : wanted;
    }
}

}  // namespace

void scatter_blocks(const Scene& scene, std::vector<Placement>& blocks) {
    if (!scene.scatter) return;
    const auto& [size, place, friction, seed] = *scene.scatter;
    if (size.value() > 0.0) vary_sizes(scene, size.value(), seed, blocks);
    if (place.value() > 0.0) vary_places(scene, place.value(), seed, blocks);
}

}  // namespace musim::lsdem::detail
