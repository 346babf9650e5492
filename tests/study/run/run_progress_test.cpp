#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "lsdem/results/checked_json.hpp"
#include "lsdem/results/drift.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/run/progress_file.hpp"
#include "lsdem/run/simulate.hpp"
#include "lsdem/run/watched_folder.hpp"
#include "tests/study/made_run.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;

namespace {

/// A spine of two blocks, centres at 1 m and 3 m, over two samples: the base moves by (0.1, 0) m, the blocks by (0.3, 0.4) m and (0.3,
/// -0.2) m.
RunResult make_leaning_run() {
    RunResult run;
    run.spine = {.block = {0, 1}, .level = {1, 2}};
    run.blocks.size = {{1.0, 1.0, 2.0}, {1.0, 1.0, 2.0}};
    run.history.time = {0.0, 0.5};
    run.history.base = {{.displacement = {0.2, 0.0, 0.0}}, {.displacement = {0.3, 0.0, 0.0}}};
    run.history.spine_position = {{0.0, 0.0, 1.0}, {5.0, 0.0, 3.0}, {0.3, 0.4, 0.9}, {5.3, -0.2, 3.5}};
    return run;
}

}  // namespace

TEST_CASE("the largest drift is the largest slope between neighbors of the spine, the base included") {
    const RunResult run = make_leaning_run();
    CHECK(find_drift(run, find_drift_pairs(run), 0).value == 0.0);
    // base to first: |(0.2, 0.4)| over 1 m; first to second: |(0, 0.6)| over 2 m
    CHECK(find_drift(run, find_drift_pairs(run), 1).value == doctest::Approx(std::sqrt(0.2)).epsilon(1e-15));

    RunResult beside = run;
    beside.history.spine_position[1].z() = 1.0;
    beside.history.spine_position[3] = {9.0, 9.0, 1.0};
    CHECK(find_drift(beside, find_drift_pairs(beside), 1).value == doctest::Approx(std::sqrt(0.2)).epsilon(1e-15));
}

TEST_CASE("a history is thinned to the extremes of its parts, signs kept") {
    CHECK(thin_extremes({1.0, -2.0, 3.0}, 3) == std::vector<double>{1.0, -2.0, 3.0});
    CHECK(thin_extremes({1.0, -2.0, 3.0, 0.5, -7.0, 6.0, 0.0}, 3) == std::vector<double>{-2.0, 3.0, -7.0});
    CHECK(thin_extremes({}, 3).empty());
}

TEST_CASE("what is seen of a run is what its last sample holds") {
    const RunResult run = make_made_run(300);
    const TimePlan plan{.time_step = 0.001, .steps_per_sample = 10, .samples = 1000, .samples_per_frame = 0};
    const RunProgress live = observe_run(run, plan);
    CHECK(live.time == run.history.time.back());
    CHECK(live.duration == plan.duration());
    CHECK(live.kinetic_energy == run.history.energy.back().kinetic);
    CHECK(live.blocks == 2);
    CHECK(live.fallen == 1);
    CHECK_FALSE(live.collapsed);
    CHECK(live.axis == 0);
    REQUIRE(live.top_velocity.size() == kProgressPoints);
    CHECK(live.top_velocity.front() == 0.7);
    CHECK(parse_progress_run(nlohmann::json::parse(to_json(live).dump())) == live);
}

TEST_CASE("a run reports its state in its folder while it goes on, and only then") {
    const musim::tests::TemporaryFolder place;
    const std::filesystem::path out = place.path() / "out";
    CHECK(look_into(out).state == FolderState::empty);
    const RunResult run = make_made_run(300);
    const TimePlan plan{.time_step = 0.001, .steps_per_sample = 10, .samples = 600, .samples_per_frame = 0};
    {
        ResultFolder folder(out);
        CHECK(look_into(out).state == FolderState::working);
        CHECK(look_into(out).runs.empty());
        ProgressFile progress(out, "made", std::chrono::seconds(0));
        RunSettings settings;
        double heard = 0.0;
        settings.observer.on_progress = [&](double fraction) { heard = fraction; };
        progress.listen_to(settings.observer);
        settings.observer.on_preparation(0.25);
        REQUIRE(look_into(out).runs.size() == 1);
        CHECK(look_into(out).runs[0].state.prepares);
        CHECK_FALSE(look_into(out).runs[0].state.run);
        CHECK_FALSE(look_into(out).runs[0].state.left);
        settings.observer.on_sample(run, plan);
        // what follows the preparation shares the rest of one scale
        settings.observer.on_progress(0.5);
        CHECK(heard == 0.5);
        const WatchedFolder watched = look_into(out);
        CHECK(watched.state == FolderState::working);
        REQUIRE(watched.runs.size() == 1);
        CHECK(watched.runs[0].works);
        CHECK(watched.runs[0].state.name == "made");
        CHECK_FALSE(watched.runs[0].state.prepares);
        CHECK(watched.runs[0].state.fraction == 0.625);
        CHECK(watched.runs[0].state.left.value() > 0.0);
        CHECK(watched.runs[0].state.run == observe_run(run, plan));
        folder.add_json("summary.json", {{"status", "collapsed"}});
        folder.commit();
    }
    CHECK_FALSE(std::filesystem::exists(out / kProgressName));
    CHECK(look_into(out).state == FolderState::finished);
    CHECK(look_into(out).status == "collapsed");
}

TEST_CASE("what a kill leaves behind is not taken for work, nor for results") {
    const musim::tests::TemporaryFolder place;
    place.write(kProgressName, R"({"schema": "musim-progress/1", "name": "left", "phase": "running", "fraction": 0.5, "wall_s": 3})");
    place.write("summary.json", make_checked_json({{"status", "completed"}}));
    const WatchedFolder watched = look_into(place.path());
    CHECK(watched.state == FolderState::killed);
    REQUIRE(watched.runs.size() == 1);
    CHECK_FALSE(watched.runs[0].works);
    // one of another make says nothing
    place.write(kProgressName, R"({"schema": "musim-progress/2"})");
    CHECK(look_into(place.path()).state == FolderState::finished);
    place.write(kProgressName, "{");
    CHECK(look_into(place.path()).state == FolderState::finished);
    CHECK(look_into(place.path()).status == "completed");
    place.write("summary.json", R"({"status": "completed"})");
    CHECK(look_into(place.path()).status == "damaged");
}
