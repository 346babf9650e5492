#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "lsdem/results/checkpoint.hpp"
#include "lsdem/run/prepare.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/run/sequence.hpp"
#include "lsdem/run/specimen_batch.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using musim::tests::bytes_of;
using musim::tests::TemporaryFolder;

namespace {

namespace fs = std::filesystem;

struct KilledPreparation {};

Scene make_prepared_wall(const std::string& more = R"(, "time": {"duration": "10 ms"}, "output": {"spine_rate": "4800 Hz"})") {
    return parse_scene(
        R"({"schema": "musim-scene/1", "name": "uneven wall", "material": "wood", "structure": {"kind": "wall", "layers": 3,
        "blocks_per_layer": 2, "block": ["12.710 mm", "26.355 mm", "39.780 mm"], "height_deviation": "0.155 mm", "seed": 3})" +
            more + "}",
        "test");
}

CheckpointSettings checkpoint_in(const fs::path& folder) {
    return {.file = folder / kCheckpointName, .scene = "{}", .program_version = "1.2", .interval = 0.0};
}

/// Throws at the call number `call`, from 1.
std::function<void(double)> killer(int call) {
    return [left = call](double) mutable {
        if (--left == 0) throw KilledPreparation{};
    };
}

void check_same(const PreparedSpecimen& a, const PreparedSpecimen& b) {
    REQUIRE(a.specimen.model.blocks.size() == b.specimen.model.blocks.size());
    for (std::size_t i = 0; i < a.specimen.model.blocks.size(); ++i) {
        CHECK(a.specimen.model.blocks[i].position == b.specimen.model.blocks[i].position);
        CHECK(a.specimen.model.blocks[i].orientation.coeffs() == b.specimen.model.blocks[i].orientation.coeffs());
    }
    CHECK(a.specimen.model.preload == b.specimen.model.preload);
    CHECK(a.rest.kinetic == b.rest.kinetic);
    CHECK(a.steps == b.steps);
    CHECK(a.block_steps == b.block_steps);
    CHECK(a.max_overlap == b.max_overlap);
}

}  // namespace

TEST_CASE("a preparation resumed from any of its checkpoints ends in the bits of an uninterrupted one" * doctest::test_suite("slow")) {
    const Scene scene = make_prepared_wall();
    const Specimen upright = make_upright_specimen(scene);
    const double step = compute_time_step(scene, upright.model).value();
    PreparationSettings settings = find_preparation(scene, upright);
    struct Way {
        BlockPlacing placing;
        double added_patience;
    };
    // the last one gets its own inertia back before it is at rest
    const double patient = settings.added_patience;
    for (const Way& way : {Way{BlockPlacing::layers_mass_scaled, patient}, Way{BlockPlacing::resting, patient},
                           Way{BlockPlacing::layers, patient}, Way{BlockPlacing::layers_mass_scaled, 1e-2}}) {
        settings.placing = way.placing;
        settings.added_patience = way.added_patience;
        int looks = 0;
        const PreparedSpecimen whole = prepare(upright, step, settings, {.observer = {.on_progress = [&](double) { ++looks; }}});
        REQUIRE(whole.rest.at_rest);
        // in the first layer, in later ones, while the whole comes to rest, and when it is so for the first time
        for (const int look : {3, looks / 4, looks / 2, looks - 1}) {
            CAPTURE(look);
            const TemporaryFolder folder;
            const RunSettings killed{.observer = {.on_progress = killer(look)}, .checkpoint = checkpoint_in(folder.path())};
            CHECK_THROWS_AS(prepare(upright, step, settings, killed), KilledPreparation);
            const Checkpoint checkpoint = read_checkpoint(folder.path() / kCheckpointName, "1.2");
            REQUIRE(checkpoint.preparation.has_value());
            check_same(prepare(upright, step, settings, {.threads = 2}, checkpoint.preparation), whole);
        }
    }
}

