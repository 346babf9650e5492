#include "lsdem/results/run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lsdem/scene/scene.hpp"

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

/// Does the structure not stand at rest when its motion begins? Of single blocks without a motion nothing is expected: they may fall.
void warn_of_start(const RunResult& run, std::vector<std::string>& warnings) {
    const std::vector<int>& layer = run.blocks.layer;
    const bool stands = std::any_of(layer.begin(), layer.end(), [](int level) { return level > 0; });
    const double peak = find_peak_of_base(run);
    if (run.origin || !(stands || peak > 0.0)) return;
    const double borne = std::max(0.0, run.start_reaction_over_weight.value_or(1.0));
    if (std::abs(borne - 1.0) > kUnborneWeight) {
        warnings.push_back(
            fmt::format("the base bore {:.3g} of the weight when the motion began (weight began to act then, which shakes the structure by "
                        "itself); leave \"preparation\": \"none\" out, or give single blocks a \"preparation\"",
                        borne));
    }
    double fastest = 0.0;
    for (const Vector3& velocity : run.initial.velocity) fastest = std::max(fastest, std::abs(velocity.z()));
    if (fastest > kFastStart * peak && peak > 0.0) {
        warnings.push_back(fmt::format(
            "a block moved up or down at {:.3g} m/s when the motion began, whose peak is {:.3g} m/s; let the structure come to rest before",
            fastest, peak));
    }
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
    const std::string what = fmt::format("diverged at {:.6g} s, block {} ({})", run.divergence->time, run.divergence->block,
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

std::vector<std::string> find_warnings(const RunResult& run) {
    std::vector<std::string> warnings;
    if (run.divergence) return warnings;
    warn_of_start(run, warnings);
    if (run.rest && run.rest->steps > 0 && !run.rest->at_rest) {
        warnings.push_back(
            fmt::format("the specimen had not come to rest before the motion (after {} steps its liveliest block kept {:.3g} of "
                        "its weight times its height, the base bore {:.6f} of the weight); does it stand at all? If so, lower the "
                        "preparation's \"damping_rate\"",
                        run.rest->steps, run.rest->kinetic, run.rest->reaction_over_weight));
    }
    if (run.rest && run.rest->fallen > 0) {
        warnings.push_back(
            fmt::format("{} of {} blocks had fallen from their layers before the motion began; take another seed, or another "
                        "\"placing\" of the preparation",
                        run.rest->fallen, run.blocks.mass.size()));
    }
    if (above_critical(run)) {
        warnings.push_back(describe_large_step(run.time_step, *run.critical_time_step));
    }
    if (run.statistics.overstiff && !above_critical(run)) {
        const Overstiff& worst = *run.statistics.overstiff;
        warnings.push_back(fmt::format(
            "the contacts of block {} were too stiff for the time step at {:.4g} s (they used {:.3g} of its limit, as faces met that "
            "do not meet in the structure as built; an unstable motion can stay bounded and go unnoticed); take at most {:.4g} s",
            worst.block, worst.time, worst.used, run.time_step / worst.used));
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
