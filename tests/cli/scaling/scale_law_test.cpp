#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

double factor(const nlohmann::json& object, const char* name) { return object["factors"][name].get<double>(); }

const nlohmann::json& quantity(const nlohmann::json& object, const std::string& name) {
    for (const auto& entry : object["quantities"]) {
        if (entry["name"] == name) return entry;
    }
    return object["quantities"].at(object["quantities"].size());
}

}  // namespace

TEST_CASE("scale solves a shipped law, with formulas, states and the prototype's values in the model") {
    const Outcome outcome = Workplace().run("scale --law true_replica --set l=1/25 --value 'E=29.175 GPa' --json");
    REQUIRE(outcome.exit_code == 0);
    const auto object = outcome.json();
    CHECK(object["law"]["name"] == "true_replica");
    CHECK(object["chosen"]["l"] == 1.0 / 25.0);
    // two roundings
    CHECK(factor(object, "E") == doctest::Approx(0.04).epsilon(1e-15));
    CHECK(quantity(object, "E")["formula"] == "l*rho*g");
    CHECK(quantity(object, "E")["state"] == "solved");
    CHECK(quantity(object, "E")["model"] == "1.167 GPa");
    CHECK(quantity(object, "t")["formula"] == "sqrt(l/g)");
    CHECK(quantity(object, "t")["latex"] == "\\sqrt{\\frac{\\lambda_{l}}{\\lambda_{g}}}");
    CHECK(quantity(object, "t")["exponents"] == nlohmann::json({{"l", "1/2"}, {"g", "-1/2"}}));
    CHECK(quantity(object, "g")["default"] == true);
    CHECK(object["free"]["count"] == 0);
    CHECK(object["groups"]["E/(rho*g*l)"] == 1.0);
    CHECK(object["distortions"].empty());
}

// 432,240 kg required and 414,896 kg added of the tower at 1:25, whose blocks weigh 17,343.6 kg
TEST_CASE("scale reports the mass to add") {
    const Workplace here;
    const auto object =
        here.run("scale --law artificial_mass --set l=1/25 --set m_s=17343.6/2.701509e8 --value 'm=2.701509e8 kg' --json").json();
    CHECK(quantity(object, "m")["model"] == "432.241 t");
    CHECK(object["additions"][0]["name"] == "m_added");
    CHECK(object["additions"][0]["model"] == "414.898 t");
    CHECK(object["overruled"] == nlohmann::json({"rho_s"}));
    const std::string text = here.run("scale --law artificial_mass --set l=1/25 --value 'm_s=2.701509e8 kg'").out;
    CHECK(text.find("m_added: l^2*E/g - l^3*rho_s = 0.001536 of the prototype's m_s, 414.952 t") != std::string::npos);
}

TEST_CASE("the law of a result is a law file that gives the same result") {
    const Workplace here;
    for (const char* arguments : {"--law artificial_mass --set l=1/25", "--law mu_vertical_distortion --set H=1/25 --set mu=0.3",
                                  "--law restoring_mixed --set l=1/25 --watch 'v/sqrt(E/rho)' --define E:GPa",
                                  "--set l=1/25 --set g=1 --hold 'v/sqrt(g*l)' --watch 'rho*g*l/E' --define E:GPa"}) {
        CAPTURE(arguments);
        const auto first = here.run(std::string("scale --json ") + arguments).json();
        here.write("law.json", first["law"].dump());
        here.write("result.json", first.dump());
        for (const char* file : {"law.json", "result.json"}) {
            std::string again = std::string("scale --json --law ") + file;
            for (const auto& [name, value] : first["chosen"].items()) again += " --set " + name + "=" + value.dump();
            auto second = here.run(again).json();
            for (const char* key : {"law", "chosen", "factors", "groups", "additions", "free"}) {
                CHECK_MESSAGE(second[key] == first[key], key);
            }
        }
    }
}

TEST_CASE("scale solves products held on the command line, with quantities of mechanics by their names") {
    const Workplace here;
    const auto object =
        here.run("scale --define E:GPa --set l=1/16 --set g=1 --set E=1 --hold 'v/sqrt(g*l)' --hold 'v*t/l' --watch 'rho*g*l/E' --json")
            .json();
    CHECK(factor(object, "v") == 0.25);
    CHECK(factor(object, "t") == 0.25);
    CHECK(object["factors"].size() == 6);
    CHECK(object["free"]["count"] == 1);
    CHECK(object["free"]["among"] == nlohmann::json({"rho"}));
    CHECK(object["groups"]["rho*g*l/E"].is_null());
    CHECK(object["watched"][0]["formula"] == "l*rho*g/E");
    // --length and the others are l, mu, g, rho
    const auto by_options = here.run("scale --length 1/16 --gravity 4 --hold 'v/sqrt(g*l)' --json").json();
    CHECK(factor(by_options, "v") == 0.5);
}

