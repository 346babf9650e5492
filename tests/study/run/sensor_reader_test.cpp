#include "lsdem/run/sensor_reader.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lsdem/results/checkpoint.hpp"
#include "lsdem/results/read_results.hpp"
#include "lsdem/results/run_warnings.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/study/made_specimen.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using musim::tests::TemporaryFolder;
using std::numbers::pi;

namespace {

/// A sensor on a block, or on the ground, in the place where it is drawn.
PlacedSensor make_sensor(SensorKind kind, std::optional<std::size_t> body, const Vector3& place = Vector3::Zero()) {
    PlacedSensor sensor;
    sensor.name = "S";
    sensor.kind = kind;
    sensor.body = body;
    sensor.place = place;
    return sensor;
}

/// The joint of a block and the ground.
PlacedSensor make_joint(std::size_t block) {
    PlacedSensor sensor = make_sensor(SensorKind::joint, block);
    sensor.place.reset();
    return sensor;
}

/// Runs a specimen with sensors that are all read at a multiple of the step.
RunResult read(Specimen specimen, std::vector<PlacedSensor> sensors, TimePlan plan, ReadingPlan readings) {
    specimen.sensors = std::move(sensors);
    readings.count = static_cast<std::uint64_t>(static_cast<double>(plan.steps()) / readings.steps);
    plan.readings.assign(specimen.sensors.size(), readings);
    return simulate(specimen, plan);
}

/// A unit cube of 1000 kg by itself in space.
Specimen make_lone_cube() {
    Specimen specimen = make_column(1);
    specimen.model.ground.present = false;
    specimen.model.ground.motion = {};
    return specimen;
}

Vector3 reading(const RunResult& run, std::size_t sensor, std::size_t k) {
    const double* values = &run.sensors[sensor].values[3 * k];
    return {values[0], values[1], values[2]};
}

/// A ground that moves along x with the velocity of a sine of so many steps a period, 64 periods long, and a cube that is far above it.
Specimen make_shaken_ground(double steps_per_period, double time_step) {
    Specimen specimen = make_column(1);
    specimen.model.blocks[0].position.z() = 1e6;
    BaseComponent& motion = specimen.model.ground.motion.shift[0];
    motion = {.start = 0.0, .dt = time_step, .velocity = {}};
    for (int k = 0; k <= static_cast<int>(64.0 * steps_per_period); ++k)
        motion.velocity.push_back(std::sin(2.0 * pi * k / steps_per_period));
    return specimen;
}

/// Scene of a block that rocks on another on a shaken base, with one sensor of each kind.
std::string make_text(const std::string& sensors) {
    return R"({"schema": "musim-scene/1", "name": "test", "material": "wood", "structure": {"kind": "blocks", "blocks": [
        {"name": "foot", "size": ["60 mm", "60 mm", "20 mm"], "position": [0, 0, "10 mm"]},
        {"name": "post", "size": ["20 mm", "30 mm", "80 mm"], "position": [0, 0, "60 mm"]}]},
        "base_motion": {"signal": "sine", "direction": "x", "amplitude": "0.5 g", "frequency": "10 Hz", "cycles": 2},
        "time": {"duration": "0.1 s"}, "output": {"spine_rate": "400 Hz"})" +
           (sensors.empty() ? "" : ", \"sensors\": [" + sensors + "]") + "}";
}

const std::string kSensors = R"(
    {"name": "A1", "kind": "acceleration", "block": "post", "point": [0, 0, "0.1 m"], "axes": "block", "rate": "700 Hz"},
    {"name": "A0", "kind": "acceleration", "block": "ground", "rate": "500 Hz"},
    {"name": "V1", "kind": "velocity", "block": 1, "rate": "500 Hz", "filter": "none"},
    {"name": "D1", "kind": "displacement", "block": "post", "point": [0, 0, "0.1 m"], "axes": "base", "rate": "500 Hz"},
    {"name": "R1", "kind": "rotation", "block": "post", "rate": "500 Hz"},
    {"name": "W1", "kind": "angular_velocity", "block": "post", "rate": "500 Hz"},
    {"name": "J1", "kind": "joint", "blocks": ["post", "foot"], "rate": "500 Hz"})";

}  // namespace

