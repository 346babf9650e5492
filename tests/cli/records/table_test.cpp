#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"
#include "tests/support/relative.hpp"

using namespace musim::cli;
using musim::lsdem::tests::relative;

namespace {

/// A table of one axis, 1 m/s and the given displacement.
std::string make_table(const std::string& displacement, const std::string& more = "") {
    return R"({"schema": "musim-table/1", "name": "test table", "axes": [{"names": ["x"], "displacement": ")" + displacement +
           R"(", "velocity": "1 m/s")" + more + R"(}], "controller": {"rate": "2000 Hz", "rest": "0.5 s", "displacement": "mm"}})";
}

constexpr const char* kArguments = "table synthetic --limits table.json --length 1/25 ";

/// Column `index` of a drive file.
std::vector<double> column(const std::string& text, int index) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    std::vector<double> values;
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        std::string cell;
        for (int i = 0; i <= index; ++i) std::getline(cells, cell, ',');
        values.push_back(std::stod(cell));
    }
    return values;
}

double largest(const std::vector<double>& values) {
    double peak = 0.0;
    for (const double value : values) peak = std::max(peak, std::abs(value));
    return peak;
}

}  // namespace

TEST_CASE("table says that a record fits, at which scales, and writes the drive file") {
    const Workplace here;
    here.write("table.json", make_table("100 mm"));
    const Outcome outcome = here.run(std::string(kArguments) + "--drive drive.csv --save-recipe recipe.json --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto object = outcome.json();
    CHECK(object["fits"] == true);
    CHECK(object["table"] == "test table");
    CHECK(object["corrections"].empty());
    CHECK(object["drive"] == "drive.csv");
    // what the controller's step and the end at rest do to the record is reported, all of it of the motion that is written
    const auto& effect = object["drive_effects"].at(0);
    CHECK(effect["pga_g"].at(1).get<double>() == relative(effect["pga_g"].at(0).get<double>(), 0.05));
    CHECK(effect["pgv_cm_s"].at(0).get<double>() == relative(42.4 / 5.0, 0.01));
    CHECK(effect["mean_psa_factor"].get<double>() >= 1.0);
    CHECK(effect["mean_psa_factor"].get<double>() < 1.1);
    const std::string said = here.run(std::string(kArguments)).out;
    CHECK(effect["largest_difference"]["pgv_cm_s"].get<double>() < 0.02 * effect["pgv_cm_s"].at(0).get<double>());
    CHECK(said.find("The table's motion is that of the base in a run of the model's record") != std::string::npos);
    CHECK(said.find("largest difference at any time ") != std::string::npos);
    CHECK(said.find("    record      table unit     used") != std::string::npos);
    CHECK(said.find("PSA by a factor ") != std::string::npos);
    const auto& component = object["components"].at(0);
    CHECK(component["axis"] == "x");
    // the built-in record has 42.4 cm/s, the scale 1/25 a fifth of it; tapers and the controller's step move it a little
    CHECK(component["velocity_cm_s"].get<double>() == relative(42.4 / 5.0, 0.02));
    const auto& limit = component["limits"].at(0);
    CHECK(limit["limit"] == "displacement");
    CHECK(limit["unit"] == "mm");
    CHECK(limit["table"].get<double>() == relative(100.0, 1e-12));
    CHECK(limit["used"].get<double>() == relative(limit["record"].get<double>() / 100.0, 1e-12));
    // displacement scales with the length
    const auto& scales = object["scales"].at(0);
    CHECK(limit["scales"].at(0).at(1).get<double>() == relative(std::min(1.0, 0.04 / limit["used"].get<double>()), 1e-12));
    CHECK(scales["largest"].get<double>() >= 0.04);

    const std::string drive = here.read("drive.csv");
    CHECK(drive.starts_with("time [s],x displacement [mm],x velocity [m/s],x acceleration [m/s^2]\n0,0,0,0\n0.0005,0,0,0\n"));
    CHECK(largest(column(drive, 1)) == relative(component["displacement_mm"].get<double>(), 1e-8));
    CHECK(largest(column(drive, 2)) == relative(component["velocity_cm_s"].get<double>() / 100.0, 1e-8));
    CHECK(column(drive, 1).back() == 0.0);
    CHECK(column(drive, 0).at(1000) == 0.5);
    CHECK(here.read("recipe.json").find("\"resample\"") != std::string::npos);
}

TEST_CASE("a record that does not fit ends with code 5 and nothing written and corrected with 0 and within the limits") {
    const Workplace here;
    here.write("table.json", make_table("1 mm"));
    const Outcome outcome = here.run(std::string(kArguments) + "--drive drive.csv --save-recipe recipe.json");
    CHECK(outcome.exit_code == 5);
    CHECK(outcome.err == "musim: error: synthetic: the table cannot make it; choose another length scale, or add --correct\n");
    CHECK(outcome.out.find("too much") != std::string::npos);
    CHECK(outcome.out.find("high-pass at ") != std::string::npos);
    CHECK(outcome.out.find("amplitude times ") != std::string::npos);
    CHECK_FALSE(here.has("drive.csv"));
    CHECK_FALSE(here.has("recipe.json"));

    const Outcome refused = here.run(std::string(kArguments) + "--correct --accept 1.01 --drive drive.csv");
    CHECK(refused.exit_code == 5);
    CHECK(refused.err.find("1.01 is accepted); choose another length scale, or add --accept ") != std::string::npos);
    CHECK_FALSE(here.has("drive.csv"));

    const Outcome corrected = here.run(std::string(kArguments) + "--correct --accept 20 --drive drive.csv --json");
    REQUIRE_MESSAGE(corrected.exit_code == 0, corrected.err);
    const auto object = corrected.json();
    CHECK(object["fits"] == false);
    const auto& best = object["corrections"].at(0);
    CHECK(best["mean_change_of_ln_psa"].get<double>() > 0.0);
    CHECK(best["spectra"].at(0)["rows"].size() == 50);
    const double peak = largest(column(here.read("drive.csv"), 1));
    CHECK(peak <= 1.0);
    CHECK(peak == relative(best["components"].at(0)["displacement_mm"].get<double>(), 1e-8));
}

// horizontally U λ_H and U √λ_H
TEST_CASE("the lengths that suit a table are heights by a law that scales heights and widths apart") {
    const Workplace here;
    here.write("table.json", make_table("100 mm"));
    const std::string law = "--friction 0.18/0.59 --law mu_vertical_distortion ";
    const auto object = here.run(kArguments + law + "--json").json();
    CHECK(object["chosen"]["H"].get<double>() == relative(0.04, 1e-15));
    const auto& component = object["components"].at(0);
    CHECK(component["velocity_cm_s"].get<double>() == relative(0.18 / 0.59 * 42.4 / 5.0, 0.02));
    const auto& limit = component["limits"].at(0);
    CHECK(limit["scales"].at(0).at(1).get<double>() == relative(std::min(1.0, 0.04 / limit["used"].get<double>()), 1e-12));
    const auto& speed = component["limits"].at(1);
    CHECK(speed["scales"].at(0).at(1).get<double>() == relative(std::min(1.0, 0.04 / std::pow(speed["used"].get<double>(), 2.0)), 1e-12));
    const auto alike = here.run(std::string(kArguments) + "--law mu_vertical_distortion --json").json(),
               froude = here.run(std::string(kArguments) + "--law froude --json").json();
    CHECK(alike["components"] == froude["components"]);
    CHECK(alike["scales"] == froude["scales"]);
    // what an axis z makes is vertical
    here.write("up.json", R"({"schema": "musim-table/1", "name": "up", "axes": [{"names": ["z"], "acceleration": "2 g"}]})");
    const std::string up = "table synthetic --limits up.json --length 1/25 --axis 1=z " + law;
    CHECK(here.run(up + "--json").json()["components"].at(0)["acceleration_g"].get<double>() == relative(0.511, 0.02));
    CHECK(here.run(up).out.find("Vertical component 1: displacement 0.04, velocity 0.2, acceleration 1, which keeps a_vertical/g\n\n") !=
          std::string::npos);
    CHECK(here.run(kArguments + law).out.find("test table: law mu_vertical_distortion, height H 0.04, width 0.01220339, time 0.2") == 0);
}

TEST_CASE("the payload is the model's or the prototype's scaled") {
    const Workplace here;
    here.write("table.json", make_table("100 mm", R"(, "payload": "2 t")"));
    const auto used = [&](const std::string& payload) {
        const Outcome outcome = here.run(std::string(kArguments) + "--json " + payload);
        const auto object = outcome.json();
        for (const auto& limit : object["components"].at(0)["limits"]) {
            if (limit["limit"] == "payload") return limit["used"].get<double>();
        }
        return -1.0;
    };
    CHECK(used("--payload '500 kg'") == relative(0.25, 1e-12));
    CHECK(used("--prototype-mass '15625 t'") == relative(0.5, 1e-12));  // 25³ t
    // models of other lengths have other masses: 2 t at 4^(1/3) of this length
    const auto limits = here.run(std::string(kArguments) + "--json --payload '500 kg'").json()["components"].at(0)["limits"];
    for (const auto& limit : limits) {
        if (limit["limit"] == "payload") CHECK(limit["scales"].at(0).at(1).get<double>() == relative(0.04 * std::cbrt(4.0), 1e-9));
    }
    CHECK(used("--payload '4 t'") == relative(2.0, 1e-12));
    CHECK(here.run(std::string(kArguments) + "--payload '4 t' --correct").err ==
          "musim: error: synthetic: the table cannot make it; choose another length scale or table\n");
}

TEST_CASE("the example tables are read") {
    const Workplace here;
    const std::string folder = MUSIM_SOURCE_DIR "/examples/tables/";
    for (const char* const name : {"array.json", "outdoor.json"}) {
        const Outcome outcome = here.run("table synthetic --limits '" + folder + name + "' --length 1/10 --json");
        CHECK_MESSAGE((outcome.exit_code == 0 || outcome.exit_code == 5), outcome.err);
        CHECK(outcome.json()["components"].size() == 1);
    }
}

TEST_CASE("a table judges models of a law as data, and finds their length scales") {
    const Workplace here;
    here.write("table.json", make_table("10 m"));
    const Outcome outcome = here.run(std::string(kArguments) + "--law gravity_distorted --set a=16 --json");
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    const auto object = outcome.json();
    // with the acceleration chosen, velocities go with sqrt(l): the 1 m/s are reached where (v at 1/25) sqrt(25 l) is as much
    const double velocity = object["components"].at(0)["velocity_cm_s"].get<double>() / 100.0;
    const auto& scales = object["scales"];
    REQUIRE(scales.size() == 1);
    CHECK(scales[0]["binds_above"] == "velocity");
    CHECK(scales[0]["largest"].get<double>() == relative(1.0 / (25.0 * velocity * velocity), 1e-12));

    const Outcome incomplete = here.run(std::string(kArguments) + "--law gravity_distorted");
    CHECK(incomplete.exit_code != 0);
    CHECK(incomplete.has_one_error_line());
    CHECK(incomplete.err.find("give it as --set NAME=NUMBER") != std::string::npos);
}

TEST_CASE("a table may end displaced, and does not take a motion that never stops") {
    const Workplace here;
    here.write("table.json", make_table("2 m"));
    // v = 0.8 sin²(pi t) m/s for a second: 0.4 m further at its end
    std::string pulse;
    for (int k = 0; k <= 200; ++k)
        pulse += std::to_string(0.005 * k) + " " + std::to_string(0.8 * std::pow(std::sin(std::numbers::pi * 0.005 * k), 2)) + "\n";
    here.write("pulse.txt", pulse);
    const std::string run =
        "table pulse.txt --unit m/s --quantity velocity --limits table.json --length 1 --periods 0.1 2 --drive drive.csv ";
    const Outcome displaced = here.run(run + "--at-rest displaced");
    REQUIRE_MESSAGE(displaced.exit_code == 0, displaced.err);
    CHECK(column(here.read("drive.csv"), 1).back() == relative(400.0, 1e-3));
    CHECK(displaced.err.empty());
    const Outcome home = here.run(run);
    REQUIRE_MESSAGE(home.exit_code == 0, home.err);
    CHECK(std::abs(column(here.read("drive.csv"), 1).back()) < 1e-6);
    CHECK(home.err.find("musim: warning: pulse.txt: component 1: the table makes PG") == 0);
    // half of the pulse ends at its peak
    here.write("half.txt", pulse.substr(0, pulse.find("0.505000")));
    const Outcome moving = here.run(
        "table half.txt --unit m/s --quantity velocity --limits table.json --length 1 --periods 0.1 2 --drive no.csv --at-rest no");
    CHECK(moving.exit_code == 3);
    CHECK(moving.err.find("the motion ends at ") != std::string::npos);
    CHECK_FALSE(here.has("no.csv"));
}

TEST_CASE("rotations and translations with the same limits are refused in one line") {
    const Workplace here;
    here.write("tilting.json", R"({"schema": "musim-table/1", "axes": [{"names": ["x", "pitch"], "velocity": "1 m/s"}]})");
    const Outcome axis = here.run("table synthetic --limits tilting.json --length 1/25");
    CHECK(axis.exit_code == 3);
    CHECK(axis.has_one_error_line());
    CHECK(axis.err.find("names are of translations and of rotations (their limits have other units)") != std::string::npos);
}

TEST_CASE("wrong input to table is reported in one line") {
    const Workplace here;
    here.write("table.json", make_table("100 mm"));
    here.write("bare.json", R"({"schema": "musim-table/1", "axes": [{"names": ["x"]}]})");
    const auto error = [&](const std::string& arguments, int code) {
        const Outcome outcome = here.run("table " + arguments);
        CHECK(outcome.exit_code == code);
        CHECK(outcome.has_one_error_line());
        CHECK(outcome.out.empty());
        return outcome.err;
    };
    CHECK(error("synthetic --limits none.json --length 1/25", 3).find("none.json: cannot be read") != std::string::npos);
    CHECK(error("synthetic --limits bare.json --length 1/25 --drive d.csv", 3).find("bare.json: has no controller") != std::string::npos);
    CHECK(error("synthetic --limits table.json --length 1/25 --axis x", 2).find("\"x\" is no COMPONENT=AXIS") != std::string::npos);
    CHECK(error("synthetic --limits table.json --length 1/25 --axis 1=q", 3).find("no axis \"q\"") != std::string::npos);
    CHECK(error("synthetic --limits table.json --length 1/25 --payload '3 m'", 2).find("a mass is wanted") != std::string::npos);
    CHECK(error("synthetic --limits table.json --length 1/25 --payload '-3 kg'", 2).find("is below zero") != std::string::npos);
    CHECK(error("synthetic --limits table.json --length 1/25 --payload '3 kg' --prototype-mass '3 t'", 2).find("contradicts") !=
          std::string::npos);
    CHECK(error("synthetic --length 1/25", 2).find("--limits is required") != std::string::npos);
}
