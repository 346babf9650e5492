#pragma once

#include <algorithm>
#include <cstdint>

#include "lsdem/motion/simulation.hpp"
#include "scaling/interruption.hpp"

namespace musim::lsdem::detail {

/// Steps between two checks at what else is to be done: progress, checkpoints, a request to stop. So many cost far more than the look.
inline constexpr std::uint64_t kPiece = 64;

/// Takes so many steps, or fewer when the simulation diverges, to the same bits as all at once. Between pieces, not at the end, `between`
/// is called with the steps taken so far, and then scaling::Interrupted thrown when the program is asked to stop.
/// `advance` takes steps, as Simulation::advance.
template <class Advance, class Between>
void advance_in_pieces(Simulation& simulation, std::uint64_t steps, const Advance& advance, const Between& between) {
    for (std::uint64_t taken = 0; true;) {
        const std::uint64_t piece = std::min(steps - taken, kPiece);
        advance(piece);
        taken += piece;
        if (taken == steps || simulation.divergence()) return;
        between(taken);
        scaling::stop_if_interrupted();
    }
}

template <class Between>
void advance_in_pieces(Simulation& simulation, std::uint64_t steps, const Between& between) {
    advance_in_pieces(
        simulation, steps, [&](std::uint64_t piece) { simulation.advance(piece); }, between);
}

}  // namespace musim::lsdem::detail
