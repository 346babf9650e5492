#include "lsdem/run/scene_summary.hpp"

#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "lsdem/results/write_results.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/scene/new_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/scene_preview.hpp"
#include "scaling/error.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;

namespace {

const std::filesystem::path kExamples = std::filesystem::path(MUSIM_SOURCE_DIR) / "examples";

double estimate(const SceneSummary& summary, const std::string& key) {
    for (const SceneEstimate& each : summary.estimates) {
        if (each.key == key) return each.value.value();
    }
    FAIL("no estimate " << key);
    return 0.0;
}

std::size_t count_parts(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

}  // namespace

TEST_CASE("a scene summary has the mass and size of the structure") {
    const SceneSummary wall = summarize_scene(read_scene(kExamples / "wall.json"));
    // six courses of five whole blocks, and of four between two halves
    REQUIRE(wall.kinds.size() == 2);
    CHECK(wall.kinds[0].count + wall.kinds[1].count == 3 * 5 + 3 * 6);
    CHECK(wall.levels == 6);
    CHECK(wall.high.z() - wall.low.z() == doctest::Approx(6 * 0.170));
    // w = 112.8 mm, pitch w·1.435/2.82: nine cells and a block
    CHECK(wall.high.x() - wall.low.x() == doctest::Approx(0.1128 * (1.0 + 8.0 * 1.435 / 2.82)));
    CHECK(wall.mass == doctest::Approx(wall.kinds[0].mass + wall.kinds[1].mass));
    CHECK(wall.kinds[0].mass == doctest::Approx(2320.0 * static_cast<double>(wall.kinds[0].count) * wall.kinds[0].size.prod()));
}

TEST_CASE("estimates are the closed forms that they name") {
    const SceneSummary column = summarize_scene(read_scene(kExamples / "column.json"));
    const double b = 12.710e-3, w = 26.355e-3, h = 39.720e-3, g = 9.80665, mass = 800.0 * b * w * h;
    CHECK(estimate(column, "rocking_thin") == doctest::Approx(b / h));
    CHECK(estimate(column, "rocking_wide") == doctest::Approx(w / h));
    CHECK(estimate(column, "frequency_parameter_thin") == doctest::Approx(std::sqrt(3.0 * g / (2.0 * std::hypot(b, h)))));
    CHECK(estimate(column, "sliding") == 0.63);
    CHECK(estimate(column, "contact_frequency") == doctest::Approx(std::sqrt(30e6 / mass) / (2.0 * std::numbers::pi)));
    CHECK(estimate(column, "elastic_speed") == doctest::Approx(h * std::sqrt(26e6 / mass)));
    CHECK(estimate(column, "climb_slip") == doctest::Approx(2.0 * estimate(column, "climb_stick")));
    CHECK(estimate(column, "base_overlap") == doctest::Approx(10.0 * mass * g / (30e6 * h)));
    // of many layers the chain is a bar that is fixed below: a quarter of a wave
    const double bar = estimate(column, "elastic_speed") / (4.0 * 10.0 * h);
    CHECK(estimate(column, "shear_frequency") == doctest::Approx(bar).epsilon(0.06));
    CHECK(estimate(column, "shear_frequency") < bar);
}

TEST_CASE("estimates are in standard g, for vertical gravity alone, and take the least friction") {
    nlohmann::json scene = nlohmann::json::parse(std::ifstream(kExamples / "column.json"));
    scene["gravity"] = "49.03325 m/s^2";
    scene["ground"] = {{"friction", 0.1}};
    const SceneSummary heavy = summarize_scene(parse_scene(scene.dump(), kExamples / "column.json"));
    CHECK(estimate(heavy, "sliding") == 0.1);
    for (const SceneEstimate& each : heavy.estimates) {
        if (each.key == "sliding") CHECK(each.text == "0.5 g");
        if (each.key == "rocking_thin") CHECK(each.text == "1.6 g");
    }
    // blocks on the ground alone have its friction, be it larger than theirs
    nlohmann::json single = scene;
    single["structure"]["layers"] = 1;
    single["ground"] = {{"friction", 0.9}};
    CHECK(estimate(summarize_scene(parse_scene(single.dump(), kExamples / "column.json")), "sliding") == 0.9);
    scene["gravity"] = {"1 m/s^2", "0 m/s^2", "-9.81 m/s^2"};
    CHECK(summarize_scene(parse_scene(scene.dump(), kExamples / "column.json")).estimates.empty());
}

TEST_CASE("a base that keeps a velocity goes on after its last sample") {
    nlohmann::json scene = nlohmann::json::parse(std::ifstream(kExamples / "column.json"));
    scene["base_motion"] = {{"signal", "step"}, {"direction", "x"}, {"velocity", "1 m/s"}};
    scene["time"]["duration"] = "0.25 s";
    const SceneSummary summary = summarize_scene(parse_scene(scene.dump(), kExamples / "column.json"));
    CHECK(summary.motions.at(0).axes.at(0).pgd == doctest::Approx(0.25).epsilon(1e-3));
}

TEST_CASE("a scene whose specimen is missing cannot be run") {
    nlohmann::json scene = nlohmann::json::parse(std::ifstream(kExamples / "uneven_wall.json"));
    scene["preparation"] = {{"specimen", "missing.h5"}};
    CHECK_THROWS_WITH_AS(summarize_scene(parse_scene(scene.dump(), kExamples / "uneven_wall.json")), doctest::Contains("missing.h5"),
                         musim::Error);
}

TEST_CASE("a scene summary has the motion of the base") {
    const SceneSummary column = summarize_scene(read_scene(kExamples / "column.json"));
    REQUIRE(column.motions.size() == 1);
    REQUIRE(column.motions[0].axes.size() == 1);
    const AxisMotion& y = column.motions[0].axes[0];
    CHECK(y.axis == 'y');
    // a Ricker wavelet of 20 Hz: its spectrum is largest near its own period
    CHECK(y.pga == doctest::Approx(0.3 * 9.80665).epsilon(1e-3));
    CHECK(*y.predominant_period == doctest::Approx(1.0 / 20.0).epsilon(0.2));
    const SceneSummary sequence = summarize_scene(read_scene(kExamples / "aftershocks.json"));
    CHECK(sequence.motions.size() == 6);
    CHECK(sequence.steps() == 6 * sequence.motions[0].plan.steps());
}

TEST_CASE("the sizes of output files are those that a run writes to a quarter") {
    Scene scene = make_new_scene({.kind = "tower", .layers = 2});
    scene.time.duration = 0.02 * musim::scaling::si::seconds;
    scene.output.spine_rate = scene.output.spine_rate * 20.0;
    scene.output.frame_rate = *scene.output.frame_rate * 20.0;
    const SceneSummary summary = summarize_scene(scene);
    const musim::tests::TemporaryFolder folder;
    ResultFolder results(folder.path() / "out");
    results.add_run("", run_scene(scene), {.scene = write_scene(scene), .program_version = "test"});
    results.commit();
    for (const OutputSize& output : summary.outputs) {
        CAPTURE(output.file);
        CHECK(output.bytes ==
              doctest::Approx(static_cast<double>(std::filesystem::file_size(folder.path() / "out" / output.file))).epsilon(0.25));
    }
}

TEST_CASE("the run time is reckoned from steps of the model itself") {
    const SceneSummary summary = summarize_scene(make_new_scene({.kind = "column"}));
    const RunTimeEstimate estimate = measure_run_time(summary, 1, 0.02);
    CHECK(estimate.steps > 0);
    CHECK(estimate.run == doctest::Approx(estimate.seconds * static_cast<double>(summary.steps()) / static_cast<double>(estimate.steps)));
    CHECK(estimate.most_preparation == 0.0);
    Scene uneven = make_new_scene({.kind = "column"});
    std::get<Column>(uneven.structure).height_deviation = musim::scaling::Length::from_value(1e-4);
    const RunTimeEstimate with_rest = measure_run_time(summarize_scene(uneven), 1, 0.02);
    CHECK(with_rest.least_preparation > 0.0);
    CHECK(with_rest.most_preparation > with_rest.least_preparation);
}

TEST_CASE("a preview draws the faces that can be seen") {
    // of a column seen from a corner: two sides of every block, and the top
    const SceneSummary column = summarize_scene(make_new_scene({.kind = "column", .layers = 4}));
    const std::string svg = make_preview_svg(column);
    CHECK(count_parts(svg, "<polygon") == 4 * 2 + 1 + 1);
    CHECK(svg.find("Acceleration of the base along x") != std::string::npos);
    CHECK(svg.find(">blocks<") != std::string::npos);
    CHECK(svg.find(">ground<") != std::string::npos);
    // of a hollow tower most faces are hidden
    const SceneSummary tower = summarize_scene(make_new_scene({.kind = "tower", .layers = 4}));
    const std::string hollow = make_preview_svg(tower);
    CHECK(count_parts(hollow, "<polygon") < tower.specimen.model.blocks.size() * 2);
    CHECK(hollow.find(">spine: blocks whose motion is sampled<") != std::string::npos);
}

TEST_CASE("a preview names the colours of the materials, each with that of its blocks") {
    const Scene scene = parse_scene(R"({"schema": "musim-scene/1", "name": "two materials", "material": "wood",
        "materials": {"capital": {"density": "2320 kg/m^3", "normal_stiffness": "2.6 GN/m", "shear_stiffness": "2.5 GN/m", "friction": 0.6, "restitution": 0.5}},
        "structure": {"kind": "blocks", "blocks": [{"size": ["1 m", "1 m", "1 m"], "position": ["0 m", "0 m", "0.5 m"]},
                      {"size": ["1 m", "1 m", "1 m"], "position": ["0 m", "0 m", "1.5 m"], "material": "capital"}]},
        "time": {"duration": "0.1 s"}, "output": {"spine_rate": "100 Hz"}})");
    const std::string svg = make_preview_svg(summarize_scene(scene));
    // all blocks are sampled: none stands out
    CHECK(svg.find(">spine: ") == std::string::npos);
    std::string shown;
    for (const std::string name : {"the scene's material", "capital"}) {
        CAPTURE(name);
        const std::size_t text = svg.find(fmt::format(">blocks of {}<", name));
        REQUIRE(text != std::string::npos);
        const std::string color = svg.substr(svg.find("fill=", svg.rfind("<rect", text)) + 6, 7);
        // a face of a block has it, and it is not the other's
        CHECK(count_parts(svg, fmt::format("\" fill=\"{}\"/>", color)) >= 1);
        CHECK(shown != color);
        shown = color;
    }
}
