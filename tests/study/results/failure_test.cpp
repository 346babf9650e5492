#include "lsdem/results/failure.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "lsdem/response/response.hpp"
#include "lsdem/results/summary.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
namespace scaling = musim::scaling;

namespace {

constexpr int kLevels = 11, kAround = 12;

/// A ring of 12 blocks of 1 x 2 x 4 m around a middle far from the origin, 11 levels high, that has moved.
struct MadeTower {
    BlockTable blocks;
    std::vector<Vector3> start;
    Falls falls;

    /// `move(level, outward unit vector)`: how far a block has moved when it falls; those that moved down by less than 1 m and not outward
    /// by as much stand.
    template <class Move>
    explicit MadeTower(const Move& move, double scale = 1.0) {
        for (int level = 1; level <= kLevels; ++level) {
            for (int i = 0; i < kAround; ++i) {
                const double angle = 2.0 * std::numbers::pi * i / kAround;
                const Vector3 outward(std::cos(angle), std::sin(angle), 0.0);
                blocks.size.push_back(scale * Vector3(1.0, 2.0, 4.0));
                blocks.mass.push_back(scale * scale * scale);
                blocks.layer.push_back(level);
                start.push_back(scale * (10.0 * outward + Vector3(100.0, 0.0, 4.0 * level - 2.0)));
                const Vector3 moved = move(level, outward);
                const bool fell = moved.norm() >= 1.0;
                falls.time.push_back(fell ? 2.0 : std::numeric_limits<double>::quiet_NaN());
                falls.displacement.emplace_back(scale * moved);
                falls.at_collapse.emplace_back(scale * moved);
            }
        }
    }
    Failure failure() const { return find_failure(FailureData{blocks, start, falls, 2.0}); }
};

/// The side toward +x rocks outward about the fourth level.
Vector3 peel(int level, const Vector3& outward) {
    if (level < 4 || outward.x() < 0.4) return Vector3::Zero();
    return (level - 3) * (outward - 0.2 * Vector3::UnitZ());
}

/// The sixth level and those beside it go out, what is above comes down by a block and in by a part of one.
Vector3 buckle(int level, const Vector3& outward) {
    if (level < 5) return Vector3::Zero();
    if (level <= 7) return (level == 6 ? 1.5 : 0.8) * outward - 0.3 * Vector3::UnitZ();
    return -0.4 * outward - 2.0 * Vector3::UnitZ();
}

/// Push of the blocks of a tower of ten layers [m/s]; `part`: 0 at the lowest layer, 1 at the highest.
using Push = Vector3 (*)(double part, const Vector3& outward);

Vector3 push_side(double part, const Vector3& outward) {
    return part > 0.2 && outward.x() > 0.5 ? Vector3((part - 0.1) * 2.0 * outward) : Vector3(Vector3::Zero());
}

Vector3 push_middle(double part, const Vector3& outward) {
    return part > 0.3 && part < 0.5 ? Vector3(1.5 * outward) : Vector3(Vector3::Zero());
}

/// Soft blocks of wood: the overlaps stay below a hundredth of a millimetre, and steps are thirty times longer.
const char* const kTower = R"({"schema": "musim-scene/1", "name": "ring",
    "material": {"density": 800, "normal_stiffness": "30 kN/m", "shear_stiffness": "26 kN/m", "friction": 0.63, "restitution": 0.3},
    "structure": {"kind": "tower", "layers": 10, "block": ["12.710 mm", "26.355 mm", "39.780 mm"], "tiling": "ring_14"},
    "time": {"duration": "0.12 s"}, "output": {"spine_rate": "500 Hz"}})";

struct PushedTower {
    Scene scene;
    RunResult run;
};

PushedTower push_tower(Push push, double length = 1.0) {
    Scene scene = parse_scene(kTower);
    const scaling::Similitude similitude = scaling::make_similitude("exact", {.length = length});
    if (length != 1.0) scene = scale_scene(scene, similitude);
    Specimen specimen = make_specimen(scene);
    specimen.settling.reset();  // it is pushed at once
    Vector3 center = Vector3::Zero();
    for (const Block& block : specimen.model.blocks) center += block.position / static_cast<double>(specimen.model.blocks.size());
    for (std::size_t b = 0; b < specimen.model.blocks.size(); ++b) {
        Block& block = specimen.model.blocks[b];
        const Vector3 outward = Vector3(block.position.x() - center.x(), block.position.y() - center.y(), 0.0).normalized();
        block.velocity = similitude.velocity() * push((specimen.layer[b] - 1) / 9.0, outward);
    }
    const TimePlan plan = make_time_plan(scene, specimen.model);
    return {scene, simulate(specimen, plan)};
}

