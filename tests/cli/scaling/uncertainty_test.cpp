#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

const std::string kWood = "--length 1/107 --friction '(0.63+/-5%)/(0.59+/-5%)' ";

/// u of λ_μ with 5 % on each coefficient.
const double kFrictionShare = std::sqrt(2.0) * 0.05;

double relative_of(const nlohmann::json& result) { return result["relative"].get<double>(); }

}  // namespace

TEST_CASE("scale reports the uncertainty of factors and groups beside the values, which stay as they are") {
    const Workplace here;
    const auto plain = here.run("scale --length 1/107 --friction 0.63/0.59 --json").json();
    auto object = here.run("scale " + kWood + "--json").json();
    CHECK_FALSE(plain.contains("uncertainty"));
    const auto uncertainty = object["uncertainty"];
    CHECK(relative_of(uncertainty["factors"]["friction"]) == doctest::Approx(kFrictionShare).epsilon(1e-12));
    CHECK(relative_of(uncertainty["factors"]["time"]) == doctest::Approx(0.5 * kFrictionShare).epsilon(1e-12));
    CHECK(uncertainty["factors"]["time"]["exponents"]["friction_model"] == -0.5);
    CHECK(relative_of(uncertainty["groups"]["mu^N"]) == 0.0);
    CHECK(relative_of(uncertainty["groups_as_shaken"]["mu^N"]) == doctest::Approx(0.5 * kFrictionShare).epsilon(1e-12));
    CHECK(uncertainty["inputs"].size() == 2);
    object.erase("uncertainty");
    CHECK(object == plain);

    const Outcome text = here.run("scale " + kWood);
    CHECK(text.out.find("7.07 %") != std::string::npos);
    CHECK(text.out.find("3.54 %") != std::string::npos);
}

TEST_CASE("the plain laws report the same in every form") {
    const Workplace here;
    const std::string structure = " --friction-prototype 0.59 --slenderness 0.32";
    for (const std::string& arguments :
         {"--length 1/107 --friction 0.63/0.59" + structure, "--length 1/25 --law froude --gravity 25" + structure,
          "--length 1/25 --law exact" + structure, "--length 1/25 --law cauchy" + structure,
          kWood + "--pga 0.511g --slenderness 0.32 --monte-carlo 2000"}) {
        CAPTURE(arguments);
        const auto object = here.run("scale --json " + arguments).json();
        for (const char* const format : {"text", "markdown", "latex"}) {
            CAPTURE(format);
            const Outcome outcome = here.run("scale " + arguments + " --format " + format);
            REQUIRE(outcome.exit_code == 0);
            CHECK(outcome.err.empty());
            for (const auto& distortion : object["distortions"]) {
                const std::string effect = distortion["effect"].get<std::string>();
                CHECK_MESSAGE(outcome.out.find(effect.substr(0, effect.find_first_of("<>=_%"))) != std::string::npos, effect);
            }
            for (const auto& factor : object["factors"].items()) {
                const std::string number = fmt::format("{:.7g}", factor.value().get<double>());
                CHECK_MESSAGE(outcome.out.find(number) != std::string::npos, factor.key(), " = ", number);
            }
            if (object.contains("measures")) CHECK(outcome.out.find("pga, model") != std::string::npos);
        }
    }
    CHECK(here.run("scale --length 1/25 --format markdown").out.find("| --- | --- |") != std::string::npos);
    CHECK(here.run("scale --length 1/25 --format latex").out.find("\\begin{longtable}") != std::string::npos);
    CHECK(here.run("scale --laws --format markdown").out.find("| froude | ") != std::string::npos);
}

TEST_CASE("an uncertain factor is read in all its forms") {
    const Workplace here;
    for (const char* form :
         {"1.07+/-0.0535", "\"1.07 +/- 5%\"", "1.07±0.0535", "\"(1.07+/-5%)\"", "\"(0.63+/-4%)/(0.59+/-3%)\"", "107/100+/-5%"}) {
        CAPTURE(form);
        const auto object = here.run(std::string("scale --length 1/25 --json --friction ") + form).json();
        CHECK(relative_of(object["uncertainty"]["factors"]["friction"]) == doctest::Approx(0.05).epsilon(1e-12));
    }
}

