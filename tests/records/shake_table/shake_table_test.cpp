#include <doctest/doctest.h>

#include <string>

#include "records/error.hpp"
#include "records/shake_table/shake_table.hpp"
#include "scaling/angle.hpp"

namespace musim::records {
namespace {

constexpr const char* kTable = R"({"schema": "musim-table/1", "name": "test", "energy_share": 0.95, "axes": [
    {"names": ["x", "y"], "displacement": "75 mm", "velocity": "80 cm/s", "moving_mass": "1 t", "force": "30 kN", "payload": "5 t",
     "acceleration": [{"payload": "0 kg", "limit": "3 g"}, {"payload": "5 t", "limit": "1.5 g"}], "overturning_moment": "20 kN*m",
     "lowest_frequency": "0.1 Hz", "highest_frequency": "50 Hz", "oil_column": {"frequency": "40 Hz", "share": 0.5}},
    {"names": ["vertical"], "acceleration": "0.8 g"}],
    "controller": {"rate": "1024 Hz", "rest": "2 s", "displacement": "mm", "velocity": "cm/s", "acceleration": "g",
                   "columns": ["time", "displacement"], "separator": "tab", "header": false, "digits": 6}})";

std::string error_of(const std::string& json) {
    try {
        parse_shake_table(json, "t.json");
    } catch (const ReadError& error) {
        return error.what();
    }
    return "";
}

/// A table whose only axis has these fields.
std::string axis(const std::string& fields) { return R"({"schema": "musim-table/1", "axes": [{"names": ["x"], )" + fields + "}]}"; }

std::string controller(const std::string& fields) {
    return R"({"schema": "musim-table/1", "axes": [{"names": ["x"]}], "controller": {)" + fields + "}}";
}

Component component(const std::string& name, std::optional<double> azimuth = {}) {
    return {name, azimuth, TimeSeries(SampleQuantity::acceleration, 0.0 * scaling::si::seconds, 1.0 * scaling::si::seconds, {0.0, 1.0})};
}

GroundMotion three_components() {
    GroundMotion motion;
    motion.source = "a.v1";
    motion.components = {component("Up"), component("90", 90.0), component("360", 360.0)};
    return motion;
}

}  // namespace

TEST_CASE("a shake table is read with all its limits") {
    const ShakeTable table = parse_shake_table(kTable, "t.json");
    REQUIRE(table.axes.size() == 3);
    CHECK(table.energy_share == 0.95);
    const TableAxis& y = table.find_axis("y");
    CHECK(y.displacement->value() == 0.075);
    CHECK(y.velocity->value() == 0.8);
    CHECK(y.acceleration.size() == 2);
    CHECK(y.acceleration[1].limit.value() == 1.5 * scaling::kStandardGravity.value());
    CHECK(y.acceleration[1].payload.value() == 5000.0);
    CHECK(y.force->value() == 30e3);
    CHECK(y.overturning_moment->value() == 20e3);
    CHECK(y.payload->value() == 5000.0);
    CHECK(y.lowest_frequency->value() == 0.1);
    CHECK(y.highest_frequency->value() == 50.0);
    CHECK(y.oil_column->frequency.value() == 40.0);
    CHECK(y.oil_column->share == 0.5);
    const TableAxis& vertical = table.find_axis("vertical");
    CHECK_FALSE(vertical.displacement);
    CHECK(vertical.acceleration.size() == 1);
    CHECK(vertical.controller_rate->value() == 1024.0);
    REQUIRE(table.controller);
    CHECK(table.controller->rest.value() == 2.0);
    CHECK(table.controller->displacement.si == 0.001);
    CHECK(table.controller->columns == std::vector{DriveColumn::time, DriveColumn::displacement});
    CHECK(table.controller->separator == '\t');
    CHECK_FALSE(table.controller->header);
    CHECK(table.controller->digits == 6);
}

