#include "lsdem/results/level_motion.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "lsdem/results/read_results.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/study/made_run.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using musim::lsdem::tests::relative;
using musim::scaling::make_similitude;
using musim::tests::TemporaryFolder;

// amplitudes 0.3 and 0.7 of the made run's levels 1 and 2, less the base's own motion, 1 m/s
TEST_CASE("a level moves against the base as its history says") {
    const RunResult run = make_made_run(20);
    for (const auto& [samples, amplitude] : {std::pair(measure_level(run, 1), 0.3), std::pair(measure_top(run), 0.7)}) {
        REQUIRE(samples.size() == 20);
        for (const LevelSample& sample : samples) {
            CHECK(sample.x.value() == doctest::Approx((amplitude - 1.0) * sample.time.value()).epsilon(1e-12));
            CHECK(sample.y.value() == 0.0);
            CHECK(sample.z.value() == 0.0);
        }
    }
    CHECK_THROWS_WITH_AS(measure_level(run, 3), doctest::Contains("level 3 is not of the spine, which has 1, 2"), std::invalid_argument);
}

TEST_CASE("a model moves as its prototype, in the prototype's units, also when it was stored") {
    const auto similitude = make_similitude("mu", {.length = 1.0 / 25.0, .friction = 0.8});
    const RunResult prototype = make_made_run(20);
    RunResult model = scale_run(prototype, similitude);
    model.similitude = similitude;
    const TemporaryFolder scratch;
    {
        ResultFolder folder(scratch.path());
        folder.add_run("", model, {.scene = "{}", .program_version = "9.9.9"});
        folder.commit();
    }
    const StoredRun stored = read_run(scratch.path());
    CHECK(stored.similitude.law_name() == "mu");
    CHECK(stored.similitude.energy() == similitude.energy());
    const auto expected = measure_top(prototype), of_model = measure_top(model), of_stored = measure_top(stored);
    for (std::size_t k = 1; k < expected.size(); ++k) {
        CHECK(of_model[k].time.value() == relative(expected[k].time.value(), 1e-14));
        CHECK(of_model[k].x.value() == relative(expected[k].x.value(), 1e-12));
        CHECK(of_stored[k].x.value() == of_model[k].x.value());
    }
}

TEST_CASE("a model that is made and run moves as its prototype to the bit where all factors are powers of two") {
    const Scene prototype = parse_scene(R"({"schema": "musim-scene/1", "name": "column", "material": "wood",
        "structure": {"kind": "column", "layers": 4, "block": ["1.36 m", "2.82 m", "4.25 m"]},
        "base_motion": {"signal": "half_sine", "direction": "x", "amplitude": "0.5 g", "duration": "0.5 s"},
        "time": {"duration": "0.5 s"}, "output": {"spine_rate": "100 Hz"}})");
    const auto whole = measure_top(run_scene(prototype));
    const auto model = measure_top(run_model(prototype, make_similitude("exact", {.length = 1.0 / 16.0})));
    REQUIRE(model.size() == whole.size());
    for (std::size_t k = 0; k < whole.size(); ++k) {
        CHECK(model[k].time.value() == whole[k].time.value());
        CHECK(model[k].x.value() == whole[k].x.value());
    }
    CHECK(std::abs(whole.back().x.value()) > 0.0);
}