TEST_CASE("slenderness without the prototype's friction is refused as of no use") {
    const Workplace here;
    const std::string command = "scale --length 1/25 --slenderness 0.32 --friction ";
    CHECK(here.run(command + "0.18/0.59").err.find("--slenderness needs --friction-prototype") != std::string::npos);
    CHECK(here.run(command + "0.18/0.59 --friction-prototype 0.59").err.empty());
    CHECK(here.run(command + "'(0.18+/-5%)/(0.59+/-5%)'").err.empty());
}

TEST_CASE("rescale reports the regime that changes, as scale does") {
    const Workplace here;
    const std::string command =
        "rescale synthetic --length 1/107 --friction 0.18/0.59 --friction-prototype 0.59 --slenderness 0.32 -o m.csv ";
    CHECK(here.run(command).out.find("error: mu/tan(alpha) is off by a factor 0.3051") != std::string::npos);
    const auto distortions = here.run(command + "--json").json()["distortions"];
    CHECK(distortions ==
          here.run("scale --length 1/107 --friction 0.18/0.59 --friction-prototype 0.59 --slenderness 0.32 --json").json()["distortions"]);
    CHECK(distortions.size() > 1);
}

TEST_CASE("several slendernesses stand in one option or in several") {
    const Workplace here;
    const std::string command = "scale --length 1/25 --friction-prototype 0.59 --json ";
    const auto structure = here.run(command + "--slenderness 0.32 0.6635").json()["structure"];
    CHECK(structure.size() == 2);
    CHECK(structure == here.run(command + "--slenderness 0.32 --slenderness 0.6635").json()["structure"]);
}

TEST_CASE("Monte Carlo stands beside first order, the same for one seed whatever the threads, other for another") {
    const Workplace here;
    const std::string command = "scale " + kWood + "--json --monte-carlo 20000 --seed ";
    const Outcome first = here.run(command + "7");
    CHECK(first.out == here.run(command + "7").out);
    CHECK(first.out == here.run(command + "7", "taskset -c 0").out);
    CHECK(first.out != here.run(command + "8").out);
    const auto uncertainty = first.json()["uncertainty"];
    CHECK(uncertainty["monte_carlo"]["samples"] == 20000);
    CHECK(uncertainty["monte_carlo"]["distribution"] == "normal");
    const auto friction = uncertainty["factors"]["friction"];
    const double u = friction["standard_uncertainty"].get<double>();
    const auto samples = friction["monte_carlo"];
    // ends of a normal interval at 1.96 u; a ratio of normal ones is askew by some u², its ends are drawn with 2.67 u/√n
    CHECK(std::abs(samples["interval"][0].get<double>() - (1.0677966 - 1.96 * u)) <= 0.15 * u);
    CHECK(std::abs(samples["interval"][1].get<double>() - (1.0677966 + 1.96 * u)) <= 0.3 * u);
    // first order leaves out some relative u²; 5 standard deviations u/√(2 n) of sampling
    CHECK(std::abs(samples["standard_deviation"].get<double>() - u) <= (0.02 + 5.0 / std::sqrt(40000.0)) * u);
    CHECK(here.run("scale " + kWood + "--monte-carlo").out.find("100000 samples, normal, seed 1.") != std::string::npos);
}

TEST_CASE("draws that cannot be are counted and reported") {
    const Outcome outcome = Workplace().run("scale --length 1/25 --friction 1+/-50% --monte-carlo 10000");
    CHECK(outcome.exit_code == 0);
    // Φ(-2) = 2.3 % of 10000
    CHECK(outcome.out.find("draws were not positive and drawn again.") != std::string::npos);
    CHECK(Workplace().run("scale --length 1/25 --friction 1+/-50% --monte-carlo 10000 --distribution lognormal").out.find("drawn again") ==
          std::string::npos);
}

