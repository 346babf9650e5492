#include "lsdem/study/tilt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "lsdem/block_height.hpp"
#include "lsdem/finite_turn.hpp"
#include "lsdem/motion/simulation.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/statics/rigid_joints.hpp"
#include "lsdem/statics/rigid_statics.hpp"
#include "scaling/interruption.hpp"

namespace musim::lsdem {
namespace {

using scaling::kDegrees;

/// Steps between two checks of what has fallen and of a request to stop.
constexpr std::uint64_t kCheck = 64;

/// Rounding of a quotient of two angles [-].
constexpr double kAngleRounding = 1e-9;

void check_scene_to_tilt(const Scene& scene) {
    const auto refuse = [&](const char* path, const char* why) { throw SceneError(fmt::format("{}: {}: {}", scene.place(), path, why)); };
    if (!scene.motions.empty()) refuse("/motions", "the scene shakes its structure (its ground is to be tilted instead); leave them out");
    if (!std::holds_alternative<std::monostate>(scene.base_motion.source) && !tilts(scene)) {
        refuse("/base_motion", "the scene shakes its structure (its ground is to be tilted instead); leave it out");
    }
    if (scene.gravity[0].value() != 0.0 || scene.gravity[1].value() != 0.0 || !(scene.gravity[2].value() < 0.0)) {
        refuse("/gravity", "it does not point downward (angles count from level ground); leave it out");
    }
}

void check_model_to_tilt(const Scene& scene, const Model& model) {
    const auto is_held = [](const Block& block) { return block.fixed && block.with_base; };
    if (!model.ground.present && std::none_of(model.blocks.begin(), model.blocks.end(), is_held)) {
        throw SceneError(
            fmt::format("{}: /ground: there is nothing to tilt (neither ground nor blocks that move with the base); add the "
                        "ground, or \"with_base\": true to fixed blocks",
                        scene.place()));
    }
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        if (!model.blocks[b].fixed || model.blocks[b].with_base) continue;
        throw SceneError(
            fmt::format("{}: block {} is held in place (it would stay where it is while the ground turns); add \"with_base\": "
                        "true to it",
                        scene.place(), b));
    }
    const auto is_loose = [](const Block& block) { return !block.fixed; };
    if (std::none_of(model.blocks.begin(), model.blocks.end(), is_loose)) {
        throw SceneError(scene.place() + ": all blocks are fixed (none can fall); let some loose");
    }
}

/// Bounds of the blocks that are loose [m].
Bounds find_loose_bounds(const Specimen& specimen) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    Bounds bounds{Vector3::Constant(kFar), Vector3::Constant(-kFar)};
    const BlockTable blocks = make_block_table(specimen);
    for (std::size_t b = 0; b < specimen.model.blocks.size(); ++b) {
        const Block& block = specimen.model.blocks[b];
        if (block.fixed) continue;
        const BlockReach reach = blocks.find_reach(b, block.orientation);
        bounds.low = bounds.low.cwiseMin(block.position - reach.below);
        bounds.high = bounds.high.cwiseMax(block.position + reach.above);
    }
    return bounds;
}

/// A structure that stands, at an angle.
struct Standing {
    std::uint64_t number = 0;  ///< of the angle, see TiltSearch::angle
    std::string state;         ///< Simulation::save
    Model model;               ///< with the motion that brought it there
};

