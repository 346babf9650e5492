#include "lsdem/study/twin_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "lsdem/build.hpp"
#include "lsdem/results/checksum.hpp"
#include "lsdem/run/advance_in_pieces.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/run/shared_progress.hpp"
#include "lsdem/scene/motions.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/detail/velocity_tape.hpp"
#include "lsdem/study/ensemble_members.hpp"
#include "lsdem/study/twin_files.hpp"
#include "lsdem/study/twin_specimen.hpp"
#include "scaling/interruption.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::lsdem {
namespace {

namespace fs = std::filesystem;

/// Blocks that are no faster than this part of √(gH) stand: they are laid to 1.4e-5 (Settling::rest), and the difference of two that stand
/// is rounding [-].
constexpr double kLeastMotion = 1e-4;

Scene with_rate(Scene scene) {
    if (!(scene.output.spine_rate.value() > 0.0)) scene.output.spine_rate = scaling::Frequency::from_value(kTwinRate);
    return scene;
}

std::vector<std::size_t> find_moving(const Model& model) {
    std::vector<std::size_t> moving;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        if (!model.blocks[b].fixed) moving.push_back(b);
    }
    return moving;
}

/// The largest coordinate of a block [m].
double find_reach(const Model& model) {
    double reach = 0.0;
    for (const Block& block : model.blocks) reach = std::max(reach, block.position.cwiseAbs().maxCoeff());
    return reach;
}

/// Ends a tape whatever happens to the run that fills it.
struct TapeGuard {
    detail::VelocityTape& tape;
    bool complete = false;
    ~TapeGuard() { tape.end(complete); }
};

/// One scene's prototype and twins on their way.
class TwinWork {
  public:
    TwinWork(const Scene& scene, const std::vector<TwinChoice>& choices, const TwinSettings& settings)
        : scene_(scene), settings_(settings) {
        if (!settings.directory.empty()) folder_ = twin_folder(settings.directory, scene, settings.version);
        for (const TwinChoice& choice : choices) study_.twins.push_back({.choice = choice, .difference = {}});
        if (folder_.empty()) return;
        make_folder(folder_);
        if (auto tape = read_prototype(folder_, study_.prototype)) tape_ = std::make_unique<detail::VelocityTape>(std::move(*tape));
    }

    TwinStudy run() {
        const bool wants_prototype = tape_ == nullptr;
        std::vector<std::size_t> pending;
        for (std::size_t i = 0; i < study_.twins.size(); ++i) {
            if (wants_prototype || folder_.empty() || !read_twin(folder_, study_.twins[i])) pending.push_back(i);
        }
        if (wants_prototype || !pending.empty()) run_missing(wants_prototype, pending);
        study_.name = scene_.name;
        return std::move(study_);
    }

  private:
    void run_missing(bool wants_prototype, const std::vector<std::size_t>& pending) {
        specimen_ = lay_twin_specimen(scene_, folder_, settings_, static_cast<double>(pending.size() + (wants_prototype ? 1 : 0)));
        plan_ = make_time_plan(scene_, specimen_.model);
        moving_ = find_moving(specimen_.model);
        if (wants_prototype) tape_ = std::make_unique<detail::VelocityTape>();
        detail::SharedProgress progress(pending.size() + (wants_prototype ? 1 : 0), settings_.observer.on_progress);
        std::vector<std::function<void()>> jobs;
        const auto add = [&](const auto& job) {
            jobs.emplace_back([&progress, job, number = jobs.size()] {
                job([&progress, number](double fraction) { progress.update(number, fraction); });
            });
        };
        // the prototype begins first: the others wait for it
        if (wants_prototype) add([this](const auto& report) { run_prototype(report); });
        for (const std::size_t i : pending) add([this, i](const auto& report) { run_twin(study_.twins[i], report); });
        scaling::run_side_by_side(jobs, settings_.threads);
    }

    /// Calls `at_sample` at t = 0 and after every sample until it returns false; did the run get there without diverging?
    template <class AtSample>
    bool run_samples(const Specimen& specimen, double time_step, const AtSample& at_sample) const {
        Simulation simulation(specimen.model, time_step, 1);
        for (std::uint64_t k = 0; k <= plan_.samples; ++k) {
            if (k > 0) detail::advance_in_pieces(simulation, plan_.steps_per_sample, [](std::uint64_t /*taken*/) {});
            scaling::stop_if_interrupted();
            if (simulation.divergence()) return false;
            if (!at_sample(simulation, k)) break;
        }
        return true;
    }

    double part(std::uint64_t sample) const { return static_cast<double>(sample) / static_cast<double>(plan_.samples); }

