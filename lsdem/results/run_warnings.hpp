#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lsdem/results/history.hpp"

namespace musim::lsdem {

/// Deepest overlap that still counts as contact [fraction of a block's height]. Stiff blocks that fall on each other overlap by a few
/// hundredths at a corner and by 1e-5 at rest; beyond this they may end up inside each other. Changes what is reported only.
inline constexpr double kDeepOverlap = 0.05;

/// Energy balance that counts as open [-]: ten times what collisions at the default step may book wrongly (docs/theory/overlap_contact.md).
inline constexpr double kOpenBalance = 0.1;

/// A structure begins at rest when its base bears its weight to within this [-], and no block moves up or down by more than this part of
/// the motion's peak velocity [-].
inline constexpr double kUnborneWeight = 1e-3, kFastStart = 0.01;

/// A kind of divergence as result files name it.
std::string_view name_of(Divergence::Kind kind);

/// Why a run diverged, in one sentence: time, block, its step, the critical step of the structure as built, and the step to take instead:
/// the default one when the run's was above the critical step, else half of the run's. Requires a run that diverged.
std::string describe_divergence(const RunResult& run);

/// Sentence about a time step above the critical one [s], and which to take.
std::string describe_large_step(double time_step, double critical);

/// Which block fell while a structure was prepared, of several the one that moved furthest for its smallest edge: where it was drawn, where
/// it is, how far it turned, and how many fell in all. Requires one.
std::string describe_fallen(const std::vector<MovedBlock>& fallen, const BlockTable& blocks);

/// Why a specimen counts as not at rest, and what to do: a damping rate that is too large leaves blocks creeping when patience
/// (Settling::patience, as many times 1/α) ends; one that is smaller gives them more time and less resistance.
std::string describe_unrest(const Rest& rest);

/// Doubts about a run that reached its end, one sentence each, with numbers and what to do. Blocks that
/// fell while the structure was prepared; a specimen that did not come to rest (Settling::patience ran out), or a structure that was not at
/// rest when its motion began (kUnborneWeight, kFastStart), unless it is listed in motion or in the air; a time step above the critical one
/// (losses in contacts can hold an instability down, so that neither the run nor its energy balance shows it); blocks that passed deep into
/// each other (kDeepOverlap); an open energy balance (kOpenBalance). Empty for a sound run, and for one that diverged.
std::vector<std::string> find_warnings(const RunResult& run);

}  // namespace musim::lsdem
