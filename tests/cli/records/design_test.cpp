#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "tests/cli/program.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"

using namespace musim::cli;
using musim::lsdem::tests::relative;

namespace {

const std::string kExample = MUSIM_SOURCE_DIR "/examples/design/tower.json";

/// A design for table.json beside it, with more keys.
std::string make_design(const std::string& more, const std::string& record = R"({"file": "synthetic"})") {
    return R"({"schema": "musim-design/1", "prototype": {"block": ["1.36 m", "2.82 m", "4.25 m"], "height": "161.5 m", "density": "2320 kg/m^3", "friction": 0.59},
        "table": "table.json", "record": )" +
           record + R"(, "materials": ["wood"])" + more + "}";
}

constexpr const char* kTable =
    R"({"schema": "musim-table/1", "axes": [{"names": ["x"], "displacement": "1 mm", "velocity": "1 m/s", "lowest_frequency": "0.1 Hz"}]})";

}  // namespace

TEST_CASE("the example design ranks wood first, excludes aluminium and names what concrete lacks") {
    const Workplace here;
    const Outcome outcome = here.run("design '" + kExample + "' --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto object = outcome.json();
    REQUIRE(object["candidates"].size() == 6);
    const auto& first = object["candidates"].at(0);
    CHECK(first["material"] == "wood");
    CHECK(first["changes_regime"] == false);
    const auto& range = first["ranges"].at(0);
    CHECK(range["largest"].get<double>() == relative(6.0 / 161.5, 1e-12));  // bisected, closed form to rounding
    CHECK(range["binds_above"] == "hall height");
    CHECK(range["binds_below"] == "highest frequency of axis x");
    CHECK(first["at_length"]["length"] == 1.0 / 107.0);
    CHECK(first["ranked_at"]["mass_kg"].get<double>() == relative(76.158, 0.002));  // printed for 1/107 by block; 1.51 m high
    for (const auto& candidate : object["candidates"]) {
        if (candidate["material"] == "aluminium") CHECK(candidate["changes_regime"] == true);
        if (candidate["material"] != "concrete") continue;
        CHECK(candidate["feasible"] == false);
        CHECK(candidate["conflict"]["upper"] == "payload of axis x");
        CHECK(candidate["conflict"]["lower"] == "smallest edge");
        CHECK(candidate["conflict"]["at_least"].get<double>() == relative(0.04 / 1.36, 1e-12));
    }
}

TEST_CASE("the report is text or Markdown, with the same numbers") {
    const Workplace here;
    const Outcome plain = here.run("design '" + kExample + "'"), markdown = here.run("design '" + kExample + "' --format markdown");
    REQUIRE(plain.exit_code == 0);
    REQUIRE(markdown.exit_code == 0);
    for (const Outcome* const outcome : {&plain, &markdown}) {
        CHECK(outcome->out.find("1/146.3 ... 1/26.92") != std::string::npos);
        CHECK(outcome->out.find("payload of axis x allows up to 1/37.8, smallest edge asks for at least 1/34") != std::string::npos);
        CHECK(outcome->out.find("excluded: changes between sliding and rocking") != std::string::npos);
    }
    CHECK(plain.out.find("---") == std::string::npos);
    CHECK(markdown.out.find("\n| --- | --- |") != std::string::npos);
    const std::string latex = here.run("design '" + kExample + "' --format latex").out;
    CHECK(latex.find("\\begin{longtable}") != std::string::npos);
    CHECK(latex.find("mu\\textasciicircum{}N") != std::string::npos);
    CHECK(markdown.out.find("sum \\|ln d\\|") != std::string::npos);
}

TEST_CASE("a record and a table are looked for beside the design and agree with it") {
    const Workplace here;
    here.write("table.json", kTable);
    here.shell("mkdir plans");
    here.write("plans/table.json", kTable);
    here.write("plans/design.json", make_design(R"(, "length": "1/25")"));
    const Outcome outcome = here.run("design plans/design.json --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto candidate = outcome.json()["candidates"].at(0);
    const auto& use = candidate["at_length"]["uses"].at(0);
    CHECK(use["limit"] == "displacement of axis x");
    // displacement goes with λ_l, to rounding
    CHECK(candidate["ranges"].at(0)["largest"].get<double>() == relative(0.04 / use["used"].get<double>(), 1e-12));
    // the record in its prototype form, from `table` at 1:1
    const Outcome table = here.run("table synthetic --limits table.json --length 1 --json");
    const auto limits = table.json()["components"].at(0)["limits"];
    CHECK(use["demand"].get<double>() == relative(0.04 * 1e-3 * limits.at(0)["record"].get<double>(), 1e-12));
}

TEST_CASE("a real record is read by component, and its high-pass lowers what it asks of the stroke") {
    if (!musim::tests::have_shared_records()) return;
    const Workplace here;
    here.write("table.json", kTable);
    const std::string file = std::filesystem::canonical(musim::tests::shared_records()).string() + "/csmip/CICLC.v1";
    const auto displacement = [&](const std::string& high_pass) {
        here.write("design.json",
                   make_design(R"(, "length": "1/25")", R"({"file": ")" + file + R"(", "axes": {"360": "x"})" + high_pass + "}"));
        const Outcome outcome = here.run("design design.json --json");
        REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
        return outcome.json()["candidates"].at(0)["at_length"]["uses"].at(0)["demand"].get<double>();
    };
    // displacement lives on periods of seconds: a ten times higher corner takes most of it, the factor 2 is far from either
    CHECK(displacement(R"(, "high_pass": "1 Hz")") < 0.5 * displacement(R"(, "high_pass": "0.1 Hz")"));
}

TEST_CASE("when nothing is feasible the code is 5 and the report says why") {
    const Workplace here;
    here.write("table.json", kTable);
    here.write("design.json", make_design(R"(, "limits": {"camera": {"rate": "10 Hz", "pictures": 1000}})"));
    const Outcome outcome = here.run("design design.json");
    CHECK(outcome.exit_code == 5);
    CHECK(outcome.has_one_error_line());
    CHECK(outcome.err.find("musim: error: design.json: nothing is feasible (wood, law mu: ") == 0);
    CHECK(outcome.out.find("camera") != std::string::npos);
    CHECK(here.run("design design.json --json").json()["candidates"].at(0)["feasible"] == false);
}

TEST_CASE("wrong input to design is reported in one line") {
    const Workplace here;
    here.write("table.json", kTable);
    const auto error = [&](const std::string& arguments, int code) {
        const Outcome outcome = here.run("design " + arguments);
        CHECK(outcome.exit_code == code);
        CHECK(outcome.has_one_error_line());
        CHECK(outcome.out.empty());
        return outcome.err;
    };
    CHECK(error("none.json", 3).find("none.json: cannot be read") != std::string::npos);
    here.write("design.json", make_design(R"(, "colour": 1)"));
    CHECK(error("design.json", 3) == "musim: error: design.json: \"colour\" is none of its settings; remove it, or correct its name\n");
    here.write("design.json", make_design("", R"({"peaks": [{"axis": "x", "acceleration": "0.5 g"}]})"));
    CHECK(error("design.json", 3).find("design.json: record: displacement is missing (axis x of the table limits it); add it") !=
          std::string::npos);
    here.write("design.json", make_design("", R"({"peaks": [{"axis": "y", "acceleration": "0.5 g"}]})"));
    CHECK(error("design.json", 3).find("the table has no axis \"y\"; choose one of x") != std::string::npos);
    CHECK(error("design.json", 3).find("record: peaks: axis: the table has no axis") != std::string::npos);
    here.write("design.json", make_design("", R"({"file": "synthetic", "axes": {"up": "x"}})"));
    CHECK(error("design.json", 3).find("up") != std::string::npos);
    here.write("design.json", make_design("", R"({"file": "lost.v1"})"));
    CHECK(error("design.json", 3).find("lost.v1") != std::string::npos);
    here.write("design.json", make_design(""));
    here.write("table.json", R"({"schema": "musim-table/1", "axes": [{"names": ["x"], "displacement": "1 m", "payload": "5 t"}]})");
    CHECK(error("design.json", 3).find("prototype: mass is missing (axis x of the table limits what it carries); add it") !=
          std::string::npos);
    error("design.json --json --format markdown", 2);
    error("", 2);
}

TEST_CASE("a design by laws as data ranks materials, names conflicts and reports factors and added mass") {
    const Workplace here;
    const std::string laws = std::string("design '") + MUSIM_SOURCE_DIR + "/examples/design/laws.json' ";
    const Outcome outcome = here.run(laws + "--json");
    REQUIRE(outcome.exit_code == 0);
    const auto candidates = outcome.json()["candidates"];
    REQUIRE(candidates.size() == 10);
    // only with widths and heights apart does aluminium slide and rock as concrete does, though it loses less at each impact: 0.986/0.861
    const auto& narrow = candidates[4];
    CHECK(narrow["material"] == "aluminium");
    CHECK(narrow["law"] == "mu_vertical_distortion");
    CHECK(narrow["changes_regime"] == false);
    CHECK(narrow["at_length"]["factors"]["width"].get<double>() == doctest::Approx(0.18 / 0.59 / 107.0).epsilon(1e-12));
    CHECK(narrow["at_length"]["groups"]["e_r"].get<double>() == doctest::Approx(0.986 / 0.861).epsilon(1e-3));
    CHECK_FALSE(narrow["at_length"]["groups"].contains("a_v/g"));
    for (std::size_t i = 0; i < 6; ++i) CHECK(candidates[i]["changes_regime"] == false);
    for (std::size_t i = 6; i < 9; ++i) CHECK(candidates[i]["changes_regime"] == true);
    const auto& heavy = candidates[2];
    CHECK(heavy["law"] == "artificial_mass");
    CHECK(heavy["at_length"]["added_mass_kg"].get<double>() > 0.9 * heavy["at_length"]["mass_kg"].get<double>());
    CHECK(candidates[9]["conflict"]["upper"] == "payload of axis x");
    const std::string text = here.run(laws).out;
    CHECK(text.find("2.874 t (2.798 t added)") != std::string::npos);
    CHECK(text.find("restoring_force: factors, model/prototype") != std::string::npos);

    here.write(
        "design.json",
        R"({"schema": "musim-design/1", "prototype": {"block": ["1.36 m", "2.82 m", "4.25 m"], "height": "161.5 m", "density": "2320 kg/m^3",
        "friction": 0.59}, "materials": ["wood"], "laws": ["restoring_spring"]})");
    const Outcome missing = here.run("design design.json");
    CHECK(missing.exit_code == 3);
    CHECK(missing.has_one_error_line());
    CHECK(missing.err.find("the factor of k_s (stiffness of an interface) is missing") != std::string::npos);
}

