#include <doctest/doctest.h>

#include <string>

#include "tests/cli/program.hpp"

using namespace musim::cli;

TEST_CASE("watch follows a run, says that it was killed, and that it has finished") {
    const Workplace here;
    here.write("scene.json", R"({"schema": "musim-scene/1", "name": "two blocks",
        "material": {"density": 2320, "normal_stiffness": "2 GN/m", "shear_stiffness": "2 GN/m", "friction": 0.3, "restitution": 0.3},
        "structure": {"kind": "column", "layers": 2, "block": ["2 m", "2 m", "1 m"]},
        "base_motion": {"signal": "sine", "direction": "x", "amplitude": "0.6 g", "frequency": "2 Hz", "cycles": 80},
        "time": {"duration": "40 s"}, "output": {"spine_rate": "200 Hz"}})");
    // it reports its state after two seconds
    here.kill_halfway("run scene.json -o out --checkpoint-interval 0", "[ out/progress.json -nt started ]",
                      MUSIM_PROGRAM " watch out --json >look.json; " MUSIM_PROGRAM " watch out --once >look.txt");
    REQUIRE(here.has("look.json"));
    const nlohmann::json look = nlohmann::json::parse(here.read("look.json"));
    CHECK(look["state"] == "working");
    REQUIRE(look["runs"].size() == 1);
    CHECK(look["runs"][0]["works"] == true);
    CHECK(look["runs"][0]["run"]["duration_s"].get<double>() == doctest::Approx(40.0));
    CHECK(look["runs"][0]["run"]["time_s"].get<double>() < 40.0);
    const std::string text = here.read("look.txt");
    CHECK_MESSAGE(text.starts_with("two blocks: "), text);
    CHECK_MESSAGE(text.find(" of 40.000 s, kinetic energy ") != std::string::npos, text);
    // no bars and no colours but on a terminal
    CHECK(text.find('\x1b') == std::string::npos);
    CHECK(text.find("▁") == std::string::npos);

    const Outcome killed = here.run("watch out");
    CHECK(killed.exit_code == 3);
    CHECK(killed.has_one_error_line());
    CHECK(killed.err.find("was killed; go on with --resume out") != std::string::npos);
    CHECK(here.run("watch out --json").json()["state"] == "killed");

    REQUIRE(here.run("run --resume out").exit_code == 0);
    CHECK_FALSE(here.has("out/progress.json"));
    const Outcome finished = here.run("watch out");
    CHECK(finished.exit_code == 0);
    CHECK(finished.out == "out: finished, completed\n");
    CHECK(here.run("watch out --json").json()["status"] == "completed");
}

TEST_CASE("watch refuses a folder where nothing works and nothing is") {
    const Workplace here;
    for (const char* directory : {"nowhere", "."}) {
        const Outcome outcome = here.run("watch " + std::string(directory));
        CHECK(outcome.exit_code == 3);
        CHECK(outcome.has_one_error_line());
        CHECK(outcome.err.find("nothing works here, and there are no results") != std::string::npos);
    }
    CHECK(here.run("watch nowhere --json").exit_code == 3);
}

TEST_CASE("a terminal is shown where a run stands on a line that fits and with bars and without colours if it asks") {
    const Workplace here;
    if (here.run("--version", "command -v script >/dev/null &&").exit_code != 0) {
        return;
    }
    here.write("summary.json", R"({"status": "completed"})");
    here.write("progress.json",
               R"({"schema": "musim-progress/1", "name": "a name that is far longer than there is room for", "phase": "running",
        "fraction": 0.5, "wall_s": 3, "left_s": 3, "run": {"time_s": 1, "duration_s": 2, "stage": 1, "kinetic_energy_J": 1e-3,
        "largest_drift": 0.01, "blocks": 10, "fallen": 2, "collapsed": true, "axis": 0, "top_velocity_m_s": [-1, 0, 1]}})");
    const auto watch = [&](const std::string& environment) {
        here.shell("(flock -n . sleep 5 & echo $! >holder)  2>/dev/null; sleep 0.2; " + environment +
                   " script -qec 'stty cols 200; " MUSIM_PROGRAM
                   " watch . --once' /dev/null >seen.txt 2>&1 </dev/null; pkill -P $(cat holder); kill $(cat holder) 2>/dev/null; true");
        return here.read("seen.txt");
    };
    const std::string seen = watch("env -u NO_COLOR TERM=xterm");
    CHECK_MESSAGE(seen.find("kinetic energy 1 mJ, largest drift 1 %, 2 of 10 blocks fallen, collapsed") != std::string::npos, seen);
    CHECK_MESSAGE(seen.find("top v_x ▁▅█") != std::string::npos, seen);
    CHECK_MESSAGE(seen.find("\x1b[31m") != std::string::npos, seen);
    CHECK(watch("NO_COLOR=1 TERM=xterm").find("\x1b[31m") == std::string::npos);
    CHECK(watch("env -u NO_COLOR TERM=dumb").find('\x1b') == std::string::npos);
}
