#include "records/design/parse_properties.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "records/design/properties_law.hpp"
#include "records/error.hpp"
#include "records/measures/intensity.hpp"
#include "records/synthesis/synthetic.hpp"
#include "tests/records/design/tower.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;

const std::string kPropertiesPrototype = R"("prototype": {"preset": "concrete", "block": ["1.36 m", "2.82 m", "4.25 m"], "layers": 38})";
const std::string kModel = R"("model": {"preset": "wood"})";
const std::string kBoth = kPropertiesPrototype + ", " + kModel;

Properties parse_own_properties(const std::string& fields, double length = 1.0 / 107.0) {
    Material stiff = concrete();
    stiff.modulus = 30e9 * si::pascals;
    return parse_properties(R"({"schema": "musim-properties/1", )" + fields + "}", "f.json", {wood(), stiff}, length);
}

void check_properties_refused(const std::string& fields, const std::string& message) {
    CHECK(musim::tests::message_of<records::ReadError>([&] { parse_own_properties(fields); }) == message);
}

}  // namespace

TEST_CASE("a model has the prototype's layers and its scaled block unless it says otherwise") {
    const Properties properties = parse_own_properties(kBoth, 0.25);
    CHECK(properties.model.layers == 38);
    CHECK(properties.model.block[2].value() == 0.25 * 4.25);
    CHECK(properties.model.friction == wood().friction);
    CHECK(properties.model.name == "wood");
    CHECK(properties.prototype.gravity == scaling::kStandardGravity);
    CHECK(*properties.prototype.height_deviation == *concrete().deviation);
    CHECK_FALSE(properties.motion.has_value());
    CHECK(std::holds_alternative<std::monostate>(properties.table));

    const Properties measured = parse_own_properties(
        kPropertiesPrototype + R"(, "model": {"preset": "wood", "name": "oak", "block": ["12.710 mm", "26.355 mm", "39.780 mm"],
        "layers": 12, "gap": "0 m", "edge_radius": "0.1 mm", "blocks_per_layer": 188, "ground_friction": "0.6", "kinetic_friction": 0.5,
        "gravity": "25 g", "friction": "0.63/2"})");
    CHECK(measured.model.name == "oak");
    CHECK(measured.model.block[0].value() == 12.710e-3);
    CHECK(measured.model.layers == 12);
    CHECK(measured.model.gap->value() == 0.0);
    CHECK(measured.model.edge_radius->value() == 0.1e-3);
    CHECK(*measured.model.blocks_per_layer == 188);
    CHECK(*measured.model.ground_friction == 0.6);
    CHECK(*measured.model.kinetic_friction == 0.5);
    CHECK(measured.model.gravity.value() == relative(25.0 * 9.80665, 1e-15));
    CHECK(measured.model.friction == 0.315);
}

TEST_CASE("a modulus becomes the stiffness of the block's own face, a face stiffness stays what it is") {
    const Properties properties = parse_own_properties(
        kPropertiesPrototype + R"(, "model": {"name": "resin", "density": "1200 kg/m^3", "friction": 0.3, "normal_stiffness": "30 MN/m",
        "shear_stiffness": "12 MN/m", "stiffness_block": ["0.01 m", "0.02 m", "0.04 m"]})");
    CHECK(properties.prototype.normal_stiffness->value() == relative(30e9 * 1.36 * 2.82 / 4.25, 1e-15 * 4.0));  // four roundings
    CHECK_FALSE(properties.prototype.shear_stiffness.has_value());
    // the same solid in another block: k A/H over that of the measured one
    const auto& [thin, wide, height] = properties.model.block;
    const double ratio = (thin.value() * wide.value() / height.value()) / (0.01 * 0.02 / 0.04);
    CHECK(properties.model.normal_stiffness->value() == relative(30e6 * ratio, 1e-15 * 8.0));  // eight roundings
    const Properties own = parse_own_properties(kPropertiesPrototype +
                                                R"(, "model": {"density": "1200 kg/m^3", "friction": 0.3, "shear_stiffness": "12 MN/m"})");
    CHECK(own.model.shear_stiffness->value() == relative(12e6, 1e-15 * 6.0));  // to a modulus and back
    CHECK(own.model.name == "model");
}

