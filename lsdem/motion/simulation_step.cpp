#include <algorithm>
#include <chrono>
#include <limits>
#include <span>
#include <utility>

#include "lsdem/contact/overlap_pairs.hpp"
#include "lsdem/motion/leaving.hpp"
#include "lsdem/motion/simulation_core.hpp"
#include "lsdem/time_step.hpp"

/// Step of a simulation, and the share of each thread in it.
namespace musim::lsdem {
namespace {

/// Steps between two checks at finiteness and energy. An unstable mode grows by a factor of about (1 + ε)^64 in between, so a failure is
/// dated within a few oscillations; looking at every step would cost a few percent.
constexpr std::uint64_t kHealthInterval = 64;

/// Steps between two checks for a block that has left its place: each costs some nanoseconds a block. Even where blocks rest as softly as
/// 1e-3 of their height, so many steps are a fifth of sqrt(H/g), and a block that falls needs more from 39° to lying.
constexpr std::uint64_t kPlaceInterval = 16;

/// A structure is at rest when its kinetic energy is below this part of weight times smallest edge, at this many checks in a row: what is
/// passed over could not have moved it by more than rounding moves it (velocities of 1e-10·sqrt(g·edge), accelerations a thousand times
/// smaller than would bring these about between two checks).
constexpr double kEnergyAtRest = 1e-20;
constexpr int kChecksAtRest = 16;

/// Cost of boxes that touch, in nodes; what does not touch is mostly passed over. Affects speed only.
constexpr std::size_t kNodesPerOverlap = 32;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Share of thread `index` of `count`.
detail::Share share_of(std::size_t items, int index, int count) {
    const auto i = static_cast<std::size_t>(index), n = static_cast<std::size_t>(count);
    return {items * i / n, items * (i + 1) / n};
}

/// Items in a row for each thread, of about equal work.
template <class WorkOf>
std::vector<detail::Share> share_equally(std::size_t items, int threads, const WorkOf& work_of) {
    std::vector<detail::Share> shares(static_cast<std::size_t>(threads));
    std::size_t work = 0, done = 0, item = 0;
    for (std::size_t i = 0; i < items; ++i) work += work_of(i);
    for (int thread = 0; thread < threads; ++thread) {
        detail::Share& share = shares[static_cast<std::size_t>(thread)];
        const std::size_t goal = share_of(work, thread, threads).last;
        share.first = item;
        for (; item < items && (done < goal || thread + 1 == threads); ++item) done += work_of(item);
        share.last = item;
    }
    return shares;
}

}  // namespace

void Simulation::Implementation::move(double h, double time) {
    // velocities are of the middle of the last step, and become those of the middle of this one
    const double kick = 0.5 * (bodies.elapsed + h);
    base.move_ground(preparation.active ? std::nullopt : std::optional(time), h, bodies);
    base.push_carried(bodies);
    const detail::Leap leap{.touches = work.touches,
                            .forces = list.forces,
                            .reference = search.reference(),
                            .gravity = model.gravity,
                            .h = h,
                            .kick = kick,
                            .decay = decay_over(kick),
                            .prepares = preparation.damping_rate > 0.0 || preparation.mass_scaling.is_active(),
                            .is_turned = base.is_turned()};
    // while the base stands, what is held stays where it is
    const std::size_t movers = preparation.active ? work.end_of_loose : bodies.size();
    const auto task = [&](int thread) {
        const detail::Share share = share_of(movers, thread, work.team.size());
        if (preparation.mass_scaling.is_active()) preparation.mass_scaling.give(work.touches, list, share.first, share.last, bodies);
        work.drift[static_cast<std::size_t>(thread)] = detail::move_blocks(leap, share, bodies);
    };
    work.team.run(task);
    base.turn_carried(bodies);
}

void Simulation::Implementation::rebuild() {
    ++steps.rebuilds;
    search.rebuild(bodies, list, balance.finished);
    list.forces.resize(list.pairs.size() + loads.size());
    if (preparation.mass_scaling.is_active()) preparation.mass_scaling.price(list);
    share_work();
}

void Simulation::Implementation::share_work() {
    work.touches.rebuild(bodies.size(), list.pairs, loads.blocks());
    work.end_of_loose = bodies.size();
    while (work.end_of_loose > 0 && bodies.fixed[work.end_of_loose - 1] != 0) --work.end_of_loose;

    const auto work_of_pair = [&](std::size_t index) -> std::size_t {
        const ContactPair& pair = list.pairs[index];
        if (pair.is_overlap()) return list.overlaps[pair.overlap].touches ? kNodesPerOverlap : 1;
        return pair.node_count;
    };
    work.pairs.set(share_equally(list.pairs.size(), work.team.size(), work_of_pair));
}

void Simulation::Implementation::update_contacts() {
    work.pairs.begin();
    const auto task = [&](int thread) {
        const auto i = static_cast<std::size_t>(thread);
        detail::Share piece;
        OverlapBatch& overlaps = work.batches[i];
        while (work.pairs.take(i, piece)) {
            const double deepest = compute_pairs(model, bodies, piece.first, piece.last, list, overlaps);
            work.overlap[i] = std::max(work.overlap[i], deepest);
        }
        work.overlap[i] = std::max(work.overlap[i], overlaps.compute());
    };
    work.team.run(task);
    base.bear(work.touches, list.forces, bodies);
}

void Simulation::Implementation::update_loads(double time) {
    if (loads.empty() || preparation.active) return;
    loads.apply(bodies, time, bodies.elapsed, std::span(list.forces).subspan(list.pairs.size()));
}

/// Number of steps from here in which the base stands and nothing moves.
std::uint64_t Simulation::Implementation::find_steps_at_rest() {
    // with damping, blocks that hardly move may still fall: forces need not balance
    if (!model.numerics.skip_rest || preparation.damping_rate > 0.0) return 0;
    steps.checks_at_rest = kinetic() <= kEnergyAtRest * balance.weight_times_edge ? steps.checks_at_rest + 1 : 0;
    if (steps.checks_at_rest < kChecksAtRest) return 0;
    const double now = static_cast<double>(steps.done) * dt;
    const double still = preparation.active ? std::numeric_limits<double>::infinity()
                                            : std::min(base.motion().still_until(now), loads.still_until(now)) - now;
    return still > dt ? static_cast<std::uint64_t>(std::min(still / dt, 9e15)) - 1 : 0;
}

void Simulation::Implementation::note_leaving() {
    // with mass scaling blocks have the inertia that their contacts ask for, whatever the step
    if (steps.leaving || preparation.mass_scaling.is_active()) return;
    const auto block = detail::find_block_out_of_place(model, bodies, work.touches, list.forces);
    if (!block) return;
    const std::uint64_t substeps = std::uint64_t{1} << compute_landing_halvings(model);
    steps.leaving = Leaving{*block, static_cast<double>(steps.done) * dt, substeps};
}

std::uint64_t Simulation::Implementation::substeps_per_step() const {
    return steps.leaving && !preparation.mass_scaling.is_active() ? steps.leaving->substeps : 1;
}

void Simulation::Implementation::step() {
    const std::uint64_t count = substeps_per_step();
    const double part = 1.0 / static_cast<double>(count), before = static_cast<double>(steps.done);
    ++steps.done;
    for (std::uint64_t substep = 1; substep <= count; ++substep) {
        const auto start = Clock::now();
        const double time = (before + static_cast<double>(substep) * part) * dt;
        move(part * dt, time);
        ++steps.substeps;
        const auto moved = Clock::now();
        work.times.motion += std::chrono::duration<double>(moved - start).count();

        const double farthest = *std::max_element(work.drift.begin(), work.drift.end());
        if (farthest > search.allowed_drift()) {
            find_non_finite();
            if (health.divergence) return;
            rebuild();
            work.times.neighbors += seconds_since(moved);
        }
        const auto listed = Clock::now();
        update_contacts();
        update_loads(time);
        work.times.contacts += seconds_since(listed);
    }
}

void Simulation::advance(std::uint64_t steps) {
    Implementation& s = *implementation_;
    std::uint64_t left = steps;
    while (left > 0 && !s.health.divergence) {
        if (s.steps.done < s.steps.rest_end) {
            const std::uint64_t passed_over = std::min(left, s.steps.rest_end - s.steps.done);
            s.steps.done += passed_over;
            s.steps.skipped += passed_over;
            left -= passed_over;
            continue;
        }
        --left;
        s.step();
        if (s.health.divergence) return;
        if (s.steps.done % kPlaceInterval == 0) s.note_leaving();
        if (s.steps.done % kHealthInterval != 0) continue;
        s.check_health();
        s.steps.rest_end = s.steps.done + s.find_steps_at_rest();
    }
}

}  // namespace musim::lsdem