    template <class Report>
    void run_prototype(const Report& report) {
        TapeGuard guard{*tape_};
        TwinPrototype& prototype = study_.prototype;
        const Block& first = specimen_.model.blocks[moving_.empty() ? 0 : moving_.front()];
        prototype.moving_blocks = moving_.size();
        prototype.height = 2.0 * specimen_.model.shapes[first.shape].half_extents.z();
        prototype.gravity = specimen_.model.gravity.norm();
        prototype.interval = plan_.time_step * static_cast<double>(plan_.steps_per_sample);
        prototype.rounding = std::numeric_limits<double>::epsilon() * find_reach(specimen_.model) / plan_.time_step;
        prototype.diverged = !run_samples(specimen_, plan_.time_step, [&](const Simulation& simulation, std::uint64_t k) {
            const BaseState base = simulation.base();
            std::vector<Vector3> velocities;
            for (const std::size_t b : moving_) {
                velocities.push_back(simulation.velocity(b));
                prototype.peak = std::max(prototype.peak, (velocities.back() - base.velocity_at(simulation.position(b))).norm());
            }
            tape_->add(std::move(velocities));
            prototype.samples = k + 1;
            report(part(k));
            return true;
        });
        if (!folder_.empty()) write_prototype(folder_, prototype, tape_->samples());
        guard.complete = true;
    }

    template <class Report>
    void run_twin(TwinRun& twin, const Report& report) {
        const scaling::Similitude similitude = scaling::make_similitude("exact", {.length = twin.choice.length});
        const double velocity = similitude.velocity();
        const double time_step = plan_.scaled(similitude.time()).time_step;
        twin.diverged = !run_samples(make_twin(specimen_, twin.choice), time_step, [&](const Simulation& simulation, auto k) {
            const std::vector<Vector3>* prototype = tape_->wait_for(k);
            if (prototype == nullptr) return false;
            double largest = 0.0;
            for (std::size_t i = 0; i < moving_.size(); ++i) {
                largest = std::max(largest, (simulation.velocity(moving_[i]) / velocity - (*prototype)[i]).norm());
            }
            twin.difference.push_back(largest);
            report(part(k));
            return true;
        });
        if (tape_->wait_for_end() && !folder_.empty()) write_twin(folder_, twin);
        report(1.0);
    }

    const Scene& scene_;
    const TwinSettings& settings_;
    fs::path folder_;  ///< empty: nothing is kept
    TwinStudy study_;
    std::unique_ptr<detail::VelocityTape> tape_;
    Specimen specimen_;
    TimePlan plan_;
    std::vector<std::size_t> moving_;
};

}  // namespace

fs::path twin_folder(const fs::path& directory, const Scene& scene, const std::string& version) {
    return directory / ("twins-" + detail::name_content(describe_build() + make_member(with_rate(scene), version).name));
}

Specimen lay_twin_specimen(const Scene& scene, const fs::path& folder, const TwinSettings& settings, double runs_to_follow) {
    RunSettings run_settings{.threads = settings.threads, .observer = settings.observer, .runs_to_follow = runs_to_follow};
    if (!folder.empty()) {
        run_settings.checkpoint = CheckpointSettings{.file = folder / kTwinSpecimenName,
                                                     .scene = write_scene(scene),
                                                     .program_version = settings.version,
                                                     .interval = settings.checkpoint_interval,
                                                     .on_failure = settings.on_warning};
    }
    return lay_specimen(scene, std::move(run_settings)).specimen;
}

std::vector<double> share_work(const std::vector<Scene>& scenes) {
    std::vector<double> shares;
    double all = 0.0;
    for (const Scene& scene : scenes) {
        const Model model = make_upright_specimen(scene).model;
        shares.push_back(static_cast<double>(make_time_plan(scene, model).steps()) * static_cast<double>(model.blocks.size()));
        all += shares.back();
    }
    for (double& share : shares) share /= all;
    return shares;
}

TwinStudy run_twins(const Scene& scene, const std::vector<TwinChoice>& choices, const TwinSettings& settings) {
    require_single_motion(scene, "a comparison of twins");
    const Scene sampled = with_rate(scene);
    TwinStudy study = TwinWork(sampled, choices, settings).run();
    const TwinPrototype& prototype = study.prototype;
    if (prototype.peak > kLeastMotion * std::sqrt(prototype.gravity * prototype.height)) return study;
    throw SceneError(
        fmt::format("{}: no block moves relative to the base (differences are measured by how fast one does); give a base motion, or a "
                    "longer duration",
                    scene.place()));
}

}  // namespace musim::lsdem
