#include <doctest/doctest.h>

#include <string>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

/// A column that is shaken for 20 ms; with frames, 11 of them.
std::string make_column(bool frames) {
    return std::string(R"({"schema": "musim-scene/1", "name": "column", "material": "wood",
        "structure": {"kind": "column", "layers": 3, "block": ["12.710 mm", "26.355 mm", "39.780 mm"]},
        "base_motion": {"signal": "half_sine", "direction": "x", "amplitude": "0.5 g", "duration": "20 ms"},
        "time": {"duration": "20 ms"}, "output": {"spine_rate": "5000 Hz")") +
           (frames ? R"(, "frame_rate": "500 Hz")" : "") + "}}";
}

bool is_png(const std::string& bytes) { return bytes.starts_with("\x89PNG\r\n"); }

}  // namespace

TEST_CASE("field draws chosen times beside each other, and gives the velocities on the image grid where they are asked for") {
    const Workplace here;
    here.write("scene.json", make_column(true));
    REQUIRE(here.run("run scene.json -o out").exit_code == 0);
    const Outcome outcome = here.run("field out -o pictures --at 0.004 0.01 --pixels 40 --format svg --csv --json");
    REQUIRE(outcome.exit_code == 0);
    const nlohmann::json json = outcome.json();
    REQUIRE(json["fields"].size() == 2);
    CHECK(json["fields"][0]["time_s"].get<double>() == doctest::Approx(0.004));
    CHECK(json["limit_m_s"].get<double>() > 0.0);
    CHECK(json["pictures"] == nlohmann::json{"field.svg"});
    const std::string svg = here.read("pictures/field.svg");
    CHECK(svg.find(">0.004 s<") != std::string::npos);
    CHECK(svg.find(">0.01 s<") != std::string::npos);
    for (const std::string named :
         {">Velocity to the right, along x<", ">out<", ">seen from −y; velocities relative to the fixed axes, not to the base<", ">x [m]<",
          ">z [m]<", ">velocity to the right, along x [m/s]<"}) {
        CAPTURE(named);
        CHECK(svg.find(named) != std::string::npos);
    }
    CHECK(here.read("pictures/" + json["fields"][1]["grid"].get<std::string>()).starts_with("column,row,right_m,z_m,block,level,"));
    CHECK(here.count("pictures") == 3);

    // two times nearest to one frame are one picture
    const nlohmann::json once = here.run("field out -o once --at 0.004 0.0041 0.01 --pixels 40 --format svg --json").json();
    CHECK(once["fields"].size() == 2);
    CHECK_FALSE(once["fields"][0].contains("grid"));
    CHECK(here.count("once") == 1);

    // six times, unless some are asked for; the limit is what was given, to the unit
    const nlohmann::json usual = here.run("field out -o usual --pixels 40 --format svg --limit '5 cm/s' --json").json();
    CHECK(usual["fields"].size() == 6);
    CHECK(usual["limit_m_s"].get<double>() == 0.05);

    // from the other side x grows to the left
    REQUIRE(here.run("field out -o behind --at 0.01 --view +y --component up --pixels 40 --format svg").exit_code == 0);
    const std::string behind = here.read("behind/field.svg");
    for (const std::string named : {">Velocity upward, along z, at 0.01 s<", ">seen from +y; ", ">−x [m]<"}) {
        CAPTURE(named);
        CHECK(behind.find(named) != std::string::npos);
    }
}

TEST_CASE("a film is one picture per frame, all with the same colours") {
    const Workplace here;
    here.write("scene.json", make_column(true));
    REQUIRE(here.run("run scene.json -o out").exit_code == 0);
    const Outcome outcome = here.run("field out -o film --film png --window 0.004 0.012 --pixels 40 --json");
    if (outcome.exit_code == 3 && outcome.err.find("built without PNG") != std::string::npos) {
        return;
    }
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.json()["frames"] == 5);
    CHECK(here.count("film") == 5);
    CHECK(is_png(here.read("film/field_00001.png")));
    CHECK(is_png(here.read("film/field_00005.png")));
    // the same bytes with any number of threads
    REQUIRE(here.run("field out -o again --film png --window 0.004 0.012 --pixels 40 --threads 1").exit_code == 0);
    CHECK(here.read("film/field_00003.png") == here.read("again/field_00003.png"));
}

TEST_CASE("an ffmpeg is called for a film, and an error says when it is absent or fails") {
    const Workplace here;
    here.write("scene.json", make_column(true));
    REQUIRE(here.run("run scene.json -o out").exit_code == 0);
    const std::string film = "field out -o film --film mp4 --window 0.004 0.006 --pixels 20";
    const Outcome absent = here.run(film, "PATH=/nowhere");
    CHECK(absent.exit_code == 3);
    CHECK(absent.has_one_error_line());
    CHECK(absent.err.find("there is no ffmpeg") != std::string::npos);
    CHECK_FALSE(here.has("film"));

    here.shell("mkdir bin; printf '#!/bin/sh\\nexit 7\\n' >bin/ffmpeg; chmod +x bin/ffmpeg");
    const Outcome failing = here.run(film, "PATH=$PWD/bin");
    if (failing.err.find("built without PNG") != std::string::npos) return;
    CHECK(failing.exit_code == 3);
    CHECK(failing.err.find("ffmpeg could not make it (exit status 7)") != std::string::npos);
    CHECK_FALSE(here.has("film"));

    // one that writes its last argument
    here.shell("printf '#!/bin/sh\\nfor last; do :; done\\necho \"$@\" >\"$last\"\\n' >bin/ffmpeg");
    REQUIRE(here.run(film + " --rate 10 --json", "PATH=$PWD/bin").json()["film"] == "field.mp4");
    CHECK(here.read("film/field.mp4").find("-framerate 10 -i film/.film/field_%05d.png") != std::string::npos);
    // without the pictures it is made of
    CHECK(here.count("film") == 1);
}

TEST_CASE("field names what is wrong and leaves nothing behind") {
    const Workplace here;
    here.write("scene.json", make_column(false));
    REQUIRE(here.run("run scene.json -o plain").exit_code == 0);
    here.write("framed.json", make_column(true));
    REQUIRE(here.run("run framed.json -o out").exit_code == 0);
    const auto refuses = [&](const std::string& arguments, const std::string& why, int code = 2) {
        CAPTURE(arguments);
        const Outcome outcome = here.run("field " + arguments + " -o pictures");
        CHECK(outcome.exit_code == code);
        CHECK(outcome.has_one_error_line());
        CHECK_MESSAGE(outcome.err.find(why) != std::string::npos, outcome.err);
        CHECK_FALSE(here.has("pictures"));
    };
    refuses("nowhere", "nowhere", 3);
    refuses("plain", "the run has kept no frames", 3);
    refuses("out --limit '5 m'", "--limit: ");
    refuses("out --limit '-5 cm/s'", "colours end at a velocity above zero");
    refuses("out --film png --window 0.01 0.004", "--window: it ends before it begins");
    refuses("out --film png --rate 0", "--rate: ");
    CHECK(here.run("field out -o pictures --at 0.1 --film png").exit_code == 2);
    CHECK(here.run("field out").exit_code == 2);
}
