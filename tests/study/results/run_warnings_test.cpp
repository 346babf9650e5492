#include "lsdem/results/run_warnings.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "tests/study/made_run.hpp"

using namespace musim::lsdem;

namespace {

bool says(const std::string& text, const char* words) { return text.find(words) != std::string::npos; }

RunResult make_diverged_run(double time_step) {
    RunResult run = make_made_run(3);
    run.status = RunStatus::diverged;
    run.divergence = Divergence{Divergence::Kind::energy_out_of_bounds, 7, 0.25};
    run.time_step = time_step;
    run.critical_time_step = 0.01;
    return run;
}

}  // namespace

TEST_CASE("a run that diverged above the critical step gets the default step as advice") {
    const std::string text = describe_divergence(make_diverged_run(0.011));
    for (const char* words : {"0.25 s", "block 7", "0.011 s", "0.01 s", "at most 0.008 s"}) CHECK_MESSAGE(says(text, words), text);
}

TEST_CASE("a run that diverged below the critical step gets the advice to halve it") {
    const std::string text = describe_divergence(make_diverged_run(0.009));
    for (const char* words : {"0.25 s", "block 7", "0.0045 s"}) CHECK_MESSAGE(says(text, words), text);
    RunResult unlimited = make_diverged_run(0.009);
    unlimited.critical_time_step.reset();
    CHECK(says(describe_divergence(unlimited), "0.0045 s"));
}

TEST_CASE("a sound run raises no warning, a doubtful one says each number") {
    RunResult run = make_made_run(3);
    CHECK(find_warnings(run).empty());
    run.critical_time_step = 0.0009;
    run.statistics.max_overlap_over_height = 2.0 * kDeepOverlap;
    run.energy_closure = 2.0 * kOpenBalance;
    const auto warnings = find_warnings(run);
    REQUIRE(warnings.size() == 3);
    CHECK(says(warnings[0], "0.00072 s"));
    CHECK(says(warnings[1], "0.1 of a block's height"));
    CHECK(says(warnings[2], "open by 0.2"));
    run.rest = Rest{.at_rest = false, .steps = 640, .kinetic = 0.001, .reaction_over_weight = 0.75};
    REQUIRE(find_warnings(run).size() == 4);
    CHECK(says(find_warnings(run)[0], "640 steps"));
    CHECK(says(find_warnings(run)[0], "bore 0.750000 of the weight"));
    run.rest->at_rest = true;
    CHECK(find_warnings(run).size() == 3);
    // of layers a few may fall; the motion is run
    run.rest->fallen = {{.block = 1, .drawn = {0, 0, 4.5}, .now = {2, 0, 0.5}, .turned = 1.5}};
    REQUIRE(find_warnings(run).size() == 4);
    CHECK(says(find_warnings(run)[0],
               "block 1 fell while the structure was prepared: drawn with its centre at (0, 0, 4.5) m, it is at (2, 0, 0.5) m"));
    CHECK(says(find_warnings(run)[0], "take another seed"));
    CHECK_FALSE(says(find_warnings(run)[0], "not run"));
    // a run that diverged has its own sentence
    run.divergence = Divergence{};
    CHECK(find_warnings(run).empty());
}

TEST_CASE("a start without the weight borne is reported with the advice that fits how the structure begins") {
    RunResult run = make_made_run(3);
    run.energy_closure = 0.0;
    run.start_reaction_over_weight = 0.0;
    run.falls.time = {std::nan(""), std::nan("")};
    run.falls.airborne = {0, 0};
    run.beginning = Beginning::at_once;
    REQUIRE(find_warnings(run).size() == 1);
    CHECK(says(find_warnings(run)[0], "leave \"preparation\": \"none\" out"));
    // listed blocks, without that key
    run.beginning = Beginning::listed;
    run.blocks.name = {"", "stone"};
    for (Vector3& velocity : run.initial.velocity) velocity.setZero();
    for (Vector3& spin : run.initial.angular_velocity) spin.setZero();
    REQUIRE(find_warnings(run).size() == 1);
    CHECK(says(find_warnings(run)[0], "a \"preparation\" lets them come to rest before"));
    CHECK_FALSE(says(find_warnings(run)[0], "none"));
    run.falls.time[1] = 0.02;
    CHECK(says(find_warnings(run)[0], "block 1 (\"stone\") fell at 0.02 s"));
    CHECK_FALSE(says(find_warnings(run)[0], "\"preparation\""));
    // thrown, or let go in the air
    run.falls.airborne[1] = 1;
    CHECK(find_warnings(run).empty());
    run.falls.airborne[1] = 0;
    run.initial.velocity[1].x() = 1.0;
    CHECK(find_warnings(run).empty());
}
