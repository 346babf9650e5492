#include <doctest/doctest.h>

#include <array>

#include "tests/cli/program.hpp"

using musim::cli::Outcome;
using musim::cli::Workplace;

namespace {

/// Commands that read what `FILE` names, wherever an option or argument takes a file.
constexpr std::array kReaders{"run FILE",
                              "pair FILE",
                              "specimen FILE",
                              "ensemble FILE -o out",
                              "sequence FILE -o out",
                              "bench twins FILE -o out",
                              "scale --length 1/25 --law FILE",
                              "scale --length 1/25 --properties FILE",
                              "design FILE",
                              "pi FILE",
                              "table FILE --length 1/25 --limits FILE",
                              "table synthetic --length 1/25 --limits FILE",
                              "rescale FILE --length 1/25 -o model.csv",
                              "record info FILE",
                              "record plot FILE -o plot.svg",
                              "record spectrum FILE",
                              "record process FILE --recipe FILE -o out.csv",
                              "record match FILE --target FILE -o out.csv",
                              "response FILE",
                              "report FILE -o report.html",
                              "field FILE -o field",
                              "watch FILE --once",
                              "specimen --compare FILE FILE"};

std::string name_file(std::string command, const std::string& file) {
    for (std::size_t at = command.find("FILE"); at != std::string::npos; at = command.find("FILE", at)) command.replace(at, 4, file);
    return command;
}

}  // namespace

TEST_CASE("pipes and devices as inputs are refused in one line, and nobody waits for them") {
    const Workplace here;
    here.shell("mkfifo pipe");
    for (const char* reader : kReaders) {
        for (const char* file : {"pipe", "/dev/zero"}) {
            const std::string command = name_file(reader, file);
            CAPTURE(command);
            const Outcome outcome = here.run(command, "timeout 20");
            CAPTURE(outcome.err);
            CHECK(outcome.exit_code == 3);
            CHECK(outcome.has_one_error_line());
        }
    }
}

TEST_CASE("files that a scene names are no pipes either") {
    const Workplace here;
    here.shell("mkfifo pipe");
    const std::string scene = R"({"schema": "musim-scene/1", "material": "wood", "time": {"duration": 1},)";
    here.write("record.json", scene + R"("structure": {"kind": "column", "layers": 2, "block": [0.1, 0.2, 0.3]},
        "base_motion": {"record": "pipe", "components": {"x": "1"}}})");
    here.write("specimen.json", scene + R"("structure": {"kind": "column", "layers": 2, "block": [0.1, 0.2, 0.3]},
        "preparation": {"specimen": "pipe"}})");
    here.write("tiling.json", scene + R"("structure": {"kind": "tower", "layers": 2, "block": [0.1, 0.2, 0.3], "tiling": "pipe"}})");
    for (const char* name : {"record.json", "specimen.json", "tiling.json"}) {
        const Outcome outcome = here.run(std::string("run ") + name, "timeout 20");
        CAPTURE(outcome.err);
        CHECK(outcome.exit_code == 3);
        CHECK(outcome.has_one_error_line());
        CHECK(outcome.err.find("pipe") != std::string::npos);
    }
}