TEST_CASE("uncertain values of a design and its table give intervals in every form of the report") {
    const Workplace here;
    const std::string design = "design '" MUSIM_SOURCE_DIR "/examples/design/uncertain.json' ";
    const auto object = here.run(design + "--json").json();
    CHECK(object["uncertainty"]["coverage"] == 0.95);
    CHECK(object["uncertainty"]["inputs"].size() == 11);
    const auto& wood = object["candidates"].at(0);
    const auto& range = wood["ranges"].at(0);
    const auto& smallest = range["uncertainty"]["smallest"];
    CHECK(smallest["value"] == range["smallest"]);
    // L ≥ U (f_P/f)² with 5 % on both coefficients and on f_P
    CHECK(smallest["relative"].get<double>() == relative(std::hypot(std::hypot(0.05, 0.05), 0.1), 1e-12));
    CHECK(smallest["exponents"]["record: peaks 1: highest_frequency"] == 2.0);
    CHECK(smallest["interval"].at(0).get<double>() < range["smallest"].get<double>());
    CHECK(wood["at_length"]["uncertainty"]["groups"]["mu^N"]["relative"] == 0.0);
    CHECK(wood["at_length"]["uncertainty"]["used"].size() == wood["at_length"]["uses"].size());
    const std::string latex = here.run(design + "--format latex").out, markdown = here.run(design + "--format markdown").out;
    for (const std::string& text : {here.run(design).out, markdown, latex}) {
        CHECK(text.find("1/186 to 1/115.1") != std::string::npos);
        CHECK(text.find("0.9296 to 1.227") != std::string::npos);  // mu/tan(alpha)
        CHECK(text.find("prototype: mass (80") != std::string::npos);
    }
    // nothing of it where nothing is uncertain
    const auto certain = here.run("design '" + kExample + "' --json").json();
    CHECK_FALSE(certain.contains("uncertainty"));
    CHECK(here.run("design '" + kExample + "'").out.find("95 %") == std::string::npos);
}

