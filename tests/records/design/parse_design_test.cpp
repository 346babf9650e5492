#include "records/design/parse_design.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <string>

#include "records/design/uses.hpp"
#include "records/error.hpp"
#include "scaling/angle.hpp"
#include "tests/records/design/tower.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;

const std::string kPrototype =
    R"("prototype": {"block": ["1.36 m", "2.82 m", "4.25 m"], "height": "161.5 m", "density": "2320 kg/m^3", "friction": "0.59"})";
const std::string kMaterials = R"("materials": ["wood"])";

Design parse(const std::string& fields) {
    return parse_design(R"({"schema": "musim-design/1", )" + fields + "}", "d.json", {wood(), concrete()});
}

void check_refused(const std::string& fields, const std::string& message) {
    CHECK(musim::tests::message_of<records::ReadError>([&] { parse(fields); }) == message);
}

void check_material_refused(const std::string& material, const std::string& message) {
    check_refused(kPrototype + R"(, "materials": [)" + material + "]", message);
}

}  // namespace

TEST_CASE("a design has defaults for all but prototype and materials") {
    const Design design = parse(kPrototype + ", " + kMaterials);
    CHECK(design.prototype.block[1] == 2.82 * si::meters);
    CHECK(design.prototype.friction == 0.59);
    CHECK(design.prototype.mass_center == 0.5 * design.prototype.height);
    CHECK(design.laws == std::vector{by("mu")});
    CHECK_FALSE(design.gravity.has_value());
    CHECK_FALSE(design.length.has_value());
    CHECK(design.groups == default_groups());
    CHECK(design.table_file.empty());
    CHECK(design.materials.at(0).name == "wood");
}

TEST_CASE("a quantity with a dimension is refused without its unit, whether number or text") {
    for (const char* const height : {"161.5", "\"161.5\""}) {
        CAPTURE(height);
        const std::string message = musim::tests::message_of<records::ReadError>([&] {
            parse(std::string(R"("prototype": {"block": ["1 m", "2 m", "4 m"], "height": )") + height +
                  R"(, "density": "2320 kg/m^3", "friction": 0.59}, "materials": ["wood"])");
        });
        CHECK_MESSAGE(message.find("d.json: prototype: height: ") == 0, message);
        CHECK_MESSAGE(message.find("the unit is missing; a length is wanted (such as \"4.25 m\")") != std::string::npos, message);
    }
}

TEST_CASE("a preset's values can be replaced, and a face stiffness becomes the solid's modulus") {
    const Design design =
        parse(kPrototype + R"(, "materials": [{"preset": "wood", "name": "oak", "density": "700 kg/m^3", "height_deviation": "0.1 mm"},
        {"name": "resin", "density": "1200 kg/m^3", "friction": "0.6/2", "normal_stiffness": "30 MN/m", "stiffness_block": ["0.01 m", "0.02 m", "0.04 m"],
         "smallest_edge": "5 mm", "price": 3}])");
    const Material &oak = design.materials.at(0), &resin = design.materials.at(1);
    CHECK(oak.name == "oak");
    CHECK(oak.density.value() == 700.0);
    CHECK(oak.friction == wood().friction);
    CHECK(oak.deviation->value() == 0.1e-3);
    CHECK(resin.friction == 0.3);
    CHECK(resin.modulus->value() == relative(30e6 * 0.04 / (0.01 * 0.02), 1e-15 * 4.0));  // four roundings
    CHECK(*resin.price == 3.0);
}

TEST_CASE("record, limits, laws and groups are read") {
    const Design design = parse(kPrototype + ", " + kMaterials + R"(, "table": "t.json", "record": {"file": "a.v1", "axes": {"360": "x"},
        "high_pass": "0.05 Hz"}, "limits": {"hall_height": "3 m", "camera": {"rate": "4800 Hz", "pictures": 20}}, "laws": ["froude", "cauchy"],
        "gravity": 25, "length": "1/25", "groups": ["kappa_n"], "name": "n")");
    const auto& record = std::get<RecordFile>(design.motion);
    CHECK(record.axes == std::vector{std::pair<std::string, std::string>("360", "x")});
    CHECK(record.high_pass->value() == 0.05);
    CHECK(design.limits.camera_rate->value() == 4800.0);
    CHECK(design.laws == std::vector{by("froude"), by("cauchy")});
    CHECK(*design.length == 1.0 / 25.0);
    CHECK(design.groups == std::vector<std::string>{"kappa_n"});
}

