#include "lsdem/results/checkpoint.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "lsdem/run/simulate.hpp"
#include "tests/study/made_specimen.hpp"
#include "tests/support/damage.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using musim::tests::bytes_of;

namespace {

namespace fs = std::filesystem;

/// A folder for a checkpoint.
struct Folder : musim::tests::TemporaryFolder {
    fs::path file() const { return path() / kCheckpointName; }
};

/// A column that slides, of which frames are kept.
struct Slide {
    Specimen specimen = make_column(3, 0.1);
    TimePlan plan = make_plan(specimen, 60);

    Slide() { plan.samples_per_frame = 7; }

    RunSettings settings(const Folder& folder, std::uint64_t every, const char* version = "1.2") const {
        RunSettings settings;
        settings.checkpoint =
            CheckpointSettings{.file = folder.file(), .scene = "{\"a\": 1}", .program_version = version, .samples = every};
        return settings;
    }
};

void write_bytes(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

std::string refusal(const fs::path& file, const std::string& version = "1.2") {
    try {
        (void)read_checkpoint(file, version);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return {};
}

/// Everything but the wall time.
void check_same(const RunResult& a, const RunResult& b) {
    CHECK(a.state_hash == b.state_hash);
    CHECK(a.status == b.status);
    CHECK(a.steps == b.steps);
    CHECK(a.collapse_time == b.collapse_time);
    CHECK(a.critical_time_step == b.critical_time_step);
    CHECK(a.energy_closure == b.energy_closure);
    CHECK(a.base_reaction_over_weight == b.base_reaction_over_weight);
    CHECK(a.history.time == b.history.time);
    CHECK(a.history.spine_position == b.history.spine_position);
    CHECK(a.history.spine_velocity == b.history.spine_velocity);
    CHECK(a.history.spine_rotation == b.history.spine_rotation);
    REQUIRE(a.history.base.size() == b.history.base.size());
    for (std::size_t k = 0; k < a.history.base.size(); ++k) {
        const BaseState &x = a.history.base[k], &y = b.history.base[k];
        CHECK(x.displacement == y.displacement);
        CHECK(x.turn.coeffs() == y.turn.coeffs());
        CHECK(x.turn_rates.velocity == y.turn_rates.velocity);
        CHECK(x.turn_rates.acceleration == y.turn_rates.acceleration);
        CHECK(x.pivot == y.pivot);
    }
    REQUIRE(a.history.energy.size() == b.history.energy.size());
    for (std::size_t k = 0; k < a.history.energy.size(); ++k) CHECK(a.history.energy[k].balance() == b.history.energy[k].balance());
    CHECK(a.frames.time == b.frames.time);
    CHECK(a.frames.position == b.frames.position);
    CHECK(a.initial.position == b.initial.position);
    CHECK(a.final.position == b.final.position);
    CHECK(a.blocks.mass == b.blocks.mass);
    CHECK(a.spine.block == b.spine.block);
    CHECK(a.losses->total().friction == b.losses->total().friction);
    REQUIRE(a.falls.time.size() == b.falls.time.size());
    for (std::size_t i = 0; i < a.falls.time.size(); ++i) {
        REQUIRE(std::isnan(a.falls.time[i]) == std::isnan(b.falls.time[i]));
        if (std::isnan(a.falls.time[i])) continue;
        CHECK(a.falls.time[i] == b.falls.time[i]);
        CHECK(a.falls.displacement[i] == b.falls.displacement[i]);
    }
    CHECK(a.falls.at_collapse == b.falls.at_collapse);
    REQUIRE(a.rest.has_value() == b.rest.has_value());
    if (a.rest) CHECK(a.rest->steps == b.rest->steps);
}

}  // namespace

TEST_CASE("a run resumed from any of its checkpoints ends in the bits of an uninterrupted one") {
    const Slide slide;
    const RunResult whole = simulate(slide.specimen, slide.plan);
    REQUIRE(whole.history.energy.back().friction_loss > 0.0);
    const std::uint64_t intervals[] = {1, 7, 20, 59};
    for (const std::uint64_t every : intervals) {
        CAPTURE(every);
        const Folder folder;
        check_same(simulate(slide.specimen, slide.plan, slide.settings(folder, every)), whole);
        // the last checkpoint before the end: at the end come results
        Checkpoint checkpoint = read_checkpoint(folder.file(), "1.2");
        CHECK(checkpoint.samples_done == (slide.plan.samples - 1) / every * every);
        CHECK(checkpoint.scene == "{\"a\": 1}");
        CHECK(folder.count() == 1);
        const double wall_time_before = checkpoint.run.wall_time;
        const RunResult resumed = resume(slide.specimen, std::move(checkpoint), {.threads = 2});
        check_same(resumed, whole);
        // wall time adds up over the parts
        CHECK(wall_time_before > 0.0);
        CHECK(resumed.wall_time > wall_time_before);
    }
}

TEST_CASE("a run on a ground that turns is resumed to the same bits") {
    Slide slide;
    BaseComponents& motion = slide.specimen.model.ground.motion;
    motion.turn[0] = {.start = 0.0, .dt = 0.125, .velocity = {0.0, 0.3, 0.0}};
    motion.turn[1] = {.start = 0.0, .dt = 0.25, .velocity = {0.0, -0.2, 0.1}};
    motion.pivot = {0.5, -1.0, 0.0};
    const RunResult whole = simulate(slide.specimen, slide.plan);
    REQUIRE(whole.history.base.back().turn.vec().norm() > 0.001);
    const Folder folder;
    simulate(slide.specimen, slide.plan, slide.settings(folder, 20));
    check_same(resume(slide.specimen, read_checkpoint(folder.file(), "1.2"), {.threads = 2}), whole);
}

TEST_CASE("a collapse before the checkpoint keeps its date") {
    Slide slide;
    slide.specimen.model.blocks[2].position.z() += 0.4;
    slide.specimen.model.blocks[2].position.x() += 0.7;
    slide.plan.samples = 400;
    const RunResult whole = simulate(slide.specimen, slide.plan);
    REQUIRE(whole.status == RunStatus::collapsed);
    REQUIRE(*whole.collapse_time < whole.history.time[350]);
    // the block that was dropped beside the column, and of 3 one is enough
    CHECK(whole.falls.time[2] == *whole.collapse_time);
    CHECK(whole.falls.displacement[2] == whole.falls.at_collapse[2]);
    CHECK(std::isnan(whole.falls.time[0]));
    const Folder folder;
    simulate(slide.specimen, slide.plan, slide.settings(folder, 350));
    check_same(resume(slide.specimen, read_checkpoint(folder.file(), "1.2")), whole);
}

TEST_CASE("a resumed run still knows how its specimen came to rest") {
    Slide slide;
    slide.specimen.settling = Settling{.damping_rate = 5.0};
    const RunResult whole = simulate(slide.specimen, slide.plan);
    REQUIRE(whole.rest->at_rest);
    REQUIRE(whole.rest->steps > 0);
    const Folder folder;
    simulate(slide.specimen, slide.plan, slide.settings(folder, 20));
    check_same(resume(slide.specimen, read_checkpoint(folder.file(), "1.2")), whole);
}

TEST_CASE("by wall time, an interval of zero is every sample and a long one is never") {
    const Slide slide;
    for (const double interval : {0.0, 1e9}) {
        const Folder folder;
        RunSettings settings = slide.settings(folder, 0);
        settings.checkpoint->interval = interval;
        simulate(slide.specimen, slide.plan, settings);
        CHECK(fs::exists(folder.file()) == (interval == 0.0));
        if (interval == 0.0) CHECK(read_checkpoint(folder.file(), "1.2").samples_done == 59);
    }
}

TEST_CASE("a run with few samples reports its progress and leaves checkpoints between them") {
    Slide slide;
    slide.plan = {.time_step = slide.plan.time_step, .steps_per_sample = 600, .samples = 2};
    const RunResult whole = simulate(slide.specimen, slide.plan);
    const Folder folder;
    RunSettings settings = slide.settings(folder, 0);
    settings.checkpoint->interval = 1e-9;
    std::vector<double> given;
    settings.observer.on_progress = [&](double part) { given.push_back(part); };
    check_same(simulate(slide.specimen, slide.plan, settings), whole);
    CHECK(given.size() > 10);
    CHECK(std::is_sorted(given.begin(), given.end()));
    CHECK(given.back() == 1.0);
    // the last one is of some steps after the first of two samples
    const Checkpoint checkpoint = read_checkpoint(folder.file(), "1.2");
    CHECK(checkpoint.samples_done == 1);
    check_same(resume(slide.specimen, checkpoint, {.threads = 2}), whole);
    Checkpoint before = checkpoint;
    before.samples_done = 0;
    CHECK_THROWS_AS(resume(slide.specimen, std::move(before)), std::runtime_error);
}

TEST_CASE("a checkpoint that cannot be written is reported, and the run goes on") {
    const Slide slide;
    const Folder folder;
    RunSettings settings = slide.settings(folder, 20);
    settings.checkpoint->file = folder.file() / "no" / "such" / "folder";
    std::vector<std::string> given;
    settings.checkpoint->on_failure = [&](const std::string& why) { given.push_back(why); };
    check_same(simulate(slide.specimen, slide.plan, settings), simulate(slide.specimen, slide.plan));
    REQUIRE(given.size() == 2);
    CHECK(given.front().find("no/such/folder") != std::string::npos);
}

TEST_CASE("checkpoints that are missing, damaged, cut off or of another version are refused with the file's name") {
    const Slide slide;
    const Folder folder;
    CHECK(refusal(folder.file()).find("there is no checkpoint") != std::string::npos);
    simulate(slide.specimen, slide.plan, slide.settings(folder, 20));
    CHECK(refusal(folder.file()).empty());
    CHECK(refusal(folder.file(), "1.3").find("begun by musim 1.2, this is 1.3") != std::string::npos);
    const std::string good = bytes_of(folder.file());
    for (std::size_t at = 0; at < good.size(); at += good.size() / 200) {
        std::string damaged = good;
        damaged[at] = static_cast<char>(damaged[at] ^ 4);
        for (const std::string& bad : {damaged, good.substr(0, at)}) {
            write_bytes(folder.file(), bad);
            const std::string why = refusal(folder.file());
            CHECK_MESSAGE(why.starts_with(folder.file().string() + ": the run cannot be continued"), "at ", at, ": ", why);
        }
    }
}

TEST_CASE("a checkpoint of another build is refused although its version is the same") {
    const Slide slide;
    const Folder folder;
    RunSettings settings = slide.settings(folder, 20);
    settings.checkpoint->build = "Clang 99 x86_64 -ffast-math";
    simulate(slide.specimen, slide.plan, settings);
    CHECK(refusal(folder.file()) == folder.file().string() + ": the run was begun by another build (Clang 99 x86_64 -ffast-math; this is " +
                                        musim::lsdem::describe_build() +
                                        "), whose bits may differ; continue it with that one or start it anew");
}

TEST_CASE("damaged checkpoints are refused or hold the same") {
    const Slide slide;
    const Folder folder;
    simulate(slide.specimen, slide.plan, slide.settings(folder, 20));
    const std::string good = bytes_of(folder.file()), state = read_checkpoint(folder.file(), "1.2").state;
    std::mt19937_64 random(1);
    for (int i = 0; i < musim::tests::count_damages(); ++i) {
        write_bytes(folder.file(), musim::tests::damage(good, random));
        CHECK_MESSAGE((!refusal(folder.file()).empty() || read_checkpoint(folder.file(), "1.2").state == state), "damage ", i);
    }
}

TEST_CASE("a checkpoint of another format is refused with file, format and what to do") {
    const Slide slide;
    const Folder folder;
    simulate(slide.specimen, slide.plan, slide.settings(folder, 20));
    std::string old = bytes_of(folder.file());
    // the head: a name of 8 bytes, the byte order in 4, the format in 4
    constexpr std::size_t kFormatAt = 12;
    REQUIRE(old[kFormatAt] == 17);
    old[kFormatAt] = 14;
    write_bytes(folder.file(), old);
    CHECK(refusal(folder.file()) ==
          folder.file().string() +
              ": the run cannot be continued (checkpoint: it has format 14, this program reads format 17; continue "
              "it with the program that wrote it); start it anew");
}

TEST_CASE("a checkpoint of another specimen is refused") {
    const Slide slide;
    const Folder folder;
    simulate(slide.specimen, slide.plan, slide.settings(folder, 20));
    CHECK_THROWS_AS(resume(make_column(2, 0.1), read_checkpoint(folder.file(), "1.2")), std::runtime_error);
    CHECK_THROWS_AS(resume(make_column(3, 0.11), read_checkpoint(folder.file(), "1.2")), std::runtime_error);
    // the same model with fewer blocks in its spine: the histories show it
    Specimen shorter = slide.specimen;
    shorter.spine.block.pop_back();
    shorter.spine.level.pop_back();
    CHECK_THROWS_AS(resume(shorter, read_checkpoint(folder.file(), "1.2")), std::runtime_error);
}

TEST_CASE("removing a checkpoint takes what a kill left of another one along, and nothing else") {
    const Folder folder;
    for (const char* name : {"checkpoint", ".checkpoint.4711.3.tmp", "result.h5", ".result.1.tmp"})
        write_bytes(folder.file().parent_path() / name, "x");
    remove_checkpoint(folder.file());
    CHECK(folder.count() == 2);
    CHECK(fs::exists(folder.file().parent_path() / "result.h5"));
    remove_checkpoint(folder.file());
    CHECK(folder.count() == 2);
}

TEST_CASE("a checkpoint whose plan is another is refused though its checksum is right") {
    const Folder folder;
    const Slide slide;
    simulate(slide.specimen, slide.plan, slide.settings(folder, 20));
    const Checkpoint whole = read_checkpoint(folder.file(), "1.2");
    CHECK_NOTHROW(require_plan(whole, slide.plan));
    CHECK_NOTHROW(resume(slide.specimen, whole));
    Checkpoint without_steps = whole;
    without_steps.plan.steps_per_sample = 0;
    CHECK_THROWS_WITH(resume(slide.specimen, without_steps), "checkpoint: its histories do not fit its state");
    Checkpoint endless = whole;
    endless.plan.samples = std::uint64_t{1} << 60U;
    CHECK_THROWS_WITH(require_plan(endless, slide.plan), "checkpoint: its steps and samples are not those of its scene");
}
