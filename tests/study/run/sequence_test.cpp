#include "lsdem/run/sequence.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "lsdem/results/read_results.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/run/sequence_plan.hpp"
#include "lsdem/scene/motions.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/study/stage_files.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using musim::tests::bytes_of;
using musim::tests::message_of;
using musim::tests::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const std::string kColumn = R"({"kind": "column", "layers": 3, "block": ["12.710 mm", "26.355 mm", "39.780 mm"]})";

/// One cycle of 8 Hz along the wide or the thin side of the blocks, as a motion of the list.
std::string sine(const std::string& amplitude, const std::string& more = "", const std::string& direction = "y") {
    return R"({"base_motion": {"signal": "sine", "direction": ")" + direction + R"(", "amplitude": ")" + amplitude +
           R"(", "frequency": "8 Hz", "cycles": 1})" + more + "}";
}

std::string make_text(const std::string& structure, const std::string& motions, const std::string& time = R"({"duration": "0.15 s"})") {
    return R"({"schema": "musim-scene/1", "name": "test", "material": "wood",
        "structure": )" +
           structure + ", " + motions + R"(, "time": )" + time + R"(, "output": {"spine_rate": "400 Hz"}})";
}

Scene make_sequence_scene(const std::string& structure, const std::string& motions) {
    return parse_scene(make_text(structure, "\"motions\": [" + motions + "]"));
}

SequenceSettings settings_for(const fs::path& directory, int threads = 1) {
    return {.directory = directory, .version = "test", .threads = threads, .checkpoint_interval = 1e9};
}

SequenceSummary shake(const Scene& scene, const fs::path& directory, int threads = 1) {
    return run_sequence(scene, settings_for(directory, threads));
}

std::vector<StoredRun> read_stages(const fs::path& directory, const SequenceSummary& summary) {
    std::vector<StoredRun> runs;
    for (const StageSummary& stage : summary.stages) runs.push_back(read_run(directory / stage.where.folder));
    return runs;
}

struct Killed {};

/// Runs a sequence that dies as soon as `fraction` of it is done, or a stage of that folder is stored.
void kill_at(const Scene* scene, const fs::path& directory, double fraction, const std::string& stored = "") {
    SequenceSettings settings = settings_for(directory);
    settings.checkpoint_interval = 0.0;
    settings.observer.on_progress = [&](double done) {
        if (done >= fraction) throw Killed{};
    };
    settings.on_stage = [&](const std::string& folder) {
        if (folder == stored) throw Killed{};
    };
    CHECK_THROWS_AS(scene != nullptr ? run_sequence(*scene, settings) : resume_sequence(settings), Killed);
}

/// `count` lone upright blocks of wood, 12.710 mm thick and 1 m apart; their heights in mm.
std::string make_lone_blocks(std::size_t count, const std::map<std::size_t, int>& heights, int height) {
    std::string blocks;
    for (std::size_t i = 0; i < count; ++i) {
        const int h = heights.contains(i) ? heights.at(i) : height;
        blocks += fmt::format(R"({}{{"size": ["12.710 mm", "26.355 mm", "{} mm"], "position": [0, "{} m", "{} mm"]}})", i > 0 ? ", " : "",
                              h, i, 0.5 * h);
    }
    return R"({"kind": "blocks", "blocks": [)" + blocks + "]}";
}

}  // namespace

TEST_CASE("a sequence of one motion is the plain run, to the byte") {
    const std::string motion = R"({"signal": "sine", "direction": "y", "amplitude": "0.4 g", "frequency": "8 Hz", "cycles": 1})";
    const Scene plain = parse_scene(make_text(kColumn, "\"base_motion\": " + motion));
    const TemporaryFolder folder;
    const SequenceSummary summary = shake(make_sequence_scene(kColumn, sine("0.4 g")), folder.path() / "sequence");
    CHECK(summary.status() == RunStatus::completed);
    CHECK_FALSE(summary.stages.front().at_start.has_value());
    ResultFolder results(folder.path() / "plain");
    results.add_run("", run_scene(plain), {.scene = write_scene(plain), .program_version = "test"});
    results.commit();
    check_same_files(folder.path() / "plain", folder.path() / "sequence" / "stage-01-sine");
}

