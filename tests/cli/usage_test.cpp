#include <doctest/doctest.h>

#include <string>

#include "tests/cli/program.hpp"

using namespace musim::cli;

TEST_CASE("help of every command succeeds, goes to stdout and has an example") {
    const Workplace here;
    CHECK(here.run("--help").exit_code == 0);
    for (const std::string command : {"scale", "rescale", "design", "table", "record info", "record plot", "record spectrum", "run", "pair",
                                      "bench accuracy", "bench similitude", "pi"}) {
        const Outcome help = here.run(command + " --help");
        CHECK_MESSAGE(help.exit_code == 0, command);
        CHECK_MESSAGE(help.out.find("  musim " + command + " ") != std::string::npos, command);
        CHECK(help.err.empty());
    }
}

TEST_CASE("the version is printed") {
    const Outcome version = Workplace().run("--version");
    CHECK(version.exit_code == 0);
    CHECK(version.out.starts_with("musim "));
}

TEST_CASE("wrong usage is one error line that names the help, exit code 2, nothing on stdout") {
    const Workplace here;
    for (const char* arguments : {"", "nonsense", "scale", "scale --length", "scale --length abc", "scale --length 1/0",
                                  "scale --length 1/25 --nope", "run", "pair", "rescale x.at2 --length 1/25", "record", "record info",
                                  "run x.json --threads -1", "pair x.json --materials other", "pair x.json --component x=360"}) {
        const Outcome outcome = here.run(arguments);
        CHECK_MESSAGE(outcome.exit_code == 2, arguments);
        CHECK_MESSAGE(outcome.has_one_error_line(), arguments, " gave ", outcome.err);
        CHECK_MESSAGE(outcome.err.find("--help") != std::string::npos, arguments);
        CHECK(outcome.out.empty());
    }
}

// [Andrade22] eq. (3): 1:107 wood under the mu law
TEST_CASE("scale gives the factors of the papers' wood model, fractions and all") {
    const Outcome outcome = Workplace().run("scale --length 1/107 --friction 0.63/0.59 --json");
    CHECK(outcome.exit_code == 0);
    const auto object = outcome.json();
    CHECK(object["law"] == "mu");
    const auto factor = [&](const char* name) { return object["factors"][name].get<double>(); };
    // printed to seven digits
    CHECK(factor("time") == doctest::Approx(0.09355432).epsilon(1e-6));
    CHECK(factor("velocity") == doctest::Approx(0.09989698).epsilon(1e-6));
    CHECK(factor("acceleration") == doctest::Approx(1.0677966).epsilon(1e-6));
    for (const char* name : {"length", "mass", "force", "stiffness", "damping"}) CHECK(object["factors"].contains(name));
    CHECK(object["groups"]["mu^N"].get<double>() == doctest::Approx(1.0).epsilon(1e-14));
    CHECK(object["distortions"].size() > 0);
}

TEST_CASE("scale reports the regime change of aluminium as an error, and exact similitude without distortion") {
    const Workplace here;
    const auto aluminium =
        here.run("scale --length 1/107 --friction 0.18/0.59 --friction-prototype 0.59 --slenderness 0.32 --json").json()["distortions"];
    bool has_error = false;
    for (const auto& distortion : aluminium) has_error |= distortion["severity"] == "error";
    CHECK(has_error);
    CHECK(here.run("scale --length 1/107 --law exact --json").json()["distortions"].empty());
}

TEST_CASE("a factor that cannot be is bad input") {
    const Workplace here;
    for (const char* arguments : {"scale --length -1", "scale --length 0", "scale --length 1/25 --law nonsense",
                                  "scale --length 1/25 --law exact --friction 0.5"}) {
        const Outcome outcome = here.run(arguments);
        CHECK_MESSAGE(outcome.exit_code == 3, arguments);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
    }
}

TEST_CASE("output that cannot be written is an error") {
    const Workplace here;
    here.write("script", "");
    const Outcome outcome = here.run("scale --length 1/25 >/dev/full");
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.has_one_error_line());
}