TEST_CASE("sensors on a block that falls freely read its closed form") {
    const TimePlan plan{.time_step = 1e-3, .steps_per_sample = 100, .samples = 5};
    PlacedSensor accelerometer = make_sensor(SensorKind::acceleration, 0);
    accelerometer.gravity = true;
    const RunResult run = read(make_lone_cube(),
                               {make_sensor(SensorKind::acceleration, 0), accelerometer, make_sensor(SensorKind::velocity, 0),
                                make_sensor(SensorKind::displacement, 0)},
                               plan, {.steps = 10.0});
    REQUIRE(run.sensors.size() == 4);
    REQUIRE(run.sensors[0].readings() == 51);
    CHECK(run.sensors[0].interval == 10.0 * plan.time_step);
    for (std::size_t k = 0; k <= 50; ++k) {
        const double t = run.sensors[0].time(k);
        CHECK(reading(run, 0, k) == Vector3(0.0, 0.0, -10.0));
        CHECK(reading(run, 1, k) == Vector3::Zero());
        // 500 steps of rounding
        CHECK(reading(run, 2, k).z() == doctest::Approx(-10.0 * t).epsilon(1e-12));
        CHECK(reading(run, 3, k).z() == doctest::Approx(-5.0 * t * t).epsilon(1e-12));
    }
}

// a point at r from the axis of a constant spin: v = ω×r, a = ω×(ω×r)
TEST_CASE("a point of a block that turns steadily has its centripetal acceleration, along one axis of the block") {
    constexpr double kSpin = 2.0, kArm = 0.3;  // [rad/s], [m]
    Specimen cube = make_lone_cube();
    cube.model.gravity.setZero();
    cube.model.blocks[0].angular_velocity = {0.0, 0.0, kSpin};
    const Vector3 place(kArm, 0.0, 0.1);
    PlacedSensor glued = make_sensor(SensorKind::acceleration, 0, place);
    glued.axes = SensorAxes::block;
    // mounted with its x along the block's y
    glued.mount = Quaternion(Eigen::AngleAxisd(0.5 * pi, Vector3::UnitZ()));
    const RunResult run = read(cube,
                               {make_sensor(SensorKind::acceleration, 0, place), glued, make_sensor(SensorKind::velocity, 0, place),
                                make_sensor(SensorKind::rotation, 0), make_sensor(SensorKind::angular_velocity, 0),
                                make_sensor(SensorKind::displacement, 0, place)},
                               {.time_step = 1e-3, .steps_per_sample = 100, .samples = 12}, {.steps = 25.0});
    for (std::size_t k = 0; k < run.sensors[0].readings(); ++k) {
        const double angle = kSpin * run.sensors[0].time(k);
        const Vector3 out(std::cos(angle), std::sin(angle), 0.0), ahead(-std::sin(angle), std::cos(angle), 0.0);
        // the step turns by 2·atan(φ/2 + φ³/24), which is φ but for φ⁵/720 [4e-17 a step]
        constexpr double kRounding = 1e-11;
        CHECK((reading(run, 0, k) + kSpin * kSpin * kArm * out).norm() < kRounding);
        CHECK((reading(run, 1, k) - Vector3(0.0, kSpin * kSpin * kArm, 0.0)).norm() < kRounding);
        CHECK((reading(run, 2, k) - kSpin * kArm * ahead).norm() < kRounding);
        CHECK((reading(run, 3, k) - Vector3(0.0, 0.0, angle)).norm() < kRounding);
        CHECK((reading(run, 4, k) - Vector3(0.0, 0.0, kSpin)).norm() < kRounding);
        CHECK((reading(run, 5, k) - kArm * (out - Vector3::UnitX())).norm() < kRounding);
    }
}