TEST_CASE("every stage begins where the one before left the structure, at rest, with the base and the energy balance anew" *
          doctest::test_suite("one-thread")) {
    const TemporaryFolder folder;
    const Scene scene = make_sequence_scene(kColumn, sine("0.5 g", R"(, "name": "first one", "repeat": 2)") + ", " + sine("0.4 g"));
    const SequenceSummary summary = shake(scene, folder.path());
    REQUIRE(summary.stages.size() == 3);
    CHECK(summary.stages[0].where.folder == "stage-01-first-one");
    CHECK(summary.stages[1].where.folder == "stage-02-first-one");
    CHECK(summary.stages[2].where.folder == "stage-03-sine");
    CHECK(summary.duration() == doctest::Approx(0.45));
    const std::vector<StoredRun> runs = read_stages(folder.path(), summary);
    for (std::size_t k = 0; k < runs.size(); ++k) {
        CAPTURE(k);
        const StoredRun& run = runs[k];
        CHECK(run.history.time.front() == 0.0);
        CHECK(run.history.base.front().displacement == Vector3::Zero());
        REQUIRE(run.history.energy.size() == run.history.samples());
        CHECK(run.history.energy.front().base_work == 0.0);
        CHECK(run.history.energy.front().friction_loss == 0.0);
        CHECK(run.history.energy.front().damping_loss == 0.0);
        REQUIRE(run.origin.has_value() == (k > 0));
        const auto json = nlohmann::json::parse(bytes_of(run.directory / "summary.json"));
        // what a step in which blocks touch or part books wrongly, see docs/theory/overlap_contact.md
        CHECK(json["energy_closure"] < 0.01);
        CHECK(json["warnings"].empty());
        CHECK(parse_scene(run.scene).motions.empty());
        if (k == 0) continue;
        CHECK(json["rest"]["at_rest"] == true);
        CHECK(run.origin->stage == k);
        CHECK(run.origin->time == doctest::Approx(0.15 * static_cast<double>(k)));
        CHECK(run.origin->position == runs[0].initial.position);
        // the whole base has moved as far as the motions before: A/ω·T each, less the thousandth that the sampling costs
        const double each = 9.80665 / (2.0 * std::numbers::pi * 8.0) / 8.0, moved = 0.5 * each * static_cast<double>(k);
        CHECK(run.origin->base.y() == doctest::Approx(moved).epsilon(1e-3));
        // between the stages the blocks came to rest, no farther than they leaned
        CHECK((run.initial.position[0] - runs[k - 1].final.position[0]).norm() < 0.2 * 0.01271);
        CHECK(run.history.spine_velocity.front().norm() < 1e-5);
    }
    // shaken further, the structure is damaged further
    const StageSummary& last = summary.stages.back();
    REQUIRE(last.at_start.has_value());
    CHECK(last.of_sequence.damage.loss->total() > summary.stages[1].of_sequence.damage.loss->total());
    CHECK(last.of_sequence.damage.loss->total() ==
          doctest::Approx(summary.stages[0].of_stage.damage.loss->total() + summary.stages[1].of_stage.damage.loss->total() +
                          last.of_stage.damage.loss->total()));
}

TEST_CASE("residuals since the first start add up over the stages, relative to the base") {
    // a block that only slides: 2 g of base acceleration against a friction of 0.63
    const std::string block =
        R"({"kind": "blocks", "blocks": [{"size": ["39.78 mm", "26.355 mm", "12.71 mm"], "position": [0, 0, "6.355 mm"]}]})";
    const TemporaryFolder folder;
    const SequenceSummary summary =
        shake(make_sequence_scene(block, sine("2 g", R"(, "duration": "0.4 s", "repeat": 3)", "x")), folder.path());
    REQUIRE(summary.stages.size() == 3);
    Vector3 sum = Vector3::Zero();
    for (const StageSummary& stage : summary.stages) {
        const Vector3 own = stage.of_stage.spine.front().residual_displacement;
        CHECK(std::abs(own.x()) > 1e-4);
        if (stage.at_start) CHECK((stage.at_start->spine.front().residual_displacement - sum).norm() < 1e-6 * sum.norm());
        sum += own;
        // to what the block still slips while its springs come to rest
        CHECK((stage.of_sequence.spine.front().residual_displacement - sum).norm() < 1e-6 * sum.norm());
        CHECK(stage.of_sequence.damage.joints.front().slip == doctest::Approx(sum.norm()).epsilon(1e-6));
    }
}