TEST_CASE("a law of one's own extends a shipped one") {
    const Workplace here;
    here.write("mine.json", R"-({"schema": "musim-law/1", "name": "mine", "title": "springs", "extends": "mechanics",
        "quantities": [{"name": "k_0", "unit": "kN/m", "meaning": "spring"}], "chosen": [{"name": "l"}, {"name": "k_0", "default": "1/4"}],
        "held": ["k_0*t^2/m"]})-");
    const auto object = here.run("scale --law mine.json --set l=1/4 --set rho=4 --json").json();
    // λ_m = 4/64, λ_t = √(λ_m/λ_k)
    CHECK(factor(object, "t") == 0.5);
    CHECK(factor(object, "a") == 1.0);
}

TEST_CASE("scale writes laws as text, Markdown and LaTeX, and lists those it has") {
    const Workplace here;
    const std::string text = here.run("scale --law froude --set l=1/25").out;
    CHECK(text.find("sqrt(l/g)") != std::string::npos);
    CHECK(text.find("E/(rho*g*l)") != std::string::npos);
    CHECK(text.find("assumes: rigid blocks") != std::string::npos);
    CHECK(here.run("scale --law froude --set l=1/25 --format markdown").out.find("|---|---|") == std::string::npos);
    CHECK(here.run("scale --law froude --set l=1/25 --format markdown").out.find("| --- | --- |") != std::string::npos);
    const std::string latex = here.run("scale --set l=1/25 --format latex").out;
    CHECK(latex.find("\\begin{align}") != std::string::npos);
    CHECK(latex.find("\\lambda_{v} &= \\sqrt{\\lambda_{l}\\,\\lambda_{\\mu}\\,\\lambda_{g}} = 0.2") != std::string::npos);
    const std::string list = here.run("scale --laws").out;
    for (const char* law : {"froude", "cauchy", "true_replica", "artificial_mass", "centrifuge", "mu", "restoring_force",
                            "gravity_distorted", "mu_vertical_distortion", "exact"}) {
        CHECK_MESSAGE(list.find(std::string("\n") + law + " ") != std::string::npos, law);
    }
    CHECK(here.run("scale --laws --json").json()["laws"].size() >= 15);
}

TEST_CASE("scale names the factors and products in conflict and what to release or to watch") {
    const Outcome outcome = Workplace().run("scale --law froude --set l=1/25 --set v=1/4 --set g=1");
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.err ==
          "musim: error: law froude: l = 0.04, g = 1, v = 0.25 cannot be where v/sqrt(g*l) is held (v/sqrt(l*g) = 1.25, not 1); "
          "release one "
          "of l, g, v, watch v/sqrt(g*l) instead, or choose another law\n");
    CHECK(outcome.out.empty());

    // the way out that it names
    const auto watched = Workplace().run("scale --law froude --set l=1/25 --set v=1/4 --set g=1 --watch 'v/sqrt(g*l)' --json").json();
    CHECK(watched["groups"]["v/sqrt(g*l)"].get<double>() == doctest::Approx(1.25).epsilon(1e-15));
    CHECK(watched["held"].empty());
}

