#include <doctest/doctest.h>

#include <regex>
#include <set>
#include <string>

#include "tests/cli/program.hpp"

using namespace musim::cli;

TEST_CASE("factors that may have been meant otherwise, and samples of little use, are noted, and those that are clear are not") {
    const Workplace here;
    struct Case {
        const char *arguments, *note;
    };
    for (const Case& doubtful : {Case{"scale --length 107", "a model at 1:107 is --length 1/107"},
                                 Case{"scale --length 1/107 --friction 0.63", "of two coefficients write 0.63/PROTOTYPE"},
                                 // a normal distribution of mean 1 and deviation 2 has 31 % below zero
                                 Case{"scale --length 1/25 --friction 1+/-200% --monte-carlo 2000", "not of a normal distribution"}}) {
        CAPTURE(doubtful.arguments);
        const Outcome outcome = here.run(doubtful.arguments);
        CHECK(outcome.exit_code == 0);
        CHECK_MESSAGE(outcome.err.find(doubtful.note) != std::string::npos, outcome.err);
    }
    for (const char* const clear :
         {"scale --length 1", "scale --length 1/107 --friction 0.18/0.59", "scale --length 1/107 --friction 1.07",
          "scale --length 1/25 --friction 0.3 --friction-prototype 0.6", "scale --length 1/25 --friction 1+/-5% --monte-carlo 2000"}) {
        CHECK_MESSAGE(here.run(clear).err.empty(), clear);
    }
    const std::string table = "table synthetic --limits " MUSIM_SOURCE_DIR "/examples/tables/outdoor.json --length 1/2 --accept 0.5";
    const std::string pi = "pi " MUSIM_SOURCE_DIR "/examples/pi/tower.json --all --limit ";
    for (const std::string& arguments : {table, pi + "0", pi + "-1"}) {
        CAPTURE(arguments);
        const Outcome outcome = here.run(arguments);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.has_one_error_line());
        CHECK(outcome.err.size() < 250);
    }
}

TEST_CASE("the law in the examples is that of the help, and a source is given once") {
    const Workplace here;
    const std::string law = MUSIM_SOURCE_DIR "/examples/laws/bolted.json";
    const auto object = here.run("scale --json --set l=1/4 --set k_b=1/4 --law " + law).json();
    CHECK(object["factors"]["t"] == 0.25);  // √(λ_m/λ_k) = √((1/64)/(1/4))
    CHECK(here.run("scale --law centrifuge --set l=1/25").out.find("sources: FengOwen14, MoncarzKrawinkler81\n") != std::string::npos);
}

TEST_CASE("a quantity with a dimension needs its unit, and a bad value is reported with its option") {
    const Workplace here;
    const std::string table = "table synthetic --limits " MUSIM_SOURCE_DIR "/examples/tables/outdoor.json --length 1/2 ";
    struct Case {
        std::string arguments, message;
    };
    for (const Case& bad :
         {Case{"scale --law true_replica --set l=1/25 --value E=29.2",
               "--value E: \"29.2\": the unit is missing; a stress is wanted (such as \"3.5 GPa\")"},
          Case{"scale --law froude --set l=1/25 --value E=x", "--value E: \"x\": "},
          Case{"scale --law froude --set l=1/25 --value zz=3m", "--value zz: \"zz\" is no quantity of the law"},
          Case{"scale --define E:furlong --set l=1/25 --hold 'v/sqrt(g*l)'", "--define E: \"furlong\": unknown unit"},
          Case{"scale --set l=1/2x", "--set l: \"1/2x\": "}, Case{"scale --length -1", "--length: \"-1\": the value must be positive"},
          Case{"scale --length 0", "--length: \"0\": the value must be positive"},
          Case{table + "--payload '2 m'", "--payload: \"2 m\": a mass is wanted"},
          Case{table + "--payload 200", "--payload: \"200\": the unit is missing; a mass is wanted (such as \"10.66 g\")"}}) {
        CAPTURE(bad.arguments);
        const Outcome outcome = here.run(bad.arguments);
        CHECK(outcome.exit_code == 2);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
        CHECK_MESSAGE(outcome.err.starts_with("musim: error: " + bad.message), outcome.err);
        CHECK(outcome.out.empty());
    }
    const Outcome coloured = here.run("calibrate restitution --material \"$(printf '\\033[31mwood')\"");
    CHECK(coloured.exit_code == 2);
    CHECK_MESSAGE(coloured.err.starts_with("musim: error: --material: \" [31mwood\" is not known; give one of wood, concrete"),
                  coloured.err);
    const Outcome folder = here.run("scale --law . --set l=1/2");
    CHECK(folder.exit_code == 3);
    CHECK_MESSAGE(folder.err.starts_with("musim: error: .: is a folder; name a law file"), folder.err);
    // plain numbers have no unit to forget
    CHECK(here.run("scale --law mu --set l=1/25 --set mu=2 --value mu=0.59").exit_code == 0);
}

TEST_CASE("help of every command succeeds, goes to stdout and has an example") {
    const Workplace here;
    CHECK(here.run("--help").exit_code == 0);
    for (const std::string command : {"scale", "rescale", "design", "table", "record info", "record plot", "record spectrum", "new",
                                      "check", "run", "pair", "bench accuracy", "bench similitude", "pi"}) {
        const Outcome help = here.run(command + " --help");
        CHECK_MESSAGE(help.exit_code == 0, command);
        CHECK_MESSAGE(help.out.find("  musim " + command + " ") != std::string::npos, command);
        CHECK(help.err.empty());
    }
}

TEST_CASE("musim alone names commands for what people come for") {
    const Workplace here;
    const Outcome alone = here.run("");
    // wrong usage: a script whose command is an empty variable is to notice
    CHECK(alone.exit_code == 2);
    CHECK(alone.out.empty());
    CHECK(alone.err.find("musim --help") != std::string::npos);
    const std::string all = here.run("--help").out;
    const std::regex command("musim ([a-z]+) ");
    std::set<std::string> named;
    for (std::sregex_iterator at(alone.err.begin(), alone.err.end(), command), end; at != end; ++at) named.insert((*at)[1]);
    CHECK(named == std::set<std::string>{"scale", "record", "table", "new", "check", "run", "report", "pair"});
    for (const std::string& name : named) CHECK_MESSAGE(all.find("\n  " + name + " ") != std::string::npos, name);
}

TEST_CASE("the version is printed") {
    const Outcome version = Workplace().run("--version");
    CHECK(version.exit_code == 0);
    CHECK(version.out.starts_with("musim "));
}

TEST_CASE("wrong usage is one error line that names the help, exit code 2, nothing on stdout") {
    const Workplace here;
    for (const char* arguments : {"nonsense", "scale", "scale --length", "scale --length abc", "scale --length 1/0",
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

TEST_CASE("a law that there is not or factors that contradict it are bad input") {
    const Workplace here;
    for (const char* arguments :
         {"scale --length 1/25 --law nonsense", "scale --length 1/25 --law exact --friction 0.5", "scale --law . --set l=1/2"}) {
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
    CHECK(outcome.err.find("standard output") != std::string::npos);
}

TEST_CASE("remarks that nobody can read end no command") {
    const Workplace here;
    here.shell("mkdir out");
    const Outcome silent = here.run("scale --length 25 2>/dev/full");
    CHECK(silent.exit_code == 0);
    CHECK(silent.out == here.run("scale --length 25").out);
}
