#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "lsdem/results/failure.hpp"
#include "lsdem/results/history.hpp"
#include "scaling/laws/similitude.hpp"
#include "scaling/structures/distortion.hpp"

namespace musim::lsdem {

/// The run in one JSON object: status, blocks, steps, dt_s (whole steps, of which times and samples are multiples), substeps (in which
/// those that were not passed over were taken), critical_dt_s (null when no block can move), duration_s, wall_s, contacts
/// (pairs that touch at the end), contact_nodes (that touch, of pairs that meet by nodes; 0 where boxes overlap), state_hash,
/// energy_closure, max_overlap_over_height, base_reaction_over_weight (null without ground or gravity), outcome (see Outcome), warnings
/// (sentences, see find_warnings), and, where they apply, stage (number, time_before_s: of a later stage of a sequence), loads (of each:
/// name, largest_force_n, and displacement_m and time_s then), rest (at_rest, steps, kinetic_over_weight_height, base_reaction_over_weight:
/// how the specimen settled before the motion), left_place (block, time_s, substeps_per_step: of the first block that left its place, see
/// Leaving), collapse_time_s, failure (of a collapse: see find_failure), divergence.
nlohmann::json make_summary(const RunResult& run);

/// A failure in one object: mode, time_s, measures (fallen, outward_share, bulge, bulge_height, inward_share_above), and why when
/// undecided.
nlohmann::json to_json(const Failure& failure);

/// A similitude in one JSON object: law, the chosen factors, all derived factors.
nlohmann::json to_json(const scaling::Similitude& similitude);

/// Inverse of to_json. Throws nlohmann::json::exception for anything else, SimilitudeError for factors that no similitude has.
scaling::Similitude parse_similitude(const nlohmann::json& json);

/// A list of distortions, each with group, factor, severity and effect.
nlohmann::json to_json(const std::vector<scaling::Distortion>& distortions);

}  // namespace musim::lsdem
