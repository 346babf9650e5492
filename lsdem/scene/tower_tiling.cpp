#include "lsdem/scene/tower_tiling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "lsdem/scene/detail/cell_ring.hpp"
#include "lsdem/scene/detail/json_text.hpp"
#include "lsdem/scene/detail/tiling_search.hpp"
#include "lsdem/scene/scene_error.hpp"

namespace musim::lsdem {

namespace {

using detail::CellRing;
using detail::kNone;
using detail::Partners;

/// Seed of the search. It decides which of the good tilings is built; docs/theory/structures.md shows the one of the full tower.
constexpr std::uint64_t kSeed = 20;

/// The exact cover starts anew with other random choices after this many placements, then after twice as many, and so on: its effort has a
/// heavy tail [Gomes00], a lucky start for the full tower needs a few hundred. It gives up after the last.
constexpr std::uint64_t kFirstNodeLimit = 500;
constexpr std::uint64_t kLastNodeLimit = 256'000;

/// Flips tried per round and squared number of cells, so that large and small rings are searched equally well; and rounds at most.
constexpr std::uint64_t kTrialsPerCellSquared = 1;
constexpr int kRounds = 8;

/// Largest plan: bounds memory and search time on mistaken input.
constexpr int kLargestGrid = 200;

struct NamedTiling {
    std::string_view name;
    TilingSettings settings;
};

constexpr std::array kPresets = {
    NamedTiling{"full", {.cells_across = 26, .inner_radius = 6.37, .outer_radius = 12.59}},
    NamedTiling{"solid_22", {.cells_across = 8, .inner_radius = 0.0, .outer_radius = 3.7}},
    NamedTiling{"ring_18", {.cells_across = 8, .inner_radius = 2.2, .outer_radius = 4.0}},
    NamedTiling{"ring_14", {.cells_across = 6, .inner_radius = 1.0, .outer_radius = 3.2}},
    NamedTiling{"solid_6", {.cells_across = 4, .inner_radius = 0.0, .outer_radius = 2.0}},
    NamedTiling{"solid_2", {.cells_across = 2, .inner_radius = 0.0, .outer_radius = 1.0}},
};

/// Second cell of a domino.
std::array<int, 2> far_cell(const Domino& domino) {
    return domino.along_x ? std::array{domino.i + 1, domino.j} : std::array{domino.i, domino.j + 1};
}

/// Plan that the dominoes cover, and how often its cells are covered at most.
struct Plan {
    CellRing ring;
    int most_covers = 0;
};

Plan make_plan(const TowerTiling& tiling) {
    const auto n = static_cast<std::size_t>(tiling.cells_across);
    std::vector<int> covers(n * n, 0);
    int most = 0;
    for (const Domino& domino : tiling.dominoes) {
        for (const auto& [i, j] : {std::array{domino.i, domino.j}, far_cell(domino)}) {
            most = std::max(most, ++covers[static_cast<std::size_t>(j) * n + static_cast<std::size_t>(i)]);
        }
    }
    std::vector<bool> inside(covers.size());
    std::transform(covers.begin(), covers.end(), inside.begin(), [](int count) { return count > 0; });
    return {detail::make_cell_ring(tiling.cells_across, inside), most};
}

Partners make_partners(const CellRing& ring, const TowerTiling& tiling) {
    Partners partners(ring.cells.size(), kNone);
    for (const Domino& domino : tiling.dominoes) {
        const auto [i, j] = far_cell(domino);
        const int near = ring.at(domino.i, domino.j);
        const int far = ring.at(i, j);
        partners[static_cast<std::size_t>(near)] = far;
        partners[static_cast<std::size_t>(far)] = near;
    }
    return partners;
}

TowerTiling make_dominoes(const CellRing& ring, const Partners& partners) {
    TowerTiling tiling{ring.cells_across, {}};
    for (std::size_t c = 0; c < partners.size(); ++c) {
        const bool along_x = partners[c] == ring.neighbors[c][detail::kEast];
        const bool along_y = partners[c] == ring.neighbors[c][detail::kNorth];
        if (along_x || along_y) tiling.dominoes.push_back({ring.cells[c][0], ring.cells[c][1], along_x});
    }
    std::sort(tiling.dominoes.begin(), tiling.dominoes.end());
    return tiling;
}

/// A quarter turn maps a single loop through all cells to itself, by a quarter of its length, and odd dominoes to even ones: the quarter
/// must be odd. See docs/theory/structures.md, "Interlock".
int least_loops(int cells) { return cells % 8 == 4 ? 1 : 2; }

std::string describe(const TilingSettings& s) {
    return fmt::format("ring of {0} x {0} cells between the radii {1} and {2}", s.cells_across, s.inner_radius, s.outer_radius);
}

void check_settings(const TilingSettings& s) {
    if (s.cells_across < 2 || s.cells_across > kLargestGrid) {
        throw SceneError(fmt::format("tiling: {} cells across (must be 2 to {}); choose another grid", s.cells_across, kLargestGrid));
    }
    if (!(s.inner_radius >= 0.0) || !(s.outer_radius > s.inner_radius)) {
        throw SceneError(
            fmt::format("tiling: radii {} and {} leave no ring (need 0 <= inner < outer); choose others", s.inner_radius, s.outer_radius));
    }
}

Partners find_cover(const CellRing& ring, const TilingSettings& settings, detail::SplitMix64& random, std::uint64_t& nodes) {
    const int black = static_cast<int>(
        std::count_if(ring.cells.begin(), ring.cells.end(), [](const auto& cell) { return (cell[0] + cell[1]) % 2 == 0; }));
    if (ring.size() == 0 || 2 * black != ring.size()) {
        throw SceneError(
            fmt::format("tiling: the {} has {} cells, {} of them black as on a chessboard (dominoes need equal numbers, not "
                        "zero); change a radius",
                        describe(settings), ring.size(), black));
    }
    detail::Cover cover;
    for (std::uint64_t limit = kFirstNodeLimit; !cover.partners && !cover.exhausted && limit <= kLastNodeLimit; limit *= 2) {
        cover = detail::cover_ring(ring, random, limit);
        nodes += cover.nodes;
    }
    if (!cover.partners) {
        throw SceneError(
            fmt::format("tiling: the {} ({} cells) has no two-fold tiling without a domino in common with its quarter turn "
                        "({} after {} placements); change a radius",
                        describe(settings), ring.size(), cover.exhausted ? "proved" : "none found", nodes));
    }
    return *std::move(cover.partners);
}

bool is_domino(const detail::Json& item) {
    return item.is_array() && item.size() == 3 && item[0].is_number_integer() && item[1].is_number_integer() && item[2].is_string() &&
           (item[2] == "x" || item[2] == "y");
}

/// Moves the dominoes so that the square their cells span starts at (0, 0).
TowerTiling fit_to_grid(std::vector<Domino> dominoes, const std::string& origin) {
    std::array<int, 2> low{dominoes.front().i, dominoes.front().j};
    std::array<int, 2> high = low;
    for (const Domino& domino : dominoes) {
        const auto [i, j] = far_cell(domino);
        low = {std::min(low[0], domino.i), std::min(low[1], domino.j)};
        high = {std::max(high[0], i), std::max(high[1], j)};
    }
    const std::array<int, 2> span{high[0] - low[0] + 1, high[1] - low[1] + 1};
    if (span[0] != span[1] || span[0] > kLargestGrid) {
        throw SceneError(
            fmt::format("{}: the dominoes span {} x {} cells (must be a square of at most {} cells a side, so that the layer "
                        "above can be the same, turned by a quarter); correct the list",
                        origin, span[0], span[1], kLargestGrid));
    }
    for (Domino& domino : dominoes) {
        domino.i -= low[0];
        domino.j -= low[1];
    }
    std::sort(dominoes.begin(), dominoes.end());
    return {span[0], std::move(dominoes)};
}

/// Largest cell index read from a file; keeps sums of indices far from overflow.
constexpr int kLargestIndex = 1'000'000;

}  // namespace

TilingSettings find_tiling_preset(std::string_view name) {
    const auto* const found =
        std::find_if(kPresets.begin(), kPresets.end(), [&](const NamedTiling& preset) { return preset.name == name; });
    if (found == kPresets.end()) {
        throw SceneError(
            fmt::format("tiling: \"{}\" is not a known preset; use one of {}", std::string(name), fmt::join(tiling_preset_names(), ", ")));
    }
    return found->settings;
}

std::vector<std::string> tiling_preset_names() {
    std::vector<std::string> names;
    names.reserve(kPresets.size());
    for (const NamedTiling& preset : kPresets) names.emplace_back(preset.name);
    return names;
}

TowerTiling rotate_quarter_turn(const TowerTiling& tiling) {
    TowerTiling turned{tiling.cells_across, {}};
    const int last = tiling.cells_across - 1;
    for (const Domino& domino : tiling.dominoes) {
        // cell (i, j) goes to (last − j, i); of a domino along y the far cell becomes the lower left one
        turned.dominoes.push_back(domino.along_x ? Domino{last - domino.j, domino.i, false} : Domino{last - domino.j - 1, domino.i, true});
    }
    std::sort(turned.dominoes.begin(), turned.dominoes.end());
    return turned;
}

TilingQuality measure_tiling(const TowerTiling& tiling) {
    TilingQuality quality;
    const Plan plan = make_plan(tiling);
    const TowerTiling turned = rotate_quarter_turn(tiling);
    TowerTiling sorted = tiling;
    std::sort(sorted.dominoes.begin(), sorted.dominoes.end());

    quality.blocks = static_cast<int>(tiling.dominoes.size());
    quality.covers_once = plan.most_covers == 1;
    quality.same_plan_turned =
        std::find(plan.ring.quarter_turn.begin(), plan.ring.quarter_turn.end(), kNone) == plan.ring.quarter_turn.end();
    quality.two_fold = rotate_quarter_turn(turned) == sorted;
    quality.least_loops = least_loops(plan.ring.size());
    quality.blocks_along_x =
        static_cast<int>(std::count_if(sorted.dominoes.begin(), sorted.dominoes.end(), [](const Domino& d) { return d.along_x; }));

    std::vector<Domino> shared;
    std::set_intersection(sorted.dominoes.begin(), sorted.dominoes.end(), turned.dominoes.begin(), turned.dominoes.end(),
                          std::back_inserter(shared));
    quality.shared_dominoes = static_cast<int>(shared.size());

    // the bond of two layers is defined only where each covers the plan once
    if (!quality.covers_once || !quality.same_plan_turned) return quality;
    const Partners odd = make_partners(plan.ring, tiling);
    const Partners even = detail::turn_partners(plan.ring, odd);
    quality.loops = detail::count_loops(odd, even).loops;
    const detail::JointCounts joints = detail::count_joints(plan.ring, odd, even);
    quality.through_joints = joints.through;
    quality.longest_straight_joint = joints.longest;
    quality.layer_joints = joints.layer;
    return quality;
}

TilingSearch search_tower_tiling(const TilingSettings& settings) {
    check_settings(settings);
    const CellRing ring = detail::make_cell_ring(settings);
    detail::SplitMix64 random(kSeed);
    TilingSearch search;
    Partners partners = find_cover(ring, settings, random, search.nodes);

    const auto cells = static_cast<std::uint64_t>(ring.size());
    for (int round = 0; round < kRounds; ++round) {
        search.flips += detail::improve_interlock(ring, partners, random, kTrialsPerCellSquared * cells * cells);
        search.tiling = make_dominoes(ring, partners);
        const TilingQuality quality = measure_tiling(search.tiling);
        if (quality.loops <= quality.least_loops && quality.through_joints == 0) break;
    }
    return search;
}

TowerTiling make_tower_tiling(const TilingSettings& settings) { return search_tower_tiling(settings).tiling; }

TowerTiling parse_tiling(std::string_view json_text, const std::string& origin) {
    const detail::Json list = detail::parse_json(json_text, origin);
    if (!list.is_array() || list.empty()) {
        throw SceneError(fmt::format("{}: not a list of dominoes; write [[i, j, \"x\"], [i, j, \"y\"], ...]", origin));
    }
    std::vector<Domino> dominoes;
    for (std::size_t k = 0; k < list.size(); ++k) {
        const detail::Json& item = list[k];
        const auto in_range = [](const detail::Json& index) { return index >= 0 && index <= kLargestIndex; };
        if (!is_domino(item) || !in_range(item[0]) || !in_range(item[1])) {
            throw SceneError(fmt::format("{}: /{}: {} is not a domino (column, row, direction); write [i, j, \"x\"] or [i, j, \"y\"]",
                                         origin, k, item.dump()));
        }
        dominoes.push_back({item[0].get<int>(), item[1].get<int>(), item[2] == "x"});
    }

    TowerTiling tiling = fit_to_grid(std::move(dominoes), origin);
    const TilingQuality quality = measure_tiling(tiling);
    if (!quality.covers_once) throw SceneError(fmt::format("{}: two dominoes cover the same cell; correct the list", origin));
    if (!quality.same_plan_turned) {
        throw SceneError(
            fmt::format("{}: the plan differs from its quarter turn (the layer above covers other cells); correct the list", origin));
    }
    if (quality.shared_dominoes > 0) {
        throw SceneError(
            fmt::format("{}: {} dominoes are also in the quarter turn of the list (their blocks would stand on one block "
                        "instead of two); correct the list",
                        origin, quality.shared_dominoes));
    }
    return tiling;
}

TowerTiling read_tiling(const std::filesystem::path& path) { return parse_tiling(detail::read_text(path), path.string()); }

}  // namespace musim::lsdem
