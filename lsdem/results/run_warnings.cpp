#include "lsdem/results/run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lsdem/scene/scene.hpp"
#include "scaling/angle.hpp"

namespace musim::lsdem {
namespace {

bool above_critical(const RunResult& run) { return run.critical_time_step && run.time_step > *run.critical_time_step; }

/// The step that "step": "auto" takes [s].
double default_step(double critical) { return TimeSettings{}.safety * critical; }

/// The fastest that the base moves [m/s].
double find_peak_of_base(const RunResult& run) {
    double peak = 0.0;
    for (const BaseState& base : run.history.base) peak = std::max(peak, base.velocity.norm());
    return peak;
}

/// Coordinates below this part of a block's smallest edge are rounding, and written as zero [-].
constexpr double kNoMove = 1e-6;

/// The first block that fell; nothing when all stand.
std::optional<std::size_t> find_first_fall(const RunResult& run) {
    std::optional<std::size_t> first;
    for (std::size_t b = 0; b < run.falls.time.size(); ++b) {
        if (!std::isnan(run.falls.time[b]) && !(first && run.falls.time[*first] <= run.falls.time[b])) first = b;
    }
    return first;
}

/// Is the structure one that moves from the start because it is so listed: thrown, dropped, pushed?
bool begins_in_motion(const RunResult& run) {
    const auto moves = [](const std::vector<Vector3>& velocities) {
        return std::any_of(velocities.begin(), velocities.end(), [](const Vector3& v) { return !v.isZero(0.0); });
    };
    const std::vector<int>& airborne = run.falls.airborne;
    return std::find(airborne.begin(), airborne.end(), 1) != airborne.end() ||
           (run.blocks.is_listed() && (moves(run.initial.velocity) || moves(run.initial.angular_velocity)));
}

/// Does the weight of a structure that was not prepared begin to act with its motion? Of single blocks without a motion nothing is
/// expected: they may fall.
void warn_of_sudden_weight(const RunResult& run, double peak, std::vector<std::string>& warnings) {
    const double borne = std::max(0.0, run.start_reaction_over_weight.value_or(1.0));
    if (begins_in_motion(run) || !(std::abs(borne - 1.0) > kUnborneWeight)) return;
    if (run.blocks.is_listed() && !(peak > 0.0)) return;
    if (run.beginning == Beginning::at_once) {
        warnings.push_back(
            fmt::format("the base bore {:.3g} of the weight when the motion began (weight began to act then, which shakes the structure by "
                        "itself); leave \"preparation\": \"none\" out",
                        borne));
    } else if (const auto fallen = find_first_fall(run)) {
        warnings.push_back(fmt::format(
            "the base bore {:.3g} of the weight when the motion began (the blocks are not in equilibrium where they are drawn), "
            "and {} fell at {:.4g} s; draw it where it is supported, or see what a check of the scene reports",
            borne, run.blocks.describe(*fallen), run.falls.time[*fallen]));
    } else {
        warnings.push_back(fmt::format(
            "the base bore {:.3g} of the weight when the motion began (the blocks are not in equilibrium where they are drawn, and "
            "move when weight begins to act); see what a check of the scene reports: where they can stand, a \"preparation\" lets them "
            "come to rest before",
            borne));
    }
}

/// Does the structure not stand at rest when its motion begins?
void warn_of_start(const RunResult& run, std::vector<std::string>& warnings) {
    if (run.rest && !run.rest->at_rest && run.rest->steps > 0) {
        warnings.push_back(describe_unrest(*run.rest));
        return;
    }
    if (run.origin) return;
    const double peak = find_peak_of_base(run);
    if (!run.rest) return warn_of_sudden_weight(run, peak, warnings);
    double fastest = 0.0;
    for (const Vector3& velocity : run.initial.velocity) fastest = std::max(fastest, std::abs(velocity.z()));
    if (fastest > kFastStart * peak && peak > 0.0) {
        warnings.push_back(fmt::format(
            "a block still moved up or down at {:.3g} m/s when the motion began, whose peak is {:.3g} m/s (the structure was at "
            "rest as far as it is brought to rest); take a stronger motion, or keep in mind that not all of what moves is its work",
            fastest, peak));
    }
}

/// Warning of blocks that fell while the structure was prepared.
void warn_of_falls_before(const RunResult& run, std::vector<std::string>& warnings) {
    if (!run.rest || run.rest->fallen.empty()) return;
    const bool listed = run.blocks.is_listed();
    const char* remedy = listed ? "draw it where it is supported" : "take another seed, or another \"placing\" of the preparation";
    warnings.push_back(fmt::format("{}{}; {}", describe_fallen(run.rest->fallen, run.blocks),
                                   run.rest->collapsed ? ", so the motion was not run" : "", remedy));
}

/// A kind of divergence as result files name it, and what a user is given.
struct KindText {
    std::string_view name, meaning;
};

const KindText& text_of(Divergence::Kind kind) {
    static constexpr std::array<KindText, 3> kTexts{{
        {"non_finite", "its state is not finite"},
        {"energy_out_of_bounds", "more energy than was put in, or an energy balance that does not close"},
        {"too_fast", "it crosses more than half of the smallest edge in one step and could pass through another"},
    }};
    return kTexts.at(static_cast<std::size_t>(kind));
}

}  // namespace

std::string_view name_of(Divergence::Kind kind) { return text_of(kind).name; }

std::string describe_divergence(const RunResult& run) {
    const std::string what = fmt::format("diverged at {:.6g} s, {} ({})", run.divergence->time, run.blocks.describe(run.divergence->block),
                                         text_of(run.divergence->kind).meaning);
    if (above_critical(run)) {
        return fmt::format("{}: the time step {:.4g} s is above the critical {:.4g} s; take at most {:.4g} s, or \"step\": \"auto\"", what,
                           run.time_step, *run.critical_time_step, default_step(*run.critical_time_step));
    }
    return fmt::format(
        "{}: blocks that have left their places can be stiffer than the structure as built; take a time step of {:.4g} s, "
        "half of this one, or a lower \"safety\"",
        what, 0.5 * run.time_step);
}

std::string describe_large_step(double time_step, double critical) {
    return fmt::format(
        "the time step {:.4g} s is above the critical {:.4g} s (an unstable motion can stay bounded and go unnoticed); take at most {:.4g} "
        "s, or \"step\": \"auto\"",
        time_step, critical, default_step(critical));
}

std::string describe_fallen(const std::vector<MovedBlock>& fallen, const BlockTable& blocks) {
    const auto moved = [&](const MovedBlock& m) { return (m.now - m.drawn).norm() / blocks.size[m.block].minCoeff(); };
    const MovedBlock& most =
        *std::max_element(fallen.begin(), fallen.end(), [&](const MovedBlock& a, const MovedBlock& b) { return moved(a) < moved(b); });
    const double rounding = kNoMove * blocks.size[most.block].minCoeff();
    const auto place = [rounding](const Vector3& p) {
        const Vector3 seen = (p.array().abs() < rounding).select(0.0, p);
        return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", seen.x(), seen.y(), seen.z());
    };
    const std::string others =
        fallen.size() == 1 ? std::string() : fmt::format(" ({} of {} blocks fell)", fallen.size(), blocks.mass.size());
    return fmt::format("{} fell while the structure was prepared: drawn with its centre at {}, it is at {}, turned by {:.3g} degrees{}",
                       blocks.describe(most.block), place(most.drawn), place(most.now), most.turned / scaling::kDegree, others);
}

std::string describe_unrest(const Rest& rest) {
    return fmt::format(
        "the specimen had not come to rest before the motion (after {} steps its liveliest block kept {:.3g} of its weight times its "
        "height, the base bore {:.6f} of the weight); lower the preparation's \"damping_rate\", if the structure stands at all",
        rest.steps, rest.kinetic, rest.reaction_over_weight);
}

std::vector<std::string> find_warnings(const RunResult& run) {
    std::vector<std::string> warnings;
    if (run.divergence) return warnings;
    warn_of_falls_before(run, warnings);
    if (!(run.rest && run.rest->collapsed)) {
        warn_of_start(run, warnings);
        const std::vector<std::string> changes = warn_of_changes(run.base_changes);
        warnings.insert(warnings.end(), changes.begin(), changes.end());
    }
    for (const SensorHistory& sensor : run.sensors) {
        if (!sensor.values.empty()) continue;
        warnings.push_back(
            fmt::format("sensor \"{}\" read nothing ({} and {} do not touch by flat faces at the start, so their joint has no place); "
                        "give it a \"point\" and a \"normal\", or name others",
                        sensor.name, sensor.bodies.front(), sensor.bodies.back()));
    }
    if (above_critical(run)) {
        warnings.push_back(describe_large_step(run.time_step, *run.critical_time_step));
    }
    if (run.statistics.overstiff && !above_critical(run)) {
        const Overstiff& worst = *run.statistics.overstiff;
        warnings.push_back(fmt::format(
            "the contacts of {} were too stiff for the time step at {:.4g} s (they used {:.3g} of its limit, as faces met that "
            "do not meet in the structure as built; an unstable motion can stay bounded and go unnoticed); take at most {:.4g} s",
            run.blocks.describe(worst.block), worst.time, worst.used, run.time_step / worst.used));
    }
    if (run.statistics.max_overlap_over_height > kDeepOverlap) {
        warnings.push_back(
            fmt::format("blocks passed into each other by {:.3g} of a block's height (contacts are meant for overlaps far "
                        "below {:g}); raise the stiffness, or lower the speeds and loads",
                        run.statistics.max_overlap_over_height, kDeepOverlap));
    }
    if (run.energy_closure > kOpenBalance) {
        warnings.push_back(
            fmt::format("the energy balance is open by {:.3g} of the energy in play (collisions book at most {:g} wrongly); "
                        "take a smaller time step",
                        run.energy_closure, kOpenBalance));
    }
    return warnings;
}

}  // namespace musim::lsdem