TEST_CASE("a sequence at 1:16 is the same bits in all stages and its summary" * doctest::test_suite("slow")) {
    const Scene scene = make_sequence_scene(
        kColumn, sine("0.7 g") + ", " + R"({"base_motion": {"signal": "half_sine", "amplitude": "0.3 g", "duration": "0.06 s"}})" + ", " +
                     sine("0.5 g"));
    const musim::scaling::Similitude similitude = musim::scaling::make_similitude("exact", {.length = 1.0 / 16.0});
    const TemporaryFolder folder;
    const SequenceSummary large = shake(scene, folder.path() / "large");
    const SequenceSummary small = shake(scale_scene(scene, similitude), folder.path() / "small");
    REQUIRE(large.stages.size() == 3);
    REQUIRE(small.stages.size() == 3);
    const auto a = read_stages(folder.path() / "large", large), b = read_stages(folder.path() / "small", small);
    const double length = 1.0 / 16.0, time = similitude.time(), velocity = similitude.velocity();
    for (std::size_t k = 0; k < 3; ++k) {
        CAPTURE(k);
        REQUIRE(a[k].history.samples() == b[k].history.samples());
        for (std::size_t i = 0; i < a[k].history.samples(); ++i) CHECK(b[k].history.time[i] == time * a[k].history.time[i]);
        for (std::size_t i = 0; i < a[k].history.spine_velocity.size(); ++i) {
            CHECK(b[k].history.spine_velocity[i] == Vector3(velocity * a[k].history.spine_velocity[i]));
            CHECK(b[k].history.spine_rotation[i] == a[k].history.spine_rotation[i]);
        }
        for (std::size_t i = 0; i < a[k].final.position.size(); ++i)
            CHECK(b[k].final.position[i] == Vector3(length * a[k].final.position[i]));
        if (k > 0) CHECK(b[k].origin->base == Vector3(length * a[k].origin->base));
        CHECK(small.stages[k].of_sequence.damage.index == large.stages[k].of_sequence.damage.index);
        CHECK(small.stages[k].peak_acceleration == similitude.acceleration() * large.stages[k].peak_acceleration);
    }
}

TEST_CASE("a base that still moves when a stage ends is stopped before the rest phase, as hard as the stage shook it" *
          doctest::test_suite("one-thread")) {
    BaseComponents motion;
    motion.shift[0] = {.start = 0.0, .dt = 0.5, .velocity = {0.0, 1.0, 0.5}};
    motion.shift[2] = {.start = 0.0, .dt = 0.25, .velocity = {0.0, -1.0, 0.0}};
    const auto stop = make_stop(motion, {0.5, 0.0, -0.25});
    // 0.5 m/s at 4 m/s²
    for (const BaseComponent& c : stop.shift) CHECK(c.dt == 0.125);
    CHECK(stop.shift[0].velocity == std::vector{0.5, 0.0});
    CHECK(stop.shift[2].velocity == std::vector{-0.25, 0.0});

    const TemporaryFolder folder;
    const std::string push = R"({"base_motion": {"signal": "half_sine", "amplitude": "0.2 g", "duration": "0.06 s"}, "duration": "0.1 s"})";
    const SequenceSummary summary = shake(make_sequence_scene(kColumn, push + ", " + push), folder.path());
    const auto runs = read_stages(folder.path(), summary);
    REQUIRE(runs.size() == 2);
    const double end = runs[0].history.base.back().displacement.x(), speed = runs[0].history.base.back().velocity.x();
    REQUIRE(speed > 0.0);
    // v²/(2a) further; half a percent for the peak between samples and the step in which it stops
    CHECK(runs[1].origin->base.x() - end == doctest::Approx(speed * speed / (2.0 * 0.2 * 9.80665)).epsilon(5e-3));
    CHECK(runs[1].history.base.front().velocity.norm() == 0.0);
    CHECK(runs[1].history.spine_velocity.front().norm() < 1e-5);
}

