#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

/// A PEER file of `npts` samples of a 2 Hz sine of 0.3 g; the header may claim another number or time step.
std::string make_at2(int npts, int claimed, const std::string& dt = ".0100", const std::string& spoilt_sample = "") {
    std::string text =
        "PEER NGA STRONG MOTION DATABASE RECORD\nMADE UP, 1/1/2000, NOWHERE, 90\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=  " +
        std::to_string(claimed) + ", DT=   " + dt + " SEC\n";
    for (int i = 0; i < npts; ++i) {
        text +=
            i == npts / 2 && !spoilt_sample.empty() ? "  " + spoilt_sample : "  " + std::to_string(0.3 * std::sin(0.04 * 3.14159265 * i));
        if (i % 5 == 4) text += "\n";
    }
    return text + "\n";
}

}  // namespace

TEST_CASE("record info reports format, length and peaks of every component") {
    const Workplace here;
    here.write("a.at2", make_at2(400, 400));
    const Outcome outcome = here.run("record info a.at2 synthetic --json");
    CHECK(outcome.exit_code == 0);
    const auto components = outcome.json()["components"];
    REQUIRE(components.size() == 2);
    for (const char* key : {"file", "format", "station", "component", "quantity", "unit", "dt_s", "npts", "pga_g", "pgv_cm_s", "pgd_cm",
                            "arias_m_s", "d5_95_s"}) {
        CHECK_MESSAGE(components[0].contains(key), key);
    }
    CHECK(components[0]["npts"] == 400);
    CHECK(components[0]["dt_s"] == 0.01);
    // samples are written with six decimals, and none falls on the crest of the sine: within (pi f dt)^2/2 = 0.2 %
    CHECK(components[0]["pga_g"].get<double>() == doctest::Approx(0.3).epsilon(0.002));
    // the built-in record has the peaks of the papers' Ridgecrest record
    CHECK(components[1]["pga_g"].get<double>() == doctest::Approx(0.511).epsilon(1e-8));
    CHECK(components[1]["pgv_cm_s"].get<double>() == doctest::Approx(42.4).epsilon(1e-8));

    CHECK(here.run("record info a.at2").out.find("PEER AT2") != std::string::npos);
}

TEST_CASE("rescale multiplies time and samples by the factors it prints, and reads its own output back") {
    const Workplace here;
    const Outcome outcome = here.run("rescale synthetic --length 1/107 --friction 0.63/0.59 -o model.csv --json");
    CHECK(outcome.exit_code == 0);
    const auto object = outcome.json();
    CHECK(object["factors"]["time"].get<double>() == doctest::Approx(0.09355432).epsilon(1e-6));

    const auto model = here.run("record info model.csv --json").json()["components"][0];
    CHECK(model["dt_s"].get<double>() == doctest::Approx(0.005 * object["factors"]["time"].get<double>()).epsilon(1e-12));
    CHECK(model["pga_g"].get<double>() == doctest::Approx(0.511 * object["factors"]["acceleration"].get<double>()).epsilon(1e-8));
    CHECK(model["pgv_cm_s"].get<double>() == doctest::Approx(42.4 * object["factors"]["velocity"].get<double>()).epsilon(1e-8));
}

TEST_CASE("a component that is asked for is the only one that is reported and written, in every format") {
    const Workplace here;
    here.write("two.txt", "0 1 -2\n0.1 -1 3\n0.2 0.5 1\n0.3 0 0\n");
    for (const char* file : {"one.csv", "one.v2", "one.at2"}) {
        CAPTURE(std::string(file));
        const Outcome outcome = here.run("rescale two.txt --length 1/4 --law froude --component 2 --json -o " + std::string(file));
        REQUIRE(outcome.exit_code == 0);
        REQUIRE(outcome.json()["components"].size() == 1);
        CHECK(outcome.json()["components"][0]["component"] == "2");
        CHECK(here.run("record info " + std::string(file) + " --json").json()["components"].size() == 1);
    }
    const Outcome unknown = here.run("rescale two.txt --length 1/4 --law froude --component 7 -o seven.csv");
    CHECK(unknown.exit_code == 3);
    CHECK(unknown.has_one_error_line());
    CHECK_FALSE(here.has("seven.csv"));
}

