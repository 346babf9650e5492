#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "records/formats/read_record.hpp"
#include "scaling/angle.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/relative.hpp"

/// Commands that treat records, given rotations.
using namespace musim::cli;
using musim::lsdem::tests::relative;
using musim::scaling::kDegree;

namespace {

constexpr double kOmegaOfFile = 2.0 * std::numbers::pi;  // [rad/s]

/// Five whole periods of an acceleration along z and of a rate about y, both at rest at the ends: a_z = sin ωt [m/s²], 2 sin ωt [deg/s].
std::string make_turned_file(const std::string& title = "ry (deg/s)") {
    std::string text = "Time (s),Up (m/s2)," + title + "\n";
    for (int i = 0; i <= 1000; ++i) {
        const double sine = std::sin(kOmegaOfFile * 0.005 * i);
        text += fmt::format("{:.3f},{:.17g},{:.17g}\n", 0.005 * i, sine, 2.0 * sine);
    }
    return text;
}

constexpr const char* kSixAxes = R"({"schema": "musim-table/1", "name": "six axes", "axes": [
    {"names": ["x", "y", "z"], "displacement": "1 m"},
    {"names": ["roll", "pitch"], "angle": "ANGLE", "angular_velocity": "9 deg/s", "angular_acceleration": "90 deg/s^2",
     "overturning_moment": "1 kN*m"},
    {"names": ["yaw"], "angle": "5 deg", "angular_velocity": "9 deg/s", "angular_acceleration": "90 deg/s^2"}],
    "controller": {"rate": "200 Hz", "displacement": "mm", "angle": "deg", "columns": ["displacement"], "digits": 17}})";

std::string make_six_axes(const std::string& angle) {
    std::string json = kSixAxes;
    return json.replace(json.find("ANGLE"), 5, angle);
}

}  // namespace

