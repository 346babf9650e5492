#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

constexpr const char* kTower = R"({"quantities": [
  {"name": "v", "unit": "cm/s", "value": 42.4}, {"name": "a", "unit": "gn", "value": 0.511}, {"name": "l", "unit": "m", "value": 161.5},
  {"name": "mu_g", "unit": "gn", "value": 0.59}, {"name": "rho", "unit": "kg/m^3", "value": 2320}]})";

/// A folder with the problem of [Andrade22] in it.
struct TowerPlace : Workplace {
    TowerPlace() { write("tower.json", kTower); }
};

}  // namespace

// [Andrade22] eqs. (1)-(3); similitude numbers of the prototype: mu^N = 0.01387054, a/(mu g) = 0.8661017
TEST_CASE("pi gives rank, groups, names, values and what cannot take part as JSON") {
    const TowerPlace here;
    const Outcome outcome = here.run("pi tower.json --repeating l,mu_g --json");
    REQUIRE(outcome.exit_code == 0);
    const auto object = outcome.json();
    CHECK(object["rank"] == 3);
    CHECK(object["repeating"] == nlohmann::json({"l", "mu_g", "rho"}));
    REQUIRE(object["groups"].size() == 2);
    CHECK(object["groups"][0]["exponents"] == nlohmann::json({{"v", 2}, {"l", -1}, {"mu_g", -1}}));
    CHECK(object["groups"][0]["name"] == "mu number^2");
    // printed to seven digits, squared
    CHECK(object["groups"][0]["value"].get<double>() == doctest::Approx(0.01387054 * 0.01387054).epsilon(1e-6));
    CHECK(object["groups"][1]["value"].get<double>() == doctest::Approx(0.8661017).epsilon(1e-7));
    CHECK(object["unused"] == nlohmann::json({{{"name", "rho"}, {"why", "rho cannot take part: it alone carries mass"}}}));
}

TEST_CASE("what pi prints as JSON is a problem that gives the same answer") {
    const TowerPlace here;
    for (const char* problem : {kTower, R"({"quantities": [{"name": "v", "unit": "cm/s", "value": "42.4 +/- 0.4"},
                                           {"name": "g", "unit": "gn", "value": 1}, {"name": "l", "unit": "m"}]})"}) {
        here.write("problem.json", problem);
        const Outcome first = here.run("pi problem.json --json");
        REQUIRE(first.exit_code == 0);
        here.write("answer.json", first.out);
        CHECK(here.run("pi answer.json --json").out == first.out);
    }
    here.write("bad.json", R"({"problem": {"quantity": []}, "rank": 1})");
    CHECK(here.run("pi bad.json").err.find("unknown key \"quantity\"") != std::string::npos);
}

TEST_CASE("pi expresses a group of the user, lists all bases, and says when there are more") {
    const TowerPlace here;
    const auto object = here.run("pi tower.json --repeating l,mu_g --express 'v/sqrt(mu_g*l)' --all --limit 2 --json").json();
    CHECK(object["expressed"][0]["powers"] == nlohmann::json({"1/2", "0"}));
    CHECK(object["expressed"][0]["name"] == "mu number");
    CHECK(object["bases"].size() == 2);
    CHECK(object["complete"] == false);
    CHECK(here.run("pi tower.json --all --limit 2").out.find("raise --limit") != std::string::npos);
}

TEST_CASE("pi writes tables in text, Markdown and LaTeX") {
    const TowerPlace here;
    CHECK(here.run("pi tower.json --repeating l,mu_g").out.find("v^2/(l*mu_g)") != std::string::npos);
    CHECK(here.run("pi tower.json --format markdown").out.find("| --- | --- |") != std::string::npos);
    const std::string latex = here.run("pi tower.json --repeating l,mu_g --format latex").out;
    CHECK(latex.find("\\begin{align}") != std::string::npos);
    CHECK(latex.find("\\Pi_{1} &= \\frac{v^{2}}{l\\,\\mu_{g}}") != std::string::npos);
}