TEST_CASE("a damaged shake table is refused in one line that names the place") {
    CHECK(error_of("{").starts_with("t.json: is no JSON (parse error at line 1, column 2:"));
    CHECK(error_of("{").ends_with("); write {\"schema\": \"musim-table/1\", \"axes\": [...]}"));
    CHECK(error_of("[]") == "t.json: is no shake table; add \"schema\": \"musim-table/1\"");
    CHECK(error_of(R"({"schema": "musim-table/1"})") == "t.json: has no axes; add \"axes\": [...]");
    CHECK(error_of(R"({"schema": "musim-table/1", "axes": [{}]})") ==
          "t.json: axes 1: has no names; add \"names\": [\"x\"], one for each direction that has these limits");
    CHECK(error_of(axis(R"("velocity": "80 cm")")).starts_with("t.json: axes 1: velocity: \"80 cm\""));
    CHECK(error_of(axis(R"("velocity": "-1 m/s")")) ==
          "t.json: axes 1: velocity is not above zero; give its magnitude, or remove it where there is no limit");
    CHECK(error_of(axis(R"("str\noke": "1 m")")) == "t.json: axes 1: \"str oke\" is none of its settings; remove it, or correct its name");
    CHECK(error_of(axis(R"("stroke": "1 m")")) == "t.json: axes 1: \"stroke\" is none of its settings; remove it, or correct its name");
    CHECK(error_of(axis(R"("force": "1 kN")")) ==
          "t.json: axes 1: moving_mass is missing (force and oil column act on table and payload); add the mass of platen and rods");
    CHECK(error_of(axis(R"("lowest_frequency": "5 Hz", "highest_frequency": "5 Hz")")) ==
          "t.json: axes 1: lowest_frequency is not below highest_frequency; exchange them");
    CHECK(error_of(axis(R"("acceleration": [{"payload": "2 kg", "limit": "1 m/s^2"}, {"payload": "1 kg", "limit": "2 m/s^2"}])")) ==
          "t.json: axes 1: acceleration 2: more payload must come after less, with no more acceleration; bring the rows into order");
    CHECK(error_of(axis(R"("acceleration": [])")).find("acceleration has no rows") != std::string::npos);
    CHECK(error_of(axis(R"("moving_mass": "1 kg", "oil_column": {"frequency": "9 Hz", "share": 2})")) ==
          "t.json: axes 1: oil_column: share is not above 0 and up to 1; write the usable part, such as 0.6");
    CHECK(error_of(R"({"schema": "musim-table/1", "axes": [{"names": ["x", "x"]}]})") ==
          "t.json: axes 1: the name \"x\" comes twice; give every direction its own");
    CHECK(error_of(R"({"schema": "musim-table/1", "energy_share": 1, "axes": [{"names": ["x"]}]})") ==
          "t.json: energy_share is not between 0.5 and 1; write 0.99 or the like");
    CHECK(error_of(controller("")) == "t.json: controller: rate is missing; add it");
    CHECK(error_of(controller(R"("rate": "100 Hz", "acceleration": "mm")"))
              .starts_with("t.json: controller: acceleration is in no unit of its own (\"mm\"); use one of "));
    CHECK(error_of(controller(R"("rate": "100 Hz", "columns": ["jerk"])")) ==
          "t.json: controller: \"jerk\" is no column; take time, displacement, velocity, acceleration");
    CHECK(error_of(controller(R"("rate": "100 Hz", "separator": ";")")) ==
          "t.json: controller: separator is \";\"; take \"comma\", \"tab\" or \"space\"");
    CHECK(error_of(controller(R"("rate": "100 Hz", "digits": 18)")) == "t.json: controller: digits is not from 1 to 17; take 9");
    CHECK(error_of(controller(R"("rate": "100 Hz", "rest": "-1 s")")) ==
          "t.json: controller: rest is below zero; give a time of zero or more");
    CHECK(error_of(controller(R"("rate": "100 Hz", "header": 1)")) ==
          "t.json: controller: header is neither true nor false; write one of them, without quotes");
}

