#include "lsdem/scene/detail/cell_ring.hpp"

#include <algorithm>
#include <cstddef>

namespace musim::lsdem::detail {

namespace {

/// An unbroken line of joint segments while a grid line is scanned from free edge to free edge.
struct JointLine {
    int length = 0;
    bool whole = true;  ///< no domino has crossed since the free edge

    void cross() {
        length = 0;
        whole = false;
    }
};

void close_line(const JointLine& line, JointCounts& counts) {
    counts.longest = std::max(counts.longest, line.length);
    const int excess = std::max(0, line.length - 1);
    counts.sum_of_squares += excess * excess;
}

/// Cell pairs on both sides of every inner grid line, free edges as {kNone, kNone}.
std::vector<std::array<int, 2>> list_borders(const CellRing& ring) {
    std::vector<std::array<int, 2>> borders;
    for (const bool vertical : {true, false}) {
        for (int line = 0; line + 1 < ring.cells_across; ++line) {
            // one step beyond the grid ends the line
            for (int t = 0; t <= ring.cells_across; ++t) {
                const int a = vertical ? ring.at(line, t) : ring.at(t, line);
                const int b = vertical ? ring.at(line + 1, t) : ring.at(t, line + 1);
                const bool free_edge = a == kNone || b == kNone;
                if (!free_edge) borders.push_back({a, b});
                if (free_edge && !borders.empty() && borders.back()[0] != kNone) borders.push_back({kNone, kNone});
            }
        }
    }
    return borders;
}

}  // namespace

int CellRing::at(int i, int j) const {
    if (i < 0 || j < 0 || i >= cells_across || j >= cells_across) return kNone;
    return index[static_cast<std::size_t>(j) * static_cast<std::size_t>(cells_across) + static_cast<std::size_t>(i)];
}

CellRing make_cell_ring(int cells_across, const std::vector<bool>& inside) {
    CellRing ring{.cells_across = cells_across,
                  .index = std::vector<int>(inside.size(), kNone),
                  .cells = {},
                  .neighbors = {},
                  .quarter_turn = {},
                  .borders = {}};
    for (int j = 0, k = 0; j < cells_across; ++j) {
        for (int i = 0; i < cells_across; ++i, ++k) {
            const auto cell = static_cast<std::size_t>(k);
            if (!inside[cell]) continue;
            ring.index[cell] = ring.size();
            ring.cells.push_back({i, j});
        }
    }
    for (const auto& [i, j] : ring.cells) {
        ring.neighbors.push_back({ring.at(i + 1, j), ring.at(i - 1, j), ring.at(i, j + 1), ring.at(i, j - 1)});
        ring.quarter_turn.push_back(ring.at(cells_across - 1 - j, i));
    }
    ring.borders = list_borders(ring);
    return ring;
}

CellRing make_cell_ring(const TilingSettings& settings) {
    const int n = settings.cells_across;
    const double inner_squared = settings.inner_radius * settings.inner_radius;
    const double outer_squared = settings.outer_radius * settings.outer_radius;
    std::vector<bool> inside;
    inside.reserve(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const double x = i + 0.5 - 0.5 * n;
            const double y = j + 0.5 - 0.5 * n;
            const double r_squared = x * x + y * y;
            // a solid plan (inner radius 0) keeps the middle cell of an odd grid out: no two-fold tiling can cover it
            inside.push_back(r_squared > inner_squared && r_squared <= outer_squared);
        }
    }
    return make_cell_ring(n, inside);
}

Partners turn_partners(const CellRing& ring, const Partners& partner) {
    Partners turned(partner.size(), kNone);
    for (std::size_t c = 0; c < partner.size(); ++c) {
        turned[static_cast<std::size_t>(ring.quarter_turn[c])] = ring.quarter_turn[static_cast<std::size_t>(partner[c])];
    }
    return turned;
}

JointCounts count_joints(const CellRing& ring, const Partners& odd, const Partners& even) {
    JointCounts counts;
    JointLine both, single;
    for (const auto& [a, b] : ring.borders) {
        if (a == kNone) {
            close_line(both, counts);
            if (both.whole && both.length > 0) ++counts.through;
            if (single.whole && single.length > 0) ++counts.layer;
            both = single = {};
            continue;
        }
        const bool odd_crosses = odd[static_cast<std::size_t>(a)] == b;
        const bool even_crosses = even[static_cast<std::size_t>(a)] == b;
        if (odd_crosses) {
            single.cross();
        } else {
            ++single.length;
        }
        if (odd_crosses || even_crosses) {
            close_line(both, counts);
            both.cross();
        } else {
            ++both.length;
        }
    }
    return counts;
}

LoopCounts count_loops(const Partners& odd, const Partners& even) {
    LoopCounts counts;
    std::vector<bool> visited(odd.size(), false);
    for (std::size_t start = 0; start < odd.size(); ++start) {
        if (visited[start]) continue;
        ++counts.loops;
        int length = 0;
        for (std::size_t cell = start; !visited[cell]; length += 2) {
            const auto across = static_cast<std::size_t>(odd[cell]);
            visited[cell] = true;
            visited[across] = true;
            cell = static_cast<std::size_t>(even[across]);
        }
        if (length == 2) ++counts.shared;
    }
    return counts;
}

}  // namespace musim::lsdem::detail
