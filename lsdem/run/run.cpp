#include "lsdem/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "lsdem/results/run_warnings.hpp"
#include "lsdem/run/drawn_places.hpp"
#include "lsdem/run/equilibrium.hpp"
#include "lsdem/run/specimen_file.hpp"
#include "lsdem/scene/as_listed.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/motions.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_error.hpp"

namespace musim::lsdem {
namespace {

bool differ_in_height(const Specimen& specimen) {
    const std::vector<Block>& blocks = specimen.model.blocks;
    return std::any_of(blocks.begin(), blocks.end(), [](const Block& block) { return block.height_offset != 0.0; });
}

bool base_moves(const Scene& scene) { return !scene.motions.empty() || !std::holds_alternative<std::monostate>(scene.base_motion.source); }

/// Steps that a double counts one by one, and samples of which histories are some hundred gigabytes.
constexpr double kMostSteps = 0x1p53, kMostSamples = 1e9;

/// Time in which a specimen by nodes comes to rest anew before its run, over 1/α: uneven walls of 3 and 6 layers. For the progress alone
/// [-].
constexpr double kSettlesAgain = 1.25;

/// Nearest whole number, one at least and kMostSteps at most.
std::uint64_t round_count(double value) { return static_cast<std::uint64_t>(std::clamp(std::round(value), 1.0, kMostSteps)); }

/// Samples that a rate gives are whole when they are so to within this part [-].
constexpr double kWhole = 1e-9;

/// Time between samples of the spine, 0 for one a step: the rate's own, when the duration is a whole number of them, else so much shorter
/// that it is [s].
double find_sample_interval(const Scene& scene) {
    const double rate = scene.output.spine_rate.value(), duration = scene.time.duration.value();
    if (!(rate > 0.0)) return 0.0;
    const double samples = duration * rate, whole = std::round(samples);
    if (whole >= 1.0 && std::abs(samples - whole) <= kWhole * whole) return 1.0 / rate;
    return duration / std::max(1.0, std::ceil(samples));
}

/// The number up to `most`, above half of it, that leaves least when it divides `all`; of several the largest.
std::uint64_t divide_evenly(std::uint64_t all, std::uint64_t most) {
    constexpr std::uint64_t kMostTries = 10000;
    const std::uint64_t largest = std::min(most, all), tries = std::min(kMostTries, (largest + 1) / 2);
    std::uint64_t best = largest;
    for (std::uint64_t k = largest; k > largest - tries && all % best > 0; --k) {
        if (all % k < all % best) best = k;
    }
    return best;
}

/// Readings of a sensor; `at`: where it stands in the scene.
ReadingPlan plan_readings(const SensorEntry& sensor, const TimePlan& plan, const std::string& at) {
    const double steps = 1.0 / (sensor.rate.value() * plan.time_step), whole = std::round(steps);
    ReadingPlan readings;
    readings.steps = std::abs(steps - whole) <= kWhole * whole ? whole : steps;
    if (!(readings.steps >= 1.0)) {
        throw SceneError(
            fmt::format("{}/rate: {:.6g} Hz is more than a reading a step ({:.4g} s: {:.6g} Hz); lower it, or shorten the \"step\"", at,
                        sensor.rate.value(), plan.time_step, 1.0 / plan.time_step));
    }
    readings.count = static_cast<std::uint64_t>(std::floor(static_cast<double>(plan.steps()) / readings.steps * (1.0 + kWhole)));
    if (sensor.filter) {
        const double corner = sensor.filter->corner ? sensor.filter->corner->value() / sensor.rate.value() : kSensorCorner;
        readings.corner_steps = corner / readings.steps;
        readings.order = sensor.filter->order;
    }
    return readings;
}

/// Gives a damping rate above the blocks' frequency parameter p the time that it needs. Tipping then grows with p²/α in place of p, so all
/// patience, which counts 1/α, is (α/p)² as long; sway dies out in the last round, at the rate that suits it: what the factors of that
/// round make of choose_damping_rate().
void allow_for_strong_damping(double chosen_rate, PreparationSettings& preparation) {
    const double over = preparation.settling.damping_rate / (2.0 * chosen_rate);  // α/p
    if (!(over > 1.0)) return;
    for (double* patience :
         {&preparation.settling.patience, &preparation.layer_patience, &preparation.resting_patience, &preparation.added_patience}) {
        *patience *= over * over;
    }
    for (double* factor : {&preparation.last_damping, &preparation.last_damping_with_mass_scaling}) *factor /= 2.0 * over;
}

}  // namespace

Specimen make_upright_specimen(const Scene& scene) {
    BuiltModel built = build_model(scene);
    std::vector<PlacedSensor> sensors = place_sensors(scene, built);
    std::vector<BoxPose> drawn = find_boxes(built.model);
    return {.model = std::move(built.model),
            .spine = std::move(built.structure.spine),
            .layer = std::move(built.structure.layer),
            .settling = {},
            .level = std::move(built.structure.level),
            .name = std::move(built.structure.name),
            .load = std::move(built.structure.load),
            .drawn = std::move(drawn),
            .sensors = std::move(sensors)};
}

bool starts_at_rest(const Specimen& specimen) {
    const std::vector<Block>& blocks = specimen.model.blocks;
    return std::all_of(blocks.begin(), blocks.end(),
                       [](const Block& block) { return block.velocity.isZero(0.0) && block.angular_velocity.isZero(0.0); });
}

bool wants_preparation(const Scene& scene, const Specimen& upright) {
    if (scene.preparation) return !scene.preparation->none;
    // single blocks begin as they are listed, and what is given a velocity is not to rest
    if (std::holds_alternative<BlockList>(scene.structure)) return differ_in_height(upright);
    return starts_at_rest(upright);
}

bool seeks_equilibrium(const Scene& scene, const Specimen& upright) {
    if (!wants_preparation(scene, upright)) return !scene.preparation && starts_at_rest(upright) && base_moves(scene);
    const bool is_there = scene.preparation && scene.preparation->specimen;
    return !is_there && find_preparation(scene, upright).from_equilibrium;
}

PreparationSettings find_preparation(const Scene& scene, const Specimen& upright) {
    const std::vector<Block>& blocks = upright.model.blocks;
    const Preparation wanted = scene.preparation.value_or(Preparation{});
    PreparationSettings preparation;
    preparation.placing = wanted.placing.value_or(differ_in_height(upright) ? BlockPlacing::layers_mass_scaled : BlockPlacing::as_drawn);
    preparation.from_equilibrium = preparation.placing == BlockPlacing::as_drawn;
    if (preparation.from_equilibrium) preparation.whole_rounds = 1;
    const double chosen = choose_damping_rate(2.0 * upright.model.shapes[blocks.front().shape].half_extents, upright.model.gravity.norm());
    preparation.settling.damping_rate = wanted.damping_rate ? wanted.damping_rate->value() : chosen;
    allow_for_strong_damping(chosen, preparation);
    return preparation;
}

Specimen make_specimen(const Scene& scene, const RunSettings& settings, const Checkpoint* from) {
    Specimen specimen = make_upright_specimen(scene);
    // a plan that is refused is refused before anything is computed
    const TimePlan plan = make_time_plan(scene, specimen.model);
    if (!wants_preparation(scene, specimen)) {
        if (seeks_equilibrium(scene, specimen)) put_in_equilibrium(specimen, compute_time_step(scene, specimen.model).value());
        specimen.beginning = scene.preparation ? Beginning::at_once : Beginning::listed;
        return specimen;
    }
    PreparationSettings preparation = find_preparation(scene, specimen);
    if (from != nullptr && from->places) {
        put_in_place(*from->places, specimen);
    } else {
        if (scene.preparation && scene.preparation->specimen) {
            take_places(*scene.preparation->specimen, specimen);
            preparation.placing = BlockPlacing::as_drawn;
            preparation.from_equilibrium = false;
            preparation.whole_rounds = 1;
        }
        const double time_step = compute_time_step(scene, specimen.model).value();
        RunSettings own = settings;
        own.observer.on_progress = settings.observer.on_preparation;
        const auto blocks = static_cast<double>(specimen.model.blocks.size());
        const double decay_steps = 1.0 / (preparation.settling.damping_rate * plan.time_step);
        const WorkToFollow to_follow{.preparations = settings.preparations_to_follow,
                                     .block_steps = blocks * (settings.runs_to_follow * static_cast<double>(plan.steps()) +
                                                              (scene.has_contact_nodes() ? kSettlesAgain * decay_steps : 0.0))};
        PreparedSpecimen prepared =
            prepare(specimen, time_step, preparation, own, from != nullptr ? from->preparation : std::nullopt, to_follow);
        specimen = std::move(prepared.specimen);
        specimen.preparation_work = static_cast<double>(prepared.block_steps);
    }
    specimen.settling = preparation.settling;
    specimen.beginning = Beginning::prepared;
    return specimen;
}

RunSettings keep_places(RunSettings settings, const Specimen& specimen) {
    if (settings.checkpoint && specimen.settling) settings.checkpoint->places = places_of(specimen);
    return settings;
}

LaidSpecimen lay_specimen(const Scene& scene, RunSettings settings) {
    std::optional<Checkpoint> from;
    if (settings.checkpoint && std::filesystem::exists(settings.checkpoint->file)) {
        from = read_checkpoint(settings.checkpoint->file, settings.checkpoint->program_version);
    }
    LaidSpecimen laid{make_specimen(scene, settings, from ? &*from : nullptr)};
    if (!laid.specimen.settling) return laid;
    if (settings.checkpoint && !(from && from->places)) {
        const TimePlan plan = make_time_plan(scene, laid.specimen.model);
        const Simulation simulation(laid.specimen.model, plan.time_step, settings.threads);
        RunResult none;
        write_checkpoint(*keep_places(settings, laid.specimen).checkpoint, 0, plan, none, simulation);
    }
    laid.rest = let_settle(scene, laid.specimen, keep_places(settings, laid.specimen), from ? &*from : nullptr);
    return laid;
}

std::optional<Rest> let_settle(const Scene& scene, Specimen& specimen, const RunSettings& settings, const Checkpoint* from) {
    if (!specimen.settling) return std::nullopt;
    const TimePlan plan = make_time_plan(scene, specimen.model);
    Simulation simulation(specimen.model, plan.time_step, settings.threads);
    std::optional<Rest> rest = settle_specimen(simulation, specimen, plan, settings, from);
    if (rest->collapsed) {
        throw SceneError(
            fmt::format("{}: {} (a comparison needs a structure that stands); draw it where it stands, or run it alone to see it fall",
                        scene.place(), describe_fallen(rest->fallen, make_block_table(specimen))));
    }
    put_in_place(find_places(simulation), specimen);
    specimen.settling.reset();
    return rest;
}

TimePlan make_time_plan(const Scene& scene, const Model& model, Sampling sampling) {
    const double limit = compute_time_step(scene, model).value();
    const double interval = find_sample_interval(scene);
    // an automatic step fits the samples, a given one is kept
    const bool fits = !scene.time.step && interval > 0.0 && (interval > limit || sampling == Sampling::at_rate);
    return make_time_plan(scene, fits ? interval / std::ceil(interval / limit) : limit);
}

TimePlan make_time_plan(const Scene& scene, double time_step) {
    const double duration = scene.time.duration.value(), steps = duration / time_step;
    const double per_sample = std::max(1.0, std::round(find_sample_interval(scene) / time_step));
    if (!(steps <= kMostSteps) || !(steps / per_sample <= kMostSamples)) {
        throw SceneError(fmt::format(
            "{}: {:.3g} s in steps of {:.3g} s are {:.1g} steps and {:.1g} samples (at most {:.0g} and {:.0g} can be counted and "
            "kept); give a shorter \"duration\", or a lower \"spine_rate\"",
            scene.place(), duration, time_step, steps, steps / per_sample, kMostSteps, kMostSamples));
    }
    TimePlan plan{.time_step = time_step};
    const std::uint64_t all = round_count(steps);
    plan.steps_per_sample = divide_evenly(all, round_count(per_sample));
    plan.samples = all / plan.steps_per_sample;
    if (scene.output.frame_rate) {
        const double sample_interval = static_cast<double>(plan.steps_per_sample) * time_step;
        plan.samples_per_frame = round_count(1.0 / (scene.output.frame_rate->value() * sample_interval));
    }
    for (std::size_t k = 0; k < scene.sensors.size(); ++k) {
        plan.readings.push_back(plan_readings(scene.sensors[k], plan, fmt::format("{}: /sensors/{}", scene.place(), k)));
    }
    return plan;
}

RunResult run_scene(const Scene& scene, const RunSettings& settings) {
    require_single_motion(scene, "a run");
    return run_specimen(scene, make_specimen(scene, settings), {}, settings);
}

RunResult run_specimen(const Scene& scene, const Specimen& specimen, std::optional<Checkpoint> from, const RunSettings& settings) {
    const RunSettings with_places = keep_places(settings, specimen);
    const TimePlan plan = make_time_plan(scene, specimen.model);
    if (!from || from->preparation || from->settling) return simulate(specimen, plan, with_places, from ? &*from : nullptr);
    require_plan(*from, plan);
    return resume(specimen, std::move(*from), with_places);
}

RunResult run_model(const Scene& prototype, const scaling::Similitude& similitude, const RunSettings& settings) {
    check_scene(prototype, prototype.place());
    RunResult run = run_scene(scale_scene(prototype, similitude), settings);
    run.similitude = similitude;
    return run;
}

RunResult resume_scene(const Scene& scene, Checkpoint checkpoint, const RunSettings& settings) {
    const Specimen specimen = make_specimen(scene, settings, &checkpoint);
    return run_specimen(scene, specimen, std::move(checkpoint), settings);
}

}  // namespace musim::lsdem