TEST_CASE("laws as data are refused in one line when they cannot be, exit code 3, and bad usage with 2") {
    const Workplace here;
    here.write("broken.json", "{");
    here.write("two_lengths.json",
               R"({"schema": "musim-law/1", "name": "two_lengths", "title": "t", "quantities": [{"name": "H", "unit": "m"},
               {"name": "b", "unit": "m"}], "chosen": [{"name": "H"}, {"name": "b"}]})");
    here.write("key.json", R"({"schema": "musim-law/1", "name": "n", "title": "t", "quantity": []})");
    for (const char* arguments :
         {"scale --law nonsense --set l=1/25", "scale --law missing.json --set l=1/25", "scale --law broken.json --set l=1/25",
          "scale --law key.json --set l=1/25", "scale --law froude --set x=1", "scale --law froude --set rho=1",
          "scale --law froude --set l=1/25 --hold v/l", "scale --set l=1/25 --hold 'v/sqrt(g*l)/x'",
          "scale --set l=1/25 --set x=1 --hold 'v/sqrt(g*l)'", "scale --length 1/25 --set l=1/25",
          "scale --law exact --set l=1/25 --set mu=2", "rescale synthetic --length 1/25 --law two_lengths.json -o x.csv",
          "rescale synthetic --length 1/25 --law restoring_force -o x.csv",
          "table synthetic --limits " MUSIM_SOURCE_DIR "/examples/tables/outdoor.json --length 1/25 --law restoring_force"}) {
        const Outcome outcome = here.run(arguments);
        CHECK_MESSAGE(outcome.exit_code == 3, arguments, " gave ", outcome.out, outcome.err);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
        CHECK_MESSAGE(outcome.out.empty(), arguments);
    }
    for (const char* arguments :
         {"scale --law froude --set l=0", "scale --law froude --set l=a", "scale --law froude --set l=1/25 --value 'v=3 kg'",
          "scale --set l", "scale --set =3", "scale --set l=1/25 --define E", "scale --law froude --format html",
          "scale --law froude --set l=1/25 --slenderness 0.3"}) {
        const Outcome outcome = here.run(arguments);
        CHECK_MESSAGE(outcome.exit_code == 2, arguments, " gave ", outcome.err);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
    }
    CHECK_FALSE(here.has("x.csv"));
}

// the model of a centrifuge at 1:25: λ_t = 1/25, λ_a = 25
TEST_CASE("records are rescaled by laws as data as by those of always") {
    const Workplace here;
    const auto object = here.run("rescale synthetic --length 1/25 --law centrifuge -o centrifuge.csv --json").json();
    CHECK(object["law"] == "centrifuge");
    CHECK(object["factors"]["time"].get<double>() == doctest::Approx(0.04).epsilon(1e-15));
    CHECK(object["chosen"]["gravity"].get<double>() == doctest::Approx(25.0).epsilon(1e-15));
    REQUIRE(here.run("rescale synthetic --length 1/25 --gravity 25 --law exact -o exact.csv").exit_code == 0);
    const auto peak = [&](const char* file) {
        return here.run(std::string("record info ") + file + " --json").json()["components"][0]["pga_g"].get<double>();
    };
    // samples are written to the last digit
    CHECK(peak("centrifuge.csv") == doctest::Approx(peak("exact.csv")).epsilon(1e-13));

    // a default that the given factors overrule is said: 1:25 in 20 g keeps E/(rho g l) in a softer solid only
    const Outcome softer = here.run("rescale synthetic --length 1/25 --gravity 20 --law centrifuge -o softer.csv");
    CHECK(softer.exit_code == 0);
    CHECK(softer.err == "musim: warning: law centrifuge: E is 0.8 by the factors given, not its default\n");

    const auto distorted = here.run("rescale synthetic --length 1/25 --law gravity_distorted --set a=1/2 -o distorted.csv --json").json();
    CHECK(distorted["factors"]["acceleration"] == 0.5);
}

