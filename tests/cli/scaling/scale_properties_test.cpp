#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "tests/cli/program.hpp"
#include "tests/support/relative.hpp"

using namespace musim::cli;
using musim::lsdem::tests::relative;

namespace {

std::string example(const std::string& name) { return "'" MUSIM_SOURCE_DIR "/examples/properties/" + name + ".json'"; }

/// The group's entry; null when there is none.
nlohmann::json find(const nlohmann::json& entries, const char* key, const std::string& name, const nlohmann::json& direction = {}) {
    for (const auto& entry : entries) {
        if (entry[key] == name && entry["direction"] == direction) return entry;
    }
    return {};
}

constexpr const char* kProperties = R"({"schema": "musim-properties/1",
    "prototype": {"preset": "concrete", "block": ["1.36 m", "2.82 m", "4.25 m"], "layers": 38},
    "model": {"preset": "wood", "blocks_per_layer": 188})";

}  // namespace

TEST_CASE("the concrete model at 1:25 keeps the motion and is five times too fast in structural speed") {
    const Workplace here;
    const Outcome outcome = here.run("scale --length 1/25 --law froude --properties " + example("concrete") + " --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto object = outcome.json();
    for (const char* key : {"law", "factors", "groups", "distortions", "properties"}) CHECK(object.contains(key));
    CHECK(object["factors"]["time"] == 0.2);
    const auto speed = find(object["distortions"], "group", "S_e^N");
    CHECK(speed["factor"].get<double>() == relative(5.0, 1e-12));
    CHECK(speed["prototype"].get<double>() == relative(113.2, 2e-3));  // printed for measured blocks
    CHECK(speed["severity"] == "warning");
    CHECK(speed["required"] == false);
    CHECK(speed["sources"] == nlohmann::json{"Rosakis21", "derived"});
    CHECK(find(object["distortions"], "group", "kappa_n")["severity"] == "note");
    CHECK(object["distortions"].size() == 4);
    // similarity of speed asks for k by λ_ρ λ_l² = 1/625; the same solid has 1/25
    const auto& shear = object["properties"]["speeds"]["shear_stiffness_n_m"];
    CHECK(shear["required_factor"].get<double>() == relative(1.0 / 625.0, 1e-12));
    CHECK(shear["factor"].get<double>() == relative(1.0 / 25.0, 1e-12));
}

TEST_CASE("the aluminium model changes regime, with the statement and its sources") {
    const Workplace here;
    const auto object = here.run("scale --length 1/107 --law mu --properties " + example("aluminium") + " --json").json();
    CHECK(object["factors"]["friction"] == 0.18 / 0.59);
    CHECK(1.0 / object["factors"]["time"].get<double>() == relative(5.713499, 1e-7));
    const auto regime = find(object["properties"]["regimes"], "topic", "sliding or rocking first", "thin");
    CHECK(regime["severity"] == "error");
    CHECK(regime["statement"].get<std::string>().find(
              "mu/tan(alpha) goes from 1.844 (rocking can start first) to 0.5625 (sliding first)") == 0);
    CHECK(regime["sources"] == nlohmann::json{"ShentonJones91", "Shenton96"});
    CHECK(find(object["properties"]["regimes"], "topic", "sliding or rocking first", "wide")["severity"].is_null());
    CHECK(find(object["properties"]["regimes"], "topic", "first motion", "thin")["statement"] ==
          "under the peak a single block rocks in the prototype, rests in the model");
    CHECK(find(object["distortions"], "group", "mu/tan(alpha)", "thin")["severity"] == "error");
    CHECK(find(object["distortions"], "group", "omega/p", "wide")["factor"].get<double>() == relative(0.5523, 1e-4));
    // thin block of the papers
    const auto& thin = object["properties"]["rocking"]["thin"];
    CHECK(thin["half_diagonal_m"]["prototype"].get<double>() == relative(2.2311, 2.3e-5));
    CHECK(thin["angle_deg"]["prototype"].get<double>() == relative(17.745, 2.9e-5));
    CHECK(thin["frequency_parameter_rad_s"]["prototype"].get<double>() == relative(1.8156, 2.8e-5));
    CHECK(thin["frequency_parameter_rad_s"]["factor"].get<double>() == relative(10.34408, 5e-7));  // √107
    CHECK(thin["energy_restitution"]["prototype"].get<double>() == relative(0.7407, 6.8e-5));
}

TEST_CASE("the wooden model stays in its regime, and the table's band is reported") {
    const Workplace here;
    const auto object = here.run("scale --length 1/107 --properties " + example("wood") + " --json").json();
    for (const auto& regime : object["properties"]["regimes"]) CHECK(regime["severity"] != "error");
    CHECK(find(object["properties"]["regimes"], "topic", "table")["severity"] == "warning");  // 106.9 Hz of 100 Hz
    CHECK(object["properties"]["motion"]["pga_m_s2"]["model"].get<double>() == relative(0.5456441 * 9.80665, 1e-6));
    CHECK(object["properties"]["motion"]["pgv_m_s"]["model"].get<double>() == relative(0.04235632, 1e-6));
    CHECK(find(object["properties"]["groups"], "group", "mu^N")["prototype"].get<double>() == relative(0.01387054, 5e-7));
    CHECK(object["properties"]["speeds"]["normal_wave_speed_m_s"]["model"].get<double>() == relative(2110.0, 1e-3));
}

TEST_CASE("the report is text or Markdown, with the same numbers") {
    const Workplace here;
    const Outcome plain = here.run("scale --length 1/107 --properties " + example("aluminium")),
                  markdown = here.run("scale --length 1/107 --format markdown --properties " + example("aluminium"));
    REQUIRE(plain.exit_code == 0);
    REQUIRE(markdown.exit_code == 0);
    for (const Outcome* const outcome : {&plain, &markdown}) {
        CHECK(outcome->out.find("aluminium for concrete, law mu: length 1/107, friction 0.3050847") != std::string::npos);
        CHECK(outcome->out.find("7 regimes: 3 errors, 0 warnings, 0 notes; 24 groups: 2 errors") != std::string::npos);
        CHECK(outcome->out.find("the peak lifts no block") != std::string::npos);
        CHECK(outcome->out.find("Not given by prototype or model: ") != std::string::npos);
        CHECK(outcome->out.find("510 MN/m") != std::string::npos);
    }
    CHECK(markdown.out.find("## Groups of rocking\n\n| group | direction |") != std::string::npos);
    CHECK(plain.out.find("---") == std::string::npos);
}

TEST_CASE("factors follow from the properties, and the same ones may be typed, others contradict") {
    const Workplace here;
    here.write("properties.json", std::string(kProperties) + "}");
    const auto alone = here.run("scale --length 1/107 --properties properties.json --json").json();
    CHECK(alone["factors"]["density"] == 800.0 / 2320.0);
    CHECK(here.run("scale --length 1/107 --friction 1.068 --density 800/2320 --gravity 1 --properties properties.json --json").json() ==
          alone);
    const Outcome contradiction = here.run("scale --length 1/107 --friction 0.3 --properties properties.json");
    CHECK(contradiction.exit_code == 3);
    CHECK(contradiction.err ==
          "musim: error: properties.json: --friction is 0.3, but prototype and model have the ratio 1.0678; leave the option out, or "
          "correct the "
          "properties\n");
    CHECK(here.run("scale --length 1/107 --gravity 2 --properties properties.json").exit_code == 3);
    CHECK(here.run("scale --length 1/107 --density 2 --properties properties.json").exit_code == 3);
    // law exact does not admit another friction
    CHECK(here.run("scale --length 1/107 --law exact --properties properties.json").err.find("choose another law") != std::string::npos);
}

TEST_CASE("records and tables are looked for beside the properties, and agree with their own commands") {
    const Workplace here;
    here.shell("mkdir plans");
    here.write("plans/table.json", R"({"schema": "musim-table/1", "axes": [{"names": ["x"], "highest_frequency": "1 Hz"}]})");
    here.write("plans/properties.json",
               std::string(kProperties) + R"(, "motion": {"file": "synthetic"}, "table": {"file": "table.json", "axis": "x"}})");
    const Outcome outcome = here.run("scale --length 1/107 --properties plans/properties.json --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto motion = outcome.json()["properties"]["motion"];
    const auto info = here.run("record info synthetic --json").json();
    const auto& component = info.contains("components") ? info["components"].at(0) : info["records"].at(0);
    CHECK(motion["pga_m_s2"]["prototype"].get<double>() == relative(component["pga_g"].get<double>() * 9.80665, 1e-12));
    CHECK(motion["pgv_m_s"]["prototype"].get<double>() == relative(component["pgv_cm_s"].get<double>() / 100.0, 1e-12));
    CHECK(motion["pgd_m"]["prototype"].get<double>() == relative(component["pgd_cm"].get<double>() / 100.0, 1e-12));
    CHECK(motion["predominant_period_s"]["prototype"] == component["predominant_period_s"]);
    CHECK(motion["pulse_period_s"]["prototype"] == component["pulse_period_s"]);
    CHECK(find(outcome.json()["properties"]["regimes"], "topic", "table")["severity"] == "error");

    // what the model was given, here the record by the law: every group of the motion is kept
    REQUIRE(here.run("rescale synthetic --length 1/107 --friction 0.63/0.59 -o plans/model.csv").exit_code == 0);
    here.write("plans/both.json",
               std::string(kProperties) + R"(, "motion": {"file": "synthetic"}, "model_motion": {"file": "model.csv"}})");
    const auto both = here.run("scale --length 1/107 --properties plans/both.json --json").json()["properties"]["groups"];
    for (const char* group : {"a/(mu*g)", "mu^N", "PGD/l"}) {
        // the record's file has ten digits
        CHECK(find(both, "group", group)["factor"].get<double>() == relative(1.0, 1e-6));
    }
}

TEST_CASE("the report of properties is written in LaTeX, its signs escaped") {
    const Workplace here;
    here.write("properties.json", std::string(kProperties) + "}");
    const std::string latex = here.run("scale --length 1/107 --properties properties.json --format latex").out;
    CHECK(latex.starts_with("\\section*{"));
    CHECK(latex.find("\\subsection*{Groups of friction}\n\\begin{longtable}") != std::string::npos);
    CHECK(latex.find("kappa\\_n") != std::string::npos);
    CHECK(latex.find(" kappa_n") == std::string::npos);
}

TEST_CASE("wrong input to the properties is reported in one line") {
    const Workplace here;
    here.write("properties.json", std::string(kProperties) + "}");
    here.write("lost.json", std::string(kProperties) + R"(, "motion": {"file": "lost.v1"}})");
    here.write("colour.json", std::string(kProperties) + R"(, "colour": 1})");
    const auto error = [&](const std::string& arguments, int code) {
        const Outcome outcome = here.run("scale --length 1/107 " + arguments);
        CHECK(outcome.exit_code == code);
        CHECK(outcome.has_one_error_line());
        CHECK(outcome.out.empty());
        return outcome.err;
    };
    CHECK(error("--properties none.json", 3).find("none.json: cannot be read") != std::string::npos);
    CHECK(error("--properties lost.json", 3).find("lost.v1") != std::string::npos);
    CHECK(error("--properties colour.json", 3) ==
          "musim: error: colour.json: \"colour\" is none of its settings; remove it, or correct its name\n");
    error("--properties properties.json --json --format markdown", 2);
    error("--properties properties.json --slenderness 0.3", 2);
    error("--properties properties.json --friction-prototype 0.3", 2);
    error("--properties properties.json --format html", 2);
    error("--unit g", 2);
    CHECK(here.run("scale --length 0 --properties properties.json").exit_code == 2);
}

TEST_CASE("uncertain properties give intervals on groups and say which regimes are open") {
    const Workplace here;
    const std::string scale = "scale --length 1/107 --properties " + example("uncertain");
    const Outcome outcome = here.run(scale + " --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto object = outcome.json();
    CHECK(object["uncertainty"]["inputs"].size() == 10);
    CHECK(object["uncertainty"]["factors"]["friction"]["relative"].get<double>() == relative(std::hypot(0.05, 0.05), 1e-12));
    const auto slip = find(object["properties"]["groups"], "group", "mu^N");
    // u(μ^N)² = u(v)² + (u(l)² + u(μ)²)/4, l by the height of the model's blocks
    CHECK(slip["uncertainty"]["model"]["relative"].get<double>() ==
          relative(std::hypot(0.4 / 42.4, 0.5 * std::hypot(0.05 / 39.78, 0.05)), 1e-12));
    CHECK(slip["uncertainty"]["prototype"]["interval"].size() == 2);
    const auto open = find(object["properties"]["regimes"], "topic", "sliding or rocking first", "wide");
    CHECK(open["limit_within_uncertainty"] == true);
    CHECK(open["severity"] == "warning");
    CHECK(find(object["properties"]["regimes"], "topic", "sliding or rocking first", "thin")["limit_within_uncertainty"] == false);
    for (const char* const format : {"text", "markdown", "latex"}) {
        const std::string text = here.run(scale + " --format " + format).out;
        CHECK(text.find("times its limit (95") != std::string::npos);
        CHECK(text.find("0.9296 to 1.227") != std::string::npos);
        CHECK(text.find("motion: predominant") != std::string::npos);
    }
    // nothing of it where nothing is uncertain
    const Outcome certain = here.run("scale --length 1/107 --properties " + example("wood") + " --json");
    CHECK_FALSE(certain.json().contains("uncertainty"));
    CHECK(certain.out.find("limit_within") == std::string::npos);
    const Outcome admitted = here.run("scale --length 1/107 --law exact --properties " + example("uncertain"));
    CHECK(admitted.exit_code == 3);
    CHECK(admitted.has_one_error_line());
}

TEST_CASE("samples of uncertain properties give intervals and the share in which each regime is another") {
    const Workplace here;
    const std::string scale = "scale --length 1/107 --properties " + example("uncertain") + " --monte-carlo 2000 --seed 3";
    const Outcome outcome = here.run(scale + " --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto object = outcome.json();
    CHECK(object["uncertainty"]["monte_carlo"]["samples"] == 2000);
    CHECK(object["uncertainty"]["factors"]["time"].contains("monte_carlo"));
    const auto slip = find(object["properties"]["groups"], "group", "mu^N")["uncertainty"]["model"];
    // the standard error of a mean is sd/√N; what is beyond first order adds 3/8 u(μ)² = 0.1 % of the value, far below sd
    const auto mean = slip["monte_carlo"]["mean"].get<double>(), value = slip["value"].get<double>();
    const auto deviation = slip["standard_uncertainty"].get<double>();
    CHECK(std::abs(mean - 1.00094 * value) < 4.0 * deviation / std::sqrt(2000.0));
    const auto share = [&](const char* topic, const char* direction) {
        return find(object["properties"]["regimes"], "topic", topic, direction)["share_elsewhere"].get<double>();
    };
    CHECK(share("sliding or rocking first", "wide") > 0.1);
    CHECK(share("sliding or rocking first", "thin") == 0.0);
    CHECK(here.run(scale + " --json").out == outcome.out);
    CHECK(here.run(scale + " --distribution uniform --json").out != outcome.out);
    for (const char* const format : {"text", "markdown", "latex"}) {
        const std::string text = here.run(scale + " --format " + format).out;
        CHECK(text.find("2000 samples, normal, seed 3.") != std::string::npos);
        CHECK(text.find("another in") != std::string::npos);
    }
    const Outcome certain = here.run("scale --length 1/107 --monte-carlo 2000 --properties " + example("wood"));
    CHECK(certain.exit_code == 3);
    CHECK(certain.has_one_error_line());
}

TEST_CASE("properties go by every law as data, from the file or typed") {
    const Workplace here;
    const std::string both =
        R"({"schema": "musim-properties/1", "prototype": {"preset": "concrete", "block": ["1.36 m", "2.82 m", "4.25 m"],
        "layers": 38}, "model": {"preset": "concrete"}, "motion": {"acceleration": "0.5 g"})";
    here.write("properties.json", both + "}");
    here.write("distorted.json", both + R"(, "law": {"law": "gravity_distorted", "set": {"a": 2}}})");
    here.write("uneven.json", both + R"(, "law": "mu_vertical_distortion"})");
    const auto typed = here.run("scale --length 1/25 --law gravity_distorted --set a=2 --properties properties.json --json");
    REQUIRE_MESSAGE(typed.exit_code == 0, typed.err);
    CHECK(typed.json()["law"] == "gravity_distorted");
    CHECK(find(typed.json()["properties"]["groups"], "group", "a/g")["factor"].get<double>() == relative(2.0, 1e-12));
    CHECK(here.run("scale --length 1/25 --properties distorted.json --json").json() == typed.json());
    const auto replica = here.run("scale --length 1/25 --law true_replica --properties properties.json --json").json();
    const auto rigidity = find(replica["properties"]["groups"], "group", "kappa_n");
    CHECK(rigidity["required"] == true);  // E/(rho g l) is held, and the same solid does not keep it
    CHECK(rigidity["factor"].get<double>() == relative(25.0, 1e-12));
    const auto error = [&](const std::string& arguments, int code) {
        const Outcome outcome = here.run("scale --length 1/25 " + arguments);
        CHECK(outcome.exit_code == code);
        CHECK(outcome.has_one_error_line());
        CHECK(outcome.out.empty());
        return outcome.err;
    };
    CHECK(error("--properties uneven.json", 3).find("uneven.json: law mu_vertical_distortion: it settles no single length l (") !=
          std::string::npos);
    CHECK(error("--properties distorted.json --law froude", 3) ==
          "musim: error: distorted.json: its law is gravity_distorted, and --law froude was typed, too; leave one out\n");
    CHECK(error("--properties distorted.json --set a=3", 3).find("and --set a=3 was typed, too") != std::string::npos);
    CHECK(error("--properties properties.json --hold 'v/sqrt(g*l)'", 2).find("--properties") != std::string::npos);
}