TEST_CASE("a stage without a rest phase goes on with the velocities of the one before") {
    const TemporaryFolder folder;
    const SequenceSummary summary =
        shake(make_sequence_scene(kColumn, sine("0.5 g") + ", " + sine("0.4 g", R"(, "settle": false)")), folder.path());
    const auto runs = read_stages(folder.path(), summary);
    REQUIRE(runs.size() == 2);
    CHECK(runs[0].history.spine_velocity.back().norm() > 1e-3);
    for (std::size_t s = 0; s < runs[0].spine.size(); ++s) {
        const std::size_t last = (runs[0].history.samples() - 1) * runs[0].spine.size() + s;
        CHECK(runs[1].history.spine_velocity[s] == runs[0].history.spine_velocity[last]);
        CHECK(runs[1].history.spine_position[s] == runs[0].history.spine_position[last]);
    }
    CHECK_FALSE(nlohmann::json::parse(bytes_of(runs[1].directory / "summary.json")).contains("rest"));
}

TEST_CASE("the sequence ends with the stage in which the structure collapses, which is dated" * doctest::test_suite("one-thread")) {
    const TemporaryFolder folder;
    const Scene scene = make_sequence_scene(kColumn, sine("0.3 g") + ", " + sine("3 g", R"(, "duration": "0.5 s")") + ", " + sine("0.3 g"));
    const SequenceSummary summary = shake(scene, folder.path());
    CHECK(summary.planned == 3);
    REQUIRE(summary.stages.size() == 2);
    CHECK(summary.status() == RunStatus::collapsed);
    CHECK(summary.stages[0].status == RunStatus::completed);
    REQUIRE(summary.stages[1].collapse_time.has_value());
    CHECK(*summary.collapse_time() == doctest::Approx(0.15 + *summary.stages[1].collapse_time));
    CHECK_FALSE(fs::exists(folder.path() / "stage-03-sine"));
    CHECK_FALSE(fs::exists(folder.path() / kCheckpointName));
    auto json = nlohmann::json::parse(bytes_of(folder.path() / "sequence.json"));
    json.erase("checksum");
    CHECK(json == to_json(summary));
    CHECK(json["collapse"]["stage"] == 2);
    CHECK(json["collapse"]["in_rest_phase"] == false);
    CHECK(json["failure"]["mode"] == "undecided");
    CHECK(json["stages"][1]["since_first_start"]["fallen_blocks"] > 0);
    const std::string csv = bytes_of(folder.path() / "sequence.csv");
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 3);
    const std::string header = csv.substr(0, csv.find('\n')), line = csv.substr(csv.rfind('\n', csv.size() - 2));
    CHECK(std::count(header.begin(), header.end(), ',') == std::count(line.begin(), line.end(), ','));
    const std::string levels = bytes_of(folder.path() / "sequence_levels.csv");
    CHECK(std::count(levels.begin(), levels.end(), '\n') == 1 + 2 * 2);
}