TEST_CASE("vertical components are recognized by their names") {
    for (const char* const name : {"Up", "UD", "Z", "HNZ", "V", "ver", "UD2", "U"}) CHECK_MESSAGE(is_vertical(component(name)), name);
    for (const char* const name : {"N", "E", "1", "HNE", "L", "BLZ4X"}) CHECK_FALSE_MESSAGE(is_vertical(component(name)), name);
    CHECK_FALSE(is_vertical(component("Z", 10.0)));
}

TEST_CASE("components find their axes by themselves or as given") {
    const ShakeTable table = parse_shake_table(kTable, "t.json");
    const AssignedAxes all = assign_axes(three_components(), table, {});
    REQUIRE(all.axes.size() == 3);
    CHECK(all.axes[0].name == "vertical");
    CHECK(all.axes[1].name == "x");
    CHECK(all.axes[2].name == "y");
    const AssignedAxes one = assign_axes(three_components(), table, {{"360", "x"}});
    REQUIRE(one.motion.components.size() == 1);
    CHECK(one.motion.components[0].name == "360");
    CHECK_THROWS_WITH(assign_axes(three_components(), table, {{"360", "x"}, {"90", "x"}}),
                      "axis x is to make two components; give each its own");
    CHECK_THROWS_WITH(assign_axes(three_components(), table, {{"360", "w"}}), "the table has no axis \"w\"; choose one of x, y, vertical");
    const ShakeTable uniaxial = parse_shake_table(axis(R"("velocity": "1 m/s")"), "t.json");
    CHECK_THROWS_WITH(assign_axes(three_components(), uniaxial, {}),
                      "a.v1: the table has no vertical axis left for component Up; choose components with pairs of component and axis");
}

constexpr const char* kSixAxes = R"({"schema": "musim-table/1", "axes": [
    {"names": ["x", "y", "z"], "displacement": "75 mm"},
    {"names": ["roll", "pitch"], "angle": "5 deg", "angular_velocity": "30 deg/s", "angular_acceleration": "4 rad/s^2",
     "overturning_moment": "2 kN*m"},
    {"names": ["yaw"], "angle": "5 deg", "angular_velocity": "30 deg/s", "angular_acceleration": "4 rad/s^2"}]})";

Component rotation(const std::string& name) {
    Component turned = component(name);
    turned.series = turned.series.with_samples(SampleQuantity::angular_velocity, {0.0, 1.0});
    return turned;
}

TEST_CASE("limits of rotations are read in rad and deg") {
    const ShakeTable table = parse_shake_table(kSixAxes, "t.json");
    REQUIRE(table.axes.size() == 6);
    const TableAxis& pitch = table.find_axis("pitch");
    CHECK(pitch.is_rotation);
    CHECK(pitch.angle->value() == 5.0 * scaling::kDegree);
    CHECK(pitch.angular_velocity->value() == doctest::Approx(30.0 * scaling::kDegree).epsilon(1e-15));
    CHECK(pitch.angular_acceleration->value() == 4.0);
    CHECK(pitch.overturning_moment->value() == 2000.0);
    CHECK_FALSE(table.find_axis("z").is_rotation);
    CHECK(find_turned_axis("Roll") == 'x');
    CHECK(find_turned_axis("ry") == 'y');
    CHECK(find_turned_axis("HJ1") == std::nullopt);
}

TEST_CASE("rotations of a record find the axis about the same direction") {
    GroundMotion motion = three_components();
    for (const char* const name : {"rz", "gyro x", "pitch"}) motion.components.push_back(rotation(name));
    const AssignedAxes all = assign_axes(motion, parse_shake_table(kSixAxes, "t.json"), {});
    REQUIRE(all.axes.size() == 6);
    CHECK(all.axes[0].name == "z");
    CHECK(all.axes[3].name == "yaw");
    CHECK(all.axes[4].name == "roll");
    CHECK(all.axes[5].name == "pitch");
    CHECK_FALSE(is_vertical(motion.components[3]));
    CHECK_THROWS_WITH(assign_axes(motion, parse_shake_table(kTable, "t.json"), {}),
                      "a.v1: the table has no rotation axis left for component rz; choose components with pairs of component and axis");
}

