#include "lsdem/response/response.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "lsdem/response/field_picture.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;

namespace {

/// Two courses: a plate at level 1 that carries two blocks side by side at level 2, each 1 x 2 x 3 m; one sample.
StoredRun make_stack() {
    StoredRun run;
    run.directory = "made";
    run.blocks = {.size = {{2.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}}, .mass = {2.0, 1.0, 1.0}, .layer = {1, 2, 2}};
    run.spine = {.block = {0, 1}, .level = {1, 2}};
    run.initial.position = {{0.0, 0.0, 1.5}, {-0.5, 0.0, 4.5}, {0.5, 0.0, 4.5}};
    run.initial.orientation.assign(3, Quaternion::Identity());
    run.final = run.initial;
    run.history.time = {0.0};
    run.history.base.resize(1);
    run.scene =
        R"({"schema": "musim-scene/1", "material": {"density": 1, "normal_stiffness": 400, "shear_stiffness": 100, "friction": 0.5, "restitution": 0.3},
            "structure": {"kind": "column", "layers": 2, "block": [1, 2, 3]}, "gravity": 10, "time": {"duration": 1}})";
    run.history.spine_position = {run.initial.position[0], run.initial.position[1]};
    run.history.spine_velocity.assign(2, Vector3::Zero());
    run.history.spine_rotation.assign(2, Vector3::Zero());
    return run;
}

Quaternion turn(double angle, const Vector3& axis) { return Quaternion(Eigen::AngleAxisd(angle, axis)); }

/// One frame of the stack's end.
void add_frame(StoredRun& run) {
    run.frames.time = {0.0};
    for (std::size_t b = 0; b < 3; ++b) {
        const Quaternion& q = run.final.orientation[b];
        run.frames.position.emplace_back(run.final.position[b].cast<float>());
        run.frames.quaternion.emplace_back(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()).cast<float>());
        run.frames.velocity.emplace_back(static_cast<float>(b), 0.0F, 0.5F);
    }
}

/// A small scene run into a folder.
void run_into(const std::filesystem::path& folder, const std::string& scene_text) {
    const Scene scene = parse_scene(scene_text);
    ResultFolder results(folder);
    results.add_run("", run_scene(scene), {.scene = write_scene(scene), .program_version = "test"});
    results.commit();
}

}  // namespace

TEST_CASE("a structure that did not move has no damage") {
    const Damage damage = assess_damage(make_stack());
    // the plate on the ground, and one joint under each block; blocks side by side carry each other not
    REQUIRE(damage.joints.size() == 3);
    CHECK(damage.joints[0].on_ground);
    CHECK(damage.index == 0.0);
    CHECK(damage.fallen == 0);
    REQUIRE(damage.levels.size() == 2);
    CHECK(damage.levels[1].blocks == 2);
}

TEST_CASE("slip is measured where blocks meet, and a base that moved as a whole leaves none") {
    StoredRun run = make_stack();
    const Vector3 base(0.3, 0.1, 0.0);
    run.history.base[0].displacement = base;
    for (Vector3& x : run.final.position) x += base;
    run.final.position[2].y() += 0.2;  // b = 1: a fifth of it
    const Damage damage = assess_damage(run);
    CHECK(damage.levels[0].slip.max == doctest::Approx(0.0));
    CHECK(damage.levels[1].slip.max == doctest::Approx(0.2));
    CHECK(damage.levels[1].slip.mean == doctest::Approx(0.1));
    CHECK(damage.levels[1].displacement.max == doctest::Approx(0.2));
    // D = 0.2 for one of three blocks
    CHECK(damage.index == doctest::Approx(0.2 / std::sqrt(3.0)));

    // a block that rocked about the middle of its lower face has not slipped
    StoredRun rocked = make_stack();
    const Quaternion q = turn(0.05, Vector3::UnitY());
    rocked.final.orientation[1] = q;
    rocked.final.position[1] = Vector3(-0.5, 0.0, 3.0) + q * Vector3(0.0, 0.0, 1.5);
    const Damage after = assess_damage(rocked);
    CHECK(after.levels[1].slip.max < 1e-12);
    CHECK(after.levels[1].rotation.max == doctest::Approx(0.05));
    CHECK(after.levels[1].turn.max < 1e-12);
    // ½·√5·0.05 over b = 1
    CHECK(after.levels[1].index == doctest::Approx(0.5 * std::sqrt(5.0) * 0.05 / std::sqrt(2.0)));
}

TEST_CASE("turns about the vertical count as turns, and fallen blocks as lost") {
    StoredRun run = make_stack();
    run.final.orientation[1] = turn(-0.1, Vector3::UnitZ());
    run.final.position[2] += Vector3(3.0, 0.0, -3.0);
    const Damage damage = assess_damage(run);
    CHECK(damage.levels[1].turn.max == doctest::Approx(0.1));
    CHECK(damage.levels[1].final_tilt.max < 1e-12);
    CHECK(damage.fallen == 1);
    CHECK(damage.levels[1].fallen == 1);
    CHECK(damage.index > 1.0 / std::sqrt(3.0));
    CHECK(damage.index < 1.0);
    StoredRun toppled = make_stack();
    toppled.final.orientation[1] = turn(1.0, Vector3::UnitX());
    CHECK(assess_damage(toppled).fallen == 1);
}

