#include "lsdem/scene/detail/tiling_search.hpp"

#include <array>
#include <cstddef>
#include <cstdlib>
#include <utility>
#include <vector>

namespace musim::lsdem::detail {

namespace {

/// Weights of the penalty. A loop is a part of the tower of its own, so it outweighs everything; shared dominoes are only discouraged,
/// because forbidding them freezes the search (the result is taken from the states without any).
constexpr int kLoopWeight = 20;
constexpr int kSharedWeight = 4;
constexpr int kThroughWeight = 3;
constexpr int kLayerWeight = 1;
constexpr int kImbalanceWeight = 1;  ///< per domino that one direction has more than the other, over 8

/// Worsening that is accepted every other time at the start of the search, falling to zero along it. A flip and its images change four
/// loops at once, so the start lets a few of them part and join again. Chosen by trial on the full tower; affects only which tiling is
/// found.
constexpr std::uint64_t kStartTemperature = 40;

std::size_t at(int cell) { return static_cast<std::size_t>(cell); }

int half_turn(const CellRing& ring, int cell) { return ring.quarter_turn[at(ring.quarter_turn[at(cell)])]; }

/// Depth-first exact cover; see cover_ring.
class CoverSearch {
  public:
    CoverSearch(const CellRing& ring, SplitMix64& random, std::uint64_t node_limit)
        : ring_(ring), random_(random), node_limit_(node_limit), partners_(ring.cells.size(), kNone) {}

    Cover run() {
        Cover cover;
        if (extend()) cover.partners = partners_;
        cover.nodes = nodes_;
        cover.exhausted = !cover.partners && nodes_ < node_limit_;
        return cover;
    }

  private:
    struct Choices {
        int cell = kNone;
        int count = 5;
        std::array<int, 4> partners{};
    };

    bool extend() {
        Choices choices = find_tightest_cell();
        if (choices.cell == kNone) return true;
        for (int k = choices.count; k > 0; --k) {
            const auto pick = random_.below(static_cast<std::uint64_t>(k));
            const int partner = std::exchange(choices.partners[pick], choices.partners[at(k - 1)]);
            if (nodes_ == node_limit_) return false;
            ++nodes_;
            place(choices.cell, partner);
            if (extend()) return true;
            remove(choices.cell, partner);
        }
        return false;
    }

    Choices find_tightest_cell() const {
        Choices tightest;
        for (int cell = 0; cell < ring_.size() && tightest.count > 0; ++cell) {
            if (partners_[at(cell)] != kNone) continue;
            Choices choices{.cell = cell, .count = 0, .partners = {}};
            for (const int neighbor : ring_.neighbors[at(cell)]) {
                if (neighbor != kNone && fits(cell, neighbor)) choices.partners[at(choices.count++)] = neighbor;
            }
            if (choices.count < tightest.count) tightest = choices;
        }
        return tightest;
    }

    /// The domino is free, differs from its opposite, and its quarter turn is not in the tiling.
    bool fits(int cell, int neighbor) const {
        if (partners_[at(neighbor)] != kNone) return false;
        const int opposite = half_turn(ring_, cell);
        if (opposite == cell || opposite == neighbor || half_turn(ring_, neighbor) == neighbor) return false;
        return partners_[at(ring_.quarter_turn[at(cell)])] != ring_.quarter_turn[at(neighbor)];
    }

    void place(int cell, int partner) { set_pair(cell, partner, partner, cell); }
    void remove(int cell, int partner) { set_pair(cell, partner, kNone, kNone); }

    /// Writes a domino's entries, and by half turn those of the opposite domino.
    void set_pair(int cell, int partner, int of_cell, int of_partner) {
        partners_[at(cell)] = of_cell;
        partners_[at(partner)] = of_partner;
        partners_[at(half_turn(ring_, cell))] = of_cell == kNone ? kNone : half_turn(ring_, of_cell);
        partners_[at(half_turn(ring_, partner))] = of_partner == kNone ? kNone : half_turn(ring_, of_partner);
    }

