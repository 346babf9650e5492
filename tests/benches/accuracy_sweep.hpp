#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "lsdem/run/use_record.hpp"
#include "lsdem/scene/accuracy_presets.hpp"
#include "tests/benches/accuracy_setting.hpp"

namespace musim::lsdem {

/// One setting tried on one problem.
struct AccuracyRow {
    std::string name;    ///< of the problem
    std::string family;  ///< which knob was turned: step, nodes, two-sided, grid, preset, or copy
    std::string label;   ///< of the setting within its family, "0.4", "44", "fast"
    AccuracySetting setting;
    AccuracyOutcome outcome;
    bool pareto = false;  ///< no other row of the problem has both a smaller error and a shorter run time
};

/// A problem and all its rows, those of one family together.
struct AccuracyPanel {
    std::string name;
    std::string title;
    std::vector<AccuracyRow> rows;
};

/// Tasks of `sweep_accuracy`.
struct SweepOptions {
    std::filesystem::path record;  ///< earthquake of the mini-tower; empty: the synthetic one
    AxisComponents components;
    bool quick = false;  ///< few settings, a low tower with a coarse reference; for tests
    int threads = 0;     ///< runs side by side, each on one thread; 0: all cores. No influence on errors.
    std::function<void(double)> on_progress = {};
};

struct AccuracySweep {
    std::string earthquake;
    std::vector<AccuracyPanel> panels;
};

/// Runs every closed-form case and the mini-tower with every setting: time step, contact by nodes (of the leader, of both blocks), grid
/// level sets, and the presets. Run times are processor time of the stepping thread; runs shorter than 20 ms are repeated twice and the
/// shortest time is kept. Throws what MiniTower does.
AccuracySweep sweep_accuracy(const SweepOptions& options = {});

/// Marks the rows of a panel that no other row beats in both error and run time. Rows with an infinite error, and copies, which measure
/// chaos and not a setting, never are.
void mark_pareto(AccuracyPanel& panel);

/// The settings a preset stands for.
AccuracySetting to_setting(const AccuracyPreset& preset);

/// One line per row: case, family, label, step, nodes (per face; 0 where boxes overlap), faces, sides (whose nodes; none where boxes
/// overlap), voxel, error, us_per_block_step, steps, block_steps, seconds, pareto. Numbers are the shortest text that reads back the same;
/// `inf` is a run that did not get there.
std::string make_accuracy_csv(const AccuracySweep& sweep);

}  // namespace musim::lsdem
