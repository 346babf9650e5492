#include "lsdem/results/outcome.hpp"
#include "lsdem/results/drift.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "scaling/laws/law_similitude.hpp"
#include "tests/study/made_run.hpp"

using namespace musim::lsdem;

namespace {

/// Two blocks of 1 m height on each other; the upper one swings by 0.2 m along x against the base and stays 0.05 m off.
RunResult make_swing() {
    RunResult run;
    run.blocks = {.size = {{1, 1, 1}, {1, 1, 1}}, .mass = {1, 1}, .layer = {1, 2}};
    run.spine = {.block = {0, 1}, .level = {1, 2}};
    run.peak_base_acceleration = {4.903325, 0, 0};
    const double base[] = {0.0, 0.3, 0.1}, upper[] = {0.0, 0.5, 0.15};  // [m]
    for (int k = 0; k < 3; ++k) {
        run.history.time.push_back(k);
        run.history.base.push_back({.displacement = {base[k], 0, 0}, .velocity = {k == 1 ? -0.25 : 0.0, 0, 0}, .acceleration = {0, 0, 0}});
        for (const double x : {base[k], upper[k]}) run.history.spine_position.emplace_back(x, 0, x == base[k] ? 0.5 : 1.5);
        if (k == 0) run.history.spine_position.back().z() = 1.5;
        for (int s = 0; s < 2; ++s) run.history.spine_velocity.emplace_back(0, 0, 0), run.history.spine_rotation.emplace_back(0, 0, 0);
    }
    run.initial.position = {{0, 0, 0.5}, {0, 0, 1.5}};
    run.final.position = {{0.1, 0, 0.5}, {0.15, 0, 1.5}};
    run.initial.orientation.assign(2, Quaternion::Identity());
    run.final.orientation = {Quaternion::Identity(), Quaternion(Eigen::AngleAxisd(0.1, Vector3::UnitZ()))};
    run.losses = Losses{.block = {{}, {}}, .ground = {}};
    return run;
}

}  // namespace

TEST_CASE("a run ends with peak, residual, drift, slip, rotation and fallen blocks, with units and places") {
    const Outcome outcome = find_outcome(make_swing());
    CHECK(outcome.top_level == 2);
    CHECK(outcome.top_peak == doctest::Approx(0.2));
    CHECK(outcome.top_residual == doctest::Approx(0.05));
    // 0.2 m over the metre between the two centres
    CHECK(outcome.drift == doctest::Approx(0.2));
    CHECK(outcome.drift_level == 2);
    REQUIRE(outcome.slip.has_value());
    CHECK(outcome.slip->value == doctest::Approx(0.05));
    CHECK(outcome.slip->block == 1);
    REQUIRE(outcome.rotation.has_value());
    CHECK(outcome.rotation->value == doctest::Approx(0.1));
    CHECK(outcome.fallen == 0);
    const std::vector<std::string> lines = describe(outcome);
    REQUIRE(lines.size() == 4);
    CHECK(lines[0] == "base motion along x: PGA 0.5 g, PGV 25 cm/s");
    CHECK(lines[1] == "top (level 2) against the base, horizontally: peak 200 mm, residual 50 mm; largest drift 20 % (below level 2)");
    CHECK(lines[2] == "largest slip left 50 mm (block 1, level 2); largest rotation left 5.73 deg (block 1, level 2)");
    CHECK(lines[3] == "0 of 2 blocks fallen");
    CHECK(to_json(outcome)["pga_g"][0].get<double>() == doctest::Approx(0.5));
    CHECK(to_json(outcome)["top"]["moves_at_end"] == false);
}

TEST_CASE("what a top that still moves has at the end is not called residual") {
    RunResult swing = make_swing();
    swing.history.base.back().velocity.x() = 0.1;
    const Outcome outcome = find_outcome(swing);
    CHECK(describe(outcome)[1].starts_with(
        "top (level 2) against the base, horizontally: peak 200 mm, at the end 50 mm and moving at 10 cm/s"));
    CHECK(to_json(outcome)["top"]["moves_at_end"] == true);
    swing.history.base.back().velocity.x() = 0.9 * kStillMoving * 0.25;
    CHECK_FALSE(find_outcome(swing).top_moves);
}