TEST_CASE("rescale writes PEER files, and asks for a format where the name implies none") {
    const Workplace here;
    CHECK(here.run("rescale synthetic --length 1/25 -o model.at2").exit_code == 0);
    const Outcome velocity = here.run("rescale synthetic --length 1/25 -o model.vt2");
    CHECK(velocity.exit_code == 3);
    CHECK(velocity.err.find(".vt2 means velocity, and component 1 is acceleration; name a .at2 file") != std::string::npos);
    CHECK(here.run("record info model.at2 --json").json()["components"][0]["format"] == "PEER AT2");
    CHECK(here.run("rescale synthetic --length 1/25 -o model --format csv").exit_code == 0);
    const Outcome unknown = here.run("rescale synthetic --length 1/25 -o model.xyz");
    CHECK(unknown.exit_code == 2);
    CHECK(unknown.has_one_error_line());
    CHECK_FALSE(here.has("model.xyz"));
}

TEST_CASE("a broken record is one error line that names file and line, exit code 3, and no output file") {
    const Workplace here;
    here.write("truncated.at2", make_at2(200, 400));
    here.write("npts.at2", make_at2(400, 300));
    here.write("nan.at2", make_at2(400, 400, ".0100", "NaN"));
    here.write("dt.at2", make_at2(400, 400, ".0000"));
    here.write("empty.at2", "");
    here.write("noise.bin", std::string("\x01\x02\xff\x00\x07", 5));
    for (const char* name : {"truncated.at2", "npts.at2", "nan.at2", "dt.at2", "empty.at2", "noise.bin", "missing.at2", "."}) {
        for (const std::string command : {"record info --json ", "rescale --length 1/25 -o out.csv "}) {
            const Outcome outcome = here.run(command + name);
            CHECK_MESSAGE(outcome.exit_code == 3, command, name);
            CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
            CHECK_MESSAGE(outcome.err.find(name) != std::string::npos, outcome.err);
            CHECK(outcome.out.empty());
        }
    }
    CHECK(here.count() == 6);
}

TEST_CASE("an unknown unit is refused with the known ones") {
    const Workplace here;
    here.write("a.txt", "0.0 1.0\n0.1 2.0\n0.2 1.0\n0.3 0.5\n");
    CHECK(here.run("record info a.txt --unit g").exit_code == 0);
    const Outcome outcome = here.run("record info a.txt --unit furlong");
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.has_one_error_line());
    CHECK(outcome.err.find("furlong") != std::string::npos);
}

TEST_CASE("PGV of an uncorrected record is reported as that of a high-passed motion, and kept in files that musim wrote") {
    const Workplace here;
    here.write("raw.at2", make_at2(2000, 2000));
    REQUIRE(here.run("rescale raw.at2 --length 1 -o raw.csv").exit_code == 0);
    here.shell("sed -i 's/^# dt_s/# integration_corner_hz: 0.25\\n# dt_s/' raw.csv");
    const Outcome outcome = here.run("rescale raw.csv --length 1/25 --gravity 25 -o model.csv");
    CHECK(outcome.out.find("high-pass 0.25 Hz") != std::string::npos);
    CHECK(outcome.out.find("high-pass 6.25 Hz") != std::string::npos);  // λ_t = 1/25
    CHECK(here.run("rescale synthetic --length 1/25 -o s.csv").out.find("no filter") != std::string::npos);
    for (const char* const file : {"model.csv", "model.at2", "model.v1"}) {
        CAPTURE(file);
        const auto model =
            here.run(std::string("rescale raw.csv --length 1/25 --gravity 25 --json -o ") + file).json()["components"][0]["model"];
        const auto read = here.run(std::string("record info --json ") + file).json()["components"][0];
        CHECK(model["highpass_hz"] == 6.25);
        CHECK(read["highpass_hz"] == 6.25);
        // samples in other units: two roundings
        CHECK(read["pgv_cm_s"].get<double>() == doctest::Approx(model["pgv_cm_s"].get<double>()).epsilon(1e-12));
    }
    // miniSEED has no room for it, which is said
    const Outcome lost = here.run("rescale raw.csv --length 1/25 --gravity 25 -o model.mseed");
    CHECK(lost.exit_code == 0);
    CHECK(lost.err.find("miniSEED cannot say how the record is integrated (high-pass 6.25 Hz)") != std::string::npos);
}