class TiltSearch {
  public:
    TiltSearch(const Scene& scene, const TiltSettings& settings, const RunSettings& run)
        : place_(scene.place()), settings_(settings), run_(run), specimen_(lay_specimen(scene, run).specimen) {
        const Model& model = specimen_.model;
        check_model_to_tilt(scene, model);
        const Bounds bounds = find_loose_bounds(specimen_);
        result_.axis = settings.axis;
        result_.height = bounds.high.z() - bounds.low.z();
        result_.unit_time = std::sqrt(result_.height / model.gravity.norm());
        result_.time_step = compute_time_step(scene, model).value();
        result_.blocks = make_block_table(specimen_);
        result_.model = model;
        pivot_ = {0.5 * (bounds.low.x() + bounds.high.x()), 0.5 * (bounds.low.y() + bounds.high.y()), 0.0};
        for (int halvings = 0; settings.step * std::ldexp(1.0, -halvings) > settings.tolerance * (1.0 + kAngleRounding); ++halvings) {
            coarsest_ *= 2;
        }
        finest_ = settings.step / static_cast<double>(coarsest_);
        last_ = static_cast<std::uint64_t>(std::ceil(settings.until / finest_ - kAngleRounding));
        if (const auto limit = find_steady_acceleration(model, result_.downhill())) result_.statics = std::atan(*limit);
    }

    TiltCollapse run() && {
        std::optional<Standing> low = level();
        std::uint64_t step = coarsest_;
        std::optional<std::uint64_t> failed;
        while (low && low->number < last_) {
            report(low->number);
            const std::uint64_t target = std::min(low->number + step, last_);
            // an angle that failed after a longer step is tried anew after the shortest one: that step may have made it fail
            const bool fails = step > 1 && failed && target >= *failed;
            std::optional<Standing> next = fails ? std::nullopt : attempt(*low, target);
            if (result_.divergence) break;
            if (next) {
                low = std::move(next);
                if (failed && low->number >= *failed) failed.reset();
                continue;
            }
            failed = target;
            if (step > 1) {
                step /= 2;
                continue;
            }
            result_.high = angle(target);
            // what the last quarter of the turn bears at the top
            result_.rate_excess = 16.0 / 3.0 / (kTurnTime * kTurnTime) * (angle(target) - angle(low->number));
            watch_fall(*low, target);
            break;
        }
        if (low) result_.low = angle(low->number);
        return std::move(result_);
    }

  private:
    double angle(std::uint64_t number) const { return std::min(static_cast<double>(number) * finest_, settings_.until); }

    void report(std::uint64_t number) const {
        if (run_.observer.on_progress) run_.observer.on_progress(static_cast<double>(number) / static_cast<double>(last_));
    }

    std::uint64_t count_steps(double times) const {
        return static_cast<std::uint64_t>(std::ceil(times * result_.unit_time / result_.time_step));
    }

    /// The first block that has fallen since the ground began to turn.
    std::optional<std::size_t> find_fallen(const Simulation& simulation) const {
        for (std::size_t b = 0; b < specimen_.model.blocks.size(); ++b) {
            if (!specimen_.model.blocks[b].fixed && simulation.has_fallen(b)) return b;
        }
        return std::nullopt;
    }

    /// Takes so many steps, or fewer when the simulation diverges or `stops()`; did it take all?
    template <class Stops>
    bool advance(Simulation& simulation, std::uint64_t steps, const Stops& stops) {
        for (std::uint64_t taken = 0; taken < steps;) {
            const std::uint64_t piece = std::min(steps - taken, kCheck);
            simulation.advance(piece);
            taken += piece, result_.steps += piece;
            scaling::stop_if_interrupted();
            if (simulation.divergence() || stops()) return false;
        }
        return true;
    }

    /// The ground turns from where it is to another angle, see kTurnTime; the number of steps that it takes.
    std::uint64_t begin_turn(Simulation& simulation, double by) const {
        const std::uint64_t quarter = count_steps(0.25 * kTurnTime);
        const double dt = static_cast<double>(quarter) * result_.time_step, rate = by / (3.0 * dt);
        BaseComponents motion;
        motion.pivot = pivot_;
        for (std::size_t i = 0; i < 3; ++i) {
            const double along = rate * settings_.axis[static_cast<Eigen::Index>(i)];
            if (along == 0.0) continue;
            motion.turn[i] = {.start = 0.0, .dt = dt, .velocity = {0.0, along, along, along, 0.0}};
        }
        simulation.begin_motion(motion);
        return 4 * quarter;
    }