TEST_CASE("pi reports uncertainties of the values of groups, to first order and by samples, in every form") {
    const Workplace here;
    here.write("u.json",
               R"({"quantities": [{"name": "v", "unit": "cm/s", "value": "42.4 +/- 10%"}, {"name": "l", "unit": "m", "value": 161.5},
        {"name": "mu_g", "unit": "gn", "value": "0.59 +/- 0.0295"}]})");
    const auto first = here.run("pi u.json --repeating l,mu_g --json").json();
    CHECK(first["groups"][0]["uncertainty"]["relative"].get<double>() == doctest::Approx(std::hypot(0.2, 0.05)).epsilon(1e-12));
    CHECK(first["groups"][0]["uncertainty"]["exponents"] == nlohmann::json({{"v", 2.0}, {"mu_g", -1.0}}));
    CHECK(first["uncertainty"]["inputs"].size() == 2);
    CHECK_FALSE(first["groups"][0]["uncertainty"].contains("monte_carlo"));
    const std::string sampled = "pi u.json --repeating l,mu_g --monte-carlo 2000 --seed 4 ";
    const Outcome outcome = here.run(sampled + "--json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    CHECK(outcome.json()["groups"][0]["uncertainty"]["monte_carlo"]["interval"].size() == 2);
    CHECK(outcome.json()["uncertainty"]["monte_carlo"]["seed"] == 4);
    CHECK(here.run(sampled + "--json").out == outcome.out);
    CHECK(here.run(sampled).out.find("(20.6 %), 95 %: ") != std::string::npos);
    CHECK(here.run(sampled + "--format markdown").out.find("| 20.6 % |") != std::string::npos);
    CHECK(here.run(sampled + "--format latex").out.find(" \\pm ") != std::string::npos);
    for (const char* const format : {"text", "markdown", "latex"}) {
        CHECK(here.run(sampled + "--format " + format).out.find("2000 samples, normal, seed 4.") != std::string::npos);
    }
    here.write("certain.json", kTower);
    CHECK(here.run("pi certain.json --monte-carlo").has_one_error_line());
    CHECK_FALSE(here.run("pi certain.json --json").json().contains("uncertainty"));
    CHECK(here.run("pi certain.json").out.find("u/value") == std::string::npos);
    here.write("wrong.json", R"({"quantities": [{"name": "v", "unit": "m/s", "value": "1 +/- -2"}]})");
    const Outcome wrong = here.run("pi wrong.json");
    CHECK(wrong.exit_code == 3);
    CHECK(wrong.has_one_error_line());
    CHECK(wrong.err.find("wrong.json: /quantities/0 (v): ") != std::string::npos);
}

TEST_CASE("pi refuses bad input in one line, exit code 3, and bad usage with 2") {
    const TowerPlace here;
    here.write("broken.json", "{");
    here.write("unit.json", R"({"quantities": [{"name": "v", "unit": "m/S"}]})");
    for (const char* arguments : {"pi missing.json", "pi .", "pi broken.json", "pi unit.json", "pi tower.json --repeating v,x",
                                  "pi tower.json --repeating v,l,a", "pi tower.json --express v^2", "pi tower.json --express 'v^'"}) {
        const Outcome outcome = here.run(arguments);
        CHECK_MESSAGE(outcome.exit_code == 3, arguments);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
        CHECK(outcome.out.empty());
    }
    for (const char* arguments : {"pi", "pi tower.json --format html", "pi tower.json --limit 0"}) {
        CHECK_MESSAGE(here.run(arguments).exit_code == 2, arguments);
    }
}

TEST_CASE("the shipped problems are answered") {
    const Workplace here;
    for (const char* name : {"tower", "sphere_drag", "rocking_block", "uncertain"}) {
        const auto object = here.run(std::string("pi " MUSIM_SOURCE_DIR "/examples/pi/") + name + ".json --json").json();
        CHECK_MESSAGE(object["groups"].size() >= 2, name);
    }
}
