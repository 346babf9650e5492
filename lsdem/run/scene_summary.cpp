#include "lsdem/run/scene_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "lsdem/block_height.hpp"
#include "lsdem/block_reach.hpp"
#include "lsdem/results/run_warnings.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/run/sequence_plan.hpp"
#include "lsdem/run/specimen_file.hpp"
#include "lsdem/scene/as_listed.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/motions.hpp"
#include "lsdem/scene/reference_block.hpp"
#include "lsdem/time_step.hpp"

namespace musim::lsdem {
namespace {

using Clock = std::chrono::steady_clock;

/// Numbers of a sample in result.h5, besides those of its spine blocks: time, base, energies; of a spine block: position, velocity,
/// rotation.
constexpr double kSampleNumbers = 16.0, kSpineNumbers = 9.0;

/// Numbers of a block in a frame, in single precision: position, quaternion, velocity, contact force; and of a block in all.
constexpr double kFrameNumbers = 11.0, kBlockNumbers = 30.0;

/// Letters of a number in spine.csv, with its comma: 15 to 17 digits, sign, point and often an exponent.
constexpr double kCsvNumber = 21.0;

/// Letters of a frame in result.xdmf.
constexpr double kXdmfFrame = 1630.0;

/// Edges of a shape: of a box its own, of a solid those of the box around it in the frame that it is placed by.
Vector3 find_size(const Shape& shape) {
    return shape.solid ? find_bounds(*shape.solid, shape.own.inverse()).size() : Vector3(2.0 * shape.half_extents);
}

/// Name of the material of a block of a layered structure: its lintels may have one of their own.
std::string find_lintel_material(const Scene& scene, const Model& model, std::size_t block) {
    const auto* wall = std::get_if<Wall>(&scene.structure);
    const bool is_own = model.blocks[block].material != model.blocks.front().material;
    return wall != nullptr && wall->lintel && is_own ? wall->lintel->material : std::string();
}

void count_blocks(const Scene& scene, SceneSummary& summary) {
    const Model& model = summary.specimen.model;
    summary.low.setConstant(std::numeric_limits<double>::infinity());
    summary.high = -summary.low;
    const Scene listed = as_listed(scene);
    const auto* list = std::get_if<BlockList>(&listed.structure);
    const auto* tower = std::get_if<Tower>(&scene.structure);
    const std::string of_all = tower == nullptr ? "" : tower->shape;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        const Block& block = model.blocks[b];
        const std::string material = list == nullptr ? find_lintel_material(scene, model, b) : list->blocks[b].material,
                          shape = list == nullptr ? of_all : list->blocks[b].shape;
        const Shape& own = model.shapes[block.shape];
        const Vector3 size = find_size(own);
        const BlockReach reach = find_block_reach(own.solid.get(), half_extents(model, block), block.orientation.toRotationMatrix());
        summary.low = summary.low.cwiseMin(block.position - reach.below);
        summary.high = summary.high.cwiseMax(block.position + reach.above);
        summary.mass += block.mass;
        const auto same = [&](const BlockKind& kind) { return kind.size == size && kind.shape == shape && kind.material == material; };
        auto kind = std::find_if(summary.kinds.begin(), summary.kinds.end(), same);
        if (kind == summary.kinds.end()) kind = summary.kinds.insert(kind, {.size = size, .shape = shape, .material = material});
        ++kind->count;
        kind->mass += block.mass;
        kind->fixed += block.fixed ? 1 : 0;
    }
    const Specimen& specimen = summary.specimen;
    const std::vector<int>& level = specimen.level.empty() ? specimen.layer : specimen.level;
    if (!level.empty()) summary.levels = *std::max_element(level.begin(), level.end());
}

std::string describe_contact(const Scene& scene, const Model& model) {
    const bool has_solids =
        std::any_of(model.shapes.begin(), model.shapes.end(), [](const Shape& shape) { return shape.solid != nullptr; });
    if (has_solids) return "flat faces meet by the energy of their overlap, in closed form";
    if (!scene.has_contact_nodes()) return "boxes meet by the energy of their overlap, in closed form";
    return fmt::format("by surface nodes of {}, stiffness by area",
                       scene.contact_nodes == ContactNodes::leader ? "the lower block" : "both blocks");
}

void plan_motions(const Scene& scene, SceneSummary& summary) {
    if (scene.motions.empty()) {
        summary.specimen = make_upright_specimen(scene);
        const TimePlan plan = make_time_plan(scene, summary.specimen.model);
        summary.motions.push_back(summarize_motion(scene, "", summary.specimen.model.ground.motion, plan));
        return;
    }
    SequencePlan sequence = plan_sequence(scene);
    for (const SequenceStage& stage : sequence.stages) {
        summary.motions.push_back(summarize_motion(stage.scene, stage.name, stage.motion, stage.plan));
    }
    summary.specimen = std::move(sequence.specimen);
}

/// Beginning of the blocks, for people.
std::string describe_start(const Scene& scene, const SceneSummary& summary, const PreparationSettings& settings) {
    using Begins = SceneStanding::Begins;
    switch (summary.standing.begins) {
        case Begins::in_equilibrium:
            return fmt::format(
                "in equilibrium where blocks are drawn, to {:.1g} of a block's weight (gaps up to {:.2g} H count as contact)",
                summary.standing.equilibrium->residual, kEquilibriumGap);
        case Begins::out_of_equilibrium:
            return std::string("not in equilibrium where blocks are drawn: ") +
                   (wants_preparation(scene, summary.specimen) ? "they move before the motion, until they rest or have fallen"
                                                               : "weight begins to act with the motion");
        case Begins::when_laid:
            return fmt::format("placing \"{}\", blocks come to rest one layer after another; how they stand is found when they are laid",
                               to_string(settings.placing));
        case Begins::from_specimen:
            return "from the specimen " + scene.preparation->specimen->string();
        case Begins::as_listed:
            break;
    }
    return scene.preparation ? "no preparation, weight begins to act with the motion"
                             : "single blocks begin as listed, weight begins to act with the motion";
}

void plan_preparation(const Scene& scene, SceneSummary& summary) {
    summary.standing = find_standing(scene, summary.specimen);
    const PreparationSettings settings = find_preparation(scene, summary.specimen);
    summary.preparation_text = describe_start(scene, summary, settings);
    if (summary.standing.begins == SceneStanding::Begins::from_specimen) {
        take_places(*scene.preparation->specimen, summary.specimen);
    } else if (wants_preparation(scene, summary.specimen)) {
        summary.preparation = estimate_preparation(summary.specimen, summary.time_step, settings);
    }
}

void size_outputs(SceneSummary& summary) {
    const auto samples = static_cast<double>(summary.samples()), frames = static_cast<double>(summary.frames());
    const auto spine = static_cast<double>(summary.specimen.spine.size()),
               blocks = static_cast<double>(summary.specimen.model.blocks.size());
    const auto runs = static_cast<double>(summary.motions.size());
    const double histories = samples * (kSampleNumbers + spine * kSpineNumbers) * sizeof(double);
    const double pictures = frames * (sizeof(double) + blocks * kFrameNumbers * sizeof(float));
    summary.outputs = {{"result.h5", histories + pictures + runs * blocks * kBlockNumbers * sizeof(double)},
                       {"result.xdmf", frames * kXdmfFrame},
                       {"spine.csv", samples * (4.0 + 3.0 * spine) * kCsvNumber}};
}

/// Does what begins with the motion shake the structure by itself, or fall?
std::string describe_unrest(const Scene& scene, const SceneSummary& summary) {
    const SceneStanding& standing = summary.standing;
    if (standing.begins != SceneStanding::Begins::out_of_equilibrium) return {};
    if (standing.statics && standing.statics->answer == RigidStatics::Answer::cannot_stand)
        return describe(*standing.statics, standing.blocks);
    if (wants_preparation(scene, summary.specimen)) return {};
    return "blocks are not in equilibrium where they are drawn, so weight begins to act with the motion, which shakes the structure by "
           "itself; a \"preparation\" brings them to rest before it, where they can";
}

void add_warnings(const Scene& scene, SceneSummary& summary) {
    summary.warnings = scene.text.remarks;
    const auto warn = [&](const std::string& what) { summary.warnings.push_back(scene.place() + ": " + what); };
    for (const std::string& cut : describe_cut_motions(scene)) warn(cut);
    if (!is_listed(scene) && summary.motions.front().rests()) {
        warn("the base rests; give a \"base_motion\" to shake the structure");
    }
    if (const std::string unrest = describe_unrest(scene, summary); !unrest.empty()) warn(unrest);
    for (const MotionSummary& motion : summary.motions) {
        BaseChanges changes;
        for (const AxisMotion& axis : motion.axes) changes[static_cast<std::size_t>(axis.axis - 'x')] = axis.change;
        for (const std::string& changed : warn_of_changes(changes)) warn(motion.name.empty() ? changed : motion.name + ": " + changed);
    }
    if (summary.critical_time_step && summary.time_step > *summary.critical_time_step) {
        warn(describe_large_step(summary.time_step, *summary.critical_time_step));
    }
    if (scene.preparation && scene.preparation->none) {
        warn("weight begins to act when the motion does, which shakes the structure by itself; leave \"preparation\": \"none\" out");
    }
    if (!(scene.output.spine_rate.value() > 0.0)) {
        warn(fmt::format("every step is kept as a sample, {} of them; give output.spine_rate, such as \"1 kHz\"", summary.samples()));
    }
    if (!scene.output.frame_rate) {
        warn("no positions of all blocks are kept, so there will be no film and no 3D view of the motion; give output.frame_rate");
    }
    double bytes = 0.0;
    for (const OutputSize& output : summary.outputs) bytes += output.bytes;
    if (bytes > kLargeOutput) {
        warn(fmt::format("results will take about {:.2g} GB; lower output.spine_rate or output.frame_rate", 1e-9 * bytes));
    }
}

template <class Count>
std::uint64_t sum(const std::vector<MotionSummary>& motions, const Count& count) {
    std::uint64_t all = 0;
    for (const MotionSummary& motion : motions) all += count(motion.plan);
    return all;
}

}  // namespace