TEST_CASE("a record that was only rescaled is no recipe, and the message says why") {
    const Workplace here;
    REQUIRE(here.run("rescale synthetic --length 1/25 -o model.csv").exit_code == 0);
    const Outcome outcome = here.run("record process synthetic --recipe model.csv -o x.csv");
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.has_one_error_line());
    CHECK(outcome.err.find("model.csv: its history has no step of a recipe") != std::string::npos);
    CHECK_FALSE(here.has("x.csv"));
}

TEST_CASE("a full disk leaves no partial record") {
    const Workplace here;
    const Outcome outcome = here.run("rescale synthetic --length 1/25 -o model.csv", kFullDisk);
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.has_one_error_line());
    CHECK(here.count() == 0);
    CHECK(here.run("rescale synthetic --length 1/25 --format csv -o /dev/full").exit_code == 3);
    CHECK(std::filesystem::is_character_file("/dev/full"));
}

TEST_CASE("record process follows a recipe, and its output contains the recipe") {
    const Workplace here;
    const Outcome done =
        here.run(R"(record process synthetic --step '{"step": "filter", "low": "0.2 Hz", "order": 4}' --step '{"step": "rest"}' )"
                 "-o one.csv --save-recipe recipe.json --json");
    CHECK(done.exit_code == 0);
    const auto history = done.json()["history"].get<std::vector<std::string>>();
    REQUIRE(history.size() >= 2);
    CHECK(history[history.size() - 2] == R"({"step":"filter","low":0.2,"order":4,"phase":"zero"})");
    CHECK(history.back() == R"({"step":"rest","end":"home"})");
    for (const char* key : {"pga_g", "pgv_cm_s", "dt_s", "duration_s"}) {
        CHECK(done.json()["components"][0]["before"].contains(key));
        CHECK(done.json()["components"][0]["after"].contains(key));
    }
    // by the recipe that was saved, and by the history of the output: the same file
    CHECK(here.run("record process synthetic --recipe recipe.json -o two.csv").exit_code == 0);
    CHECK(here.run("record process synthetic --recipe one.csv -o three.csv").exit_code == 0);
    CHECK(here.read("two.csv") == here.read("one.csv"));
    CHECK(here.read("three.csv") == here.read("one.csv"));
    CHECK(here.run("record process synthetic --recipe recipe.json -o four.v2").exit_code == 0);
    CHECK(here.run("record info four.v2").out.find("COSMOS") != std::string::npos);
    CHECK(here.run("record process synthetic --recipe recipe.json -o five.mseed").exit_code == 0);
    CHECK(here.run("record info five.mseed --sensitivity 1").exit_code == 0);
}

TEST_CASE("what record process cannot do is said in one line, and nothing is written") {
    const Workplace here;
    here.write("bad.json", R"({"schema": "musim-recipe/1", "steps": [{"step": "filtre"}]})");
    struct Case {
        std::string arguments, message;
    };
    for (const Case& wanted :
         {Case{"--recipe bad.json -o x.csv", "bad.json: step 1 (filtre): is no step; take one of"},
          Case{"--recipe missing.json -o x.csv", "missing.json: cannot be read"},
          Case{"-o x.csv", "there is nothing to do: give --recipe FILE or --step JSON"},
          Case{R"(--step '{"step": "cut", "window": [900, 901]}' -o x.csv)", "step 1 (cut): window 900 s to 901 s does not fit"},
          Case{R"(--step '{"step": "level"}' -o x.xyz)", "--out: \"x.xyz\" implies no format; add --format csv, at2, cosmos or mseed"}}) {
        CAPTURE(wanted.arguments);
        const Outcome outcome = here.run("record process synthetic " + wanted.arguments);
        CHECK(outcome.exit_code != 0);
        CHECK(outcome.has_one_error_line());
        CHECK(outcome.err.find(wanted.message) != std::string::npos);
        CHECK_FALSE(here.has("x.csv"));
    }
}
