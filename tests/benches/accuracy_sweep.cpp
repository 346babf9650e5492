#include "tests/benches/accuracy_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "scaling/side_by_side.hpp"
#include "tests/benches/accuracy_cases.hpp"
#include "tests/benches/accuracy_tower.hpp"

namespace musim::lsdem {
namespace {

/// Runs shorter than this are repeated, since the clock and the caches make up much of them [s].
constexpr double kShortRun = 0.02;
constexpr int kRepeats = 3;

/// Courses of the quick tower.
constexpr int kQuickCourses = 6;

AccuracyRow make_row(std::string family, std::string label, const AccuracySetting& setting) {
    return {.name = {}, .family = std::move(family), .label = std::move(label), .setting = setting, .outcome = {}};
}

/// Every knob turned alone, the others at the standard preset.
std::vector<AccuracyRow> make_rows(bool quick) {
    using Counts = std::vector<int>;
    const AccuracySetting standard = to_setting(find_accuracy_preset(Accuracy::standard));
    std::vector<AccuracyRow> rows;
    const auto add_step = [&](double safety) {
        AccuracySetting setting = standard;
        setting.safety = safety;
        rows.push_back(make_row("step", fmt::format("{}", safety), setting));
    };
    const auto add_nodes = [&](const std::string& family, const Counts& counts, ContactNodes sides) {
        for (const int nodes : counts) {
            AccuracySetting setting = standard;
            setting.faces = FaceContact::nodes;
            setting.nodes_per_face = nodes;
            setting.sides = sides;
            rows.push_back(make_row(family, fmt::format("{}", nodes), setting));
        }
    };
    const auto add_grid = [&](double voxel) {
        AccuracySetting setting = standard;
        setting.voxel = voxel;
        rows.push_back(make_row("grid", fmt::format("b/{:g}", 1.0 / voxel), setting));
    };
    for (const double safety : quick ? std::vector{0.8, 0.4} : std::vector{0.8, 0.4, 0.2, 0.1}) add_step(safety);
    add_nodes("nodes", quick ? Counts{12, 44} : Counts{4, 12, 24, 44, 176, 440}, ContactNodes::leader);
    add_nodes("two-sided", quick ? Counts{44} : Counts{12, 44, 176}, ContactNodes::both);
    for (const double voxel : quick ? std::vector{0.05} : std::vector{0.1, 0.05, 0.025}) add_grid(voxel);
    for (const auto accuracy : {Accuracy::fast, Accuracy::standard, Accuracy::reference}) {
        const AccuracyPreset& preset = find_accuracy_preset(accuracy);
        if (quick && accuracy == Accuracy::reference) continue;
        rows.push_back(make_row("preset", to_string(accuracy), to_setting(preset)));
    }
    return rows;
}

/// The outcome of one setting, with the least time of a few repeats of a short run.
AccuracyOutcome run_case(const AccuracyCase& problem, const AccuracySetting& setting) {
    AccuracyOutcome outcome = problem.run(setting);
    for (int again = 1; again < kRepeats && outcome.seconds < kShortRun; ++again)
        outcome.seconds = std::min(outcome.seconds, problem.run(setting).seconds);
    return outcome;
}

/// The first row with the same setting, which may be the row itself; a setting that two families share is run once.
std::size_t find_first(const std::vector<AccuracyRow>& rows, std::size_t row) {
    const auto same = [&](const AccuracyRow& other) {
        return other.setting == rows[row].setting && (other.family == "copy") == (rows[row].family == "copy");
    };
    return static_cast<std::size_t>(std::find_if(rows.begin(), rows.end(), same) - rows.begin());
}

/// The converged run of the tower: steps far shorter than those of the finest preset.
AccuracySetting make_tower_reference(bool quick) { return {.safety = quick ? 0.2 : 0.025}; }

/// The two panels of the tower: its motion before chaos sets in, and its peak velocity over the whole window.
class TowerPanels {
  public:
    TowerPanels(const SweepOptions& options, const std::vector<AccuracyRow>& rows)
        : tower_(options.record, options.components, options.quick ? kQuickCourses : kMiniTowerCourses),
          quick_(options.quick),
          rows_(rows) {
        // what one unit in the last place does to the reference
        if (!quick_) rows_.push_back(make_row("copy", "one ulp", make_tower_reference(quick_)));
        motions_.resize(rows_.size());
    }

