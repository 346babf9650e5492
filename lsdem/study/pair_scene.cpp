#include "lsdem/study/pair_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include "lsdem/build.hpp"
#include "lsdem/results/checksum.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/run/scale_specimen.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/specimen_seed.hpp"
#include "lsdem/study/ensemble_members.hpp"
#include "lsdem/study/model_distortions.hpp"
#include "lsdem/study/own_models.hpp"
#include "lsdem/study/pair_models.hpp"
#include "lsdem/study/twin_files.hpp"
#include "scaling/setting.hpp"

namespace musim::lsdem {
namespace {

using scaling::Similitude;

/// Runs that take steps of their own are compared at the prototype's samples, which need not be those of its scene's rate.
void sample_as(const PairMember& prototype, const Similitude& similitude, Scene& scene) {
    const auto differ = [](double a, double b) { return !(std::abs(a - b) <= scaling::kFactorRounding * std::abs(b)); };
    const TimePlan& plan = prototype.staged ? prototype.staged->stages.front().plan : prototype.plan;
    const double rate = 1.0 / (static_cast<double>(plan.steps_per_sample) * plan.time_step * similitude.time());
    if (differ(scene.output.spine_rate.value(), rate)) scene.output.spine_rate = scaling::Frequency::from_value(rate);
    if (prototype.staged) return;
    const double duration = plan.duration() * similitude.time();
    if (differ(scene.time.duration.value(), duration)) scene.time.duration = scaling::Time::from_value(duration);
}

/// That each block of a model has its like in the prototype.
void require_same_structure(const Specimen& prototype, const Specimen& model, const std::string& place) {
    const std::size_t wanted = prototype.model.blocks.size(), has = model.model.blocks.size();
    if (has != wanted) {
        throw SceneError(fmt::format("{}: {} blocks where the prototype has {}; a pair needs similar structures", place, has, wanted));
    }
    if (model.layer != prototype.layer || model.spine.block != prototype.spine.block) {
        throw SceneError(fmt::format("{}: its layers are not the prototype's; a pair needs similar structures, block by block", place));
    }
}

/// A scene that says what the prototype's says, to rounding: in the prototype's places, since laying would magnify rounding, and twins are
/// not laid.
PairMember place_like(const PairMember& prototype, const std::string& label, const Scene& scene) {
    PairMember member{label, make_upright_specimen(scene), prototype.plan, Similitude(), {}, prototype.rest};
    member.is_image = true;
    put_in_place(places_of(prototype.specimen), member.specimen);
    return member;
}

/// The scale, and a number when there is a model of it already: labels name folders.
std::string make_label(double length, const std::vector<PairMember>& members) {
    const std::string scale = make_scale_label(length);
    std::string label = scale;
    const auto taken = [&] {
        return std::any_of(members.begin(), members.end(), [&](const PairMember& member) { return member.label == label; });
    };
    for (int number = 2; taken(); ++number) label = fmt::format("{} {}", scale, number);
    return label;
}

/// Where specimens and runs of a pair are kept until its results are.
class KeptPair {
  public:
    KeptPair(const Scene& prototype, const std::vector<ScaledScene>& models, const PairSceneSettings& how, const RunSettings& settings) {
        if (!settings.checkpoint) return;
        // scenes are named by the files that they name, too; the number of twins decides on no run
        const std::string& version = settings.checkpoint->program_version;
        std::string all = describe_build() + make_member(prototype, version).name;
        for (const ScaledScene& model : models) {
            const Similitude& s = model.similitude;
            all += fmt::format(" {} {} {} {} {} {}", make_member(model.scene, version).name, s.length(), s.friction(), s.gravity(),
                               s.density(), to_string(model.materials));
        }
        all += fmt::format(" {} {}", how.specimen == PairSpecimen::one, how.judging.seed);
        folder_ = settings.checkpoint->file / ("unfinished-" + detail::name_content(all));
        resumed_ = std::filesystem::exists(folder_);
        make_folder(folder_);
    }
    KeptPair(const KeptPair&) = delete;
    KeptPair& operator=(const KeptPair&) = delete;
    /// Nothing is left of a pair that left nothing.
    ~KeptPair() {
        std::error_code not_empty;
        if (!folder_.empty()) std::filesystem::remove(folder_, not_empty);
    }
    const std::filesystem::path& folder() const { return folder_; }
    bool resumed() const { return resumed_; }
    /// Settings of preparing one specimen.
    RunSettings settings_of(const std::string& label, RunSettings settings) const {
        return with_file(std::move(settings), folder_ / (name_folder(label) + ".specimen"));
    }
    /// Settings of work that keeps its runs in the folder itself.
    RunSettings settings_of_all(RunSettings settings) const { return with_file(std::move(settings), folder_); }