TEST_CASE("blocks that earlier stages have thrown down count for the collapse" * doctest::test_suite("slow")) {
    // of 40 blocks the first falls in the first stage, which is too few; two of them are enough
    const std::string blocks = make_lone_blocks(40, {{0, 120}, {1, 70}}, 30);
    const std::string wait = R"(, "duration": "0.8 s")";
    const TemporaryFolder folder;
    const SequenceSummary summary =
        shake(make_sequence_scene(blocks, sine("0.25 g", wait, "x") + ", " + sine("0.4 g", wait, "x") + ", " + sine("0.3 g", wait, "x")),
              folder.path());
    REQUIRE(summary.stages.size() == 2);
    CHECK(summary.stages[0].status == RunStatus::completed);
    CHECK(summary.stages[0].fallen == 1);
    CHECK(summary.stages[1].fallen_before == 1);
    CHECK(summary.stages[1].fallen == 2);
    CHECK(summary.stages[1].status == RunStatus::collapsed);
    // since the start of the stage only one fell
    CHECK(summary.stages[1].of_stage.damage.fallen == 1);
    CHECK(summary.stages[1].of_sequence.damage.fallen == 2);
    const auto runs = read_stages(folder.path(), summary);
    CHECK(runs[1].falls.time[0] == doctest::Approx(runs[0].falls.time[0] - 0.8));
    CHECK(runs[1].falls.displacement[0] == runs[0].falls.displacement[0]);
    CHECK(runs[1].falls.time[1] > 0.0);
}

TEST_CASE("a structure that collapses while it comes to rest has collapsed after its motion") {
    const TemporaryFolder folder;
    const Scene scene =
        make_sequence_scene(make_lone_blocks(1, {}, 100), sine("1 g", R"(, "duration": "0.125 s")", "x") + ", " + sine("0.1 g"));
    const SequenceSummary summary = shake(scene, folder.path());
    REQUIRE(summary.stages.size() == 1);
    CHECK(summary.status() == RunStatus::collapsed);
    CHECK(*summary.stages[0].collapse_time > 0.125);
    CHECK(to_json(summary)["collapse"]["in_rest_phase"] == true);
    CHECK(read_stages(folder.path(), summary)[0].status == RunStatus::collapsed);
}

TEST_CASE("a sequence killed anywhere and resumed has the files of one that was not to the byte" * doctest::test_suite("slow")) {
    const Scene scene = make_sequence_scene(kColumn, sine("0.5 g", R"(, "repeat": 2)") + ", " + sine("0.4 g"));
    const TemporaryFolder folder;
    const fs::path whole = folder.path() / "whole";
    shake(scene, whole);
    // in the first, a later and the last stage, in the rest phase after the first, and right after one was stored; then once more
    struct Kill {
        double first, second;
        std::string stored;
    };
    for (const Kill& kill : {Kill{0.1, 0.2, ""}, Kill{0.5, 0.9, ""}, Kill{0.3, 0.33, ""}, Kill{2.0, 2.0, "stage-01-sine"}}) {
        CAPTURE(kill.first);
        CAPTURE(kill.stored);
        const fs::path out = folder.path() / "out";
        kill_at(&scene, out, kill.first, kill.stored);
        REQUIRE(fs::exists(out / kCheckpointName));
        CHECK_FALSE(fs::exists(out / "sequence.json"));
        if (kill.second < 2.0) kill_at(nullptr, out, kill.second, kill.stored);
        resume_sequence(settings_for(out));
        check_same_files(whole, out);
        fs::remove_all(out);
    }
}

