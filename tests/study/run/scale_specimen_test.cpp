#include "lsdem/run/scale_specimen.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "lsdem/model_hash.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/compare_runs.hpp"
#include "scaling/error.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/study/made_specimen.hpp"

using namespace musim::lsdem;
using musim::scaling::make_similitude;
using musim::scaling::ScaleFactors;
using musim::scaling::Similitude;

namespace {

/// examples/uneven_wall.json, lower and shaken at once.
const Scene& uneven_wall() {
    static const Scene wall = parse_scene(R"({
        "schema": "musim-scene/1", "name": "uneven wall", "material": "concrete", 
        "structure": { "kind": "wall", "layers": 4, "blocks_per_layer": 2, "block": ["54.4 mm", "112.8 mm", "170 mm"],
                       "height_deviation": "0.2 mm", "seed": 1 },
        "base_motion": { "signal": "half_sine", "direction": "x", "amplitude": "0.4 g", "duration": "0.1 s" },
        "time": { "duration": "0.1 s" }, "output": { "spine_rate": "500 Hz" } })");
    return wall;
}

/// Laid once for all tests.
const Specimen& laid_wall() {
    static const Specimen specimen = make_specimen(uneven_wall());
    return specimen;
}

/// The run of a specimen's image, and how it differs from that of the specimen.
RunDifference run_image(const Specimen& specimen, const TimePlan& plan, const RunResult& prototype, const ScaleFactors& factors) {
    const Similitude similitude = make_similitude("exact", factors);
    return compare_runs(prototype, simulate(scale_specimen(specimen, similitude), plan.scaled(similitude.time())), similitude);
}

/// λ_l/λ_g is a power of four.
const std::vector<ScaleFactors> kPowersOfTwo{{.length = 1.0 / 16.0},
                                             {.length = 1.0 / 64.0},
                                             {.length = 1.0 / 16.0, .gravity = 4.0, .density = 0.5},
                                             {.length = 1.0 / 64.0, .gravity = 16.0, .density = 2.0},
                                             {.length = 0.125, .gravity = 8.0, .density = 0.25}};

}  // namespace

TEST_CASE("the image of a laid wall runs to the same bits where all factors are powers of two") {
    const TimePlan plan = make_time_plan(uneven_wall(), laid_wall().model);
    const RunResult prototype = simulate(laid_wall(), plan);
    REQUIRE(laid_wall().model.preload.size() > 8);
    // it moves, and slips
    REQUIRE(prototype.losses->total().friction > 0.0);
    for (const ScaleFactors& factors : kPowersOfTwo) {
        CAPTURE(factors.length);
        CAPTURE(factors.gravity);
        const RunDifference difference = run_image(laid_wall(), plan, prototype, factors);
        CHECK(difference.bitwise_identical);
        CHECK(difference.rms_velocity == 0.0);
    }
}

TEST_CASE("the image of a column and of its copy run to the same bits") {
    const Specimen column = make_column(3, 0.15);
    const TimePlan plan = make_plan(column, 200);
    for (const Specimen& specimen : {column, make_moved_copy(column)}) {
        const RunResult prototype = simulate(specimen, plan);
        for (const ScaleFactors& factors : kPowersOfTwo) CHECK(run_image(specimen, plan, prototype, factors).bitwise_identical);
    }
    // the last place scales, too
    const Similitude similitude = make_similitude("exact", {.length = 1.0 / 16.0});
    CHECK(hash_model(scale_specimen(make_moved_copy(column), similitude).model, 1.0) ==
          hash_model(make_moved_copy(scale_specimen(column, similitude)).model, 1.0));
}

TEST_CASE("an image is the model of the scaled scene, number by number") {
    const auto with = [](const std::string& shape, const std::string& structure) {
        return parse_scene(R"({"schema": "musim-scene/1", "name": "any", "material": "wood", "shape": )" + shape + R"(, "structure": )" +
                           structure +
                           R"(, "base_motion": {"signal": "ricker", "direction": "z", "amplitude": "0.3 g", "frequency": "20 Hz"},
                                  "time": {"duration": "0.1 s"}})");
    };
    const std::string wall = R"({"kind": "wall", "layers": 3, "blocks_per_layer": 2, "block": ["12.71 mm", "26.355 mm", "39.78 mm"],
        "height_deviation": "0.155 mm", "seed": 3})";
    const std::string spheres = R"({"kind": "blocks", "blocks": [{"size": ["2 cm", "2 cm", "2 cm"], "position": [0, 0, "1 cm"],
        "velocity": ["1 m/s", 0, 0], "angular_velocity": [0, "3 Hz", 0]}]})";
    const Similitude similitude = make_similitude("exact", {.length = 1.0 / 64.0, .gravity = 4.0, .density = 2.0});
    for (const Scene& scene : {with(R"({"kind": "box"})", wall), with(R"({"kind": "box", "level_set": "grid", "voxel": "0.65 mm"})", wall),
                               with(R"({"kind": "sphere", "radius": "1 cm", "nodes": 50, "voxel": "1 mm"})", spheres)}) {
        const Specimen image = scale_specimen(make_upright_specimen(scene), similitude);
        const Specimen built = make_upright_specimen(scale_scene(scene, similitude));
        CHECK(hash_model(image.model, 1.0) == hash_model(built.model, 1.0));
        CHECK(image.layer == built.layer);
        CHECK(image.spine.block == built.spine.block);
    }
}