TEST_CASE("record info gives rotations a table of their own") {
    const Workplace here;
    here.write("turned.csv", make_turned_file());
    const Outcome outcome = here.run("record info turned.csv --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto ry = outcome.json()["components"][1];
    CHECK(ry["component"] == "ry");
    CHECK(ry["quantity"] == "angular velocity");
    CHECK(ry["unit"] == "rad/s");
    CHECK(ry["peak_angular_velocity_rad_s"] == relative(2.0 * kDegree, 1e-12));
    // (2/ω)(1 − cos ωt), the trapezoids off by (ω dt)²/12
    CHECK(ry["peak_angle_rad"] == relative(4.0 * kDegree / kOmegaOfFile, 1e-4));
    CHECK(ry["peak_angular_acceleration_rad_s2"].is_null());
    CHECK_FALSE(ry.contains("pga_g"));
    const std::string out = here.run("record info turned.csv").out;
    CHECK(out.find("PGA [g]") < out.find("omega [rad/s]"));
    CHECK(out.find("0.6366") != std::string::npos);
}

TEST_CASE("a rotation without a unit is refused in one line, or read in the unit that is given") {
    const Workplace here;
    std::string text = make_turned_file("gyro y");
    here.write("both.csv", text);
    const Outcome beside = here.run("record info both.csv");
    CHECK(beside.exit_code == 0);
    CHECK(beside.err.find("column 3 'gyro y' is left out (a rotation that names no unit)") != std::string::npos);
    const Outcome refused = here.run("record info both.csv --quantity angular_velocity");
    CHECK(refused.exit_code == 3);
    CHECK(refused.has_one_error_line());
    CHECK(refused.err.find("column 3 'gyro y' is a rotation that names no unit (rad, deg, rad/s, deg/s, rad/s^2, ...); write it into the "
                           "title, give --unit or choose others with --columns") != std::string::npos);
    const Outcome given = here.run("record info both.csv --unit deg/s --json");
    REQUIRE_MESSAGE(given.exit_code == 0, given.err);
    CHECK(given.json()["components"][0]["peak_angular_velocity_rad_s"] == relative(2.0 * kDegree, 1e-12));
    here.write("length.csv", make_turned_file("roll (mm)"));
    const Outcome length = here.run("record info length.csv");
    CHECK(length.exit_code == 3);
    CHECK(length.err.find("names the unit 'mm' (not understood, or not of what the title says)") != std::string::npos);
}

TEST_CASE("rescale keeps angles and divides rates by the time") {
    const Workplace here;
    here.write("turned.csv", make_turned_file());
    const Outcome outcome = here.run("rescale turned.csv --length 1/16 --law froude -o model.csv --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto ry = outcome.json()["components"][1];
    CHECK(ry["rotation"] == true);
    CHECK(ry["model"]["peak_angular_velocity_rad_s"] == 4.0 * ry["prototype"]["peak_angular_velocity_rad_s"].get<double>());
    CHECK(ry["model"]["peak_angle_rad"] == ry["prototype"]["peak_angle_rad"]);
    const auto info = here.run("record info model.csv --json").json()["components"][1];
    CHECK(info["quantity"] == "angular velocity");
    CHECK(info["peak_angle_rad"] == ry["prototype"]["peak_angle_rad"]);
    CHECK(here.run("rescale turned.csv --length 1/16 -o model.at2 --component ry").err.find("PEER files hold no rotations") !=
          std::string::npos);
    const Outcome distorted = here.run("rescale turned.csv --length 1/16 --friction 0.3/0.6 --law mu_vertical_distortion -o distorted.csv");
    CHECK(distorted.exit_code == 0);
    CHECK(distorted.err.find("what a turned base does to points away from its axis is not similar") != std::string::npos);
}

TEST_CASE("table holds a rotation against its axis and writes a drive file that is read back") {
    const Workplace here;
    here.write("turned.csv", make_turned_file());
    here.write("six.json", make_six_axes("5 deg"));
    const Outcome outcome =
        here.run("table turned.csv --limits six.json --length 1 --payload \"100 kg\" --payload-height \"0.5 m\" --drive drive.csv --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto components = outcome.json()["components"];
    CHECK(components[0]["axis"] == "z");
    CHECK(components[1]["axis"] == "pitch");
    // the rate ends at rest at once; its angle (2/ω)(1 − cos ωt) comes home, so that nothing is taken out but sums' rounding and (ω dt)²
    const auto limits = components[1]["limits"];
    const double angle = 4.0 / kOmegaOfFile, acceleration = 2.0 * kOmegaOfFile;  // [deg, deg/s²]
    CHECK(limits[0]["limit"] == "angle");
    CHECK(limits[0]["unit"] == "deg");
    CHECK(limits[0]["record"] == relative(angle, 1e-2));
    CHECK(limits[1]["record"] == relative(2.0, 1e-2));
    CHECK(limits[2]["record"] == relative(acceleration, 1e-2));
    const double moment = 100.0 * 0.5 * (0.5 * acceleration * kDegree + 9.80665 * std::sin(angle * kDegree));
    CHECK(limits[3]["limit"] == "overturning moment");
    CHECK(limits[3]["record"].get<double>() == relative(moment / 1e3, 1e-2));
    const musim::tests::TemporaryFolder copy;
    const auto drive =
        musim::records::read_record(copy.write("drive.csv", here.read("drive.csv")),
                                    {.dt = 0.005 * musim::scaling::si::seconds, .quantity = musim::records::SampleQuantity::displacement});
    REQUIRE(drive.components.size() == 2);
    CHECK(drive.components[1].series.quantity() == musim::records::SampleQuantity::angle);
    CHECK(musim::records::find_largest(drive.components[1].series.samples()) ==
          relative(limits[0]["record"].get<double>() * kDegree, 1e-12));
    CHECK(outcome.json()["drive_effects"][1]["angle_deg"][1] == relative(limits[0]["record"].get<double>(), 1e-12));

    here.write("small.json", make_six_axes("0.1 deg"));
    const Outcome too_much = here.run("table turned.csv --limits small.json --length 1");
    CHECK(too_much.exit_code == 5);
    CHECK(too_much.out.find("<- too much") != std::string::npos);
    CHECK(too_much.out.find("amplitude times") != std::string::npos);

    here.write("three.json", R"({"schema": "musim-table/1", "axes": [{"names": ["x", "y", "z"], "displacement": "1 m"}]})");
    const Outcome no_axis = here.run("table turned.csv --limits three.json --length 1");
    CHECK(no_axis.exit_code == 3);
    CHECK(no_axis.has_one_error_line());
    CHECK(no_axis.err.find("the table has no rotation axis left for component ry") != std::string::npos);
}

TEST_CASE("record process adds the rotation of the surface, figures and spectra are of translations") {
    const Workplace here;
    here.write("turned.csv", make_turned_file());
    const Outcome outcome = here.run(
        "record process turned.csv --columns time=1,Up=2 -o six.csv --json --step "
        "'{\"step\": \"surface_rotation\", \"velocity\": \"500 m/s\", \"vertical\": \"Up\"}'");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto added = outcome.json()["components"][1];
    CHECK(added["before"].is_null());
    CHECK(added["after"]["peak_angular_velocity_rad_s"] == relative(1.0 / 500.0, 1e-12));
    const Outcome spectrum = here.run("record spectrum six.csv -o spectra.csv");
    CHECK(spectrum.exit_code == 0);
    CHECK(spectrum.err.find("component ry is a rotation and has no spectrum") != std::string::npos);
    const Outcome plot = here.run("record plot six.csv --component ry -o ry.svg");
    CHECK(plot.exit_code == 3);
    CHECK(plot.has_one_error_line());
}