    /// Holds the ground; does the structure stand?
    bool hold(Simulation& simulation, TiltTry& now) {
        const auto falls = [&] { return (now.fallen = find_fallen(simulation)).has_value(); };
        const std::uint64_t quarter = count_steps(0.25 * kHoldTime);
        simulation.set_velocity_damping(std::min(kHoldDamping / result_.unit_time, 1.0 / result_.time_step));
        if (!advance(simulation, quarter, falls)) return false;
        simulation.set_velocity_damping(0.0);
        if (!advance(simulation, 2 * quarter, falls)) return false;
        const Kinematics before = simulation.kinematics();
        if (!advance(simulation, quarter, falls)) return false;
        const Kinematics after = simulation.kinematics();
        const double time = static_cast<double>(quarter) * result_.time_step;
        const double unit = result_.height / result_.unit_time;  // √(gH)
        for (std::size_t b = 0; b < before.position.size(); ++b) {
            const Block& block = specimen_.model.blocks[b];
            if (block.fixed) continue;
            const double turned = 2.0 * (after.orientation[b] * before.orientation[b].conjugate()).vec().norm();
            const double moved = (after.position[b] - before.position[b]).norm() + turned * half_extents(specimen_.model, block).norm();
            now.speed = std::max(now.speed, moved / (time * unit));
        }
        return now.speed <= kMostSpeed;
    }

    Standing keep(const Simulation& simulation, std::uint64_t number) const {
        std::ostringstream out;
        simulation.save(out);
        return {number, std::move(out).str(), simulation.model()};
    }

    Simulation restore(const Standing& standing) const {
        std::istringstream in(standing.state);
        return Simulation::restore(standing.model, in, run_.threads);
    }

    /// Level ground.
    std::optional<Standing> level() {
        Model model = specimen_.model;
        model.ground.motion = {};
        Simulation simulation(std::move(model), result_.time_step, run_.threads);
        TiltTry now;
        now.stands = hold(simulation, now);
        result_.tries.push_back(now);
        if ((result_.divergence = simulation.divergence())) return std::nullopt;
        if (now.stands) return keep(simulation, 0);
        throw SceneError(fmt::format("{}: the structure does not stand on level ground ({}); draw it where it stands", place_,
                                     now.fallen
                                         ? result_.blocks.describe(*now.fallen) + " falls"
                                         : fmt::format("blocks move at {:.2g} of the square root of g times its height", now.speed)));
    }

    /// The structure at a larger angle, if it stands there.
    std::optional<Standing> attempt(const Standing& from, std::uint64_t target) {
        Simulation simulation = restore(from);
        TiltTry now{.from = angle(from.number), .angle = angle(target), .stands = false};
        const std::uint64_t steps = begin_turn(simulation, now.angle - now.from);
        const auto falls = [&] { return (now.fallen = find_fallen(simulation)).has_value(); };
        now.stands = advance(simulation, steps, falls) && hold(simulation, now);
        result_.tries.push_back(now);
        result_.divergence = simulation.divergence();
        if (!now.stands || result_.divergence) return std::nullopt;
        return keep(simulation, target);
    }

    /// Places seen from the ground as if it had not been tilted. `before`: its angle when its present motion began.
    std::vector<BodyPlace> find_places(const Simulation& simulation, double before) const {
        const BaseState base = simulation.base();
        const Quaternion back = turn_by(-before * settings_.axis);
        std::vector<BodyPlace> places;
        for (std::size_t b = 0; b < specimen_.model.blocks.size(); ++b) {
            const Vector3 seen = base.seen_from_base(simulation.position(b));
            places.push_back(
                {.position = pivot_ + back * (seen - pivot_), .orientation = back * base.turn.conjugate() * simulation.orientation(b)});
        }
        return places;
    }