TEST_CASE("measures of the prototype are carried to the model with their uncertainties") {
    const auto object = Workplace()
                            .run("scale " + kWood +
                                 R"(--pga 0.511g --pgv "42.4+/-0.4 cm/s" --pgd "20 cm" --arias "2 m/s" --duration "40 s" )"
                                 R"(--time-step "5 ms" --height "161.5 m" --slenderness 0.32 --json)")
                            .json();
    CHECK(object["measures"]["pga_g"]["prototype"].get<double>() == doctest::Approx(0.511).epsilon(1e-14));
    // printed to seven digits
    CHECK(object["measures"]["pga_g"]["model"].get<double>() == doctest::Approx(0.5456441).epsilon(1e-7));
    CHECK(object["measures"]["pgv_cm_s"]["model"].get<double>() == doctest::Approx(4.235632).epsilon(1e-7));
    CHECK(object["structure"]["mu^N"]["model"].get<double>() == doctest::Approx(0.01387054).epsilon(1e-7));
    const auto uncertainty = object["uncertainty"];
    CHECK(relative_of(uncertainty["measures"]["pgv_cm_s"]["model"]) ==
          doctest::Approx(std::hypot(0.5 * kFrictionShare, 0.4 / 42.4)).epsilon(1e-12));
    CHECK(relative_of(uncertainty["structure"]["mu^N"]["model"]) == doctest::Approx(std::hypot(0.025, 0.4 / 42.4)).epsilon(1e-12));
    CHECK(relative_of(uncertainty["structure"]["mu/tan(alpha) at 0.32"]["model"]) == doctest::Approx(0.05).epsilon(1e-12));

    // values alone, without an uncertain input
    const auto certain = Workplace().run("scale --length 1/25 --pgv \"42.4 cm/s\" --json").json();
    CHECK(certain["measures"]["pgv_cm_s"]["model"].get<double>() == doctest::Approx(8.48).epsilon(1e-14));
    CHECK_FALSE(certain.contains("uncertainty"));
}

TEST_CASE("an uncertainty stands in the unit of its value") {
    const std::string out = Workplace().run("scale " + kWood + "--pgv \"42.4+/-0.1 cm/s\" --monte-carlo 2000").out;
    CHECK(out.find("42.4 cm/s      0.1 cm/s") != std::string::npos);
    // 3.5 % of 4.2 cm/s
    CHECK(out.find("4.235632 cm/s  0.15 cm/s") != std::string::npos);
    CHECK(out.find("um/s") == std::string::npos);
}

TEST_CASE("rescale scales by the values and reports the model's measures and groups with their uncertainties") {
    const Workplace here;
    const std::string friction = "--friction '(0.63+/-5%)/(0.59+/-5%)' ";
    const auto object = here.run("rescale synthetic --length 1/107 " + friction +
                                 R"(--height "161.5+/-0.5% m" --monte-carlo 5000 --seed 2 -o uncertain.csv --json)")
                            .json();
    CHECK(here.run("rescale synthetic --length 1/107 --friction 0.63/0.59 -o certain.csv").exit_code == 0);
    CHECK(here.read("uncertain.csv") == here.read("certain.csv"));

    const auto component = object["uncertainty"]["components"][0];
    const auto model = [&](const char* measure) { return component["measures"][measure]["model"]; };
    CHECK(model("pga_g")["value"].get<double>() == doctest::Approx(0.5456441).epsilon(1e-7));
    CHECK(relative_of(model("pga_g")) == doctest::Approx(kFrictionShare).epsilon(1e-12));
    CHECK(relative_of(model("pgv_cm_s")) == doctest::Approx(0.5 * kFrictionShare).epsilon(1e-12));
    CHECK(relative_of(model("pgd_cm")) == 0.0);
    CHECK(relative_of(model("arias_m_s")) == doctest::Approx(1.5 * kFrictionShare).epsilon(1e-12));
    CHECK(relative_of(model("dt_s")) == doctest::Approx(0.5 * kFrictionShare).epsilon(1e-12));
    CHECK(relative_of(model("duration_s")) == doctest::Approx(0.5 * kFrictionShare).epsilon(1e-12));
    CHECK(model("pga_g")["monte_carlo"]["interval"].size() == 2);
    // the model of the written record: friction 5 %, height 0.5 %, both under a root
    CHECK(relative_of(component["structure"]["mu^N"]["model"]) == doctest::Approx(0.5 * std::hypot(0.05, 0.005)).epsilon(1e-12));
    CHECK(relative_of(component["structure"]["a/(mu*g)"]["model"]) == doctest::Approx(0.05).epsilon(1e-12));

    const Outcome text = here.run("rescale synthetic --length 1/107 " + friction + "-o text.csv");
    CHECK(text.out.find("pga, model") != std::string::npos);
    CHECK(text.out.find("7.07 %") != std::string::npos);
}