TEST_CASE("motions are peaks or records, a table is frequencies or an axis") {
    const Properties given =
        parse_own_properties(kBoth + R"(, "motion": {"acceleration": "0.511 g", "velocity": "42.4 cm/s", "displacement": "20 cm",
        "vertical_acceleration": "0 g", "predominant_period": "0.5 s", "pulse_period": "2 s", "duration": "40 s", "step": "5 ms",
        "lowest_frequency": "0.1 Hz", "highest_frequency": "10 Hz", "direction": "30 deg"},
        "model_motion": {"file": "table.csv", "component": "x", "vertical": "z", "high_pass": "1 Hz"},
        "table": {"lowest_frequency": "0.2 Hz", "highest_frequency": "50 Hz"}, "name": "n")");
    const auto& motion = std::get<scaling::MotionProperties>(*given.motion);
    CHECK(motion.velocity->value() == 0.424);
    CHECK(motion.vertical_acceleration->value() == 0.0);
    CHECK(motion.step->value() == 0.005);
    CHECK(*motion.direction == relative(std::numbers::pi / 6.0, 1e-15));
    const auto& record = std::get<RecordOfMotion>(*given.model_motion);
    CHECK(record.file == "table.csv");
    CHECK(record.vertical == "z");
    CHECK(record.high_pass->value() == 1.0);
    CHECK(std::get<scaling::Bandwidth>(given.table).highest->value() == 50.0);
    const Properties axis = parse_own_properties(kBoth + R"(, "table": {"file": "t.json", "axis": "x"})");
    CHECK(std::get<AxisOfTable>(axis.table).axis == "x");
}

TEST_CASE("wrong properties are refused with the place and what to do") {
    CHECK(
        musim::tests::message_of<records::ReadError>([] { parse_properties("{", "f.json", {}, 1.0); }) ==
        R"(f.json: is no JSON (parse error at line 1, column 2: syntax error while parsing object key - unexpected end of input; expected )"
        R"(string literal); write {"schema": "musim-properties/1", "prototype": {...}, "model": {...}})");
    CHECK(musim::tests::message_of<records::ReadError>([] { parse_properties(R"({"schema": "musim-design/1"})", "f.json", {}, 1.0); }) ==
          R"(f.json: is no file of structure properties; add "schema": "musim-properties/1")");
    check_properties_refused(kPropertiesPrototype,
                             R"(f.json: model is missing; add {"preset" or "density" and "friction", "block", "layers", ...})");
    check_properties_refused(
        R"("prototype": {"preset": "concrete", "layers": 3}, )" + kModel,
        R"(f.json: prototype: block is no list of three lengths; write ["12.7 mm", "26.4 mm", "39.7 mm"], the height last)");
    check_properties_refused(R"("prototype": {"preset": "concrete", "block": ["1 m", "2 m", "3 m"]}, )" + kModel,
                             "f.json: prototype: layers is missing; add it");
    check_properties_refused(R"("prototype": {"preset": "concrete", "block": ["1 m", "2 m", "3 m"], "layers": 0}, )" + kModel,
                             "f.json: prototype: layers is below 1; correct it");
    check_properties_refused(R"("prototype": {"preset": "concrete", "block": ["1 m", "2 m", "3 m"], "layers": 4294967299}, )" + kModel,
                             "f.json: prototype: layers is beyond all counts; correct it");
    check_properties_refused(
        kPropertiesPrototype + R"(, "model": {"preset": "glass"})",
        "f.json: model: \"glass\" is no preset; take one of wood, concrete, or give its density and friction under a name");
    check_properties_refused(kPropertiesPrototype + R"(, "model": {"density": "800 kg/m^3"})",
                             "f.json: model: friction is missing; add it");
    check_properties_refused(kPropertiesPrototype + R"(, "model": {"preset": "wood", "gap": "-1 mm"})",
                             "f.json: model: gap is below zero; correct it, or remove it where it is not known");
    check_properties_refused(kPropertiesPrototype + R"(, "model": {"preset": "wood", "modulus": "1e9 Pa", "normal_stiffness": "1e6 N/m"})",
                             "f.json: model: modulus contradicts normal_stiffness; remove one of them");
    check_properties_refused(kPropertiesPrototype + R"(, "model": {"preset": "wood", "stiffness_block": ["1 m", "2 m", "3 m"]})",
                             "f.json: model: \"stiffness_block\" is none of its settings; remove it, or correct its name");
    check_properties_refused(kBoth + R"(, "colour": 1)", R"(f.json: "colour" is none of its settings; remove it, or correct its name)");
    check_properties_refused(kBoth + R"(, "motion": {"velocity": "1 m/s"})", "f.json: motion: acceleration is missing; add it");
    check_properties_refused(kBoth + R"(, "motion": {"file": "a", "velocity": "1 m/s"})",
                             "f.json: motion: \"velocity\" is none of its settings; remove it, or correct its name");
    check_properties_refused(
        kBoth + R"(, "model_motion": {"acceleration": "1 m/s^2"})",
        "f.json: motion is missing (model_motion is held against it); add the prototype's motion, or remove model_motion");
    check_properties_refused(kBoth + R"(, "table": {"file": "t.json"})", "f.json: table: axis is missing; add it");
}