TEST_CASE("a run that is killed while its specimen is prepared, or later, goes on from there") {
    const Scene scene = make_prepared_wall();
    const RunResult whole = run_scene(scene);
    for (const int look : {2, 100, 0}) {
        CAPTURE(look);
        const TemporaryFolder folder;
        // one that is not killed in its preparation is killed after two samples
        RunSettings killed{.observer = {.on_progress = killer(2)}, .checkpoint = checkpoint_in(folder.path())};
        if (look > 0) killed.observer.on_preparation = killer(look);
        CHECK_THROWS_AS(run_scene(scene, killed), KilledPreparation);
        Checkpoint checkpoint = read_checkpoint(folder.path() / kCheckpointName, "1.2");
        CHECK(checkpoint.preparation.has_value() == (look > 0));
        CHECK(checkpoint.places.has_value() == (look == 0));
        int looks = 0;
        const RunSettings counted{.observer = {.on_preparation = [&](double) { ++looks; }}};
        const RunResult resumed = resume_scene(scene, std::move(checkpoint), counted);
        CHECK(resumed.state_hash == whole.state_hash);
        CHECK(resumed.rest->steps == whole.rest->steps);
        CHECK((looks == 0) == (look == 0));
    }
}

// contacts by nodes cannot be given the friction that they bore when the preparation ended, so the specimen comes to rest once more
TEST_CASE("a specimen by nodes that comes to rest before its run shows how far it is, and goes on when it was killed") {
    const Scene scene = make_prepared_wall(
        R"(, "shape": {"kind": "box", "nodes_per_face": 12}, "contact": {"faces": "nodes"}, "time": {"duration": "1 ms"})");
    std::vector<double> parts;
    const RunResult whole = run_scene(scene, {.observer = {.on_preparation = [&](double part) { parts.push_back(part); }}});
    REQUIRE(whole.rest->at_rest);
    const auto looks = static_cast<std::ptrdiff_t>(whole.rest->steps / 64);
    REQUIRE(looks > 20);
    // the part grows from look to look, beyond what the preparation had come to
    const auto settling = parts.end() - looks;
    CHECK(std::is_sorted(settling, parts.end()));
    CHECK(parts.back() > *(parts.end() - looks / 2));
    CHECK(parts.back() > *std::max_element(parts.begin(), settling));
    const std::ptrdiff_t look = looks / 2;
    const TemporaryFolder folder;
    std::ptrdiff_t left = std::ssize(parts) - look;
    const auto kill = [&left](double) {
        if (--left == 0) throw KilledPreparation{};
    };
    constexpr std::uint64_t kLooksBetween = 8;
    RunSettings killed{.observer = {.on_preparation = kill}, .checkpoint = checkpoint_in(folder.path())};
    killed.checkpoint->samples = kLooksBetween;
    CHECK_THROWS_AS(run_scene(scene, killed), KilledPreparation);
    Checkpoint checkpoint = read_checkpoint(folder.path() / kCheckpointName, "1.2");
    CHECK(checkpoint.settling.has_value());
    CHECK(checkpoint.places.has_value());
    int again = 0;
    const RunSettings counted{.threads = 2, .observer = {.on_preparation = [&](double) { ++again; }}};
    const RunResult resumed = resume_scene(scene, std::move(checkpoint), counted);
    CHECK(resumed.state_hash == whole.state_hash);
    CHECK(resumed.rest->steps == whole.rest->steps);
    // nothing but what was left
    CHECK(again <= look + static_cast<std::ptrdiff_t>(kLooksBetween) + 2);
}

TEST_CASE("a preparation that began in equilibrium is resumed to the same bits") {
    const Scene scene = parse_scene(
        R"({"schema": "musim-scene/1", "name": "even wall", "material": "wood", "structure": {"kind": "wall", "layers": 3,
        "blocks_per_layer": 2, "block": ["12.710 mm", "26.355 mm", "39.780 mm"]}, "time": {"duration": "10 ms"},
        "output": {"spine_rate": "4800 Hz"}})",
        "test");
    const RunResult whole = run_scene(scene);
    const TemporaryFolder folder;
    // it is at rest all the time: progress is reported at the end only
    CHECK_THROWS_AS(run_scene(scene, {.observer = {.on_preparation = killer(1)}, .checkpoint = checkpoint_in(folder.path())}),
                    KilledPreparation);
    Checkpoint checkpoint = read_checkpoint(folder.path() / kCheckpointName, "1.2");
    REQUIRE(checkpoint.preparation.has_value());
    CHECK(resume_scene(scene, std::move(checkpoint)).state_hash == whole.state_hash);
}

