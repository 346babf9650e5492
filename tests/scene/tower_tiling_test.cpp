#include "lsdem/scene/tower_tiling.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include "tests/scene/made_scene.hpp"

using namespace musim::lsdem;
using musim::lsdem::testing::check_message;
using musim::lsdem::testing::error_of;

namespace {

using Cell = std::array<int, 2>;

std::array<Cell, 2> cells_of(const Domino& domino) {
    return {Cell{domino.i, domino.j}, domino.along_x ? Cell{domino.i + 1, domino.j} : Cell{domino.i, domino.j + 1}};
}

/// Number of times that each cell is covered, counted without the library's own plan.
std::map<Cell, int> count_covers(const TowerTiling& tiling) {
    std::map<Cell, int> covers;
    for (const Domino& domino : tiling.dominoes) {
        for (const Cell& cell : cells_of(domino)) ++covers[cell];
    }
    return covers;
}

/// Index of the domino on each cell.
std::map<Cell, std::size_t> index_cells(const TowerTiling& tiling) {
    std::map<Cell, std::size_t> index;
    for (std::size_t k = 0; k < tiling.dominoes.size(); ++k) {
        for (const Cell& cell : cells_of(tiling.dominoes[k])) index[cell] = k;
    }
    return index;
}

/// Connected parts of the blocks of two alternating layers, by union-find over blocks that share a cell.
int count_parts(const TowerTiling& odd, const TowerTiling& even) {
    const auto below = index_cells(odd);
    std::vector<std::size_t> parent(odd.dominoes.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t k) {
        while (parent[k] != k) k = parent[k];
        return k;
    };
    for (const Domino& domino : even.dominoes) {
        const auto cells = cells_of(domino);
        parent[root(below.at(cells[0]))] = root(below.at(cells[1]));
    }
    int parts = 0;
    for (std::size_t k = 0; k < parent.size(); ++k) parts += parent[k] == k ? 1 : 0;
    return parts;
}

}  // namespace

TEST_CASE("every preset ring is tiled so that each block rests on exactly two blocks of the layer below") {
    for (const std::string& name : tiling_preset_names()) {
        CAPTURE(name);
        const TilingSettings settings = find_tiling_preset(name);
        const TowerTiling odd = make_tower_tiling(settings);
        const TowerTiling even = rotate_quarter_turn(odd);

        // exactly the cells of the ring, once each, in both layers
        const auto covers = count_covers(odd);
        std::map<Cell, int> ring;
        const int n = settings.cells_across;
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                const double r = std::hypot(i + 0.5 - 0.5 * n, j + 0.5 - 0.5 * n);
                if (r > settings.inner_radius && r <= settings.outer_radius) ring[{i, j}] = 1;
            }
        }
        CHECK(covers == ring);
        CHECK(count_covers(even) == ring);

        // two supports each, from below and from above
        const auto below = index_cells(odd);
        for (const Domino& domino : even.dominoes) {
            const auto cells = cells_of(domino);
            CHECK(below.at(cells[0]) != below.at(cells[1]));
        }

        // two-fold symmetry: the layer after next is the first one again
        CHECK(rotate_quarter_turn(even) == odd);
        const TilingQuality quality = measure_tiling(odd);
        CHECK(quality.stands());
        CHECK(quality.two_fold);
        CHECK(quality.blocks == static_cast<int>(odd.dominoes.size()));
    }
}

TEST_CASE(
    "the full tower has 188 blocks a layer in both directions, bonded into the fewest possible parts without a straight joint through") {
    const TilingSearch search = search_tower_tiling(find_tiling_preset("full"));
    const TilingQuality quality = measure_tiling(search.tiling);

    CHECK(search.tiling == make_tower_tiling(TilingSettings{}));
    CHECK(quality.blocks == 188);
    CHECK(quality.loops == 2);  // 376 = 8·47 cells: one loop is impossible, see docs/theory/structures.md
    CHECK(quality.least_loops == 2);
    CHECK(quality.through_joints == 0);
    CHECK(quality.longest_straight_joint <= 3);
    CHECK(quality.blocks_along_x >= 188 / 3);
    CHECK(quality.blocks_along_x <= 2 * 188 / 3);
    CHECK(search.nodes < 2000);
}

TEST_CASE("the loops of a tiling are the parts of the tower that no block ties to each other") {
    for (const std::string& name : tiling_preset_names()) {
        CAPTURE(name);
        const TowerTiling odd = make_tower_tiling(find_tiling_preset(name));
        const TilingQuality quality = measure_tiling(odd);
        CHECK(quality.loops == count_parts(odd, rotate_quarter_turn(odd)));
        CHECK(quality.loops == quality.least_loops);
    }
}