TEST_CASE("what blocks dissipate is booked below the level above them, and the ground's below the first") {
    StoredRun run = make_stack();
    CHECK_FALSE(assess_damage(run).loss);
    // the plate leads its joints with the two blocks; of these the first leads the joint between them
    run.losses = Losses{.block = {{6.0, 1.0}, {0.5, 0.25}, {0.0, 0.0}}, .ground = {2.0, 0.25}};
    const Damage damage = assess_damage(run);
    CHECK(damage.levels[0].loss->friction == 2.0);
    CHECK(damage.levels[0].loss->damping == 0.25);
    CHECK(damage.levels[1].loss->friction == 6.5);
    CHECK(damage.levels[1].loss->damping == 1.25);
    CHECK(damage.loss->total() == 10.0);
    CHECK(find_loss_share(damage.levels[1], damage) == 0.775);
    CHECK(make_damage_csv(damage).find(",6.5,1.25,0.775\n") != std::string::npos);
    // blocks in no layer share one row, which gets everything
    run.blocks.layer = {0, 0, 0};
    const Damage heap = assess_damage(run);
    REQUIRE(heap.levels.size() == 1);
    CHECK(heap.levels[0].loss->total() == 10.0);
}

TEST_CASE("the camera sees the block in front, in its colour and place") {
    StoredRun run = make_stack();
    run.final.position[1].y() -= 3.0;  // toward a camera at -y, and in front of block 2 at +x
    run.final.position[1].x() += 1.0;
    run.final.position[2].y() += 0.5;
    add_frame(run);
    const CameraImage front = take_picture(run, 0, {.side = CameraSide::minus_y, .columns = 60});
    const CameraImage back = take_picture(run, 0, {.side = CameraSide::plus_y, .columns = 60});
    const auto at = [](const CameraImage& image, double right, double z) {
        const auto column = static_cast<std::size_t>((right - image.left) / image.pixel);
        const auto row = static_cast<std::size_t>((z - image.bottom) / image.pixel);
        return image.block.at(row * image.columns + column);
    };
    CHECK(at(front, 0.5, 4.5) == 1);
    CHECK(at(back, -0.5, 4.5) == 2);  // right is -x from there
    CHECK(at(front, -0.5, 1.5) == 0);
    CHECK(at(front, -0.5, 4.5) == -1);
    CHECK(find_velocity(run, 0, 2, CameraSide::minus_y, FieldComponent::right) == 2.0);
    CHECK(find_velocity(run, 0, 2, CameraSide::plus_y, FieldComponent::right) == -2.0);
    CHECK(find_velocity(run, 0, 0, CameraSide::minus_y, FieldComponent::up) == 0.5);

    // block 2 is hidden from the front: two polygons, the grid names two blocks
    const std::string svg =
        make_field_svg(run, {{0, front}}, {.side = CameraSide::minus_y, .component = FieldComponent::right, .limit = 2.0, .name = "made"});
    const auto count_of = [](const std::string& text, const std::string& part) {
        std::size_t count = 0;
        for (std::size_t p = text.find(part); p != std::string::npos; p = text.find(part, p + 1)) ++count;
        return count;
    };
    CHECK(count_of(svg, "<polygon") == 2);
    // of three views each has a panel, its time, and one colour bar
    run.frames.time.front() = 0.25;
    const CameraImage later = take_picture(run, 0, {.side = CameraSide::minus_y, .columns = 60});
    const std::string panels =
        make_field_svg(run, {{0, later}, {0, later}, {0, later}},
                       {.side = CameraSide::minus_y, .component = FieldComponent::right, .limit = 2.0, .name = "made"});
    CHECK(count_of(panels, "<polygon") == 6);
    CHECK(count_of(panels, "<clipPath") == 3);
    CHECK(count_of(panels, ">0.25 s<") == 3);
    CHECK(count_of(panels, ">velocity to the right, along x [m/s]<") == 1);
    CHECK(find_field_limit(run, {{0, front}}, CameraSide::minus_y, FieldComponent::right) == 1.0);
    CHECK(find_field_limit(run, {{0, front}}, CameraSide::minus_y, FieldComponent::up) == 0.5);

    CHECK(make_field_csv(run, 0, front, CameraSide::minus_y).find(",2,2,") == std::string::npos);

    run.frames.time = {0.0, 0.1, 0.2};
    CHECK(find_frame(run, -0.04) == 0);
    CHECK(find_frame(run, 0.16) == 2);
    CHECK(find_frame(run, 0.24) == 2);
    CHECK_THROWS_WITH_AS(find_frame(run, 0.26), "made: there is no frame at 0.26 s (frames are from 0 to 0.2 s); name a time between them",
                         ResultError);
    run.frames = {};
    CHECK_THROWS_WITH_AS(find_frame(run, 0.0),
                         "made/result.h5: the run has kept no frames (its scene has no output.frame_rate); give one, e.g. \"frame_rate\": "
                         "\"100 Hz\", and run it again",
                         ResultError);
}