// a base of a = 2 m/s² under a block of friction μ = 0.1, g = 10 m/s²: the block has μg, and slips by (a − μg)t²/2
TEST_CASE("sensors on a sliding block and its joint read Coulomb's law") {
    const Specimen column = make_column(1, 0.1);
    const TimePlan plan{.time_step = 0.5 * compute_critical_time_step(column.model), .steps_per_sample = 20, .samples = 12};
    REQUIRE(plan.duration() < 0.25);
    PlacedSensor seen_from_base = make_sensor(SensorKind::displacement, 0);
    seen_from_base.relative = true;
    const RunResult run = read(column, {make_sensor(SensorKind::acceleration, 0), make_joint(0), seen_from_base}, plan, {.steps = 4.0});
    const SensorHistory &acceleration = run.sensors[0], &joint = run.sensors[1];
    REQUIRE(joint.readings() == acceleration.readings());
    const double weight = 1e4, elastic = 0.1 * weight / 1e9;  // [N]; shift of the joint at the limit of friction [m]
    const double stuck = std::sqrt(2.0 * elastic / 2.0);      // time in which the base moves as far [s]
    double force = 0.0, last = 0.0;
    for (std::size_t k = 0; k < joint.readings(); ++k) {
        const double t = joint.time(k);
        const double* values = &joint.values[6 * k];
        CHECK(values[3] == doctest::Approx(weight).epsilon(0.02));
        // the block is pulled along by the base: Coulomb's limit at every instant once it slides
        if (k > 0) CHECK(std::abs(values[4]) <= 0.1 * values[3] * (1.0 + 1e-9));
        CHECK(acceleration.values[3 * k] == doctest::Approx(values[4] / 1000.0).epsilon(1e-12));
        // it rocks by some elastic lengths
        CHECK(std::abs(values[0]) < 2.0 * weight / 1e9);
        CHECK(std::abs(values[1] + 0.5 * (2.0 - 1.0) * t * t) < (2.0 - 1.0) * stuck * t + 2.0 * elastic);
        CHECK(std::abs(values[2]) < 1e-12);
        CHECK(std::abs(reading(run, 2, k).x() - values[1]) < 2.0 * weight / 1e9);
        if (t > 0.05) {
            force += values[4];
            last += 1.0;
        }
    }
    CHECK(force / last == doctest::Approx(0.1 * weight).epsilon(0.01));
}

TEST_CASE("a block that rests on a shaken base moves as sensors on the base do, one that is held to it exactly so") {
    Specimen column = make_column(1);
    const TimePlan plan = make_plan(column, 100);
    std::vector<PlacedSensor> sensors{make_sensor(SensorKind::displacement, 0), make_sensor(SensorKind::displacement, std::nullopt),
                                      make_sensor(SensorKind::acceleration, std::nullopt), make_sensor(SensorKind::acceleration, 0)};
    const RunResult run = read(column, sensors, plan, {.steps = 20.0});
    // twice what the base's 2 m/s² bend the springs of the joint, rocking included: 6 more at half a height above a square base
    const double bend = 2.0 * 2.0 * 1000.0 * 2.0 / 1e9 * 7.0;
    for (std::size_t k = 0; k < run.sensors[0].readings(); ++k) {
        CHECK((reading(run, 0, k) - reading(run, 1, k)).norm() < bend);
        CHECK(reading(run, 1, k) == run.history.base[k].displacement);
        CHECK(reading(run, 2, k) == run.history.base[k].acceleration);
    }
    column.model.blocks[0].fixed = column.model.blocks[0].with_base = true;
    column.model.blocks.push_back({.mass = 1000.0, .position = {3.0, 0.0, 0.5 - 1e-5}});
    const RunResult held = read(column, sensors, plan, {.steps = 20.0});
    for (std::size_t k = 0; k < held.sensors[0].readings(); ++k) {
        CHECK((reading(held, 0, k) - reading(held, 1, k)).norm() < 1e-15);
        CHECK(reading(held, 3, k) == reading(held, 2, k));
    }
}