TEST_CASE("a tiling is the same every time it is made") {
    CHECK(make_tower_tiling(TilingSettings{}) == make_tower_tiling(TilingSettings{}));
    CHECK(search_tower_tiling(find_tiling_preset("solid_22")).flips == search_tower_tiling(find_tiling_preset("solid_22")).flips);
}

TEST_CASE("four quarter turns of a tiling are the tiling") {
    const TowerTiling tiling{3, {{0, 0, true}, {2, 0, false}}};
    TowerTiling turned = tiling;
    for (int k = 0; k < 4; ++k) turned = rotate_quarter_turn(turned);
    CHECK(turned == tiling);
    // by hand: (0,0)-(1,0) goes to (2,0)-(2,1), and (2,0)-(2,1) to (2,2)-(1,2)
    CHECK(rotate_quarter_turn(tiling).dominoes == std::vector<Domino>{{1, 2, true}, {2, 0, false}});
}

TEST_CASE("measuring finds the faults of a poor tiling") {
    // brick courses of one direction: its quarter turn shares nothing, but the 2 x 2 squares stand beside each other without bond
    const TowerTiling squares{
        4, {{0, 0, true}, {0, 1, true}, {2, 0, true}, {2, 1, true}, {0, 2, true}, {0, 3, true}, {2, 2, true}, {2, 3, true}}};
    const TilingQuality quality = measure_tiling(squares);
    CHECK(quality.stands());
    CHECK(quality.loops == 4);
    CHECK(quality.through_joints == 2);
    CHECK(quality.longest_straight_joint == 4);
    CHECK(quality.blocks_along_x == 8);

    // the pinwheel is its own quarter turn: every block stands on one block only
    const TowerTiling pinwheel{3, {{0, 0, true}, {2, 0, false}, {1, 2, true}, {0, 1, false}}};
    CHECK(measure_tiling(pinwheel).shared_dominoes == 4);
    CHECK_FALSE(measure_tiling(pinwheel).stands());

    CHECK_FALSE(measure_tiling({2, {{0, 0, true}, {0, 0, false}}}).covers_once);
    CHECK_FALSE(measure_tiling({3, {{0, 0, true}}}).same_plan_turned);
}

TEST_CASE("a ring without a tiling is refused with the reason") {
    check_message(error_of([] { make_tower_tiling({.cells_across = 3, .inner_radius = 0.0, .outer_radius = 2.2}); }),
                  {"8 cells", "has no two-fold tiling", "proved", "change a radius"});
    check_message(error_of([] { make_tower_tiling({.cells_across = 5, .inner_radius = 1.2, .outer_radius = 1.5}); }),
                  {"4 cells", "4 of them black"});
    check_message(error_of([] { make_tower_tiling({.cells_across = 4, .inner_radius = 0.1, .outer_radius = 0.2}); }), {"0 cells"});
    check_message(error_of([] { make_tower_tiling({.cells_across = 1000}); }), {"1000 cells across", "2 to 200"});
    check_message(error_of([] { make_tower_tiling({.cells_across = 8, .inner_radius = 3.0, .outer_radius = 2.0}); }), {"radii 3 and 2"});
    check_message(error_of([] { find_tiling_preset("ring_15"); }), {"\"ring_15\"", "ring_14"});
}

TEST_CASE("a tiling is read from text wherever its grid starts") {
    CHECK(parse_tiling(R"([[5, 7, "x"], [5, 8, "x"]])", "text") == TowerTiling{2, {{0, 0, true}, {0, 1, true}}});
}

TEST_CASE("a tiling file that no tower can stand on is refused with the reason") {
    check_message(error_of([] { parse_tiling("[[0,0,\"x\"]", "t.json"); }), {"t.json:1:", "not valid JSON"});
    check_message(error_of([] { parse_tiling("{}", "t.json"); }), {"t.json: not a list"});
    check_message(error_of([] { parse_tiling(R"([[0,0,"x"],[0,1,"z"]])", "t.json"); }), {"t.json: /1:", "not a domino"});
    check_message(error_of([] { parse_tiling(R"([[0,0,"x"],[-1,1,"x"]])", "t.json"); }), {"t.json: /1:"});
    check_message(error_of([] { parse_tiling(R"([[0,0,"x"],[0,0,"y"]])", "t.json"); }), {"cover the same cell"});
    check_message(error_of([] { parse_tiling(R"([[0,0,"x"],[0,1,"x"],[2,0,"y"]])", "t.json"); }), {"span 3 x 2"});
    check_message(error_of([] { parse_tiling(R"([[0,0,"x"],[2,0,"y"],[1,2,"x"],[0,1,"y"]])", "t.json"); }), {"would stand on one block"});
    check_message(error_of([] { parse_tiling(R"([[0,0,"x"],[0,1,"y"],[1,2,"x"]])", "t.json"); }), {"differs from its quarter turn"});
    check_message(error_of([] { read_tiling("/nowhere/t.json"); }), {"/nowhere/t.json", "cannot be read"});
}
