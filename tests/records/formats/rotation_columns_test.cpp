#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "records/formats/read_record.hpp"
#include "records/formats/write_record.hpp"
#include "scaling/angle.hpp"
#include "tests/records/formats/text_file_shapes.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

/// Angles, rates and angular accelerations as columns of text files, and in the files that musim writes.
namespace musim::records {
namespace {

using scaling::kDegree;
using scaling::si::seconds;
using tests::kPulsePeak;
using tests::read_shape;

bool history_tells(const GroundMotion& motion, std::string_view text) {
    for (const std::string& line : motion.history)
        if (line.find(text) != std::string::npos) return true;
    return false;
}

}  // namespace

TEST_CASE("units of rotations are known as people write them") {
    const std::vector<std::pair<const char*, double>> angles{
        {"rad", 1.0}, {"mrad", 1e-3}, {"deg", kDegree}, {"°", kDegree}, {"degrees", kDegree}};
    const std::vector<std::pair<const char*, double>> rates{{"rad/s", 1.0},   {"deg/s", kDegree},       {"°/s", kDegree},
                                                            {"dps", kDegree}, {"mdps", 1e-3 * kDegree}, {"rad s-1", 1.0},
                                                            {"mrad/s", 1e-3}, {"radians/sec", 1.0},     {"degrees per second", kDegree}};
    const std::vector<std::pair<const char*, double>> accelerations{
        {"rad/s2", 1.0}, {"rad/s^2", 1.0}, {"deg/s²", kDegree}, {"rad/sec/sec", 1.0}, {"mrad/s2", 1e-3}};
    const auto check = [](const auto& units, SampleQuantity quantity) {
        for (const auto& row : units) {
            const std::string text = row.first;
            CAPTURE(text);
            const auto unit = find_sample_unit(text);
            REQUIRE(unit);
            CHECK(unit->quantity == quantity);
            CHECK(unit->si == doctest::Approx(row.second).epsilon(1e-15));
        }
    };
    check(angles, SampleQuantity::angle);
    check(rates, SampleQuantity::angular_velocity);
    check(accelerations, SampleQuantity::angular_acceleration);
    // those of translations keep their meaning
    CHECK(find_sample_unit("mm/s")->quantity == SampleQuantity::velocity);
    CHECK(find_sample_unit("in")->quantity == SampleQuantity::displacement);
    CHECK_FALSE(find_sample_unit("ms"));
    CHECK_FALSE(find_sample_unit("degC"));
    for (const char* const name : {"angular velocity", "Angular_Velocity", "angular-velocity"})
        CHECK(find_sample_quantity(name) == SampleQuantity::angular_velocity);
    for (const SampleQuantity quantity : {SampleQuantity::acceleration, SampleQuantity::velocity, SampleQuantity::displacement,
                                          SampleQuantity::angular_acceleration, SampleQuantity::angular_velocity, SampleQuantity::angle}) {
        CHECK(find_quantity(is_rotation(quantity), derivative_order(quantity)) == quantity);
        CHECK(find_sample_unit(si_unit_name(quantity))->si == 1.0);
        CHECK(find_sample_quantity(to_string(quantity)) == quantity);
    }
}

TEST_CASE("columns of rotations are components beside accelerations") {
    const GroundMotion motion = read_shape(tests::table("Time (s),ax (g),ay (g),gyro x (deg/s),Gyro y (deg/s)\n", {0.1, 0.2, 30.0, 60.0}));
    CHECK(motion.component_names() == "ax, ay, gyro x, Gyro y");
    CHECK(motion.components[1].series.quantity() == SampleQuantity::acceleration);
    CHECK(motion.components[2].series.quantity() == SampleQuantity::angular_velocity);
    CHECK(find_largest(motion.components[3].series.samples()) == doctest::Approx(60.0 * kDegree * kPulsePeak).epsilon(1e-5));
    CHECK(history_tells(motion, "as acceleration and angular velocity in g, deg/s"));

    for (const auto& row :
         std::vector<std::pair<std::string, SampleQuantity>>{{"rx (rad)", SampleQuantity::angle},
                                                             {"pitch [deg]", SampleQuantity::angle},
                                                             {"roll (deg/s)", SampleQuantity::angular_velocity},
                                                             {"omega_x_rad/s", SampleQuantity::angular_velocity},
                                                             {"Angular velocity z (rad/s)", SampleQuantity::angular_velocity},
                                                             {"rotation rate z (mrad/s)", SampleQuantity::angular_velocity},
                                                             {"yaw [rad/s2]", SampleQuantity::angular_acceleration},
                                                             {"Angular acceleration x (deg/s2)", SampleQuantity::angular_acceleration},
                                                             {"theta_y (mrad)", SampleQuantity::angle}}) {
        CAPTURE(row.first);
        const GroundMotion alone = read_shape(tests::table("Time (s)," + row.first + "\n", {1.0}));
        REQUIRE(alone.components.size() == 1);
        CHECK(alone.components[0].series.quantity() == row.second);
        CHECK_FALSE(history_tells(alone, kUnitNotGiven));
    }
}

TEST_CASE("rotations are read with as many derivatives as the translations beside them") {
    const std::string content = tests::table(
        "time [s],x displacement [mm],x acceleration [g],pitch angle [deg],pitch angular velocity [deg/s],pitch angular acceleration "
        "[deg/s2]\n",
        {1.0, 2.0, 3.0, 4.0, 5.0});
    const auto quantity_of_second = [&](const ReadOptions& options) {
        const GroundMotion motion = read_shape(content, options);
        REQUIRE(motion.components.size() == 2);
        return motion.components[1].series.quantity();
    };
    CHECK(quantity_of_second({}) == SampleQuantity::angular_acceleration);
    CHECK(quantity_of_second({.quantity = SampleQuantity::displacement}) == SampleQuantity::angle);
    const GroundMotion rates = read_shape(content, {.quantity = SampleQuantity::angular_velocity});
    REQUIRE(rates.components.size() == 1);
    CHECK(find_largest(rates.components[0].series.samples()) == doctest::Approx(4.0 * kDegree * kPulsePeak).epsilon(1e-5));
}

TEST_CASE("a rotation without a unit is left out beside accelerations and refused alone") {
    const GroundMotion beside = read_shape(tests::table("Time (s),Acc x (g),gyro x,roll\n", {1.0, 0.1, 0.2}));
    CHECK(beside.component_names() == "Acc x");
    CHECK(history_tells(beside, "column 3 'gyro x' is left out"));
    CHECK(history_tells(beside, "column 4 'roll' is left out (a rotation that names no unit)"));
    const std::string alone = tests::table("Time (s),rx,ry\n", {1.0, 0.1});
    tests::check_refused(alone, "column 2 'rx' is a rotation that names no unit (rad, deg, rad/s, deg/s, rad/s^2, ...)");
    tests::check_refused(tests::table("Time (s),Acc x (g),gyro x\n", {1.0, 0.1}), "column 3 'gyro x' is a rotation that names no unit",
                         {.quantity = SampleQuantity::angular_velocity});
    const GroundMotion given = read_shape(alone, {.unit = "deg/s"});
    CHECK(given.components.size() == 2);
    CHECK(given.components[0].series.quantity() == SampleQuantity::angular_velocity);
    const GroundMotion stated = read_shape(tests::table("# Units: m/s2, deg\nTime (s),ax,ay,rx\n", {1.0, 0.1, 3.0}));
    REQUIRE(stated.components.size() == 3);
    CHECK(stated.components[2].series.quantity() == SampleQuantity::angle);
    CHECK(find_largest(stated.components[2].series.samples()) == doctest::Approx(3.0 * kDegree * kPulsePeak).epsilon(1e-5));
}

TEST_CASE("units of lengths for rotations, and of rotations for lengths, are refused, and bearings are no motion") {
    tests::check_refused(tests::table("Time (s),roll (mm)\n", {1.0}),
                         "names the unit 'mm' (not understood, or not of what the title says)");
    tests::check_refused(tests::table("Time (s),gyro x (deg)\n", {1.0}), "names the unit 'deg'");
    tests::check_refused(tests::table("Time (s),Displacement x (deg)\n", {1.0}), "names the unit 'deg'");
    const GroundMotion motion = read_shape(tests::table("Time (s),Acc x (g),Latitude (deg),Heading (°)\n", {1.0, 0.1, 0.2}));
    CHECK(motion.component_names() == "Acc x");
    CHECK(history_tells(motion, "column 3 'Latitude (deg)' is left out (a bearing)"));
    const GroundMotion noted = read_shape(tests::table("# azimuth 30 (deg)\n# acceleration in g\n", {1.0, 0.1}, ' '));
    CHECK(noted.components.size() == 2);
    CHECK(noted.components[0].series.quantity() == SampleQuantity::acceleration);
}

TEST_CASE("rotations beside translations are written as CSV and read back to the last bit, other formats refuse them") {
    const tests::TemporaryFolder folder;
    GroundMotion motion = read_shape(tests::table("Time (s),ax (g),gyro x (deg/s)\n", {0.1, 30.0}));
    write_csv(folder.path() / "six.csv", motion);
    const GroundMotion again = read_record(folder.path() / "six.csv");
    REQUIRE(again.components.size() == 2);
    for (std::size_t c = 0; c < 2; ++c) CHECK(again.components[c].series == motion.components[c].series);
    CHECK(read_record(folder.path() / "six.csv", {.quantity = SampleQuantity::angular_velocity}).components.size() == 2);
    CHECK_THROWS_AS(read_record(folder.path() / "six.csv", {.quantity = SampleQuantity::angle}), ReadError);

    const std::string file = (folder.path() / "a.at2").string();
    CHECK_THROWS_WITH(write_at2(file, motion, "gyro x"),
                      (file + ": PEER files hold no rotations (component gyro x is angular velocity); write CSV").c_str());
    CHECK_THROWS_AS(write_cosmos(folder.path() / "a.v2", motion), WriteError);
    CHECK_FALSE(std::filesystem::exists(file));
    CHECK_THROWS_AS(read_record(folder.write("b.at2", "PEER\nevent\nACCELERATION TIME SERIES IN UNITS OF DEG\nNPTS= 1, DT= .1 SEC\n1.0\n")),
                    ReadError);
    CHECK_THROWS_AS(
        read_record(folder.write("c.at2", "PEER\nevent\nACCELERATION TIME SERIES\nNPTS= 1, DT= .1 SEC\n1.0\n"), {.unit = "deg"}),
        ReadError);
}

}  // namespace musim::records