void check_same_measures(const FailureMeasures& a, const FailureMeasures& b) {
    CHECK(a.fallen == b.fallen);
    CHECK(a.outward_share == b.outward_share);
    CHECK(a.bulge == b.bulge);
    CHECK(a.bulge_height == b.bulge_height);
    CHECK(a.inward_share_above == b.inward_share_above);
}

}  // namespace

TEST_CASE("a section that rocks outward is peeling") {
    const Failure failure = MadeTower(peel).failure();
    CHECK(failure.mode == FailureMode::peeling);
    CHECK(failure.why.empty());
    CHECK(failure.time == 2.0);
    // 5 of 12 blocks of 8 levels, all outward; widest at the top
    CHECK(failure.measures.fallen == 40);
    CHECK(failure.measures.outward_share == 1.0);
    CHECK(failure.measures.bulge_height == 1.0);
}

TEST_CASE("a bulge with what is above it coming down and in is buckling") {
    const Failure failure = MadeTower(buckle).failure();
    CHECK(failure.mode == FailureMode::buckling);
    // level 6 of 11 went out by 1.5 thin sides; four levels above it came down, level 7 stands
    CHECK(failure.measures.fallen == 60);
    CHECK(failure.measures.bulge == doctest::Approx(1.5));
    CHECK(failure.measures.bulge_height == doctest::Approx(0.5));
    CHECK(failure.measures.inward_share_above == 1.0);
    CHECK(failure.measures.outward_share == doctest::Approx(0.2));
}

TEST_CASE("what is neither, or has no outward, stays undecided and says why") {
    // straight down, without a bulge
    const Failure sunk = MadeTower([](int, const Vector3&) { return Vector3(0.0, 0.0, -2.0); }).failure();
    CHECK(sunk.mode == FailureMode::undecided);
    CHECK(sunk.why == "the measures of neither mode hold");
    CHECK(describe(sunk).find("undecided (the measures of neither mode hold)") != std::string::npos);
    // widest at the lowest level
    const Failure foot =
        MadeTower([](int level, const Vector3& e) { return level == 1 ? Vector3(1.5 * e) : Vector3(0.0, 0.0, -2.0); }).failure();
    CHECK(foot.measures.inward_share_above == 1.0);
    CHECK(foot.mode == FailureMode::undecided);
    // half a ring
    MadeTower half(peel);
    for (std::size_t b = 0; b < half.start.size(); ++b) half.start[b].y() = std::abs(half.start[b].y());
    CHECK(half.failure().why.find("does not surround an axis") != std::string::npos);
    // of walls and single blocks nothing is said of rings
    const std::string said = describe(half.failure());
    CHECK(said.find("no failure mode is given") != std::string::npos);
    for (const char* const of_towers : {"went outward", "bulged", "0%"}) CHECK(said.find(of_towers) == std::string::npos);
}

TEST_CASE("modes and measures of a tower a quarter as large are the same bits") {
    for (const auto move : {peel, buckle}) {
        const Failure large = MadeTower(move).failure(), small = MadeTower(move, 0.25).failure();
        CHECK(large.mode == small.mode);
        check_same_measures(large.measures, small.measures);
    }
}

TEST_CASE("simulated towers pushed out on one side and at mid-height are distinguished, at every scale") {
    const PushedTower peeled = push_tower(push_side), buckled = push_tower(push_middle);
    const auto peeling = find_failure(peeled.run), buckling = find_failure(buckled.run);
    REQUIRE(peeling.has_value());
    REQUIRE(buckling.has_value());
    CHECK_MESSAGE(peeling->mode == FailureMode::peeling, describe(*peeling));
    CHECK_MESSAGE(buckling->mode == FailureMode::buckling, describe(*buckling));

    const auto small = find_failure(push_tower(push_middle, 1.0 / 16.0).run);
    REQUIRE(small.has_value());
    CHECK(small->mode == buckling->mode);
    CHECK(small->time == buckling->time / 4.0);
    check_same_measures(small->measures, buckling->measures);

    // the results on disk say the same
    const musim::tests::TemporaryFolder folder;
    ResultFolder results(folder.path() / "run");
    results.add_run("", peeled.run, {.scene = write_scene(peeled.scene), .program_version = "test"});
    results.commit();
    const nlohmann::json stored = to_json(measure_response(read_run(folder.path() / "run")));
    CHECK(stored["failure"] == to_json(*peeling));
    CHECK(make_summary(peeled.run)["failure"] == stored["failure"]);
}

TEST_CASE("a run that stands has no failure") {
    const PushedTower standing = push_tower([](double, const Vector3&) { return Vector3(Vector3::Zero()); });
    REQUIRE(standing.run.status == RunStatus::completed);
    CHECK_FALSE(find_failure(standing.run).has_value());
    CHECK_FALSE(make_summary(standing.run).contains("failure"));
}