    /// The last step once more, until its mechanism is seen.
    void watch_fall(const Standing& from, std::uint64_t target) {
        Simulation simulation = restore(from);
        const double before = angle(from.number);
        // the frame in which the present motion begins is that of the ground then
        const std::uint64_t steps = begin_turn(simulation, angle(target) - before);
        const std::vector<BodyPlace> first = find_places(simulation, before);
        std::vector<BodyPlace> drawn;
        std::vector<double> edge;
        std::vector<int> held;
        for (const Block& block : specimen_.model.blocks) {
            drawn.push_back({block.position, block.orientation});
            edge.push_back(2.0 * half_extents(specimen_.model, block).minCoeff());
            held.push_back(block.fixed ? 1 : 0);
        }
        const bool has_joints = is_of_flat_sides(specimen_.model);
        const std::vector<RigidJoint> joints =
            has_joints ? find_rigid_joints(specimen_.model, kMechanismGap).joints : std::vector<RigidJoint>{};
        std::vector<BodyPlace> now;
        std::vector<JointMotion> motions;
        const auto is_visible = [&] {
            now = find_places(simulation, before);
            motions = find_joint_motions(joints, drawn, first, now);
            if (!joints.empty()) return find_largest_motion(motions, edge) > kVisiblePart;
            for (std::size_t b = 0; b < now.size(); ++b) {
                if ((now[b].position - first[b].position).norm() > kVisiblePart * edge[b]) return true;
            }
            return false;
        };
        if (advance(simulation, steps, is_visible)) advance(simulation, count_steps(kFallTime), is_visible);
        result_.divergence = simulation.divergence();
        TiltFall fall{.place = std::move(now), .time = simulation.time(), .mechanism = std::nullopt, .sentence = {}};
        if (has_joints) {
            fall.mechanism = find_mechanism(std::move(motions), held);
            const Vector3 up = turn_by(-angle(target) * settings_.axis) * Vector3::UnitZ();
            fall.sentence = lsdem::describe(*fall.mechanism, result_.blocks, {result_.downhill(), up});
        }
        result_.fall = std::move(fall);
    }

    std::string place_;
    TiltSettings settings_;
    RunSettings run_;
    Specimen specimen_;
    TiltCollapse result_;
    Vector3 pivot_ = Vector3::Zero();  ///< below the middle of the structure
    std::uint64_t coarsest_ = 1;       ///< the first step over the last one
    double finest_ = 0.0;              ///< the last one [rad]
    std::uint64_t last_ = 0;           ///< number of the last angle
};

}  // namespace

std::string check_tilt(const TiltSettings& settings) {
    const auto in_degrees = [](double angle) { return fmt::format("{:g} degrees", angle * kDegrees); };
    if (!(settings.until > 0.0) || settings.until > 90.0 * scaling::kDegree * (1.0 + kAngleRounding)) {
        return fmt::format("the largest angle is {} (must be above 0 and at most 90)", in_degrees(settings.until));
    }
    if (!(settings.step > 0.0) || settings.step > settings.until * (1.0 + kAngleRounding)) {
        return fmt::format("the step is {} (must be above 0 and at most the largest angle, {})", in_degrees(settings.step),
                           in_degrees(settings.until));
    }
    // the ground is placed to some 1e-16 rad at each of thousands of steps
    constexpr double kLeast = 1e-6 * scaling::kDegree;
    if (!(settings.tolerance >= kLeast)) {
        return fmt::format("the tolerance is {} (below {}, motions are lost in rounding)", in_degrees(settings.tolerance),
                           in_degrees(kLeast));
    }
    if (std::abs(settings.axis.norm() - 1.0) > kAngleRounding || settings.axis.z() != 0.0) return "the axis is not horizontal, of length 1";
    return {};
}

TiltCollapse find_tilt_of_collapse(const Scene& scene, const TiltSettings& settings, const RunSettings& run) {
    if (const std::string why = check_tilt(settings); !why.empty()) throw std::invalid_argument("tilt: " + why);
    check_scene_to_tilt(scene);
    Scene still = scene;
    still.base_motion = {};
    return TiltSearch(still, settings, run).run();
}

}  // namespace musim::lsdem
