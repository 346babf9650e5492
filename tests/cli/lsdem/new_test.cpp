#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>

#include "tests/cli/program.hpp"
#include "tests/support/shared_records.hpp"

using namespace musim::cli;

TEST_CASE("a new scene of every kind is written or printed and runs at once") {
    const Workplace here;
    for (const std::string kind : {"tower", "wall", "column", "blocks"}) {
        CAPTURE(kind);
        const Outcome made = here.run("new " + kind + " --layers 2 -o " + kind + ".json");
        CHECK(made.exit_code == 0);
        CHECK(made.err.empty());
        CHECK(made.out.find("next: musim check " + kind + ".json") != std::string::npos);
        CHECK(here.run("new " + kind + " --layers 2").out == here.read(kind + ".json"));
        const Outcome run = here.run("run " + kind + ".json --duration 1e-3 --json");
        CHECK(run.exit_code == 0);
        CHECK(run.json()["status"] == "completed");
        // but for the motion that so short a run cuts
        CHECK_MESSAGE(run.err.find("musim: note") == std::string::npos, run.err);
    }
}

TEST_CASE("a new scene is of a material of a file, on the block that it was measured on or fitted to another") {
    const Workplace here;
    here.write("mine.json", R"({"schema": "musim-material/1", "name": "my stone", "block": ["50 mm", "0.1 m", "0.2 m"],
        "material": {"density": "23 kN/m^3", "normal_stiffness": "900 MN/m", "shear_stiffness": "400 MN/m", "friction": 0.6,
        "restitution": 0.4}})");
    const auto make = [&](const std::string& more) {
        const Outcome made = here.run("new column --material " + more);
        REQUIRE_MESSAGE(made.exit_code == 0, made.err);
        return made.json();
    };
    const auto own = make("mine.json");
    CHECK(own["name"].get<std::string>().starts_with("column of my stone blocks, 1:21.25"));  // 4.25 m over 0.2 m
    CHECK(own["structure"]["block"][0] == "50 mm");
    CHECK(own["material"]["normal_stiffness"] == "900 MN/m");
    CHECK(own["material"]["density"] == "2345.347 kg/m^3");  // 23 kN/m^3 over 9.80665 m/s^2
    // k goes with A/H: twice the block is twice as stiff
    CHECK(make("mine.json --block '0.1 m' '0.2 m' '0.4 m'")["material"]["normal_stiffness"] == "1800 MN/m");
    // E A/H = 58.6 GPa x 0.2 m x 0.6 m/0.3 m
    CHECK(make("granite --block '0.2 m' '0.6 m' '0.3 m'")["material"]["normal_stiffness"] == "23440 MN/m");
    CHECK(make("granite")["structure"]["block"][2] == "4.25 m");
    for (const auto& [text, message] :
         {std::pair{R"({"schema": "musim-material/1", "block": [1, 1, 1]})", "\"material\" is missing"},
          {R"({"schema": "musim-material/1", "block": [1, 0, 1], "material": "wood"})", "not longer than zero"},
          {R"({"schema": "musim-material/1", "block": [1, 1, 1], "material": {"cohesion": 1}})", "musim has no"},
          {"{", "not valid JSON"}}) {
        here.write("bad.json", text);
        const Outcome refused = here.run("new column --material bad.json");
        CHECK(refused.exit_code == 3);
        CHECK_MESSAGE(refused.has_one_error_line(), refused.err);
        CHECK_MESSAGE(refused.err.find(std::string("bad.json")) != std::string::npos, refused.err);
        CHECK_MESSAGE(refused.err.find(message) != std::string::npos, refused.err);
    }
}

TEST_CASE("a file that exists is not replaced by a new scene unless asked") {
    const Workplace here;
    here.write("mine.json", "my work");
    const Outcome refused = here.run("new column -o mine.json");
    CHECK(refused.exit_code == 3);
    CHECK_MESSAGE(refused.has_one_error_line(), refused.err);
    CHECK(refused.err.find("mine.json: there is a file of this name already") != std::string::npos);
    CHECK(here.read("mine.json") == "my work");
    CHECK(here.run("new column -o mine.json --force").exit_code == 0);
    CHECK(here.read("mine.json") != "my work");
}

TEST_CASE("a new scene takes the strong motion of an own record at the scale of the model") {
    if (!musim::tests::have_shared_records()) return;
    const Workplace here;
    here.shell("cp '" + (musim::tests::shared_records() / "csmip" / "CICLC.v1").string() + "' mine.v1");
    const Outcome made = here.run("new column --record mine.v1 -o column.json");
    REQUIRE_MESSAGE(made.exit_code == 0, made.err);
    CHECK(made.err.find("mine.v1: strong motion from ") != std::string::npos);
    const auto motion = nlohmann::json::parse(here.read("column.json"))["base_motion"];
    CHECK(motion["record"] == "mine.v1");
    CHECK(motion["scale"]["length"] == "1/107");
    CHECK(motion["scale"]["friction"] == "0.63/0.59");
    CHECK(here.run("run column.json --duration 1e-3 --json").exit_code == 0);
    CHECK(here.run("new column --record mine.v1 --component y=nowhere").exit_code == 3);
}