TEST_CASE("at a scale that is no power of two every number is off by its own rounding, and the run by what that grows to") {
    const double length = std::pow(4.0, 0.37);
    const Similitude similitude = make_similitude("exact", {.length = length});
    const Specimen image = scale_specimen(laid_wall(), similitude);
    const Specimen built = make_upright_specimen(scale_scene(uneven_wall(), similitude));
    constexpr double kUlp = 0x1p-52;
    for (std::size_t i = 0; i < image.model.blocks.size(); ++i) {
        const Block &block = image.model.blocks[i], &prototype = laid_wall().model.blocks[i], &other = built.model.blocks[i];
        CHECK((block.position / length - prototype.position).cwiseAbs().maxCoeff() <= kUlp * prototype.position.cwiseAbs().maxCoeff());
        CHECK(block.orientation.coeffs() == prototype.orientation.coeffs());
        // volume and density of the built one are products of rounded numbers
        CHECK(std::abs(block.mass / other.mass - 1.0) <= 8.0 * kUlp);
    }
    const Settling &settling = *image.settling, &of_prototype = *laid_wall().settling;
    CHECK(std::abs(settling.damping_rate * similitude.time() / of_prototype.damping_rate - 1.0) <= 2.0 * kUlp);

    // 20 ms, before blocks have left each other: rounding of places, 1e-16 of 0.7 m, rings in the contacts as 1e-11 m/s
    TimePlan plan = make_time_plan(uneven_wall(), laid_wall().model);
    plan.samples = 10;
    const RunDifference difference = run_image(laid_wall(), plan, simulate(laid_wall(), plan), {.length = length});
    INFO("differs by " << difference.max_velocity);
    CHECK(difference.max_velocity > 0.0);
    CHECK(difference.max_velocity < 1e-8);
}

TEST_CASE("what friction holds and how fast velocities decay has an image, too") {
    Specimen specimen = make_column(2);
    specimen.model.velocity_damping = 3.0;
    specimen.model.preload = {{.leader = 0, .follower = 1, .friction = {1.0, 2.0, 3.0}, .couple = 13.0}};
    const Similitude similitude = make_similitude("exact", {.length = 1.0 / 64.0, .gravity = 4.0, .density = 8.0});
    const Model image = scale_specimen(specimen, similitude).model;
    const double weight = 8.0 * 4.0 * std::pow(1.0 / 64.0, 3);
    CHECK(image.velocity_damping == 3.0 * 16.0);
    CHECK(image.preload[0].friction == weight * Vector3(1.0, 2.0, 3.0));
    CHECK(image.preload[0].couple == 13.0 * weight / 64.0);
}

TEST_CASE("where a law changes friction, or stiffness for its weight, a specimen has no image") {
    const std::pair<const char*, ScaleFactors> changing[] = {{"mu", {.length = 1.0 / 16.0, .friction = 1.5}},
                                                             {"froude", {.length = 1.0 / 16.0, .friction = 1.5}},
                                                             {"cauchy", {.length = 1.0 / 16.0}}};
    for (const auto& [law, factors] : changing) {
        try {
            scale_specimen(make_column(1), make_similitude(law, factors));
            FAIL_CHECK("scaled");
        } catch (const musim::scaling::SimilitudeError& error) {
            const std::string message = error.what();
            CHECK(message.find(law) != std::string::npos);
            CHECK(message.find("take law \"exact\"") != std::string::npos);
        }
    }
}

TEST_CASE("by any law that keeps friction and stiffness over weight the image is that of the exact law") {
    const double length = 1.0 / 20.0;
    const Model exact = scale_specimen(laid_wall(), make_similitude("exact", {.length = length})).model;
    for (const char* law : {"mu", "froude", "true_replica"}) {
        CAPTURE(law);
        const Model image = scale_specimen(laid_wall(), make_similitude(law, {.length = length})).model;
        CHECK(hash_model(image, 1.0) == hash_model(exact, 1.0));
    }
    // in a gravity of 1/length every length law is one with the centrifuge
    const ScaleFactors heavy{.length = length, .gravity = 20.0};
    const Model centrifuge = scale_specimen(laid_wall(), make_similitude("exact", heavy)).model;
    CHECK(hash_model(scale_specimen(laid_wall(), make_similitude("cauchy", heavy)).model, 1.0) == hash_model(centrifuge, 1.0));
}

TEST_CASE("the image of a vertical motion goes by the law's vertical factor") {
    Specimen specimen = make_column(1);
    for (BaseComponent& component : specimen.model.ground.motion.shift) component = {.start = 1.0, .dt = 1.0, .velocity = {3.0}};
    const Similitude similitude({.length = 1.0 / 16.0}, 1.0, "vertical by half", 0.5);
    const auto motion = scale_specimen(specimen, similitude).model.ground.motion;
    CHECK(motion.shift[0].velocity[0] == 0.75);
    CHECK(motion.shift[2].velocity[0] == 0.375);
    CHECK(motion.shift[2].dt == 0.25);
}