TEST_CASE("an outcome has the base's motion along every axis that moves") {
    Outcome outcome = find_outcome(make_swing());
    outcome.pga.z() = 0.1 * musim::scaling::kStandardGravity.value();
    outcome.pgv.z() = 0.05;
    CHECK(describe(outcome)[0] == "base motion along x: PGA 0.5 g, PGV 25 cm/s");
    CHECK(describe(outcome)[1] == "base motion along z: PGA 0.1 g, PGV 5 cm/s");
    outcome.pgv.setZero();
    CHECK(describe(outcome)[0] == "base at rest");
}

TEST_CASE("the outcome of a model is scaled back to the prototype and ratios stay") {
    const musim::scaling::Similitude similitude = musim::scaling::make_similitude("mu", {.length = 1.0 / 16.0});
    const Outcome model = find_outcome(make_swing()), prototype = scale_back(model, similitude);
    CHECK(prototype.top_peak == 16.0 * model.top_peak);
    CHECK(prototype.pgv.x() == 4.0 * model.pgv.x());
    CHECK(prototype.pga == model.pga);
    CHECK(prototype.drift == model.drift);
    CHECK(prototype.rotation->value == model.rotation->value);
}

TEST_CASE("slip and rotation are those of blocks that stand") {
    RunResult run = make_swing();
    run.final.position[1] = {5, 0, 0.5};
    const Outcome outcome = find_outcome(run);
    CHECK(outcome.fallen == 1);
    REQUIRE(outcome.rotation.has_value());
    CHECK(outcome.rotation->block == 0);
    CHECK(outcome.slip->block == 0);
}

TEST_CASE("listed blocks go by their names, and have drift only against what lies under them") {
    // two posts side by side, whose centres differ by rounding, and a lintel on the second alone
    RunResult run;
    run.blocks = {.size = {{1, 1, 1}, {1, 1, 1}, {1, 1, 0.5}}, .mass = {1, 1, 1}, .layer = {1, 1, 2}, .name = {"", "post", "lintel"}};
    run.spine = {.block = {0, 1, 2}, .level = {1, 1, 2}};
    run.history.time = {0.0, 1.0};
    run.history.base.resize(2);
    run.history.spine_position = {{0, 0, 0.5}, {1, 0, 0.5 + 1e-15}, {1.2, 0, 1.25}, {0.1, 0, 0.5}, {0.8, 0, 0.5}, {1.15, 0, 1.25}};
    run.history.spine_velocity.assign(6, Vector3::Zero());
    run.history.spine_rotation.assign(6, Vector3::Zero());
    run.initial.position.assign(run.history.spine_position.begin(), run.history.spine_position.begin() + 3);
    run.final.position.assign(run.history.spine_position.begin() + 3, run.history.spine_position.end());
    run.initial.orientation.assign(3, Quaternion::Identity());
    run.final.orientation = run.initial.orientation;
    const std::vector<DriftPair> pairs = find_drift_pairs(run);
    REQUIRE(pairs.size() == 3);
    CHECK_FALSE(pairs[0].lower.has_value());
    CHECK_FALSE(pairs[1].lower.has_value());
    CHECK(pairs[2].lower == 1);
    CHECK(pairs[2].rise == doctest::Approx(0.75));
    const Outcome outcome = find_outcome(run);
    // the second post has moved by 0.2 m over half a metre; the lintel on it by 0.15 m over 0.75 m
    CHECK(outcome.drift == doctest::Approx(0.4));
    CHECK(outcome.drift_name == "post");
    CHECK(outcome.top_name == "lintel");
    CHECK(describe(outcome)[1].starts_with("top (lintel, level 2) against the base"));
    CHECK(describe(outcome)[2].find("(block 1 (\"post\"), level 1)") != std::string::npos);
    CHECK(to_json(outcome)["top"]["name"] == "lintel");
    CHECK(label_spine(run) == std::vector<std::string>{"block 0", "post", "lintel"});
    CHECK(head_spine(run) == std::vector<std::string>{"block0", "post", "lintel"});
    // one that begins in the air has none
    run.falls.airborne = {0, 0, 1};
    CHECK(find_drift_pairs(run).size() == 2);
}
