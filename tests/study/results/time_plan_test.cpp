#include "lsdem/results/time_plan.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "lsdem/run/run.hpp"
#include "lsdem/run/sequence_plan.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scene_json.hpp"

using namespace musim::lsdem;

namespace {

Scene make_planned_scene(const std::string& rate, const std::string& time = R"("duration": "0.5 s")") {
    return parse_scene(fmt::format(R"({{"schema": "musim-scene/1", "material": "wood",
        "structure": {{"kind": "column", "layers": 2, "block": ["12.71 mm", "26.355 mm", "39.78 mm"]}},
        "time": {{{}}}, "output": {{"spine_rate": "{}"}}}})",
                                   time, rate));
}

TimePlan plan_of(const Scene& scene) { return make_time_plan(scene, make_upright_specimen(scene).model); }

constexpr const char* kRates[] = {"1 uHz", "1 Hz", "3 Hz", "200 Hz", "333.3 Hz", "4801 Hz", "1 GHz"};

}  // namespace

TEST_CASE("the rate of the spine decides when samples are taken and not how long a run is") {
    const Scene some = make_planned_scene("200 Hz");
    const double limit = compute_time_step(some, make_upright_specimen(some).model).value();
    for (const char* rate : kRates) {
        CAPTURE(rate);
        const TimePlan plan = plan_of(make_planned_scene(rate));
        CHECK(plan.duration() == doctest::Approx(0.5).epsilon(0.5 * plan.time_step / 0.5));
        CHECK(plan.time_step <= limit * (1.0 + 1e-12));
        // nor how long a step is: two samples a step would be twice as many steps
        CHECK(plan.time_step > 0.5 * limit);
    }
    // samples are as asked for where they can be
    CHECK(plan_of(make_planned_scene("200 Hz")).samples == 100);
    CHECK(plan_of(make_planned_scene("1 uHz")).samples == 1);
    CHECK(plan_of(make_planned_scene("333.3 Hz")).samples == 167);
    const TimePlan every = plan_of(make_planned_scene("1 GHz"));
    CHECK(every.steps_per_sample == 1);
    CHECK(every.time_step == limit);
}

TEST_CASE("a step of the scene's own is kept and the run has as many as the duration holds") {
    for (const char* rate : kRates) {
        CAPTURE(rate);
        const TimePlan plan = plan_of(make_planned_scene(rate, R"("duration": "0.5 s", "step": "5.03 us")"));
        CHECK(plan.time_step == 5.03e-6);
        // 99403.6 steps; what does not fill a sample is a few of them
        CHECK(plan.steps() <= 99404);
        CHECK(plan.steps() > 99404 - 10);
    }
}

TEST_CASE("runs with steps of their own are sampled at the same times when that is asked for") {
    const Scene scene = make_planned_scene("1 MHz");
    const Model model = make_upright_specimen(scene).model;
    const TimePlan plan = make_time_plan(scene, model, Sampling::at_rate);
    CHECK(plan.time_step == 1e-6);
    CHECK(plan.samples == 500000);
}

TEST_CASE("the stages of a sequence share one step and are as long as they are to be") {
    const std::string motions = R"({"schema": "musim-scene/1", "material": "wood",
        "structure": {"kind": "column", "layers": 2, "block": ["12.71 mm", "26.355 mm", "39.78 mm"]},
        "motions": [{"base_motion": {"signal": "sine", "direction": "x", "amplitude": "0.1 g", "frequency": "10 Hz", "cycles": 3}},
                    {"base_motion": {"signal": "sine", "direction": "x", "amplitude": "0.1 g", "frequency": "30 Hz", "cycles": 1}}],
        "output": {"spine_rate": "7 Hz"}})";
    const SequencePlan plan = plan_sequence(parse_scene(motions));
    REQUIRE(plan.stages.size() == 2);
    const double step = plan.stages[0].plan.time_step;
    CHECK(plan.stages[1].plan.time_step == step);
    for (const SequenceStage& stage : plan.stages) {
        const double duration = stage.scene.time.duration.value();
        CHECK(stage.plan.duration() == doctest::Approx(duration).epsilon(10.0 * step / duration));
    }
}