    const CellRing& ring_;
    SplitMix64& random_;
    std::uint64_t node_limit_;
    std::uint64_t nodes_ = 0;
    Partners partners_;
};

/// The four cells of a 2 × 2 square, from its lower left one.
struct Square {
    int south_west, south_east, north_west, north_east;
};

/// The square at `cell`; south_west = kNone when it leaves the plan.
Square find_square(const CellRing& ring, int cell) {
    const int east = ring.neighbors[at(cell)][kEast];
    const int north = ring.neighbors[at(cell)][kNorth];
    const int north_east = north == kNone ? kNone : ring.neighbors[at(north)][kEast];
    if (east == kNone || north_east == kNone) return {kNone, kNone, kNone, kNone};
    return {cell, east, north, north_east};
}

void join(Partners& partners, int a, int b) {
    partners[at(a)] = b;
    partners[at(b)] = a;
}

/// Turns the two parallel dominoes that fill a square by a quarter; false when the square is not filled by two.
bool flip(Partners& partners, const Square& square) {
    const auto& [sw, se, nw, ne] = square;
    if (partners[at(sw)] == se && partners[at(nw)] == ne) {
        join(partners, sw, nw);
        join(partners, se, ne);
        return true;
    }
    if (partners[at(sw)] == nw && partners[at(se)] == ne) {
        join(partners, sw, se);
        join(partners, nw, ne);
        return true;
    }
    return false;
}

/// Flips a square and its opposite. A second call undoes the first.
bool flip_with_opposite(const CellRing& ring, Partners& partners, const Square& square) {
    if (!flip(partners, square)) return false;
    const Square opposite{half_turn(ring, square.north_east), half_turn(ring, square.north_west), half_turn(ring, square.south_east),
                          half_turn(ring, square.south_west)};
    if (opposite.south_west == square.south_west || flip(partners, opposite)) return true;
    flip(partners, square);
    return false;
}

/// Number of dominoes along one direction beyond those along the other.
int count_imbalance(const CellRing& ring, const Partners& odd) {
    int cells_along_x = 0;
    for (std::size_t c = 0; c < odd.size(); ++c) {
        if (odd[c] == ring.neighbors[c][kEast] || odd[c] == ring.neighbors[c][kWest]) ++cells_along_x;
    }
    return std::abs(cells_along_x - (ring.size() - cells_along_x)) / 2;
}

struct Score {
    int penalty = 0;
    int shared = 0;
};

Score compute_score(const CellRing& ring, const Partners& odd) {
    const Partners even = turn_partners(ring, odd);
    const LoopCounts loops = count_loops(odd, even);
    const JointCounts joints = count_joints(ring, odd, even);
    return {kLoopWeight * loops.loops + kSharedWeight * loops.shared + kThroughWeight * joints.through + kLayerWeight * joints.layer +
                joints.sum_of_squares + kImbalanceWeight * count_imbalance(ring, odd) / 8,
            loops.shared};
}

}  // namespace

Cover cover_ring(const CellRing& ring, SplitMix64& random, std::uint64_t node_limit) { return CoverSearch(ring, random, node_limit).run(); }

int compute_penalty(const CellRing& ring, const Partners& partners) { return compute_score(ring, partners).penalty; }

std::uint64_t improve_interlock(const CellRing& ring, Partners& partners, SplitMix64& random, std::uint64_t trials) {
    Partners current = partners;
    int penalty = compute_penalty(ring, current);
    int best = penalty;
    std::uint64_t accepted = 0;
    for (std::uint64_t trial = 0; trial < trials; ++trial) {
        const Square square = find_square(ring, static_cast<int>(random.below(ring.cells.size())));
        if (square.south_west == kNone || !flip_with_opposite(ring, current, square)) continue;

        const Score score = compute_score(ring, current);
        const std::uint64_t allowance = random.halvings() * kStartTemperature * (trials - trial) / trials;
        if (score.penalty > penalty + static_cast<int>(allowance)) {
            flip_with_opposite(ring, current, square);
            continue;
        }
        ++accepted;
        penalty = score.penalty;
        if (score.shared == 0 && penalty < best) {
            best = penalty;
            partners = current;
        }
    }
    return accepted;
}

}  // namespace musim::lsdem::detail