TEST_CASE("a rotation moves no axis that is a translation, and the other way round") {
    const ShakeTable table = parse_shake_table(kSixAxes, "t.json");
    GroundMotion motion = three_components();
    motion.components.push_back(rotation("roll"));
    CHECK_THROWS_WITH(
        assign_axes(motion, table, {{"roll", "x"}}),
        "a.v1: component roll is angular velocity, and axis x is a translation; choose components with pairs of component and axis");
    CHECK_THROWS_WITH(assign_axes(motion, table, {{"90", "yaw"}}),
                      "a.v1: component 90 is acceleration, and axis yaw is a rotation; choose components with pairs of component and axis");
    for (const char* const name : {"roll", "Pitch", "rot_z", "theta_x", "rotation about x", "HJE", "BJ1"}) {
        CHECK(is_named_as_rotation(name));
        motion.components[0].name = name;
        CHECK_THROWS_AS(assign_axes({.source = "a", .components = {motion.components[0]}}, table, {{name, "yaw"}}), ReadError);
    }
    motion.components.pop_back();
    motion.components[0].name = "rz";
    CHECK_THROWS_WITH(assign_axes(motion, table, {{"rz", "yaw"}}),
                      "a.v1: component rz is acceleration by its unit, and a rotation by its name; name the unit of its samples, such as "
                      "rad/s");
    for (const char* const name : {"HNE", "NS2", "rake", "J"}) {
        CHECK_FALSE(is_named_as_rotation(name));
        motion.components[0].name = name;
        CHECK(assign_axes(motion, table, {{name, "x"}}).axes.size() == 1);
    }
}

TEST_CASE("limits of the other kind, without a unit or not all of a rotation are refused in one line") {
    const auto turned = [](const std::string& fields) {
        return R"({"schema": "musim-table/1", "axes": [{"names": ["yaw"], )" + fields + "}]}";
    };
    CHECK(
        error_of(axis(R"("angle": "5 deg")")) ==
        "t.json: axes 1: angle is a limit of rotations (this axis is a translation); give displacement, velocity and acceleration, or name "
        "the axis roll, pitch or yaw");
    CHECK(error_of(axis(R"("displacement": "5 deg")")).starts_with("t.json: axes 1: displacement: \"5 deg\""));
    CHECK(error_of(turned(R"("displacement": "5 mm")")) ==
          "t.json: axes 1: displacement is a limit of translations (this axis is a rotation); give angle, angular_velocity and "
          "angular_acceleration");
    CHECK(
        error_of(turned(R"("angle": "5 deg", "angular_velocity": "9 deg/s")")) ==
        "t.json: axes 1: angular_acceleration is missing (a rotation is limited in angle, angular_velocity and angular_acceleration); add "
        "it");
    CHECK(error_of(turned(R"("angle": 5)")) == "t.json: axes 1: angle is 5 (neither in rad nor in deg); write text such as \"5 deg\"");
    CHECK(error_of(turned(R"("angle": "5 deg", "angular_velocity": "9 1/s", "angular_acceleration": "9 rad/s^2")")) ==
          "t.json: axes 1: angular_velocity is 9 1/s (neither in rad nor in deg); write text such as \"30 deg/s\"");
    CHECK(error_of(turned(R"("overturning_moment": "9 kN*m")")) ==
          "t.json: axes 1: overturning_moment of \"yaw\" (nothing overturns about the vertical); remove it");
    CHECK(error_of(R"({"schema": "musim-table/1", "axes": [{"names": ["x", "yaw"]}]})") ==
          "t.json: axes 1: names are of translations and of rotations (their limits have other units); write an entry of \"axes\" for "
          "each");
}

}  // namespace musim::records