// a base that turns at ω about z through p: its points have −ω²r, and a body at rest at ρ from p has ω×(ω×ρ) = −ω²ρ as seen from it
TEST_CASE("sensors on a base that turns, on what it carries and on what it leaves behind read its closed form") {
    constexpr double kSpin = 2.0, kArm = 0.3;  // [rad/s], [m]
    Specimen specimen = make_column(2);
    Model& model = specimen.model;
    model.gravity.setZero();
    model.ground.motion = {.shift = {}, .turn = {}, .pivot = {1.0, 0.0, 0.0}};
    model.ground.motion.turn[2] = {.start = 0.0, .dt = 10.0, .velocity = {kSpin, kSpin}};
    model.blocks[0].position = {1.0 + kArm, 0.0, 1.5};
    model.blocks[0].fixed = model.blocks[0].with_base = true;
    model.blocks[1].position = {-3.0, 4.0, 9.0};
    const auto seen_from_base = [](PlacedSensor sensor) {
        sensor.axes = SensorAxes::base;
        sensor.relative = true;
        return sensor;
    };
    PlacedSensor along_base = make_sensor(SensorKind::acceleration, 0);
    along_base.axes = SensorAxes::base;
    const RunResult run =
        read(specimen,
             {make_sensor(SensorKind::acceleration, std::nullopt, {1.0 + kArm, 0.0, 0.0}), along_base, make_sensor(SensorKind::rotation, 0),
              seen_from_base(make_sensor(SensorKind::displacement, 0)), seen_from_base(make_sensor(SensorKind::rotation, 0)),
              seen_from_base(make_sensor(SensorKind::acceleration, 1)), seen_from_base(make_sensor(SensorKind::velocity, 1)),
              seen_from_base(make_sensor(SensorKind::displacement, 1)), make_sensor(SensorKind::displacement, 1)},
             {.time_step = 1e-3, .steps_per_sample = 100, .samples = 12}, {.steps = 25.0});
    constexpr double kRounding = 1e-11;
    const Vector3 started(-4.0, 4.0, 9.0), spin(0.0, 0.0, kSpin);  // of the free block from the point about which the base turns
    for (std::size_t k = 1; k < run.sensors[0].readings(); ++k) {
        const double angle = kSpin * run.sensors[0].time(k);
        const Vector3 out(std::cos(angle), std::sin(angle), 0.0);
        CHECK((reading(run, 0, k) + kSpin * kSpin * kArm * out).norm() < kRounding);
        CHECK((reading(run, 1, k) + kSpin * kSpin * kArm * Vector3::UnitX()).norm() < kRounding);
        CHECK((reading(run, 2, k) - angle * Vector3::UnitZ()).norm() < kRounding);
        CHECK(reading(run, 3, k).norm() < kRounding);
        CHECK(reading(run, 4, k).norm() < kRounding);
        const Vector3 seen = Eigen::AngleAxisd(-angle, Vector3::UnitZ()) * started;
        CHECK((reading(run, 5, k) - spin.cross(spin.cross(seen))).norm() < kRounding);
        CHECK((reading(run, 6, k) + spin.cross(seen)).norm() < kRounding);
        CHECK((reading(run, 7, k) - (seen - started)).norm() < kRounding);
        CHECK(reading(run, 8, k) == Vector3::Zero());
    }
}

// |H|² = 1/(1 + (tan(π f dt)/tan(π f_c dt))^(2n)), readings a quarter of a period apart, or three of one that is folded back
TEST_CASE("the filter of a sensor lets half the power of its corner pass, and what it folds back is as small as it says") {
    constexpr double kStep = 1e-3;  // [s]
    const ReadingPlan readings{.steps = 10.0, .corner_steps = 0.025, .order = 4};
    for (const double cycles_per_step : {0.025, 0.075}) {
        CAPTURE(cycles_per_step);
        const double period = 1.0 / cycles_per_step;
        const TimePlan plan{.time_step = kStep, .steps_per_sample = 10, .samples = static_cast<std::uint64_t>(6.0 * period)};
        const RunResult run = read(make_shaken_ground(period, kStep), {make_sensor(SensorKind::velocity, std::nullopt)}, plan, readings);
        const double ratio = std::tan(pi * cycles_per_step) / std::tan(pi * readings.corner_steps);
        const double expected = 1.0 / std::sqrt(1.0 + std::pow(ratio, 8.0));
        const std::size_t last = run.sensors[0].readings() - 1;
        // 2e-3: times of samples are to a few roundings those of steps
        CHECK(std::hypot(reading(run, 0, last).x(), reading(run, 0, last - 1).x()) == doctest::Approx(expected).epsilon(2e-3));
    }
}

