#include "lsdem/study/twin_runs.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/compare_runs.hpp"
#include "lsdem/study/twin_files.hpp"
#include "tests/study/pushed_wall.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using musim::lsdem::tests::make_pushed_wall;
using musim::lsdem::tests::relative;
using musim::tests::message_of;
using musim::tests::TemporaryFolder;

namespace {

/// Overlaps at rest are 1e-4 of a block's height.
Scene make_column_scene() {
    return parse_scene(R"({"schema": "musim-scene/1", "name": "pushed column",
        "material": {"density": 800, "normal_stiffness": "30 kN/m", "shear_stiffness": "26 kN/m", "friction": 0.63, "restitution": 0.3},
        "structure": {"kind": "column", "layers": 3, "block": ["12.71 mm", "26.355 mm", "39.78 mm"]},
        "base_motion": {"signal": "half_sine", "direction": "y", "amplitude": "1.2 g", "duration": "0.05 s"},
        "time": {"duration": "0.1 s"}})");
}

const std::vector<TwinChoice> kLengths{{.length = 1.0 / 16.0}, {.length = std::pow(4.0, 0.37)}, {.length = 4.0}, {.length = 0.3}};

bool all_equal(const TwinStudy& a, const TwinStudy& b) {
    return a.prototype.peak == b.prototype.peak && a.prototype.samples == b.prototype.samples &&
           a.prototype.interval == b.prototype.interval &&
           std::equal(a.twins.begin(), a.twins.end(), b.twins.begin(), b.twins.end(), [](const TwinRun& x, const TwinRun& y) {
               return x.choice == y.choice && x.difference == y.difference && x.diverged == y.diverged;
           });
}

std::size_t count_files(const std::filesystem::path& folder, const std::string& begin) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) count += entry.path().filename().string().starts_with(begin);
    return count;
}

}  // namespace

TEST_CASE("models at powers of four do not differ at all, others by rounding, side by side as one by one") {
    const TwinStudy study = run_twins(make_pushed_wall(), kLengths, {.threads = 3});
    CHECK(all_equal(study, run_twins(make_pushed_wall(), kLengths, {.threads = 1})));
    CHECK(study.name == "pushed wall");
    CHECK(study.prototype.samples == 31);
    CHECK(study.prototype.interval == relative(0.002, 1e-12));
    CHECK(study.prototype.height == relative(0.17, 1e-12));
    CHECK(study.prototype.moving_blocks == 5);
    // the base gets to 0.15 m/s
    CHECK(study.prototype.peak > 0.01);
    for (const TwinRun& twin : study.twins) {
        REQUIRE(twin.difference.size() == study.prototype.samples);
        CHECK_FALSE(twin.diverged);
        const double largest = *std::max_element(twin.difference.begin(), twin.difference.end());
        const bool power = twin.choice.length == 4.0 || twin.choice.length == 1.0 / 16.0;
        CHECK((largest == 0.0) == power);
        CHECK(largest < kPartingLevel * study.prototype.peak);
    }
}

TEST_CASE("a scene without a rate is sampled a hundred times a second, and blocks of equal height begin as they are") {
    const TwinStudy study = run_twins(make_column_scene(), {{.length = 0.0625}, {.length = 0.07}});
    CHECK(study.prototype.samples == 11);
    CHECK(study.prototype.moving_blocks == 3);
    CHECK(find_growth(study.prototype, study.twins[0]).running.back() == 0.0);
    CHECK(find_growth(study.prototype, study.twins[1]).running.back() < 1e-9);
}

TEST_CASE("what is there is not run again, what is missing or damaged is, to the same bits") {
    const TemporaryFolder folder;
    const Scene wall = make_pushed_wall();
    const TwinStudy fresh = run_twins(wall, kLengths);
    std::vector<double> preparation, progress;
    TwinSettings settings{.directory = folder.path(), .version = "test", .threads = 1};
    settings.observer.on_preparation = [&](double fraction) { preparation.push_back(fraction); };
    settings.observer.on_progress = [&](double fraction) { progress.push_back(fraction); };
    CHECK(all_equal(run_twins(wall, {kLengths.begin(), kLengths.begin() + 2}, settings),
                    run_twins(wall, {kLengths.begin(), kLengths.begin() + 2})));
    CHECK_FALSE(preparation.empty());
    CHECK(progress.back() == doctest::Approx(1.0));
    const std::filesystem::path runs = twin_folder(folder.path(), wall, "test");
    CHECK(count_files(runs, "model_") == 2);

    // two more of the specimen as it was laid
    preparation.clear();
    CHECK(all_equal(run_twins(wall, kLengths, settings), fresh));
    CHECK(preparation.size() <= 1);  // it still rests: one look
    CHECK(count_files(runs, "model_") == 4);
    progress.clear();
    CHECK(all_equal(run_twins(wall, kLengths, settings), fresh));
    CHECK(progress.empty());

    // one that was lost, one of another twin, one cut off, the prototype
    std::filesystem::remove(runs / twin_file_name(kLengths[0]));
    std::filesystem::copy_file(runs / twin_file_name(kLengths[3]), runs / twin_file_name(kLengths[1]),
                               std::filesystem::copy_options::overwrite_existing);
    std::ofstream(runs / twin_file_name(kLengths[2])) << R"({"format": "musim-tw)";
    CHECK(all_equal(run_twins(wall, kLengths, settings), fresh));
    std::ofstream(runs / "prototype.velocities") << "nothing";
    CHECK(all_equal(run_twins(wall, kLengths, settings), fresh));

    // another version, another duration: other runs
    CHECK(twin_folder(folder.path(), wall, "other") != runs);
    Scene longer = wall;
    longer.time.duration = 2.0 * wall.time.duration;
    CHECK(twin_folder(folder.path(), longer, "test") != runs);
}

TEST_CASE("copies moved in the same directions part in proportion to how far") {
    const TwinStudy study = run_twins(make_column_scene(), choose_shifted({1e-10, 1e-9, 1e-8}, 2, 1), {.threads = 2});
    const TwinSummary summary = summarize(study);
    const std::vector<Proportionality> sets = find_proportionality(study, summary.twins);
    REQUIRE(sets.size() == 2);
    for (const Proportionality& set : sets) {
        REQUIRE(set.departure.has_value());
        INFO("departs by " << *set.departure << " at " << set.time << " s, " << set.level);
        CHECK(*set.departure < 2.0);
    }
    // other directions, other differences
    CHECK(study.twins[0].difference != study.twins[3].difference);
}

// Its blocks are drawn in contact and rebound flat when gravity begins, so that rounding alone chooses the edge by which they part.
// The deviation is asked for at nine tenths of the horizon, so the runs have to reach it.
TEST_CASE("exact models of the demo tower part smoothly" * doctest::test_suite("slow")) {
    Scene tower = read_scene(std::filesystem::path(MUSIM_SOURCE_DIR) / "examples/twins/tower_as_drawn.json");
    const double duration = 4.6;
    tower.time.duration = musim::scaling::Time::from_value(duration);
    const TwinStudy study = run_twins(tower, choose_models(6, 1), {.threads = 0});
    const TwinSummary summary = summarize(study);
    CHECK(summary.horizon < 0.95 * duration);
    for (const TwinGrowth& twin : summary.twins) CHECK(twin.growth.factor < 15.0);
    CHECK(summary.at_horizon.sd < 0.4);
}

TEST_CASE("twins that cannot be compared are refused with what to do") {
    CHECK(message_of<SceneError>([] { run_twins(make_pushed_wall(""), {{.length = 0.3}}); }).find("give a base motion") !=
          std::string::npos);
}