  private:
    RunSettings with_file(RunSettings settings, const std::filesystem::path& file) const {
        if (!folder_.empty()) settings.checkpoint->file = file;
        return settings;
    }

    std::filesystem::path folder_;
    bool resumed_ = false;
};

/// The specimens of a pair, laid one after another, and its runs as one scale: each specimen costs about as much as the first.
class LayingProgress {
  public:
    /// Besides the first, `others` are laid; then come `runs`.
    LayingProgress(const RunSettings& all, std::size_t others, std::size_t runs)
        : all_(all), others_(static_cast<double>(others)), runs_(static_cast<double>(runs)) {}

    /// For the specimen that is laid next.
    RunSettings next(RunSettings settings) {
        before_ = done_;
        settings.preparations_to_follow = others_;
        settings.runs_to_follow = runs_;
        settings.observer.on_progress = {};
        settings.observer.on_preparation = [this](double part) {
            done_ = std::min(before_ + part, 1.0);
            if (all_.observer.on_preparation) all_.observer.on_preparation(done_);
        };
        return settings;
    }

  private:
    const RunSettings& all_;
    double others_, runs_;
    double before_ = 0.0, done_ = 0.0;
};

/// Runs other specimens of the prototype for its own models, when heights are drawn, after the pair itself. What there is to run counts
/// in runs for the progress, and a specimen that is laid first as two.
class OtherSpecimens {
  public:
    /// `own`: are there models of their own, which are held against other specimens unless that is asked for otherwise?
    OtherSpecimens(const Scene& prototype, bool own, const PairSceneSettings& how, std::size_t runs) : scene_(prototype) {
        const bool drawn = draws_specimen(prototype) && !(prototype.preparation && prototype.preparation->specimen);
        if (how.specimens.value_or(0) > 0 && !drawn) {
            throw SceneError(
                fmt::format("{}: neither block heights (height_deviation) nor a scatter are drawn, so it has one specimen only",
                            prototype.place()),
                Remedy{"leave ", Setting::specimen_count, " out"});
        }
        if (drawn) count_ = how.specimens.value_or(own ? kOtherSpecimens : 0);
        share_ = static_cast<double>(runs) / static_cast<double>(runs + 2 * count_);
    }
    RunSettings settings_of_pair(const RunSettings& settings) const { return part_of(settings, 0.0, share_); }
    PairSettings judging_of_pair(PairSettings judging) const {
        if (!judging.on_spare) return judging;
        judging.on_spare = [share = share_, report = judging.on_spare](double part) { report(share * part); };
        return judging;
    }
    std::vector<RunTrace> run(const RunResult& prototype, const RunSettings& settings) const {
        return run_other_specimens(scene_, prototype, count_, part_of(settings, share_, 1.0));
    }

  private:
    static RunSettings part_of(RunSettings settings, double from, double to) {
        std::function<void(double)>& on_progress = settings.observer.on_progress;
        if (!on_progress) return settings;
        on_progress = [=, report = on_progress](double part) { report(from + (to - from) * part); };
        return settings;
    }

