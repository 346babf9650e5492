#include "lsdem/run/simulate.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/study/made_specimen.hpp"

using namespace musim::lsdem;

TEST_CASE("a run keeps one sample per plan entry, and its spine is the blocks asked for") {
    const Specimen column = make_column(3);
    const TimePlan plan = make_plan(column, 40);
    const RunResult run = simulate(column, plan);

    CHECK(run.status == RunStatus::completed);
    CHECK(run.steps == plan.steps());
    CHECK(run.history.samples() == 41);
    CHECK(run.history.base.size() == 41);
    CHECK(run.history.energy.size() == 41);
    CHECK(run.history.spine_velocity.size() == 41 * 3);
    CHECK(run.history.time.front() == 0.0);
    CHECK(run.history.time.back() == doctest::Approx(plan.duration()).epsilon(1e-12));
    CHECK(run.history.spine_position[40 * 3 + 2] == run.final.position[2]);
    CHECK(run.frames.time.empty());
}

TEST_CASE("the ground carries the weight of a stack that rests") {
    Specimen column = make_column(3);
    column.model.ground.motion.shift[0].velocity.clear();
    const RunResult run = simulate(column, make_plan(column, 100));
    REQUIRE(run.base_reaction_over_weight.has_value());
    // it starts in equilibrium: only rounding of the overlap, 1e-16 m in 3e-5 m, is left
    CHECK(*run.base_reaction_over_weight == doctest::Approx(1.0).epsilon(1e-9));
}

TEST_CASE("the block table holds each block's own height") {
    Specimen column = make_column(2);
    const double offset = 0.01 * column.model.shapes[0].half_extents.z();
    column.model.blocks[1].height_offset = offset;
    column.model.blocks[1].position.z() += 0.5 * offset;
    const RunResult run = simulate(column, make_plan(column, 1));
    CHECK(run.blocks.size[1].z() - run.blocks.size[0].z() == doctest::Approx(offset).epsilon(1e-12));
    CHECK(run.blocks.size[1].head<2>() == run.blocks.size[0].head<2>());
}

TEST_CASE("frames come at every n-th sample, the start included") {
    const Specimen column = make_column(2);
    TimePlan plan = make_plan(column, 10);
    plan.samples_per_frame = 4;
    const RunResult run = simulate(column, plan);
    REQUIRE(run.frames.time.size() == 3);
    CHECK(run.frames.time[1] == run.history.time[4]);
    CHECK(run.frames.position.size() == 3 * 2);
    CHECK(run.frames.quaternion[5][0] == 1.0F);
    CHECK(run.frames.contact_force.size() == 3 * 2);
}

TEST_CASE("a frame's contact forces of a standing column are what each block bears and passes on") {
    Specimen column = make_column(3);
    column.model.ground.motion.shift[0].velocity.clear();
    TimePlan plan = make_plan(column, 10);
    plan.samples_per_frame = 10;
    const RunResult run = simulate(column, plan);
    REQUIRE(run.frames.contact_force.size() == 2 * 3);
    const double weight = run.blocks.mass[0] * column.model.gravity.norm();
    // single precision
    for (std::size_t b = 0; b < 3; ++b) {
        CHECK(static_cast<double>(run.frames.contact_force[3 + b]) / weight ==
              doctest::Approx(5.0 - 2.0 * static_cast<double>(b)).epsilon(1e-6));
    }
}

TEST_CASE("progress rises to one") {
    std::vector<double> fractions;
    const Specimen column = make_column(1);
    simulate(column, make_plan(column, 25),
             {.threads = 1, .observer = {.on_progress = [&](double fraction) { fractions.push_back(fraction); }}});
    REQUIRE_FALSE(fractions.empty());
    CHECK(std::is_sorted(fractions.begin(), fractions.end()));
    CHECK(fractions.back() == 1.0);
}

TEST_CASE("a block that falls over is a collapse, and the run goes on to its end") {
    Specimen column = make_column(1);
    Block& block = column.model.blocks[0];
    // stands on an edge, 80 degrees from upright, and falls to its other side
    block.orientation = Quaternion(Eigen::AngleAxisd(0.1, Vector3::UnitY()));
    block.angular_velocity = {0.0, 8.0, 0.0};
    block.position.z() = 0.9;
    const TimePlan plan = make_plan(column, 500);
    const RunResult run = simulate(column, plan);
    CHECK(run.status == RunStatus::collapsed);
    REQUIRE(run.collapse_time.has_value());
    CHECK(*run.collapse_time < plan.duration());
    CHECK(run.steps == plan.steps());
}

TEST_CASE("a time step far above the limit ends the run as diverged, with block and time") {
    const Specimen column = make_column(3);
    TimePlan plan = make_plan(column, 1000);
    plan.time_step *= 20.0;
    const RunResult run = simulate(column, plan);
    CHECK(run.status == RunStatus::diverged);
    REQUIRE(run.divergence.has_value());
    CHECK(run.divergence->block < 3);
    CHECK(run.divergence->time > 0.0);
    CHECK(run.steps < plan.steps());
}

TEST_CASE("a copy differs from its specimen by one unit in the last place of one coordinate of every block") {
    Specimen column = make_column(4);
    column.model.blocks[1].position.x() = -70.0;
    const Specimen copy = make_moved_copy(column);
    for (std::size_t b = 0; b < 4; ++b) {
        const Vector3& from = column.model.blocks[b].position;
        const Vector3& to = copy.model.blocks[b].position;
        const Eigen::Index moved = b == 1 ? 0 : 2;
        CHECK(to[moved] == std::nextafter(from[moved], 1e9));
        for (Eigen::Index i = 0; i < 3; ++i) {
            if (i != moved) CHECK(to[i] == from[i]);
        }
    }
}

TEST_CASE("a scaled plan has the same counts and its time step multiplied") {
    const TimePlan plan{.time_step = 0.4, .steps_per_sample = 3, .samples = 5, .samples_per_frame = 2};
    const TimePlan model = plan.scaled(0.25);
    CHECK(model.time_step == 0.1);
    CHECK(model.steps() == 15);
    CHECK(model.samples_per_frame == 2);
}