std::uint64_t SceneSummary::steps() const {
    return sum(motions, [](const TimePlan& plan) { return plan.steps(); });
}

std::uint64_t SceneSummary::samples() const {
    return sum(motions, [](const TimePlan& plan) { return plan.samples + 1; });
}

std::uint64_t SceneSummary::frames() const {
    return sum(motions, [](const TimePlan& plan) { return plan.samples_per_frame == 0 ? 0 : plan.samples / plan.samples_per_frame + 1; });
}

SceneSummary summarize_scene(const Scene& scene) {
    SceneSummary summary;
    summary.name = scene.name;
    plan_motions(scene, summary);
    count_blocks(scene, summary);
    summary.materials.emplace_back("", scene.material);
    summary.materials.insert(summary.materials.end(), scene.materials.begin(), scene.materials.end());
    summary.pairs = scene.pairs;
    summary.scatter = scene.scatter;
    summary.stiffness_base = reference_area(scene);
    summary.contact = describe_contact(scene, summary.specimen.model);
    summary.time_step = summary.motions.front().plan.time_step;
    summary.critical_time_step = find_critical_time_step(summary.specimen.model);
    plan_preparation(scene, summary);
    summary.estimates = estimate_scene(scene, find_least_friction(summary.specimen.model, summary.levels), summary.specimen,
                                       summary.motions, summary.standing);
    size_outputs(summary);
    add_warnings(scene, summary);
    return summary;
}

