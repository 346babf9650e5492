#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/cli/program.hpp"
#include "tests/support/shared_records.hpp"

using namespace musim::cli;
using doctest::Approx;

namespace {

/// A smooth target of 20 periods from 0.1 to 3 s, in g: flat, then 1/T.
std::string make_target() {
    std::string text = "# made up\nperiod_s,name,psa_g\n";
    for (int i = 0; i < 20; ++i) {
        const double period = 0.1 * std::pow(30.0, i / 19.0);
        text += fmt::format("{},\"a, b\",{}\n", period, 0.6 * std::min(1.0, 0.5 / period));
    }
    return text;
}

}  // namespace

TEST_CASE("record match brings a record to a target and reports how far it was") {
    const Workplace here;
    here.write("target.csv", make_target());
    const Outcome outcome = here.run("record match synthetic --target target.csv --band 0.2 2 -o matched.csv --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto object = outcome.json();
    CHECK(object["before"]["largest_misfit"].get<double>() > 0.05);
    CHECK(object["after"]["largest_misfit"].get<double>() <= 0.05);
    CHECK(object["iterations"].get<int>() > 0);
    CHECK(object["first_period_s"].get<double>() >= 0.2);
    CHECK(object["last_period_s"].get<double>() <= 2.0);
    for (const char* key : {"pga_g", "pgv_cm_s", "pgd_cm", "arias_m_s"}) CHECK(object["before"][key].get<double>() > 0.0);

    // the written record has that spectrum
    const std::string first = fmt::format("{}", object["first_period_s"].get<double>());
    const auto spectrum = here.run("record spectrum matched.csv --json --periods " + first + " 2 2").json()["spectra"][0];
    const double period = spectrum["period_s"][0], target = 0.6 * std::min(1.0, 0.5 / period);
    CHECK(std::abs(std::log(spectrum["psa_g"][0].get<double>() / target)) <= 0.05);

    const std::string table = here.run("record match synthetic --target target.csv --band 0.2 2 -o again.csv").out;
    CHECK(table.find("largest |ln|") != std::string::npos);
    CHECK(here.read("again.csv") == here.read("matched.csv"));
}

TEST_CASE("a spectrum that musim wrote is a target: its own record stays as it is") {
    const Workplace here;
    REQUIRE(here.run("record spectrum synthetic --periods 0.1 2 15 -o own.csv").exit_code == 0);
    const auto object = here.run("record match synthetic --target own.csv -o same.csv --json").json();
    CHECK(object["iterations"] == 0);
    CHECK(object["factor"] == 1.0);
    // the numbers of the CSV are the shortest that read back as they were; g to m/s² rounds
    CHECK(object["before"]["largest_misfit"].get<double>() < 1e-12);
    const auto other = here.run("record match synthetic --target own.csv --target-column sa_g -o sa.csv --json").json();
    CHECK(other["before"]["largest_misfit"].get<double>() > 1e-6);
}

TEST_CASE("the Ridgecrest record is matched within 5 %") {
    if (!musim::tests::have_shared_records()) return;
    const Workplace here;
    here.write("target.csv", make_target());
    const std::string file = "'" + (musim::tests::shared_records() / "csmip" / "CICLC.v1").string() + "'";
    const Outcome outcome = here.run("record match " + file + " --component 360 --target target.csv -o clc.csv --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    CHECK(outcome.json()["after"]["largest_misfit"].get<double>() <= 0.05);
    CHECK(here.run("record match " + file + " --target target.csv -o all.csv").err.find("--component") != std::string::npos);
}

TEST_CASE("what record match cannot do is one error line, and nothing is written") {
    const Workplace here;
    here.write("target.csv", make_target());
    here.write("two.csv", "period_s,psa_g\n0.5,0.3\n0.5,0.4\n");
    here.write("hole.csv", "period_s,psa_g\n0.5,0.3\n0.6,\n");
    here.write("zero.csv", "0.5,0.3\n0.6,0\n");
    here.write("jagged.csv", "0.5,0.1\n0.505,1.0\n");
    here.write("titles.csv", "T,PSA\n0.5,0.3\n");
    for (const char* wrong : {"missing.csv", "two.csv", "hole.csv", "zero.csv", "jagged.csv", "titles.csv", "target.csv --band 5 6",
                              "target.csv --damping 1.5", "target.csv --component Up"}) {
        const Outcome outcome = here.run(std::string("record match synthetic -o out.csv --json --target ") + wrong);
        CHECK_MESSAGE(outcome.exit_code == 3, wrong);
        CHECK_MESSAGE(outcome.has_one_error_line(), wrong, " gave ", outcome.err);
        CHECK_MESSAGE(outcome.out.empty(), wrong);
        CHECK_FALSE(here.has("out.csv"));
    }
    CHECK(here.run("record match synthetic -o out.csv --target hole.csv").err.find("hole.csv:3:") != std::string::npos);
    for (const char* wrong : {"synthetic -o out.csv", "synthetic --target target.csv", "--target target.csv -o out.csv",
                              "synthetic --target target.csv -o out.csv --tolerance 0"}) {
        CHECK_MESSAGE(here.run(std::string("record match ") + wrong).exit_code == 2, wrong);
    }
}