TEST_CASE("samples of an uncertain design say how often it is feasible and which limits govern") {
    const Workplace here;
    here.write("design.json", R"({"schema": "musim-design/1",
        "prototype": {"block": ["1.36 m", "2.82 m", "4.25 m"], "height": "161.5 +/- 1% m", "density": "2320 kg/m^3", "friction": 0.59},
        "limits": {"hall_height": "6 m +/- 5 cm"}, "length": "1/27",
        "materials": [{"preset": "wood", "smallest_edge": "8 mm +/- 2%"}], "laws": ["mu"]})");
    const std::string design = "design design.json --monte-carlo 1000 --seed 5 ";
    const Outcome outcome = here.run(design + "--json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto object = outcome.json();
    CHECK(object["uncertainty"]["monte_carlo"]["seed"] == 5);
    const auto& sampled = object["candidates"].at(0)["monte_carlo"];
    CHECK(sampled["feasible_share"] == 1.0);
    CHECK(sampled["length"].get<double>() == relative(1.0 / 27.0, 1e-15));
    const auto& hall = sampled["limits"].at(0);
    CHECK(hall["limit"] == "hall height");
    CHECK(hall["sets_largest_share"] == 1.0);
    // 161.5 m/27 is 18.5 mm below the hall, with u = 78 mm of both: 40.6 %, four standard errors of 1000 samples are 6.2 %
    CHECK(std::abs(hall["broken_share"].get<double>() - 0.406) < 0.062);
    CHECK(sampled["smallest"]["interval"].at(0) < object["candidates"].at(0)["ranges"].at(0)["smallest"]);
    for (const char* const format : {"text", "markdown", "latex"}) {
        const std::string text = here.run(design + "--format " + format).out;
        CHECK(text.find("1000 samples, normal, seed 5.") != std::string::npos);
        CHECK(text.find("feasible in") != std::string::npos);
    }
    const Outcome certain = here.run("design '" + kExample + "' --monte-carlo 1000");
    CHECK(certain.exit_code == 3);
    CHECK(certain.has_one_error_line());
}

TEST_CASE("a table's uncertain limits are a design's input, and no business of other commands") {
    const Workplace here;
    here.write("table.json", R"({"schema": "musim-table/1", "axes": [{"names": ["x"], "displacement": "1 mm +/- 3 %"}]})");
    here.write("design.json", make_design(""));
    const auto object = here.run("design design.json --json").json();
    CHECK(object["uncertainty"]["inputs"].at(0)["name"] == "table.json: axes 1: displacement");
    // displacement goes with λ_l
    CHECK(object["candidates"].at(0)["ranges"].at(0)["uncertainty"]["largest"]["relative"].get<double>() == relative(0.03, 1e-12));
    const Outcome table = here.run("table synthetic --limits table.json --length 1/25");
    CHECK(table.exit_code == 3);
    CHECK(table.has_one_error_line());
    CHECK(table.err.find("table.json: axes 1: displacement is \"1 mm +/- 3 %\" (+/- makes no sense here") != std::string::npos);
    here.write("design.json", make_design(R"(, "length": "1/25 +/- 1%")"));
    const Outcome chosen = here.run("design design.json");
    CHECK(chosen.exit_code == 3);
    CHECK(chosen.has_one_error_line());
}