TEST_CASE("the filter of a sensor delays slow signals by as much as its history says") {
    Specimen specimen = make_shaken_ground(10.0, 1e-3);
    specimen.model.ground.motion.shift[0] = {.start = 0.0, .dt = 1.0, .velocity = {0.0, 3.0}};  // 3 m/s²
    const TimePlan plan{.time_step = 1e-3, .steps_per_sample = 10, .samples = 40};
    for (const int order : {1, 4, 7}) {
        const RunResult run =
            read(specimen, {make_sensor(SensorKind::velocity, std::nullopt)}, plan, {.steps = 10.0, .corner_steps = 0.025, .order = order});
        const SensorHistory& sensor = run.sensors[0];
        CHECK(sensor.corner == doctest::Approx(25.0).epsilon(1e-14));
        // memory of the start: the slowest pole has forgotten it by exp(−2π 25 Hz · 0.4 s · sin(π/14)) = 1e-6
        CHECK(reading(run, 0, 40).x() == doctest::Approx(3.0 * (0.4 - sensor.delay)).epsilon(1e-5));
    }
}

TEST_CASE("readings lie where their rate says, also between two steps") {
    const TimePlan plan{.time_step = 1e-3, .steps_per_sample = 100, .samples = 5};
    const RunResult run = read(make_lone_cube(), {make_sensor(SensorKind::velocity, 0)}, plan, {.steps = 7.3});
    REQUIRE(run.sensors[0].readings() == 69);
    for (std::size_t k = 0; k < 69; ++k) {
        CHECK(reading(run, 0, k).z() == doctest::Approx(-10.0 * 7.3e-3 * static_cast<double>(k)).epsilon(1e-11));
    }
}

TEST_CASE("sensors change nothing of a run, and its results give back what they read") {
    const Scene scene = parse_scene(make_text(kSensors));
    const RunResult run = run_scene(scene);
    CHECK(run.state_hash == run_scene(parse_scene(make_text(""))).state_hash);
    REQUIRE(run.sensors.size() == 7);
    for (const SensorHistory& sensor : run.sensors) CHECK(sensor.readings() == (sensor.name == "A1" ? 71 : 51));
    // it rocks: the joint opens and closes, and bears weight when it begins
    CHECK(find_peak(run.sensors[6], 0).value > 1e-4);
    const double mass = run.blocks.mass[1];
    CHECK(run.sensors[6].values[3] == doctest::Approx(9.80665 * mass).epsilon(1e-3));
    // a glued accelerometer reads g upwards at rest
    CHECK(run.sensors[0].values[2] == doctest::Approx(9.80665).epsilon(1e-3));

    const TemporaryFolder folder;
    {
        ResultFolder results(folder.path() / "out");
        results.add_run("", run, {.scene = write_scene(scene), .program_version = "test"});
        results.commit();
    }
    CHECK(read_run(folder.path() / "out").sensors == run.sensors);
    const std::vector<SensorTable> tables = make_sensor_tables(run.sensors);
    REQUIRE(tables.size() == 2);
    CHECK(tables[0].name == "sensors_700Hz.csv");
    CHECK(tables[1].name == "sensors_500Hz.csv");
    CHECK(std::filesystem::exists(folder.path() / "out" / "sensors_700Hz.csv"));
    CHECK(tables[0].csv.starts_with("time_s,A1_ax_m_s2,A1_ay_m_s2,A1_az_m_s2\n0,"));
    CHECK(tables[1].csv.find(",J1_gap_m,J1_slip1_m,J1_slip2_m,J1_normal_N,J1_shear1_N,J1_shear2_N\n") != std::string::npos);
}