TEST_CASE("uncertainties that cannot be are one error line that names the option") {
    const Workplace here;
    struct Case {
        std::string arguments, message;
        int exit_code;
    };
    for (const Case& wanted : {
             Case{"--friction 0.63+/--0.03", "--friction: \"0.63+/--0.03\": the uncertainty is -0.03 (must not be negative)", 2},
             Case{"--friction 0.63+/-nan", "--friction: \"0.63+/-nan\": the uncertainty \"nan\" is not a finite number", 2},
             Case{"--friction -0.63+/-0.03", "--friction: \"-0.63+/-0.03\": the value is -0.63 (must be positive", 2},
             Case{"--slenderness 0.3+/-x", "--slenderness: ", 2},
             Case{"--pgv 42.4+/-0.4", "--pgv: \"42.4+/-0.4\": the unit is missing", 2},
             Case{"--seed 3", "--seed requires --monte-carlo", 2},
             Case{"--monte-carlo 1.5", "--monte-carlo: 1.5 is no whole number", 2},
             Case{"--monte-carlo", "Monte Carlo: nothing is uncertain", 3},
             Case{"--friction 1+/-5% --monte-carlo 10", "--monte-carlo: 10 is out of range; give a whole number from 1000", 2},
             Case{"--friction 1+/-5% --monte-carlo --distribution gauss",
                  "--distribution: \"gauss\" is not known; give one of normal, lognormal, uniform", 2},
             Case{"--friction 1+/-5% --law exact", "friction is uncertain, and the law admits its value alone (law exact: mu = 0.9990", 3},
             Case{"--friction \"(0.63+/-5%)/(0.59+/-5%)\" --friction-prototype 0.6", "the prototype's friction coefficient is 0.6", 3},
         }) {
        for (const std::string command : {"scale --length 1/25 ", "rescale synthetic -o out.csv --length 1/25 "}) {
            if (command.starts_with("rescale") && wanted.arguments.starts_with("--pgv")) continue;
            CAPTURE(wanted.arguments);
            const Outcome outcome = here.run(command + wanted.arguments);
            CHECK(outcome.exit_code == wanted.exit_code);
            CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
            CHECK_MESSAGE(outcome.err.find(wanted.message) != std::string::npos, outcome.err);
            CHECK(outcome.out.empty());
        }
    }
    CHECK_FALSE(here.has("out.csv"));
}

TEST_CASE("commands that use the values of uncertain factors alone say so") {
    const Workplace here;
    const Outcome outcome = here.run("record plot synthetic --length 1/25+/-1% -o both.svg");
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.find("musim: note: only the values of uncertain factors are used here") != std::string::npos);
}

