#include "cli/whole_option.hpp"

#include <doctest/doctest.h>

#include <CLI/App.hpp>
#include <CLI/Error.hpp>
#include <cstdint>
#include <functional>
#include <string>

#include "cli/app.hpp"
#include "scaling/error.hpp"
#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

/// Calls visit(command, option) for every option and argument that takes a value, of all commands.
void visit_options(const CLI::App& app, const std::string& command, const std::function<void(const std::string&, CLI::Option&)>& visit) {
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_items_expected_max() > 0) visit(command, const_cast<CLI::Option&>(*option));
    }
    for (const CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; })) {
        visit_options(*each, command + " " + each->get_name(), visit);
    }
}

/// Words of an option on a value, given as often as it wants values; empty when it is taken.
std::string give(CLI::Option& option, const std::string& value) {
    option.clear();
    for (int i = 0; i < std::max(1, option.get_items_expected_min()); ++i) option.add_result(std::string(value));
    try {
        option.run_callback();
    } catch (const CLI::Error& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a whole number is decimal, with leading zeros or without, and nothing else is one") {
    for (const char* const ten : {"10", "010", "0010", "+10", "1e1", "20/2", "10.0"}) CHECK_MESSAGE(parse_whole(ten, {}) == 10, ten);
    CHECK(parse_whole("08", {1, 12}) == 8);
    // beyond what a double counts
    CHECK(parse_whole("18446744073709551615", {}) == UINT64_MAX);
    CHECK(parse_whole("0018446744073709551615", {}) == UINT64_MAX);
    for (const char* const text : {"", "0x10", "1.5", "ten", "1e", "10 11", "0b1", "1/3", "--5", "1,000", "nan", "inf"}) {
        CHECK_THROWS_WITH_AS(parse_whole(text, {1, 12}),
                             (std::string(text) + " is no whole number; give a whole number from 1 to 12").c_str(),
                             musim::scaling::ParseError);
    }
    for (const char* const text : {"0", "13", "-1", "1e300", "18446744073709551616"}) {
        CHECK_THROWS_WITH_AS(parse_whole(text, {1, 12}), (std::string(text) + " is out of range; give a whole number from 1 to 12").c_str(),
                             musim::scaling::ParseError);
    }
}

TEST_CASE("no option of any command is left to the number reading of CLI11, for which 010 is eight") {
    CLI::App app;
    Action action;
    add_commands(app, action);
    int options = 0;
    visit_options(app, "musim", [&](const std::string& command, CLI::Option& option) {
        ++options;
        // none of them is octal; one at least lies in the range of any whole number
        for (const char* const text : {"08", "0009", "089", "0890", "08900", "0x", "x"}) {
            const std::string said = give(option, text);
            CHECK_MESSAGE(said.find("Could not convert") == std::string::npos, command << " " << option.get_name() << ": " << said);
        }
    });
    CHECK(options > 200);
}

TEST_CASE("no option of any command takes an empty value") {
    CLI::App app;
    Action action;
    add_commands(app, action);
    visit_options(app, "musim", [](const std::string& command, CLI::Option& option) {
        if (option.get_items_expected_min() == 0) return;  // it may stand alone
        for (const char* const text : {"", " "}) {
            const std::string said = give(option, text);
            CHECK_MESSAGE(said.find("is empty; give a value, or leave it out") != std::string::npos,
                          command << " " << option.get_name() << ": " << said);
        }
    });
}

TEST_CASE("010 is ten on a command line, and a number that is none is said of its own option") {
    const Workplace here;
    struct Case {
        const char *arguments, *message;
    };
    for (const Case& bad :
         {Case{"ensemble wall.json -o out --members 010 --only 011", "--only: there is no member 11 of 10"},
          Case{"ensemble wall.json -o out --members 12 --only 0x8 --threads 2",
               "--only: 0x8 is no whole number; give a whole number from 1 to 2147483647"},
          Case{"ensemble wall.json -o out --members 0", "--members: 0 is out of range; give a whole number from 1 to 100000"},
          Case{"run wall.json --threads -1", "--threads: -1 is out of range; give a whole number from 0 to 100000"},
          Case{"scale --length 1/25 --monte-carlo 1", "--monte-carlo: 1 is out of range"},
          Case{"scale --length= 1/25", "--length: is empty; give a value, or leave it out"},
          Case{"run --out= wall.json", "--out: is empty; give a value, or leave it out"},
          Case{"ensemble wall.json -o '' --only ''", "--out: is empty"}, Case{"run wall.json --duration ''", "--duration: is empty"},
          Case{"new tower --record ' '", "--record: is empty"}, Case{"scale --length 010 --friction 1/x", "--friction: "}}) {
        CAPTURE(bad.arguments);
        const Outcome outcome = here.run(bad.arguments);
        CHECK(outcome.exit_code == 2);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
        CHECK_MESSAGE(outcome.err.starts_with("musim: error: " + std::string(bad.message)), outcome.err);
    }
    CHECK(here.run("scale --length 010 --json").json()["factors"]["length"] == 10.0);
    const std::string two = here.run("record make stochastic --seed 02 -o two.csv").err;
    CHECK_MESSAGE(here.run("record make stochastic --seed 2 -o deux.csv").exit_code == 0, two);
    CHECK(here.read("two.csv") == here.read("deux.csv"));
}