TEST_CASE("a peak that a limit needs must be given, others not") {
    records::ShakeTable table{.name = "t", .source = "", .axes = {free_axis()}};
    const std::vector<GivenPeaks> peaks{{.axis = "x", .acceleration = 5.0 * si::meters_per_second_squared}};
    CHECK(make_loads(peaks, table, "d.json").at(0).prototype.acceleration.value() == 5.0);
    table.axes[0].velocity = 1.0 * si::meters_per_second;
    CHECK(musim::tests::message_of<records::ReadError>([&] { make_loads(peaks, table, "d.json"); }) ==
          "d.json: record: velocity is missing (axis x of the table limits it); add it to the peaks");
}

TEST_CASE("peaks of rotations are held against limits of rotations") {
    const Design design = parse(kPrototype + ", " + kMaterials +
                                R"(, "table": "t", "record": {"peaks": [{"axis": "pitch", "angular_acceleration": "90 deg/s^2",
        "angle": "2 deg"}]})");
    const auto& peaks = std::get<std::vector<GivenPeaks>>(design.motion);
    TableAxis axis{.name = "pitch", .is_rotation = true};
    axis.angle = scaling::Ratio::from_value(0.1);
    ShakeTable table{.name = "t", .source = "", .axes = {axis}};
    const AxisLoad load = make_loads(peaks, table, "d.json").at(0);
    CHECK(load.prototype.turn.angle.value() == doctest::Approx(2.0 * scaling::kDegree).epsilon(1e-15));
    CHECK(load.prototype.turn.angular_acceleration.value() == doctest::Approx(0.5 * std::numbers::pi).epsilon(1e-15));
    CHECK(load.prototype.acceleration.value() == 0.0);
    CHECK(describe_amount(2.0 * scaling::kDegree, "rad") == "2 deg");
    CHECK(describe_amount(scaling::kDegree, "rad/s^2") == "1 deg/s^2");

    table.axes[0].angular_velocity = 1.0 / si::seconds;
    CHECK(musim::tests::message_of<records::ReadError>([&] { make_loads(peaks, table, "d.json"); }) ==
          "d.json: record: angular_velocity is missing (axis pitch of the table limits it); add it to the peaks");
    const auto with = [](const std::string& peak) {
        return kPrototype + ", " + kMaterials + R"(, "table": "t", "record": {"peaks": [{"axis": "yaw", )" + peak + "}]}";
    };
    check_refused(with(R"("acceleration": "0.5 g")"),
                  "d.json: record: peaks 1: acceleration is a peak of a translation (axis yaw is a rotation); give angular_acceleration, "
                  "angular_velocity and angle");
    check_refused(with(R"("angle": "2 deg")"), "d.json: record: peaks 1: angular_acceleration is missing; add it");
    check_refused(
        with(R"("angular_acceleration": "2 1/s^2")"),
        "d.json: record: peaks 1: angular_acceleration is 2 1/s^2 (neither in rad nor in deg); write text such as \"200 deg/s^2\"");
}