TEST_CASE("a model at a power of four reads what its prototype reads, to the bit") {
    const Scene scene = parse_scene(make_text(kSensors));
    const musim::scaling::Similitude law = musim::scaling::make_similitude("exact", {.length = 1.0 / 16.0});
    const RunResult prototype = run_scene(scene), model = run_model(scene, law);
    const double l = law.length(), t = law.time();
    const std::vector<double> factors{l / (t * t), l / (t * t), l / t, l, 1.0, 1.0 / t};
    for (std::size_t s = 0; s < prototype.sensors.size(); ++s) {
        const SensorHistory &big = prototype.sensors[s], &small = model.sensors[s];
        CAPTURE(big.name);
        REQUIRE(big.values.size() == small.values.size());
        CHECK(small.interval == big.interval * t);
        bool same = true;
        for (std::size_t i = 0; i < big.values.size(); ++i) {
            const double factor = s < 6 ? factors[s] : i % 6 < 3 ? l : law.factor<musim::scaling::Force>();
            same = same && small.values[i] == big.values[i] * factor;
        }
        CHECK(same);
    }
}

TEST_CASE("sensors of a run that was killed go on to the same bits") {
    Specimen specimen = make_column(3, 0.1);
    TimePlan plan = make_plan(specimen, 60);
    specimen.sensors = {make_sensor(SensorKind::acceleration, 2, {0.5, 0.0, 0.5}), make_joint(0), make_sensor(SensorKind::velocity, 1)};
    plan.readings = {{.steps = 7.3, .count = 164, .corner_steps = 0.03, .order = 4},
                     {.steps = 20.0, .count = 60},
                     {.steps = 33.0, .count = 36, .corner_steps = 0.01, .order = 3}};
    const RunResult whole = simulate(specimen, plan);
    CHECK(whole.sensors[0].readings() == 165);
    for (const std::uint64_t every : {7U, 59U}) {
        const TemporaryFolder folder;
        RunSettings settings;
        settings.checkpoint =
            CheckpointSettings{.file = folder.path() / "checkpoint", .scene = "{}", .program_version = "1", .samples = every};
        (void)simulate(specimen, plan, settings);
        Checkpoint checkpoint = read_checkpoint(folder.path() / "checkpoint", "1");
        REQUIRE(checkpoint.samples_done < plan.samples);
        CHECK(checkpoint.plan == plan);
        CHECK(resume(specimen, checkpoint).sensors == whole.sensors);
        Specimen other = specimen;
        other.sensors.pop_back();
        CHECK_THROWS_WITH_AS(resume(other, checkpoint), doctest::Contains("its sensors are not those"), std::runtime_error);
    }
}

TEST_CASE("the joint of two blocks that do not touch reads nothing, which is reported, unless it has a place") {
    const std::string joint = R"({"name": "J", "kind": "joint", "blocks": ["post", "ground"], "rate": "500 Hz")";
    const RunResult none = run_scene(parse_scene(make_text(joint + "}")));
    REQUIRE(none.sensors.size() == 1);
    CHECK(none.sensors[0].values.empty());
    const std::vector<std::string> warnings = find_warnings(none);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].starts_with("sensor \"J\" read nothing (post and ground do not touch"));

    const RunResult placed = run_scene(parse_scene(make_text(joint + R"(, "point": [0, 0, "20 mm"], "normal": [0, 0, 1]})")));
    CHECK(placed.sensors[0].readings() == 51);
    CHECK(find_peak(placed.sensors[0], 3).value == 0.0);
}

TEST_CASE("a rate above one reading a step is refused with the highest that there can be") {
    const Scene scene = parse_scene(make_text(R"({"name": "V", "kind": "velocity", "block": 0, "rate": "1 GHz"})"));
    CHECK_THROWS_WITH_AS(run_scene(scene), doctest::Contains("/sensors/0/rate: 1e+09 Hz is more than a reading a step"), SceneError);
}
