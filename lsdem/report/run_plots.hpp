#pragma once

#include <optional>
#include <vector>

#include "lsdem/report/report_content.hpp"
#include "lsdem/report/report_figure.hpp"

namespace musim::lsdem {

/// Velocities of the spine along the strongest axis of the first run, all runs scaled back to it: cm/s over s, or v/√(μ g l) over t √(μ
/// g/l) when they are of several scales; at most ten levels, the lowest at the bottom, as Fig. 8 of [Harmon23]. Nothing without a spine.
/// `pair`: of pair.json, whose twins are a band about the first run; any other object draws none.
std::optional<ReportFigure> make_spine_figure(const std::vector<ReportedRun>& runs, const nlohmann::json& pair = {});

/// Departure of the models and twins of a pair from their prototype (make_departure_plot), models in the looks of the runs of their names.
/// Nothing for a pair.json without it.
std::optional<ReportFigure> make_departure_figure(const std::vector<ReportedRun>& runs, const nlohmann::json& pair,
                                                  const std::string& name);

/// Difference of each model from the first run: √(Σ_s |v/λ_v − v_P|²)/√(max_t Σ_s |v_P|²) over time, s the blocks of the spine. Models that
/// never differ are left out, and those that sample at other dimensionless times; nothing when none is left.
std::optional<ReportFigure> make_difference_figure(const std::vector<ReportedRun>& runs);

/// Arrival over height of one run, of the methods that found a speed, with the speeds that fit it. Nothing where none did.
std::optional<ReportFigure> make_lag_figure(const ReportedRun& run);

/// Profiles over the levels, runs beside each other in the looks that they have in the other plots: residual displacement of the spine over
/// λ_l (of several runs a figure per direction), mean slip below a level over λ_l, mean rotation, tilts at the start [Harmon23, Figs. 6 and
/// 10].
std::vector<ReportFigure> make_profile_figures(const std::vector<ReportedRun>& runs);

/// Distribution of the blocks' tilts over the levels of a structure at its start [Harmon23, Fig. 6]: of each level the median, what
/// nine of ten blocks stay below, and the largest [degrees]. `layer` and `tilt` [rad] have an entry per block; blocks in layer 0 are in
/// none. `whose` stands below the title.
ReportFigure make_tilt_figure(const std::string& name, const std::string& whose, const std::vector<int>& layer,
                              const std::vector<double>& tilt);

/// Energies of one run over time, gravitational energy from its start.
ReportFigure make_energy_figure(const ReportedRun& run);

/// Energy that interfaces dissipated, level by level, over all. Nothing for results without it.
std::optional<ReportFigure> make_loss_figure(const std::vector<ReportedRun>& runs);

}  // namespace musim::lsdem