TEST_CASE("wrong designs are refused with the place and what to do") {
    CHECK(musim::tests::message_of<records::ReadError>([] {
              parse_design("{", "d.json", {});
          }).find("d.json: is no JSON (parse error at line 1, column 2:") == 0);
    CHECK(musim::tests::message_of<records::ReadError>([] { parse_design("{}", "d.json", {}); }) ==
          R"(d.json: is no design; add "schema": "musim-design/1")");
    check_refused(kMaterials, R"(d.json: prototype is missing; add {"block": [...], "height", "density", "friction"})");
    check_refused(kPrototype, R"(d.json: materials is no list; write ["wood", {"name": "resin", "density": ..., "friction": ...}])");
    check_refused(kPrototype + ", " + kMaterials + R"(, "colour": 1)",
                  R"(d.json: "colour" is none of its settings; remove it, or correct its name)");
    check_refused(R"("prototype": {"block": ["1 m", "2 m"]})",
                  R"(d.json: prototype: block is no list of three lengths; write ["12.7 mm", "26.4 mm", "39.7 mm"], the height last)");
    check_refused(R"("prototype": {"block": ["1 m", "2 m", "0 m"]})", "d.json: prototype: a length of block is not above zero; correct it");
    check_refused(R"("prototype": {"block": ["1 m", "2 m", "3 m"]})", "d.json: prototype: height is missing; add it");
    check_refused(R"("prototype": {"block": ["1 m", "2 m", "3 m"], "height": "-1 m"})",
                  "d.json: prototype: height is not above zero; correct it, or remove it where it is not known");
    check_refused(kPrototype + ", " + kMaterials + R"(, "table": "t.json")",
                  "d.json: record is missing (the table is to make it); give both, or neither");
    check_refused(kPrototype + ", " + kMaterials + R"(, "record": {})",
                  "d.json: table is missing (it is to make the record); give both, or neither");
    check_refused(kPrototype + ", " + kMaterials + R"(, "table": "t", "record": {})", "d.json: record: file is missing; add it");
    check_refused(kPrototype + ", " + kMaterials + R"(, "table": "t", "record": {"file": "a", "axes": 1})",
                  R"(d.json: record: axes is no object; write {"360": "x"}, component before axis)");
    check_refused(kPrototype + ", " + kMaterials + R"(, "table": "t", "record": {"peaks": [{"axis": "x"}]})",
                  "d.json: record: peaks 1: acceleration is missing; add it");
    check_refused(kPrototype + ", " + kMaterials + R"(, "limits": {"camera": {"rate": "1 Hz"}})",
                  "d.json: limits: camera: pictures is missing; add it");
    check_refused(kPrototype + R"(, "materials": ["wood"], "limits": {"overlap_ratio": 1})",
                  "d.json: material wood has no modulus (overlap_ratio asks for it); add it, or remove the limit");
    check_refused(kPrototype + ", " + kMaterials + R"(, "laws": [1])", "d.json: an entry of laws is no text; write it in quotes");
    check_refused(
        kPrototype + ", " + kMaterials + R"(, "groups": ["x"])",
        "d.json: groups: \"x\" is no group; take some of mu^N, t*sqrt(mu*g/l), a/(mu*g), a/g, a/(g*tan(alpha)), a_vertical/g, omega/p, "
        "Fr^N, mu/tan(alpha), mu, kappa_n, C^N, S_e^N, k_s/k_n, c_res, sigma_H/H, delta_w/sigma_H, e_r, "
        "v/sqrt(mu*g*l), v/sqrt(g*l), E/(rho*g*l)");
    const std::string law =
        musim::tests::message_of<records::ReadError>([] { parse(kPrototype + ", " + kMaterials + R"(, "laws": ["x"])"); });
    CHECK(law.find("d.json: laws: ") == 0);
    CHECK(law.find("froude") != std::string::npos);
}

TEST_CASE("wrong materials are refused with the place and what to do") {
    check_material_refused(
        R"("tin")", "d.json: materials 1: \"tin\" is no preset; take one of wood, concrete, or give its density and friction under a name");
    check_material_refused(R"("wood", "wood")", "d.json: the material \"wood\" comes twice; give every one its own \"name\"");
    check_material_refused(R"({"name": "a", "density": "1 kg/m^3"})", "d.json: materials 1: friction is missing; add it");
    check_material_refused(R"({"density": "1 kg/m^3"})", "d.json: materials 1: name is missing; add it");
    check_material_refused(R"({"preset": "wood", "modulus": "1 Pa", "normal_stiffness": "1 N/m"})",
                           "d.json: materials 1: modulus contradicts normal_stiffness; remove one of them");
    check_material_refused(
        R"({"preset": "wood", "normal_stiffness": "1 N/m"})",
        R"(d.json: materials 1: stiffness_block is no list of three lengths; write ["12.7 mm", "26.4 mm", "39.7 mm"], the height last)");
    check_material_refused(R"({"preset": "wood", "taste": 1})",
                           R"(d.json: materials 1: "taste" is none of its settings; remove it, or correct its name)");
    const Material bare{.name = "bare", .density = 1.0 * si::kilograms_per_cubic_meter, .friction = 0.5};
    CHECK(musim::tests::message_of<records::ReadError>([&] {
              parse_design(
                  R"({"schema": "musim-design/1", )" + kPrototype + R"(, "materials": ["bare"], "limits": {"deviation_ratio": 0.01}})",
                  "d.json", {bare});
          }) == "d.json: material bare has no height_deviation (limits ask for it); add it, or remove the limit");
}

}  // namespace musim::records
