#include <doctest/doctest.h>

#include <string>

#include "lsdem/report/report.hpp"

using namespace musim::lsdem;

namespace {

SensorHistory make_readings(const std::string& name, SensorKind kind, std::vector<double> values) {
    SensorHistory sensor;
    sensor.name = name;
    sensor.kind = kind;
    sensor.bodies = {"post", "plinth"};
    sensor.interval = 0.01;
    sensor.corner = 25.0;
    sensor.order = 4;
    sensor.values = std::move(values);
    return sensor;
}

ReportedRun make_instrumented_run() {
    ReportedRun run{.label = "model", .folder = "model"};
    run.run.sensors = {make_readings("A_1", SensorKind::acceleration, {0.0, 0.0, 9.8, -3.25, 1.0, 9.0, 2.0, 0.0, 9.5}),
                       make_readings("J", SensorKind::joint, {0.0, 0.0, 0.0, 50.0, 0.0, 0.0, 0.001, 0.0, 0.0, 40.0, -7.5, 0.0}),
                       make_readings("dead", SensorKind::joint, {})};
    return run;
}

}  // namespace

TEST_CASE("a report has the peaks of sensors with their times, and draws what they read") {
    const auto section = make_sensor_section({make_instrumented_run()});
    REQUIRE(section);
    // peak of x with its sign, at the second reading
    CHECK(section->html.find("-3.25") != std::string::npos);
    CHECK(section->html.find("post against plinth") != std::string::npos);
    CHECK(section->html.find("post, axes of the world") != std::string::npos);
    CHECK(section->html.find("25 Hz, 4 poles") != std::string::npos);
    CHECK(section->html.find("dead") == std::string::npos);
    // a joint has lengths and forces
    REQUIRE(section->figures.size() == 3);
    CHECK(section->figures[0].title == "A_1: acceleration");
    CHECK(section->figures[0].csv.find("x,0.01,-3.25") != std::string::npos);
    CHECK(section->figures[1].name == "sensor_2_J");
    CHECK(section->figures[2].name == "sensor_2_J_force");
    CHECK(section->figures[2].csv.find("shear force 1,0.01,-7.5") != std::string::npos);
}

TEST_CASE("a report of runs without sensors has no section of them") {
    CHECK_FALSE(make_sensor_section({ReportedRun{.label = "model", .folder = "model"}}));
}