TEST_CASE("a sequence is resumed with the same records only, where there is one, and written over by the same scene only") {
    const TemporaryFolder folder;
    const fs::path record = folder.write("record.csv", "0 0 0\n0.01 1 0\n0.02 -1 0\n0.03 0 0\n0.04 0 0\n0.05 0 0\n");
    const std::string motion = R"({"base_motion": {"record": "record.csv", "components": {"x": "1"}}, "duration": "0.05 s"})";
    const Scene scene =
        parse_scene(make_text(kColumn, "\"motions\": [" + sine("0.1 g") + ", " + motion + "]"), folder.path() / "scene.json");
    const fs::path out = folder.path() / "out";
    CHECK(message_of<std::runtime_error>([&] { resume_sequence(settings_for(out)); }).find("no checkpoint") != std::string::npos);
    CHECK_FALSE(fs::exists(out));
    kill_at(&scene, out, 0.9);
    CHECK(message_of<std::runtime_error>([&] { shake(scene, out); }).find("continue it with a resumption of") != std::string::npos);
    folder.write("record.csv", "0 0 0\n0.01 2 0\n0.02 -2 0\n0.03 0 0\n0.04 0 0\n0.05 0 0\n");
    const std::string changed = message_of<ResultError>([&] { resume_sequence(settings_for(out)); });
    CHECK_MESSAGE(changed.find("has a record of the scene or the program changed") != std::string::npos, changed);
    folder.write("record.csv", "0 0 0\n0.01 1 0\n0.02 -1 0\n0.03 0 0\n0.04 0 0\n0.05 0 0\n");
    CHECK(resume_sequence(settings_for(out)).stages.size() == 2);
    CHECK(message_of<std::runtime_error>([&] { resume_sequence(settings_for(out)); }).find("has finished") != std::string::npos);
    const SequenceSummary again = shake(scene, out);
    REQUIRE(again.stages.size() == 2);
    const fs::path second = out / again.stages[1].where.folder;
    const Scene shorter = make_sequence_scene(kColumn, sine("0.1 g"));
    CHECK(message_of<ResultError>([&] { shake(shorter, out); }).find("contents.json: here are results of another scene") !=
          std::string::npos);
    CHECK(fs::exists(second));
    SequenceSettings settings = settings_for(out);
    settings.force = true;
    CHECK(run_sequence(shorter, settings).stages.size() == 1);
    CHECK_FALSE(fs::exists(second));
}

TEST_CASE("motions that the base could only join by a jump are refused before anything runs") {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& motions, const std::string& what) {
        const std::string message =
            message_of<std::runtime_error>([&] { shake(make_sequence_scene(kColumn, motions), folder.path() / "out"); });
        CHECK_MESSAGE(message.find(what) != std::string::npos, message);
        CHECK(message.find('\n') == std::string::npos);
        CHECK_FALSE(fs::exists(folder.path() / "out"));
    };
    const std::string step = R"({"base_motion": {"signal": "step", "velocity": "0.1 m/s"}})";
    refused(step + ", " + sine("0.1 g"), "/motions/1: at the end of stage-01-step (\"step\") the base still has the velocity");
    // in the middle of the sine it runs fastest
    const std::string half = sine("0.5 g", R"(, "duration": "0.0625 s")");
    refused(half + ", " + sine("0.1 g", R"(, "settle": false)"), "/motions/1: the base would jump by 0.195 m/s from stage-01-sine");
    CHECK_NOTHROW(plan_sequence(make_sequence_scene(kColumn, sine("0.1 g") + ", " + step)));
    const Scene plain = parse_scene(make_text(kColumn, R"("base_motion": null)"));
    CHECK(message_of<std::runtime_error>([&] { plan_sequence(plain); }).find("use a single run") != std::string::npos);
}

TEST_CASE("a scene with a list of motions is refused where one can be used") {
    const Scene scene = make_sequence_scene(kColumn, sine("0.1 g"));
    CHECK(message_of<std::runtime_error>([&] { run_scene(scene); }).find("use a sequence") != std::string::npos);
}

TEST_CASE("a sequence gives the same files with any number of threads") {
    // more than 256 blocks: enough for two threads
    const std::string wall = R"({"kind": "wall", "layers": 9, "blocks_per_layer": 33, "block": ["12.710 mm", "26.355 mm", "39.780 mm"]})";
    const std::string jolt =
        R"({"base_motion": {"signal": "sine", "direction": "x", "amplitude": "2 g", "frequency": "400 Hz", "cycles": 1}, "duration": "2.5 ms")";
    const Scene scene = make_sequence_scene(wall, jolt + "}, " + jolt + R"(, "settle": false})");
    const TemporaryFolder folder;
    const SequenceSummary summary = shake(scene, folder.path() / "one", 1);
    REQUIRE(summary.stages.size() == 2);
    CHECK(summary.stages[1].of_stage.damage.loss->friction > 0.0);
    shake(scene, folder.path() / "two", 2);
    check_same_files(folder.path() / "one", folder.path() / "two");
}