TEST_CASE("a checkpoint of a preparation of other blocks is refused") {
    const Scene scene = make_prepared_wall();
    const TemporaryFolder folder;
    CHECK_THROWS_AS(run_scene(scene, {.observer = {.on_preparation = killer(3)}, .checkpoint = checkpoint_in(folder.path())}),
                    KilledPreparation);
    const Checkpoint checkpoint = read_checkpoint(folder.path() / kCheckpointName, "1.2");
    CHECK_THROWS_AS((void)resume_scene(with_seed(scene, 4), checkpoint), std::runtime_error);
}

TEST_CASE("blocks in no layers are prepared as they are drawn") {
    const Scene scene = parse_scene(
        R"({"schema": "musim-scene/1", "name": "block", "material": "wood", "structure": {"kind": "blocks", "blocks":
        [{"size": ["12.710 mm", "26.355 mm", "39.780 mm"], "position": [0, 0, "19.89 mm"]}]}, "preparation": {"placing": "as_drawn"},
        "time": {"duration": "5 ms"}, "output": {"spine_rate": "4800 Hz"}})",
        "test");
    const RunResult run = run_scene(scene);
    REQUIRE(run.rest.has_value());
    CHECK(run.rest->at_rest);
    CHECK(std::abs(*run.base_reaction_over_weight - 1.0) < 1e-4);
}

TEST_CASE("specimens whose preparation was killed are the same files in the end and leave nothing else behind" *
          doctest::test_suite("slow")) {
    const TemporaryFolder folder;
    SpecimenBatch batch{.scene = make_prepared_wall(), .seeds = {3}, .folder = folder.path() / "whole", .version = "test", .threads = 1};
    const SpecimenReport whole = make_specimens(batch).front();
    batch.folder = folder.path() / "killed";
    batch.checkpoint_interval = 0.0;
    batch.on_progress = killer(50);
    CHECK_THROWS_AS(make_specimens(batch), KilledPreparation);
    const fs::path file = batch.folder / whole.file.filename(), checkpoint = file.string() + ".checkpoint";
    CHECK(fs::exists(checkpoint));
    CHECK_FALSE(fs::exists(file));
    batch.on_progress = {};

    SUBCASE("gone on with") {
        const SpecimenReport report = make_specimens(batch).front();
        CHECK(report.resumed);
        CHECK(report.prepared.steps == whole.prepared.steps);
    }
    SUBCASE("a damaged checkpoint is reported, and the preparation begun anew") {
        std::ofstream(checkpoint, std::ios::binary) << "damaged";
        std::string warning;
        batch.on_warning = [&](const std::string& what) { warning = what; };
        CHECK_FALSE(make_specimens(batch).front().resumed);
        CHECK(warning.find(checkpoint.string()) != std::string::npos);
    }
    SUBCASE("one of another format is named in a warning, and the preparation begun anew") {
        std::string old = bytes_of(checkpoint);
        old[12] = 8;  // see the test of checkpoints
        std::ofstream(checkpoint, std::ios::binary) << old;
        std::string warning;
        batch.on_warning = [&](const std::string& what) { warning = what; };
        CHECK_FALSE(make_specimens(batch).front().resumed);
        CHECK(warning.find(checkpoint.string()) != std::string::npos);
        CHECK(warning.find("format 8") != std::string::npos);
    }
    CHECK(bytes_of(file) == bytes_of(whole.file));
    CHECK_FALSE(fs::exists(checkpoint));
}

TEST_CASE("a sequence that is killed while its specimen is prepared goes on from there") {
    const Scene scene = make_prepared_wall(
        R"(, "motions": [{"base_motion": {"signal": "sine", "direction": "y", "amplitude": "0.2 g", "frequency": "40 Hz", "cycles": 1}}],
        "output": {"spine_rate": "4800 Hz"})");
    const TemporaryFolder folder;
    SequenceSettings settings{.directory = folder.path() / "whole", .version = "test"};
    run_sequence(scene, settings);
    settings.directory = folder.path() / "killed";
    settings.checkpoint_interval = 0.0;
    settings.observer.on_preparation = killer(50);
    CHECK_THROWS_AS(run_sequence(scene, settings), KilledPreparation);
    settings.observer.on_preparation = {};
    resume_sequence(settings);
    const char* const spine = "stage-01-sine/spine.csv";
    CHECK(bytes_of(folder.path() / "killed" / spine) == bytes_of(folder.path() / "whole" / spine));
}
