#include "lsdem/run/rest_phase.hpp"

#include <chrono>
#include <cmath>
#include <utility>

#include "lsdem/run/advance_in_pieces.hpp"

namespace musim::lsdem {
namespace {

using Clock = std::chrono::steady_clock;

/// Stops a base that moves, and lets velocities decay from there.
SettlingSimulation begin_rest_phase(Simulation simulation, const SequenceStage& stage, const Settling& settling, RestPhaseState& state) {
    // undamped while the base moves: the damping of velocities would hold blocks back against it
    state.stop = simulation.base().velocity;
    if (!state.stop.isZero(0.0)) {
        state.clock = simulation.time();
        state.moved = simulation.base().displacement;
        const BaseComponents stop = make_stop(stage.motion, state.stop);
        simulation.begin_motion(stop);
        detail::advance_in_pieces(simulation, static_cast<std::uint64_t>(std::ceil(stop.shift[0].dt / simulation.time_step())),
                                  [](std::uint64_t /*taken*/) {});
    }
    return {std::move(simulation), settling.damping_rate};
}

}  // namespace

RestPhaseEnd come_to_rest(Simulation& simulation, const SequenceStage& stage, const Settling& settling, RunResult& run,
                          const RestPhaseWatch& watch, const std::optional<RestPhaseState>& from) {
    const Clock::time_point start = Clock::now();
    RestPhaseState state = from.value_or(RestPhaseState{});
    SettlingSimulation settling_simulation =
        from ? SettlingSimulation(std::move(simulation)) : begin_rest_phase(std::move(simulation), stage, settling, state);
    const Simulation& now = settling_simulation.state();
    const double wall_time_before = state.wall_time;
    const auto wall_time = [&] { return wall_time_before + std::chrono::duration<double>(Clock::now() - start).count(); };
    const auto base_moved = [&] { return Vector3(state.moved + now.base().displacement); };

    SettlingWatch observer;
    observer.on_progress = watch.on_progress;
    observer.give_up = [&] {
        note_falls(run, now, state.clock + now.time(), BaseState{base_moved()});
        return run.collapse_time.has_value();
    };
    observer.on_state = [&](const SettlingState& settled) {
        state.settling = settled;
        state.wall_time = wall_time();
        if (watch.on_state) watch.on_state(state, now);
    };
    RestPhaseEnd end;
    end.rest = settle(settling_simulation, settling, observer, state.settling);
    update_status(run, now);
    if (run.divergence) run.divergence->time += state.clock;
    end.moved = base_moved();
    end.wall_time = wall_time();
    simulation = std::move(settling_simulation).finish();
    return end;
}

BaseComponents find_motion(const SequenceStage& stage, const RestPhaseState& state) {
    return state.stop.isZero(0.0) ? stage.motion : make_stop(stage.motion, state.stop);
}

}  // namespace musim::lsdem
