#include "lsdem/export/sensor_streams.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "lsdem/results/result_error.hpp"
#include "records/formats/read_record.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using musim::tests::TemporaryFolder;

namespace {

SensorHistory make_history(const std::string& name, SensorKind kind, std::size_t readings) {
    SensorHistory sensor;
    sensor.name = name;
    sensor.kind = kind;
    sensor.interval = 0.002;
    for (std::size_t i = 0; i < readings * sensor.channels(); ++i) sensor.values.push_back(std::sin(0.1 * static_cast<double>(i)));
    return sensor;
}

StoredRun make_run() {
    StoredRun run;
    run.directory = "out";
    run.sensors = {make_history("A1", SensorKind::acceleration, 700), make_history("top left", SensorKind::velocity, 20),
                   make_history("top left 2", SensorKind::rotation, 20), make_history("joint", SensorKind::joint, 20),
                   make_history("none", SensorKind::joint, 0)};
    return run;
}

}  // namespace

TEST_CASE("miniSEED of a sensor is read back by musim to the bit") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "a1.mseed";
    const StoredRun run = make_run();
    CHECK(write_sensor_streams(file, run, "A1") == 3);
    const musim::records::GroundMotion motion = musim::records::read_record(file, {.sensitivity = 1.0});
    REQUIRE(motion.components.size() == 3);
    CHECK(motion.station.find("A1") != std::string::npos);
    for (std::size_t c = 0; c < 3; ++c) {
        const musim::records::Component& component = motion.components[c];
        CHECK(component.name == "CN" + std::to_string(c + 1));
        CHECK(component.series.quantity() == musim::records::SampleQuantity::acceleration);
        CHECK(component.series.dt().value() == 0.002);
        const std::vector<double> column = run.sensors[0].column(c);
        CHECK(std::vector<double>(component.series.samples().begin(), component.series.samples().end()) == column);
    }
}

TEST_CASE("all sensors that read something are streams of stations of their own") {
    const TemporaryFolder folder;
    CHECK(write_sensor_streams(folder.path() / "all.mseed", make_run()) == 3 + 3 + 3 + 6);
    const std::string bytes = musim::tests::bytes_of(folder.path() / "all.mseed");
    for (const char* code : {"A1     CN3XX", "TOPLE  CH1XX", "S3     CJ2XX", "JOINT  CBZXX", "JOINT  CE2XX"}) {
        CAPTURE(code);
        CHECK(bytes.find(code) != std::string::npos);
    }
}

TEST_CASE("there is no miniSEED of sensors that are not there or read nothing") {
    const auto refusal = [](const StoredRun& run, const std::optional<std::string>& name) {
        return musim::tests::message_of<ResultError>([&] { write_sensor_streams("none.mseed", run, name); });
    };
    StoredRun none = make_run();
    none.sensors.clear();
    CHECK(refusal(none, {}).find("out: the run has no sensors; give its scene \"sensors\"") != std::string::npos);
    CHECK(refusal(make_run(), "A2").find("out: there is no sensor \"A2\"; known are A1, top left") != std::string::npos);
    CHECK(refusal(make_run(), "none").find("out: its sensors read nothing") != std::string::npos);
}