TEST_CASE("a new scene of an uncorrected record has the strong motion above the instrument's offset") {
    const Workplace here;
    std::string record =
        "# musim ground motion 1\n# quantity: acceleration\n# unit: m/s^2\n# start_s: 0\n# dt_s: 0.01\n# integration_corner_hz: "
        "0.05\ntime_s,EW\n";
    for (int i = 0; i < 4000; ++i) {
        // 1 m/s^2 for two seconds, on an offset of 2 m/s^2 throughout
        record += fmt::format("{},{}\n", 0.01 * i, 2.0 + (i >= 2000 && i < 2200 ? (i / 10 % 2 == 0 ? 1.0 : -1.0) : 0.0));
    }
    here.write("offset.csv", record);
    const Outcome made = here.run("new column --record offset.csv --length 1 -o column.json");
    REQUIRE_MESSAGE(made.exit_code == 0, made.err);
    CHECK_MESSAGE(made.err.find("the record's own peak 0.102 g") != std::string::npos, made.err);
    CHECK_MESSAGE(made.err.find("strong motion from 19.") != std::string::npos, made.err);
}

TEST_CASE("a new scene of counts names the sensitivity that was given") {
    const Workplace here;
    std::string series = "TIMESERIES XX_ABC__HLE_D, 400 samples, 100 sps, 2020-02-29T12:00:00.000000, SLIST, INTEGER, Counts\n";
    for (int i = 0; i < 400; ++i) series += fmt::format("{}\n", i < 100 || i > 300 ? 0 : i / 10 % 2 == 0 ? 1000 : -1000);
    here.write("counts.txt", series);
    const Outcome refused = here.run("new column --record counts.txt -o column.json");
    CHECK(refused.exit_code == 3);
    CHECK_MESSAGE(refused.err.find("(SLIST holds counts); give --station-xml FILE, or --sensitivity NUMBER in counts") != std::string::npos,
                  refused.err);

    const Outcome made = here.run("new column --record counts.txt --sensitivity 2000 --quantity acceleration --length 1 -o column.json");
    REQUIRE_MESSAGE(made.exit_code == 0, made.err);
    CHECK_MESSAGE(made.err.find("the record's own peak 0.05099 g") != std::string::npos, made.err);
    const auto motion = nlohmann::json::parse(here.read("column.json"))["base_motion"];
    CHECK(motion["sensitivity"] == 2000.0);
    CHECK(motion["quantity"] == "acceleration");
    CHECK(here.run("check column.json").err.find("sensitivity") == std::string::npos);
}

TEST_CASE("a new scene of own blocks has their scale and stiffness") {
    const Workplace here;
    const Outcome made = here.run("new tower --layers 2 --block '6.8 cm' '14.1 cm' '21.25 cm' -o tower.json");
    REQUIRE_MESSAGE(made.exit_code == 0, made.err);
    CHECK(made.out.find("tower of wood blocks, 1:20") != std::string::npos);
    // k = E A/H: the same solid in blocks of 107/20 times the length
    const auto scene = nlohmann::json::parse(here.read("tower.json"));
    CHECK(scene["structure"]["block"] == nlohmann::json({"68 mm", "141 mm", "212.5 mm"}));
    CHECK(scene["material"]["normal_stiffness"] == "160.5 MN/m");
    CHECK(here.run("new tower --block '6.8 cm' '14.1 cm' '21.25 cm' --length 1/25").out.find("wood blocks, 1:25") != std::string::npos);
    CHECK(here.run("check tower.json").exit_code == 0);
}

TEST_CASE("a model larger than its prototype is noted wherever it is asked for") {
    const Workplace here;
    const Outcome made = here.run("new column --length 107 -o column.json");
    CHECK(made.exit_code == 0);
    CHECK(made.out.find("wood blocks, 107:1") != std::string::npos);
    CHECK(made.err.find("musim: note: --length 107 makes the model larger than the prototype") != std::string::npos);
}

TEST_CASE("what a new scene cannot be is refused in one line") {
    const Workplace here;
    struct Case {
        const char* arguments;
        int exit_code;
        const char* message;
    };
    for (const Case& wrong :
         {Case{"new", 2, "kind is required"}, Case{"new towr", 2, "did you mean \"tower\"?"}, Case{"new tower --layers 0", 2, "--layers"},
          Case{"new tower --length 0", 2, "--length"},
          Case{"new tower --material stone", 3, "\"stone\" is neither a known material nor a file"},
          Case{"new tower --component x=1", 2, "--record"}, Case{"new tower --record lost.v1", 3, "lost.v1"},
          Case{"new tower --block 1cm 2cm", 2, "--block"}, Case{"new tower --block 1cm 2cm 3kg", 2, "a length is wanted"},
          Case{"new tower --block 1cm 2cm 0m", 2, "not above zero"}, Case{"new tower --block 1 2 3", 2, "the unit is missing"},
          Case{"new tower --record a.at2 b.at2", 2, "--record takes one file); merge the files of one station with `musim record process"},
          Case{"new tower --length 1e-300", 3, "musim: error: "}, Case{"new tower -o gone/tower.json", 3, "gone"}}) {
        CAPTURE(wrong.arguments);
        const Outcome outcome = here.run(wrong.arguments);
        CHECK(outcome.exit_code == wrong.exit_code);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
        CHECK_MESSAGE(outcome.err.find(wrong.message) != std::string::npos, outcome.err);
        CHECK(here.count() == 0);
    }
}
