#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lsdem/results/summary.hpp"
#include "lsdem/scene/scene.hpp"
#include "scaling/laws/model_scales.hpp"
#include "scaling/laws/similitude.hpp"
#include "scaling/structures/distortion.hpp"
#include "scaling/text_table.hpp"

namespace musim::cli {

/// Named factors as one JSON object.
nlohmann::json to_json(const std::vector<scaling::NamedFactor>& factors);

/// {"law", "chosen", "factors"}, as lsdem::to_json() of a similitude; the length that is chosen goes by its name where it is not l.
nlohmann::json to_json(const scaling::ModelScales& scales);

/// "height H 0.04, width 0.012, " where these may scale apart; nothing of a similitude.
std::string describe_lengths(const scaling::ModelScales& scales);

/// Treatment of components that shake vertically, and to a_vertical/g, where that is not what is done to the others: a line, or nothing.
std::string describe_vertical(const std::vector<std::string>& components, const scaling::ModelScales& scales);

/// A table of factors under a title.
scaling::TextTable make_factors_table(const std::string& title, const std::vector<scaling::NamedFactor>& factors);

/// One line per distortion, or that there is none; and the same on stdout.
std::vector<std::string> describe_distortions(const std::vector<scaling::Distortion>& distortions);
void print_distortions(const std::vector<scaling::Distortion>& distortions);

/// A line that names the elasticity of the blocks themselves, which is no group of rigid blocks in contact, where the same solid does not
/// keep it; else nothing.
std::vector<std::string> describe_elasticity(const scaling::ModelScales& scales);

/// If the run diverged, says so on stderr in one line with block, time and the step that would work, and returns true.
bool report_divergence(const std::string& where, const lsdem::RunResult& run);

/// One line on stderr, `musim: warning: ...`, for everything doubtful about a run that reached its end.
void report_warnings(const std::string& where, const lsdem::RunResult& run);

/// The scene of a file; what is to be said about its text, on stderr, `musim: warning: ...`.
lsdem::Scene read_scene(const std::filesystem::path& file);

/// Remarks at the end about how values of a scene's text were understood: unit weights, numbers without a unit.
void note_reading(const lsdem::Scene& scene);

/// One line on stderr, `musim: warning: ...`, for every motion of a scene that its duration cuts.
void note_cut_motions(const std::string& where, const lsdem::Scene& scene);

}  // namespace musim::cli