RunTimeEstimate measure_run_time(const SceneSummary& summary, int threads, double budget) {
    constexpr std::uint64_t kFirst = 8;  // steps in which contacts are met and memory is touched for the first time
    Model model = summary.specimen.model;
    model.numerics.skip_rest = false;
    Simulation simulation(std::move(model), summary.time_step, threads);
    const auto seconds_since = [](Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); };
    const Clock::time_point begin = Clock::now();
    for (std::uint64_t k = 0; k < kFirst && seconds_since(begin) < budget; ++k) simulation.advance(1);
    const std::uint64_t before = simulation.statistics().steps;
    const Clock::time_point start = Clock::now();
    RunTimeEstimate estimate{.threads = simulation.threads()};
    for (std::uint64_t chunk = 1; estimate.seconds < budget && estimate.steps < summary.steps() && !simulation.divergence();) {
        simulation.advance(chunk);
        estimate.seconds = seconds_since(start);
        estimate.steps = simulation.statistics().steps - before;
        if (estimate.seconds < budget / 4.0) chunk *= 2;
    }
    if (estimate.steps == 0) return estimate;
    const double step = estimate.seconds / static_cast<double>(estimate.steps);
    const double block_step = step / static_cast<double>(summary.specimen.model.blocks.size());
    estimate.run = step * static_cast<double>(summary.steps());
    estimate.least_preparation = block_step * summary.preparation.least;
    estimate.most_preparation = block_step * summary.preparation.most;
    return estimate;
}

}  // namespace musim::lsdem