    const Scene& scene_;
    std::size_t count_ = 0;
    double share_ = 1.0;
};

}  // namespace

std::string make_scale_label(double length) {
    const double inverse = 1.0 / length;
    const double whole = std::round(inverse);
    const bool is_whole = whole >= 1.0 && std::abs(inverse / whole - 1.0) < scaling::kFactorRounding;
    return is_whole ? fmt::format("1:{:.0f}", whole) : fmt::format("x{}", length);
}

ScenePair pair_scene(const Scene& prototype, const std::vector<ModelChoice>& models, std::optional<Materials> materials,
                     const RunSettings& settings, const PairSceneSettings& how) {
    std::vector<ScaledScene> scaled_scenes;
    scaled_scenes.reserve(models.size());
    for (const ModelChoice& choice : models) scaled_scenes.push_back(make_scaled(prototype, choice, materials));
    const KeptPair kept(prototype, scaled_scenes, how, settings);
    const auto is_image = [&](std::size_t m) {
        const ScaledScene& model = scaled_scenes[m];
        const bool has_image = !models[m].scene && model.materials == Materials::exact && model.similitude.keeps_statics();
        return has_image && how.specimen == PairSpecimen::one;
    };
    const auto is_prototype = [&](std::size_t m) {
        return scaled_scenes[m].second && scaled_scenes[m].second->is_prototype() && how.specimen == PairSpecimen::one;
    };
    std::vector<std::vector<LoneScene>> lone_scenes;
    std::size_t laid = 0, lone_count = 0;
    for (std::size_t m = 0; m < models.size(); ++m) {
        const bool alone = how.one_at_a_time && scaled_scenes[m].materials == Materials::own && !models[m].scene;
        lone_scenes.push_back(alone ? find_lone_scenes(prototype, scaled_scenes[m]) : std::vector<LoneScene>{});
        lone_count += lone_scenes.back().size();
        laid += (is_image(m) || is_prototype(m) ? 0 : 1) + lone_scenes.back().size();
    }
    LayingProgress layings(settings, laid, count_runs(models.size() + lone_count, how.judging));
    const PairMember original =
        lay_member("prototype", prototype, Similitude(), layings.next(kept.settings_of("prototype", settings)), Sampling::every_step);

    ScenePair pair{
        .prototype = prototype, .scales = find_motion_scales(original.specimen), .unfinished = kept.folder(), .resumed = kept.resumed()};
    std::vector<PairMember> members, lone_members;
    for (std::size_t m = 0; m < models.size(); ++m) {
        const ModelChoice& choice = models[m];
        ScaledScene& scaled = scaled_scenes[m];
        const bool exact = scaled.materials == Materials::exact, same = scaled.second && scaled.second->same_structure;
        if (!same && (!exact || choice.scene)) sample_as(original, scaled.similitude, scaled.scene);
        const std::string label = make_label(scaled.similitude.length(), members);
        const auto lay = [&](const std::string& name, const Scene& scene, const Similitude& similitude) {
            return lay_member(name, scene, similitude, layings.next(kept.settings_of(name, settings)),
                              same ? Sampling::every_step : Sampling::at_rate);
        };
        members.push_back(is_image(m)       ? make_image(original, label, scaled.similitude)
                          : is_prototype(m) ? place_like(original, label, scaled.scene)
                                            : lay(label, scaled.scene, scaled.similitude));
        if (choice.scene) require_same_structure(original.specimen, members.back().specimen, choice.scene->place());
        if (!same) {
            members.back().distortions =
                find_model_distortions({prototype, original.specimen.model}, {scaled.scene, members.back().specimen.model}, scaled.scales);
        }
        members.back().asked = find_asked(scaled, members.back().distortions);
        members.back().law = scaled.law;
        members.back().material = scaled.material;
        members.back().materials = scaled.materials;
        members.back().scene = scaled.second;
        if (choice.law) pair.laws.push_back(*scaled.solved);
        // an exact model steps as its prototype does
        if (exact) {
            members.back().plan = original.plan.scaled(scaled.similitude.time());
            if (original.staged) members.back().staged = original.staged->scaled(scaled.similitude);
        }
        if (same) members.back().plan = make_plan_beside(prototype, original.plan, scaled.scene, members.back().specimen.model);
        for (LoneScene& lone : lone_scenes.back()) {
            sample_as(original, lone.similitude, lone.scene);
            lone_members.push_back(lay(label + ", " + lone.property, lone.scene, lone.similitude));
            lone_members.back().materials = Materials::own;
        }
        pair.models.push_back(std::move(scaled.scene));
    }
    members.insert(members.end(), std::make_move_iterator(lone_members.begin()), std::make_move_iterator(lone_members.end()));
    Scene sampled = prototype;
    sample_as(original, original.similitude, sampled);
    const bool own = std::any_of(members.begin(), members.end(), [](const PairMember& m) { return m.materials == Materials::own; });
    const OtherSpecimens others(sampled, own, how, count_runs(members.size(), how.judging));
    pair.study = run_pair(original, members, others.settings_of_pair(kept.settings_of_all(settings)), others.judging_of_pair(how.judging));
    if (how.judging.on_spare) how.judging.on_spare(0.0);
    pair.study.specimen_traces = others.run(pair.study.prototype, kept.settings_of_all(settings));
    pair.study.tolerance = how.accept;

    // the runs beside the models go to the models they belong to
    std::vector<PairedRun>& runs = pair.study.models;
    std::size_t run = models.size();
    for (std::size_t m = 0; m < models.size(); ++m) {
        for (const LoneScene& lone : lone_scenes[m]) {
            runs[m].alone.push_back({lone.property, lone.factor, runs[run].run.status, runs[run].difference});
            ++run;
        }
    }
    runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(models.size()), runs.end());
    return pair;
}

}  // namespace musim::lsdem