// [Schroedinger14]: half of the velocity arrives with 0.9878 c0 between the layers 5 and 30 of a stuck chain.
TEST_CASE("the front in a stored run of a stuck column runs at its elastic speed") {
    const musim::tests::TemporaryFolder folder;
    // gravity so small that the joints, apart at the start by nothing, settle by nothing; friction holds all the same
    run_into(folder.path() / "run", R"({"schema": "musim-scene/1", "name": "chain",
        "material": {"preset": "wood", "friction": 1e9, "restitution": 1},
        "structure": {"kind": "column", "layers": 40, "block": ["12.710 mm", "26.355 mm", "39.720 mm"], "rotation_locked": true},
        "base_motion": {"signal": "step", "direction": "x", "velocity": "3 mm/s"},
        "time": {"duration": "0.72 ms", "step": "0.5 us"}, "output": {"frame_rate": "10 kHz"}})");
    const StoredRun run = read_run(folder.path() / "run");
    CHECK(run.frames.time.size() == 8);
    const Response response = measure_response(run, {.axis = {}, .threshold = 0.5, .window = {}});
    CHECK(response.axis == 0);
    // c_e = H·√(k_s/m)
    CHECK(response.scales.elastic_speed == doctest::Approx(1963.1).epsilon(1e-3));
    const SpeedEstimate& first = response.speeds.front();
    REQUIRE(first.speed.has_value());
    // 20 of 40 levels from the second on (the lowest joint is not loaded at the start and slips): the fitted line of arrivals n + 0.2
    // n^(1/3)
    CHECK(*first.speed / response.scales.elastic_speed == doctest::Approx(0.988).epsilon(5e-3));
    CHECK(response.damage.fallen == 0);
    CHECK(to_json(response)["speeds"][0]["speed_m_s"].get<double>() == *first.speed);

    // nothing is faster than elastic waves: with clocks a tenth as slow the same histories show no speed
    StoredRun quicker = run;
    for (double& time : quicker.history.time) time *= 0.1;
    const SpeedEstimate none = measure_response(quicker, {.axis = {}, .threshold = 0.5, .window = {}}).speeds.front();
    CHECK_FALSE(none.speed.has_value());
    CHECK(none.why.find("above the elastic speed of 1.96e+03 m/s") != std::string::npos);
}

TEST_CASE("a run reads back as it was written") {
    const musim::tests::TemporaryFolder folder;
    run_into(folder.path() / "run", R"({"schema": "musim-scene/1", "material": "wood",
        "structure": {"kind": "column", "layers": 3, "block": ["12.710 mm", "26.355 mm", "39.720 mm"]},
        "base_motion": {"signal": "sine", "direction": "y", "amplitude": "1 g", "frequency": "50 Hz", "cycles": 1},
        "time": {"duration": "2 ms"}})");
    const StoredRun run = read_run(folder.path() / "run");
    CHECK(run.status == RunStatus::completed);
    CHECK(run.spine.level == std::vector<int>{1, 3});
    CHECK(run.history.spine_velocity.size() == 2 * run.history.samples());
    CHECK(run.history.spine_position.back() == run.final.position[2]);
    CHECK(run.frames.time.empty());
    const Response response = measure_response(run);
    CHECK(response.axis == 1);
    for (const SpeedEstimate& e : response.speeds) CHECK(e.why == "fewer than three levels are kept");
    CHECK(response.spine[1].residual_displacement ==
          run.final.position[2] - run.initial.position[2] - run.history.base.back().displacement);
    // the losses in the file are those of the energy balance: four terms, each rounded once
    const RunResult again = run_scene(parse_scene(run.scene));
    REQUIRE(again.history.energy.back().friction_loss > 0.0);
    CHECK(response.damage.loss->friction == doctest::Approx(again.history.energy.back().friction_loss).epsilon(1e-14));
    CHECK(response.damage.loss->damping == doctest::Approx(again.history.energy.back().damping_loss).epsilon(1e-14));
    CHECK_THROWS_AS(measure_response(run, {.axis = {}, .threshold = 0.1, .window = {{1.0, 2.0}}}), ResultError);
}

TEST_CASE("what is no result is refused in one line") {
    const musim::tests::TemporaryFolder folder;
    const std::filesystem::path missing = folder.path() / "missing";
    CHECK_THROWS_WITH_AS(
        read_run(missing),
        (missing.string() + ": is no directory of results (there is none of that name); name one that a run has written").c_str(),
        ResultError);
    CHECK_THROWS_AS(read_run(folder.path()), ResultError);
    std::ofstream(folder.path() / "result.h5") << "not HDF5";
    CHECK_THROWS_WITH_AS(read_run(folder.path()),
                         ((folder.path() / "result.h5").string() +
                          ": is no file of musim, or cut off; remove it and make it again with the command that made it")
                             .c_str(),
                         ResultError);
}