TEST_CASE("a record's peaks and periods are measured, the vertical one too") {
    records::GroundMotion motion = records::make_synthetic_record();
    const records::TimeSeries series = motion.components.front().series;
    std::vector<double> half(series.samples().begin(), series.samples().end());
    for (double& value : half) value *= -0.5;
    motion.components.push_back({.name = "Up", .series = {series.quantity(), series.start(), series.dt(), half}});
    motion.components.front().azimuth_deg = 0.0;

    const scaling::MotionProperties properties = measure_motion(motion, {});
    CHECK(properties.acceleration.value() == std::abs(records::find_peak_acceleration(series).value.value()));
    CHECK(properties.vertical_acceleration->value() == 0.5 * properties.acceleration.value());
    CHECK(*properties.step == series.dt());
    CHECK(*properties.duration == records::compute_significant_duration(series));
    CHECK(properties.predominant_period->value() > 0.0);
    CHECK(*properties.lowest_frequency < 1.0 / *properties.predominant_period);
    CHECK(*properties.highest_frequency > 1.0 / *properties.predominant_period);
    CHECK(measure_motion(motion, {.file = "", .component = "up"}).acceleration == *properties.vertical_acceleration);
    CHECK_THROWS_AS(measure_motion(motion, {.file = "", .component = "west"}), records::ReadError);
    motion.components.pop_back();
    CHECK_FALSE(measure_motion(motion, {}).vertical_acceleration.has_value());
}

TEST_CASE("a table's axis follows what its own limits, its loaded oil column and its controller leave") {
    records::TableAxis axis = free_axis();
    CHECK_FALSE(find_bandwidth(axis, {}).lowest.has_value());
    CHECK_FALSE(find_bandwidth(axis, {}).highest.has_value());
    axis.lowest_frequency = 0.1 / si::seconds;
    axis.highest_frequency = 60.0 / si::seconds;
    CHECK(find_bandwidth(axis, {}).lowest->value() == 0.1);
    CHECK(find_bandwidth(axis, {}).highest->value() == 60.0);
    // the column softens by √(M/(M + m)) = 1/2
    axis.moving_mass = 100.0 * si::kilograms;
    axis.oil_column = records::OilColumn{.frequency = 80.0 / si::seconds, .share = 0.5};
    CHECK(find_bandwidth(axis, 300.0 * si::kilograms).highest->value() == relative(20.0, 1e-15 * 4.0));

    scaling::StructureProperties structure = parse_own_properties(kBoth).model;
    CHECK(find_mass(structure).value() == 0.0);
    structure.blocks_per_layer = 188;
    CHECK(find_mass(structure).value() == relative(76.158, 0.002));  // printed for blocks of 1/106.84
}