// similitude by vertical distortion: t √(V/G), horizontally U G, vertically G
TEST_CASE("a law whose heights and widths scale apart rescales a record, its vertical component by its own factor") {
    const Workplace here;
    std::string text = "# musim ground motion 1\n# quantity: acceleration\n# unit: m/s^2\n# start_s: 0\n# dt_s: 0.01\ntime_s,360,Up\n";
    for (int i = 0; i <= 400; ++i) {
        const double t = 0.01 * i;
        text += std::to_string(t) + "," + std::to_string(std::sin(6.0 * t)) + "," + std::to_string(0.5 * std::sin(9.0 * t)) + "\n";
    }
    here.write("both.csv", text);
    const std::string scales = " --length 1/107 --friction 0.18/0.59 ";
    const auto peaks = [](const nlohmann::json& object, const char* scale) {
        return std::pair(object["components"][0][scale]["pga_g"].get<double>(), object["components"][1][scale]["pga_g"].get<double>());
    };
    for (const char* law : {"mu", "mu_vertical_distortion"}) {
        const auto object = here.run("rescale both.csv" + scales + "--law " + law + " -o model.csv --json").json();
        CAPTURE(object.dump());
        REQUIRE(object["components"][1]["vertical"] == true);
        const auto [horizontal, vertical] = peaks(object, "prototype");
        const auto [model_horizontal, model_vertical] = peaks(object, "model");
        CHECK(model_horizontal == doctest::Approx(horizontal * 0.18 / 0.59).epsilon(1e-12));
        CHECK(model_vertical == doctest::Approx(vertical).epsilon(1e-12));
        CHECK(object["factors"]["acceleration_vertical"].get<double>() == doctest::Approx(1.0).epsilon(1e-14));
    }
    const Outcome given = here.run("rescale both.csv" + scales + "--law mu_vertical_distortion -o model.csv");
    CHECK(given.out.find("Law mu_vertical_distortion: height H 0.009345794, width 0.002851259, time 0.09667365") == 0);
    CHECK(
        given.out.find("Vertical component Up: displacement 0.009345794, velocity 0.09667365, acceleration 1, which keeps a_vertical/g") !=
        std::string::npos);
    // of a vertical component, a/g alone is reported
    const auto groups =
        here.run("rescale both.csv" + scales + "--height 161.5m --friction-prototype 0.59 --slenderness 0.32 -o m.csv --json")
            .json()["uncertainty"]["components"];
    CHECK(groups[0]["structure"].contains("mu^N"));
    CHECK(groups[1]["structure"].size() == 1);
    CHECK(groups[1]["structure"].contains("a_vertical/g"));
    // uncertain factors: u(λ_t) is half of u(λ_H), relative
    const auto uncertain =
        here.run("rescale both.csv --length 1/107+/-1% --friction 0.18/0.59 --law mu_vertical_distortion -o m.csv --json").json();
    const auto time = uncertain["uncertainty"]["factors"]["time"];
    CHECK(time["standard_uncertainty"].get<double>() / time["value"].get<double>() == doctest::Approx(0.005).epsilon(1e-9));
}

TEST_CASE("a law that keeps the groups of rigid blocks names the elasticity that the same solid does not keep") {
    const Workplace here;
    // E unchanged, lambda_rho = lambda_g = 1: E/(rho g l) grows as 1/lambda_l
    const std::string said = here.run("scale --length 1/25").out;
    CHECK(said.find("No distortion: every known group of rigid blocks in contact is kept.") != std::string::npos);
    CHECK(said.find("in the same solid E/(rho*g*l) is off by a factor 25; it is kept by a solid with 0.04 times the E") !=
          std::string::npos);
    CHECK(here.run("scale --length 1/25 --json").json().at("solid_elasticity").get<double>() == doctest::Approx(25.0).epsilon(1e-12));
    // a centrifuge keeps it
    CHECK(here.run("scale --length 1/25 --gravity 25").out.find("E/(rho*g*l)") == std::string::npos);
    CHECK(here.run("rescale synthetic --length 1/25 -o model.csv").out.find("is off by a factor 25") != std::string::npos);
}

TEST_CASE("files nested without end and values without end are refused in a short line") {
    const Workplace here;
    const std::string nested = std::string(100'000, '[') + std::string(100'000, ']');
    here.write("law.json", R"({"schema": "musim-law/1", "name": "x", "title": "t", "held": [)" + nested + "]}");
    here.write("scene.json", R"({"schema": "musim-scene/1", "name": )" + nested + "}");
    here.write("big.json", R"({"schema": "musim-scene/1", "name": 1e999})");
    const std::string nines(500, '9');
    const std::vector<std::string> commands{"scale --law law.json --length 1/25",
                                            "pi law.json",
                                            "design law.json",
                                            "run scene.json",
                                            "run big.json",
                                            "scale --length " + nines,
                                            "run scene.json --threads " + nines,
                                            "scale --length 1" + std::string(500, 'x'),
                                            "record process synthetic -o a.csv --recipe law.json"};
    for (const std::string& command : commands) {
        const Outcome outcome = here.run(command);
        CAPTURE(command.substr(0, 60));
        CHECK(outcome.exit_code >= 2);
        CHECK(outcome.exit_code <= 3);
        CHECK(outcome.has_one_error_line());
        CHECK(outcome.err.size() < 400);
        CHECK(outcome.err.find("internal") == std::string::npos);
    }
    // a page of what can be shown
    const Outcome page = here.run("report law.json -o page.html");
    CHECK((page.exit_code == 0 || page.exit_code == 3));
}