    void add_jobs(std::vector<std::function<void()>>& jobs) {
        jobs.emplace_back([this] { reference_ = tower_.run(make_tower_reference(quick_)); });
        for (std::size_t r = rows_.size(); r-- > 0;) {
            if (find_first(rows_, r) != r) continue;
            jobs.emplace_back([this, r] { motions_[r] = tower_.run(rows_[r].setting, rows_[r].family == "copy"); });
        }
    }

    void add_panels(std::vector<AccuracyPanel>& panels) const {
        AccuracyPanel motion{"tower", "Mini-tower: motion of the top", rows_},
            peak{"tower_peak", "Mini-tower: peak velocity of the top", rows_};
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            const TopMotion& top = motions_[find_first(rows_, r)];
            motion.rows[r].outcome = peak.rows[r].outcome = top.cost;
            motion.rows[r].outcome.error = compare_tops(top, reference_);
            peak.rows[r].outcome.error = compare_peaks(top, reference_);
        }
        panels.push_back(std::move(motion));
        panels.push_back(std::move(peak));
    }

    const std::string& earthquake() const { return tower_.description(); }

  private:
    MiniTower tower_;
    bool quick_;
    std::vector<AccuracyRow> rows_;
    TopMotion reference_;
    std::vector<TopMotion> motions_;
};

}  // namespace

AccuracySetting to_setting(const AccuracyPreset& preset) { return {.safety = preset.safety}; }

void mark_pareto(AccuracyPanel& panel) {
    const auto counts = [](const AccuracyRow& row) { return std::isfinite(row.outcome.error) && row.family != "copy"; };
    for (AccuracyRow& row : panel.rows) {
        const auto beats = [&](const AccuracyRow& other) {
            if (!counts(other)) return false;
            const AccuracyOutcome &a = other.outcome, &b = row.outcome;
            return a.error <= b.error && a.seconds <= b.seconds && (a.error < b.error || a.seconds < b.seconds);
        };
        row.pareto = counts(row) && std::none_of(panel.rows.begin(), panel.rows.end(), beats);
    }
}

AccuracySweep sweep_accuracy(const SweepOptions& options) {
    const std::vector<AccuracyCase> cases = make_closed_form_cases();
    const std::vector<AccuracyRow> rows = make_rows(options.quick);
    AccuracySweep sweep;
    for (const AccuracyCase& problem : cases) sweep.panels.push_back({problem.name, problem.title, rows});

    // the longest first
    TowerPanels tower(options, rows);
    std::vector<std::function<void()>> jobs;
    tower.add_jobs(jobs);
    for (std::size_t c = 0; c < cases.size(); ++c) {
        for (std::size_t r = 0; r < rows.size(); ++r) {
            AccuracyRow& row = sweep.panels[c].rows[r];
            if (find_first(rows, r) == r) jobs.emplace_back([&problem = cases[c], &row] { row.outcome = run_case(problem, row.setting); });
        }
    }
    scaling::run_side_by_side(jobs, options.threads, options.on_progress);

    tower.add_panels(sweep.panels);
    sweep.earthquake = tower.earthquake();
    for (AccuracyPanel& panel : sweep.panels) {
        for (std::size_t r = 0; r < panel.rows.size(); ++r) {
            panel.rows[r].name = panel.name;
            panel.rows[r].outcome = panel.rows[find_first(panel.rows, r)].outcome;
        }
        mark_pareto(panel);
    }
    return sweep;
}

std::string make_accuracy_csv(const AccuracySweep& sweep) {
    std::string csv = "case,family,label,step,nodes,faces,sides,voxel,error,us_per_block_step,steps,block_steps,seconds,pareto\n";
    for (const AccuracyPanel& panel : sweep.panels) {
        for (const AccuracyRow& row : panel.rows) {
            const AccuracySetting& s = row.setting;
            const AccuracyOutcome& o = row.outcome;
            const bool by_nodes = s.faces == FaceContact::nodes || s.voxel > 0.0;
            const char* const sides = !by_nodes ? "none" : s.sides == ContactNodes::leader ? "leader" : "both";
            fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{},{},{},{:.4g},{},{},{:.4g},{}\n", row.name, row.family, row.label,
                           s.safety, by_nodes ? s.nodes_per_face : 0, by_nodes ? "nodes" : "overlap", sides, s.voxel, o.error,
                           o.block_steps > 0 ? 1e6 * o.seconds / static_cast<double>(o.block_steps) : 0.0, o.steps, o.block_steps,
                           o.seconds, row.pareto ? 1 : 0);
        }
    }
    return csv;
}

}  // namespace musim::lsdem