TEST_CASE("laws as data report the uncertainty of solved factors, groups, values and additions") {
    const Workplace here;
    const std::string replica =
        "scale --law true_replica --set l=1/25+/-0.4% --set 'rho=(2310+/-1%)/(2320+/-2%)' --value 'E=29.2+/-5% GPa' ";
    auto object = here.run(replica + "--monte-carlo 5000 --seed 3 --json").json();
    const auto uncertainty = object["uncertainty"];
    CHECK(relative_of(uncertainty["factors"]["E"]) == doctest::Approx(std::hypot(0.004, 0.01, 0.02)).epsilon(1e-12));
    CHECK(uncertainty["factors"]["E"]["exponents"]["rho_prototype"] == -1.0);
    CHECK(relative_of(uncertainty["groups"]["E/(rho*g*l)"]) == 0.0);
    CHECK(relative_of(uncertainty["groups_as_shaken"]["v/sqrt(g*l)"]) == doctest::Approx(0.002).epsilon(1e-12));
    CHECK(uncertainty["values"]["E"]["prototype"]["value"] == 29.2e9);
    const double share = std::hypot(std::hypot(0.004, 0.01, 0.02), 0.05);
    CHECK(relative_of(uncertainty["values"]["E"]["model"]) == doctest::Approx(share).epsilon(1e-12));
    CHECK(uncertainty["values"]["E"]["model"]["monte_carlo"]["interval"].size() == 2);
    CHECK(uncertainty["inputs"][3]["unit"] == "kg m^-1 s^-2");
    CHECK(uncertainty["monte_carlo"]["samples"] == 5000);

    // the values are those of the command without uncertainties
    object.erase("uncertainty");
    CHECK(object == here.run("scale --law true_replica --set l=1/25 --set rho=2310/2320 --value 'E=29.2 GPa' --json").json());

    const Outcome text = here.run(replica);
    CHECK(text.err.empty());
    CHECK(text.out.find("E, model      1.162966 GPa  0.064 GPa") != std::string::npos);
    CHECK(here.run(replica + "--format markdown").out.find("| E, model | 1.162966 GPa | 0.064 GPa |") != std::string::npos);
    CHECK(here.run(replica + "--format latex").out.find("E, model & 1.162966 GPa & 0.064 GPa") != std::string::npos);

    const auto mass = here.run("scale --law artificial_mass --set l=1/25+/-1% --value 'm_s=270151 t' --json").json()["uncertainty"];
    CHECK(mass["additions"]["m_added"]["model"]["value"].get<double>() == doctest::Approx(270151e3 * (0.0016 - 0.000064)).epsilon(1e-12));
    CHECK(mass["additions"]["m_added"]["model"]["standard_uncertainty"].get<double>() ==
          doctest::Approx(270151e3 * (2.0 * 0.0016 - 3.0 * 0.000064) * 0.01).epsilon(1e-12));
}

TEST_CASE("rescale propagates uncertain factors of laws as data, those of --set too") {
    const Workplace here;
    // λ_a = λ_E/(λ_ρ λ_l)
    const auto object =
        here.run("rescale synthetic --law centrifuge --length 1/25 --set E=1+/-4% --monte-carlo 2000 -o m.csv --json").json();
    const auto uncertainty = object["uncertainty"];
    CHECK(uncertainty["inputs"][0]["name"] == "E");
    CHECK(relative_of(uncertainty["factors"]["acceleration"]) == doctest::Approx(0.04).epsilon(1e-12));
    CHECK(relative_of(uncertainty["factors"]["time"]) == doctest::Approx(0.02).epsilon(1e-12));
    CHECK(relative_of(uncertainty["components"][0]["measures"]["pga_g"]["model"]) == doctest::Approx(0.04).epsilon(1e-12));
}

TEST_CASE("uncertainties of laws as data that cannot be are one line") {
    const Workplace here;
    const auto error = [&](const std::string& arguments) {
        const Outcome outcome = here.run("scale " + arguments);
        CHECK(outcome.exit_code != 0);
        CHECK(outcome.out.empty());
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
        return outcome.err;
    };
    CHECK(error("--law exact --set l=1/25 --set mu=1+/-5%").find("the factor of mu is uncertain, where mu is held") != std::string::npos);
    CHECK(error("--law true_replica --set l=1/25 --monte-carlo").find("nothing is uncertain") != std::string::npos);
    CHECK(error("--law true_replica --set l=1/25+/--1%").find("must not be negative") != std::string::npos);
    CHECK(error("--law true_replica --set l=1/25 --value 'E=29.2+/-1 kg'").find("a stress is wanted") != std::string::npos);
    CHECK(error("--law true_replica --set l=1/25 --value 'E=-2 GPa'").find("E is -2 GPa (a value must be positive") != std::string::npos);
    CHECK(error("--law true_replica --set l=1/25 --value mu=0").find("mu is 0 (a value must be positive") != std::string::npos);
    CHECK(error("--length 1/25 --pgd '-3 cm'").find("--pgd: \"-3 cm\": the value must be positive") != std::string::npos);
    CHECK(error("--length 1/25 --height '0 m'").find("--height: \"0 m\": the value must be positive") != std::string::npos);
    CHECK(error("--length 1/25 --pgv '42 furlong'").find("unknown unit \"furlong\"; write") != std::string::npos);
    CHECK(error("--law true_replica --set l=1/25 --value 'E=2 GPa' --value 'E=3 GPa'").find("E is given twice") != std::string::npos);
}