TEST_CASE("properties carry uncertainties and name a law as designs do") {
    scaling::UncertainReading reading("f.json");
    const auto read = [&](const std::string& fields) {
        return parse_properties(R"({"schema": "musim-properties/1", )" + fields + "}", "f.json", {wood(), concrete()}, 0.25, &reading);
    };
    const Properties properties =
        read(R"("prototype": {"preset": "concrete", "block": ["1.36 m +/- 1 mm", "2.82 m", "4.25 m"], "layers": 38}, )" + kModel +
             R"(, "motion": {"acceleration": "0.511 g +/- 1%", "direction": "30 deg +/- 2 deg"}, "law": {"law": "gravity_distorted",
             "set": {"a": "2 +/- 1%"}}, "table": {"highest_frequency": "100 +/- 2 Hz"})");
    REQUIRE(reading.inputs().size() == 5);
    CHECK(reading.inputs()[0].name == "prototype: block b");
    CHECK(reading.inputs()[2].quantity.uncertainty == relative(2.0 * std::numbers::pi / 180.0, 1e-15 * 4.0));
    CHECK(reading.inputs()[4].name == "law: set: a");
    CHECK(properties.law->name() == "gravity_distorted");
    CHECK(properties.law->set().front().factor == 2.0);
    CHECK(read(kBoth + R"(, "law": "froude")").law->name() == "froude");
    check_properties_refused(
        kBoth + R"(, "motion": {"acceleration": "0.5 g +/- 1%"})",
        "f.json: motion: acceleration is \"0.5 g +/- 1%\" (+/- makes no sense here: values alone are used); give the value alone");
    check_properties_refused(
        kBoth + R"(, "law": 1)",
        "f.json: law is neither a name nor an object; write \"true_replica\" or {\"law\": \"gravity_distorted\", \"set\": {\"a\": 2}}");
    check_properties_refused(
        kBoth + R"(, "motion": {"file": "a.v1", "high_pass": "0.1 Hz +/- 1%"})",
        "f.json: motion: high_pass is \"0.1 Hz +/- 1%\" (+/- makes no sense here: it is chosen); give the value alone");
    CHECK(musim::tests::message_of<records::ReadError>([&] { read(kBoth + R"(, "law": "no_such_law")"); }).find("f.json: law: ") == 0);
}

TEST_CASE("a law takes from the properties what it asks for") {
    const auto apply = [&](const std::string& law, const std::string& model = kModel, double length = 0.04) {
        const Properties properties = parse_own_properties(kPropertiesPrototype + ", " + model + R"(, "law": )" + law, length);
        const scaling::PairProperties pair{.prototype = properties.prototype, .model = properties.model};
        return apply_law(*properties.law, solve_for(*properties.law, pair, length), pair, length);
    };
    const std::string same = R"("model": {"preset": "concrete"})", spun = R"("model": {"preset": "concrete", "gravity": "25 g"})";
    const scaling::Similitude replica = apply(R"("true_replica")");
    CHECK(replica.law_name() == "true_replica");
    CHECK(replica.time() == 0.2);
    CHECK(apply(R"("centrifuge")", spun).acceleration() == relative(25.0, 1e-12));
    CHECK(apply(R"({"law": "gravity_distorted", "set": {"a": 4}})", same, 0.25).time() == 0.25);
    CHECK(apply(R"("mu")").law_name() == "mu");
    const auto refusal = [&](const std::string& law, const std::string& model) {
        return musim::tests::message_of<scaling::SimilitudeError>([&] { apply(law, model); });
    };
    CHECK(refusal(R"("mu_vertical_distortion")", same).find("law mu_vertical_distortion: it settles no single length l (") == 0);
    CHECK(refusal(R"("centrifuge")", same).find("law centrifuge: ") == 0);
    CHECK(refusal(R"({"law": "mechanics", "set": {"t": 0.2, "g": 25}})", same).find("law mechanics: it sets g to 25, where gravity") == 0);
}

}  // namespace musim::records
