#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace musim::lsdem {

/// A block's place in a layer: the cell (i, j) and its neighbor one step along x (i + 1) or y (j + 1). Cells count from the lower left
/// corner of the grid.
struct Domino {
    int i = 0;
    int j = 0;
    bool along_x = true;

    bool operator==(const Domino&) const = default;
    friend bool operator<(const Domino& a, const Domino& b) { return std::tie(a.i, a.j, a.along_x) < std::tie(b.i, b.j, b.along_x); }
};

/// The ring of cells that a tiling covers: those of a square grid whose centres lie at  inner_radius < r/p ≤ outer_radius  from its
/// middle, p being the pitch of the cells. The defaults are the tower of [Harmon23]: 376 cells, 188 blocks a layer.
struct TilingSettings {
    int cells_across = 26;        ///< cells along each side of the grid
    double inner_radius = 6.37;   ///< in pitches; 0 for a solid plan
    double outer_radius = 12.59;  ///< in pitches

    bool operator==(const TilingSettings&) const = default;
};

/// A named ring: "full" (188 blocks a layer), "ring_18" and "ring_14" (hollow), "solid_22", "solid_6" and "solid_2".
/// Throws SceneError with the known names for any other.
TilingSettings find_tiling_preset(std::string_view name);

/// The names that find_tiling_preset knows.
std::vector<std::string> tiling_preset_names();

/// Tiling T of the odd layers (1, 3, ...) of a tower, sorted. The even layers are rot90 T, a quarter turn about the middle of the grid.
struct TowerTiling {
    int cells_across = 0;
    std::vector<Domino> dominoes;

    bool operator==(const TowerTiling&) const = default;
};

/// Image of the tiling under a quarter turn (counterclockwise, x to y) about the middle of the grid, sorted.
TowerTiling rotate_quarter_turn(const TowerTiling& tiling);

/// Quality of a tiling T as one half of a tower's bond, the other half being rot90 T. See docs/theory/structures.md, "Interlock".
struct TilingQuality {
    int blocks = 0;                  ///< dominoes of a layer
    bool covers_once = false;        ///< no cell is covered twice
    bool same_plan_turned = false;   ///< rot90 T covers the same cells as T
    bool two_fold = false;           ///< T = rot180 T
    int shared_dominoes = 0;         ///< blocks that stand exactly on one block below
    int loops = 0;                   ///< parts of the tower that no block ties to each other
    int least_loops = 0;             ///< lower bound of `loops` for this number of cells, see docs/theory/structures.md
    int blocks_along_x = 0;          ///< in T; rot90 T has as many along y
    int through_joints = 0;          ///< straight joints from free edge to free edge through all layers
    int longest_straight_joint = 0;  ///< longest straight joint through all layers, in pitches
    int layer_joints = 0;            ///< straight joints from free edge to free edge within T alone

    /// Every block rests on exactly two blocks of the layer below.
    bool stands() const { return covers_once && same_plan_turned && shared_dominoes == 0; }
};

/// Measures a tiling; pure. All counts refer to the two alternating layers T and rot90 T.
TilingQuality measure_tiling(const TowerTiling& tiling);

/// Search by which a tiling was found.
struct TilingSearch {
    TowerTiling tiling;
    std::uint64_t nodes = 0;  ///< placements tried by the exact cover
    std::uint64_t flips = 0;  ///< flips accepted while the interlock was improved
};

/// Finds a tiling T = rot180 T of the ring that shares no domino with rot90 T, with as few loops and straight joints as it can.
///
/// Exact cover of the cells by pairs of opposite dominoes, then simulated annealing over symmetric flips; integers only, so that the
/// result is the same everywhere. See docs/theory/structures.md, "The tower's tiling". Throws SceneError when the ring is empty or has no
/// such tiling.
TilingSearch search_tower_tiling(const TilingSettings& settings);

/// The tiling of search_tower_tiling.
TowerTiling make_tower_tiling(const TilingSettings& settings);

/// Reads a tiling from JSON text: a list of dominoes [[i, j, "x"|"y"], ...]. `origin` names the text in messages. The grid is the square
/// that the cells span. Throws SceneError when the text is malformed or the blocks would not each rest on exactly two.
TowerTiling parse_tiling(std::string_view json_text, const std::string& origin);

/// parse_tiling of a file. Throws SceneError also when the file cannot be read.
TowerTiling read_tiling(const std::filesystem::path& path);

}  // namespace musim::lsdem
