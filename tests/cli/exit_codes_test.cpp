#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

/// A command with the arguments that it cannot do without, but for the file that it reads.
struct Command {
    std::string name;
    std::string needs;   ///< besides its input
    std::string number;  ///< an option that takes a number
};

const std::vector<Command>& commands() {
    static const std::vector<Command> kCommands{
        {"run", "", "--duration"},
        {"check", "", "--threads"},
        {"pair", "", "--length"},
        {"sequence", "-o out", "--checkpoint-interval"},
        {"ensemble", "-o out", "--members"},
        {"specimen", "-o out", "--seeds"},
        {"bench twins", "", "--models"},
        {"bench verdict", "", "--sets"},
        {"response", "", "--threshold"},
        {"report", "", ""},
        {"field", "-o out", "--rate"},
        {"watch", "--once", ""},
        {"pi", "", "--limit"},
        {"design", "", "--monte-carlo"},
        {"rescale", "--length 1/25 -o out.csv", "--friction"},
        {"table", "--limits table.json --length 1/25", "--accept"},
        {"record info", "", "--friction"},
        {"record plot", "-o out.svg", "--damping"},
        {"record process", R"(--step '{"step": "level"}' -o out.csv)", "--dt"},
        {"record match", "--target target.csv -o out.csv", "--tolerance"},
        {"record spectrum", "", "--damping"},
    };
    return kCommands;
}

/// With a file that no command can use, and others that commands need besides.
struct FilledWorkplace : Workplace {
    FilledWorkplace() {
        write("noise", "\x01\x02 no input of any command\n");
        write("table.json", R"({"schema": "musim-table/1", "axes": [{"names": ["x"]}]})");
        write("target.csv", "0.5,0.3\n0.6,0.3\n");
    }
};

void check_refusal(const Workplace& here, const std::string& arguments, int exit_code, const std::string& message) {
    CAPTURE(arguments);
    const Outcome outcome = here.run(arguments);
    CHECK(outcome.exit_code == exit_code);
    CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
    CHECK_MESSAGE(outcome.err.find(message) != std::string::npos, outcome.err);
    CHECK(outcome.err.size() < 500);
    CHECK(outcome.out.empty());
    CHECK(here.count() == 3);
}

}  // namespace

TEST_CASE("a file that is missing or is no input is bad input to every command and is named") {
    const FilledWorkplace here;
    for (const Command& command : commands()) {
        check_refusal(here, command.name + " lost.file " + command.needs, 3, "lost.file");
        check_refusal(here, command.name + " noise " + command.needs, 3, "noise");
    }
}

TEST_CASE("an unknown option or a value that is no number is wrong usage of every command and is named") {
    const FilledWorkplace here;
    for (const Command& command : commands()) {
        check_refusal(here, command.name + " noise --jsn " + command.needs, 2,
                      "--jsn: musim " + command.name + " has no such option (did you mean \"--json\"?); see musim " + command.name);
        if (command.number.empty()) continue;
        check_refusal(here, command.name + " noise " + command.needs + " " + command.number + "=x", 2, command.number + ": ");
    }
}

TEST_CASE("ends in the wrong order, and a picture of no known kind, are wrong usage") {
    const FilledWorkplace here;
    for (const std::string arguments : {"record info noise --mean-period-band 20 0.25", "record info noise --intensity-band 2 1",
                                        "record plot noise --window 5 4 -o p.svg", "table noise --limits noise --length 1/25 --periods 3 1",
                                        "record match noise --target noise --band 5 0.05 -o m.csv", "response noise --window 5 4"}) {
        check_refusal(here, arguments, 2, "; give the lower end first");
    }
    check_refusal(here, "table noise --limits noise --length 1/25 --highpass -1", 2, "--highpass: ");
    check_refusal(here, "check noise -o x.jpg", 2, "--out: ");
}

TEST_CASE("an empty name is wrong usage of every command and changes nothing") {
    const FilledWorkplace here;
    for (const Command& command : commands()) check_refusal(here, command.name + " '' " + command.needs, 2, ": is empty; give a value");
    for (const std::string command : {"run noise", "pair noise", "response noise", "report noise", "bench accuracy", "bench similitude",
                                      "calibrate friction --material wood", "record spectrum noise", "record plot noise"}) {
        check_refusal(here, command + " -o ''", 2, "--out: is empty; give a value");
    }
}

TEST_CASE("a mistyped command or option gets the nearest known one also where something else is missing") {
    const FilledWorkplace here;
    struct Case {
        std::string arguments, message;
    };
    for (const Case& wrong :
         {Case{"rum noise", "\"rum\": musim has no such command; did you mean \"run\"?; see musim --help"},
          Case{"recrd", "did you mean \"record\"?"},
          Case{"record inffo noise --json", "\"inffo\": musim record has no such command; did you mean \"info\"?"},
          Case{"record make ricket -o x.csv", "did you mean \"ricker\"?"},
          Case{"scale --lenght 1/25", "--lenght: musim scale has no such option (did you mean \"--length\"?)"},
          Case{"scale --lenght=1/25", "did you mean \"--length\"?"},
          Case{"run --duratoin 2 noise", "--duratoin: musim run has no such option (did you mean \"--duration\"?)"},
          Case{"bench speed", "known are "}, Case{"scale --length 1/25 --q", "--q: musim scale has no such option; see"},
          Case{"run noise noise", "\"noise\": musim run takes no further argument"}}) {
        check_refusal(here, wrong.arguments, 2, wrong.message);
    }
    check_refusal(here, "scale --length 1/25 --law frode", 3, "there is no law \"frode\" (did you mean \"froude\"?)");
}

TEST_CASE("a number out of range and a word that is not known are refused with what may stand there") {
    struct Case {
        const char* arguments;
        const char* message;
    };
    const FilledWorkplace here;
    here.write("noise", R"({"schema": "musim-scene/1", "name": "column", "material": "woood",
        "structure": {"kind": "column", "layers": 2, "block": ["1 m", "1 m", "1 m"]}, "time": {"duration": "1 ms"}})");
    for (const Case& c :
         {Case{"ensemble noise -o out --members -1", "--members: -1 is out of range; give a whole number from 1 to 100000"},
          Case{"ensemble noise -o out --members 1.5", "--members: 1.5 is no whole number; give a whole number from 1"},
          Case{"ensemble noise -o out --members 99999999999999999999", "give a whole number from 1 to 100000"},
          Case{"pair noise --twins -1", "--twins: -1 is out of range; give a whole number from 0 to 1000"},
          Case{"pair noise --specimens 1001", "--specimens: 1001 is out of range; give a whole number from 0 to 1000"},
          Case{"bench verdict noise --twins 1", "--twins: 1 is out of range; give a whole number from 2 to 100000"},
          Case{"bench twins noise --models 0", "--models: 0 is out of range; give a whole number from 1 to 100000"},
          Case{"calibrate stiffness --material wood --layers 2", "--layers: 2 is out of range; give a whole number from 20"},
          Case{"field run -o out --pixels 4001", "--pixels: 4001 is out of range; give a whole number from 8 to 4000"},
          Case{"calibrate friction --material woood", "--material: \"woood\" is not known (did you mean \"wood\"?); give one of wood,"},
          Case{"scale --length 1/25 --format latx", "--format: \"latx\" is not known (did you mean \"latex\"?); give one of text,"}}) {
        check_refusal(here, c.arguments, 2, c.message);
    }
    check_refusal(here, "run noise", 3, "noise: /material: \"woood\" is not a known material (did you mean \"wood\"?)");
}
