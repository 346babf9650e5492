#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"
#include "tests/support/shared_records.hpp"

using namespace musim::cli;
using doctest::Approx;

namespace {

/// A record of two components, 5 s at 100 Hz, in m/s² above `offset`; the second lasts `cut` samples less.
std::string make_csv(double offset = 0.0, const std::string& more_header = "", int cut = 0) {
    std::string text =
        "# musim ground motion 1\n# quantity: acceleration\n# unit: m/s^2\n# start_s: 0\n# dt_s: 0.01\n" + more_header + "time_s,360,90\n";
    for (int i = 0; i <= 500; ++i) {
        const double t = 0.01 * i, shake = t < 0.5 ? 0.0 : 1.0;
        text += fmt::format("{},{},", t, offset + 3.0 * shake * std::sin(9.0 * t));
        text += i <= 500 - cut ? fmt::format("{}\n", offset + 2.0 * shake * std::sin(5.0 * t)) : "\n";
    }
    return text;
}

nlohmann::json spectrum(const Workplace& here, const std::string& arguments) {
    const Outcome outcome = here.run("record spectrum --json " + arguments);
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    return outcome.json();
}

/// A shared PEER record of station RSN8883.
std::string rsn8883(const std::string& azimuth) {
    return "'" + (musim::tests::shared_records() / "peer" / ("RSN8883_14383980_13849" + azimuth + ".AT2")).string() + "'";
}

long count_lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

}  // namespace

// shared/records/README.md: a Nigam-Jennings recursion by others, which agrees with PEER's own spectra; RotD50 has five digits
TEST_CASE("record spectrum gives PEER's spectra of RSN8883, and RotD50 with the other file") {
    if (!musim::tests::have_shared_records()) return;
    const Workplace here;
    const auto object = spectrum(here, rsn8883("360") + " " + rsn8883("090") + " --rotd 360,090 --periods 0.1 1 2");
    const auto& north = object["spectra"].at(0);
    CHECK(north["component"] == "360");
    CHECK(north["damping"] == 0.05);
    CHECK(north["period_s"] == std::vector<double>{0.1, 1.0});
    // PEER takes its peaks at the samples, dt apart: the true ones are up to (π dt/T)²/2 higher
    const auto check = [](const nlohmann::json& values, double at_tenth, double at_one) {
        const auto is_peer = [](double value, double printed, double higher) {
            CHECK(value >= printed * (1.0 - 1e-4));
            CHECK(value <= printed * (1.0 + higher + 1e-4));
        };
        is_peer(values.at(0), at_tenth, 0.5 * std::pow(std::acos(-1.0) * 0.005 / 0.1, 2));
        is_peer(values.at(1), at_one, 0.5 * std::pow(std::acos(-1.0) * 0.005, 2));
    };
    check(north["psa_g"], 0.3376857, 0.1302793);
    REQUIRE(object["rotd"].size() == 1);
    check(object["rotd"][0]["rotd50_psa_g"], 0.25306, 0.094044);

    // the order of the files is not that of the components
    const auto swapped = spectrum(here, rsn8883("090") + " " + rsn8883("360") + " --rotd 360,090 --periods 0.1 1 2");
    CHECK(swapped["rotd"][0]["component"] == object["rotd"][0]["component"]);
    CHECK(swapped["rotd"][0]["rotd100_deg"] == object["rotd"][0]["rotd100_deg"]);
}

TEST_CASE("all quantities of a spectrum are one response in their units, per component and damping") {
    const Workplace here;
    here.write("a.csv", make_csv());
    const auto spectra = spectrum(here, "a.csv --damping 0.02,0.05 --damping 0.1 --periods 0.2 2 3")["spectra"];
    REQUIRE(spectra.size() == 6);
    CHECK(spectra[0]["component"] == "360");
    CHECK(spectra[2]["damping"] == 0.1);
    CHECK(spectra[3]["component"] == "90");
    for (const auto& s : spectra) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto value = [&](const char* key) { return s.at(key).at(i).template get<double>(); };
            const double omega = 2.0 * 3.141592653589793 / value("period_s");
            CHECK(value("psv_cm_s") == Approx(omega * value("sd_cm")).epsilon(1e-12));
            CHECK(value("psa_g") == Approx(omega * omega * 0.01 * value("sd_cm") / 9.80665).epsilon(1e-12));
            // at low damping the mass accelerates and moves about as the pseudo-quantities say
            CHECK(value("sa_g") == Approx(value("psa_g")).epsilon(0.05));
            CHECK(value("sv_cm_s") == Approx(value("psv_cm_s")).epsilon(0.6));
        }
    }
    CHECK(spectra[0]["psa_g"][1] > spectra[1]["psa_g"][1]);

    // an option before the files does not take them for damping ratios
    CHECK(spectrum(here, "--damping 0.02 a.csv a.csv --periods 0.2 2 3")["spectra"].size() == 4);

    const auto one = spectrum(here, "a.csv --component 090")["spectra"];
    REQUIRE(one.size() == 1);
    CHECK(one[0]["component"] == "90");
    CHECK(one[0]["period_s"].size() == 100);
    CHECK(one[0]["period_s"].front() == 0.01);
    CHECK(one[0]["period_s"].back() == 10.0);
}

TEST_CASE("RotD of a file's components lies between them and their vector sum, as long as both last") {
    const Workplace here;
    here.write("a.csv", make_csv());
    here.write("shorter.csv", make_csv(0.0, "", 20));
    const auto object = spectrum(here, "a.csv --rotd 360,90 --periods 0.5 2 3");
    REQUIRE(object["spectra"].size() == 2);
    REQUIRE(object["rotd"].size() == 1);
    const auto& rotd = object["rotd"][0];
    for (std::size_t i = 0; i < 3; ++i) {
        const double x = object["spectra"][0]["psa_g"][i], y = object["spectra"][1]["psa_g"][i];
        const double least = rotd["rotd00_psa_g"][i], median = rotd["rotd50_psa_g"][i], largest = rotd["rotd100_psa_g"][i];
        CHECK(least <= median);
        CHECK(median <= largest);
        CHECK(least <= std::min(x, y) * (1.0 + 1e-12));
        CHECK(largest >= std::max(x, y) * (1.0 - 1e-12));
        CHECK(largest <= std::hypot(x, y) * (1.0 + 1e-12));
    }
    CHECK(spectrum(here, "shorter.csv --rotd 360,90 --periods 0.5 2 3")["rotd"].size() == 1);
}

TEST_CASE("spectra of uncorrected records are above their initial level") {
    const Workplace here;
    here.write("level.csv", make_csv());
    here.write("offset.csv", make_csv(5.0, "# integration_corner_hz: 0.05\n"));
    const auto level = spectrum(here, "level.csv --rotd 360,90"), offset = spectrum(here, "offset.csv --rotd 360,90");
    for (std::size_t i = 0; i < 100; ++i) {
        // rounding of the offset samples
        CHECK(offset["spectra"][0]["psa_g"][i].get<double>() == Approx(level["spectra"][0]["psa_g"][i].get<double>()).epsilon(1e-9));
        CHECK(offset["rotd"][0]["rotd50_psa_g"][i].get<double>() ==
              Approx(level["rotd"][0]["rotd50_psa_g"][i].get<double>()).epsilon(1e-9));
    }
}

TEST_CASE("a model's spectrum at scaled periods is the prototype's") {
    // 1:16 in the same material: time 1/4, the same acceleration
    const Workplace here;
    REQUIRE(here.run("rescale synthetic --length 1/16 -o model.csv").exit_code == 0);
    const auto prototype = spectrum(here, "synthetic --periods 0.1 10 20")["spectra"][0],
               model = spectrum(here, "model.csv --periods 0.1/4 10/4 20")["spectra"][0];
    for (std::size_t i = 0; i < 20; ++i) {
        CHECK(model["psa_g"][i].get<double>() == Approx(prototype["psa_g"][i].get<double>()).epsilon(1e-9));
    }
}

TEST_CASE("a batch keeps the order of its files for any number of threads, and does what it can") {
    const Workplace here;
    here.write("a.csv", make_csv());
    here.write("b.csv", make_csv(1.0));
    here.write("bad.csv", "nothing\n");
    here.write("v.txt", "0.0 1.0\n0.1 2.0\n0.2 1.0\n0.3 0.5\n");
    const std::string good = "record spectrum --json synthetic a.csv b.csv a.csv --periods 0.1 1 5 --threads ";
    const Outcome one = here.run(good + "1"), four = here.run(good + "4");
    CHECK(one.exit_code == 0);
    CHECK(one.out == four.out);
    std::vector<std::string> files;
    const auto object = one.json();
    for (const auto& s : object["spectra"]) {
        if (files.empty() || files.back() != s["file"]) files.push_back(s["file"]);
    }
    CHECK(files == std::vector<std::string>{"synthetic", "a.csv", "b.csv", "a.csv"});

    const Outcome mixed = here.run("record spectrum --json a.csv bad.csv b.csv -o spectra.csv");
    CHECK(mixed.exit_code == 3);
    CHECK_MESSAGE(mixed.has_one_error_line(), mixed.err);
    CHECK(mixed.err.find("bad.csv") != std::string::npos);
    CHECK(mixed.json()["spectra"].size() == 4);
    CHECK(here.has("spectra.csv"));

    const Outcome none = here.run("record spectrum --json bad.csv missing.csv -o none.csv");
    CHECK(none.exit_code == 3);
    CHECK(count_lines(none.err) == 2);
    CHECK(none.out.empty());
    CHECK_FALSE(here.has("none.csv"));

    const Outcome velocity = here.run("record spectrum v.txt --quantity velocity");
    CHECK(velocity.exit_code == 3);
    CHECK_MESSAGE(velocity.has_one_error_line(), velocity.err);
    CHECK(velocity.err.find("v.txt") != std::string::npos);
}

TEST_CASE("record spectrum writes CSV with units, SVG with a curve per component, and a table") {
    const Workplace here;
    here.write("a, b.csv", make_csv());
    CHECK(here.run("record spectrum 'a, b.csv' --rotd 360,90 --periods 0.1 1 4 -o spectra.csv").exit_code == 0);
    const std::string csv = here.read("spectra.csv");
    CHECK(
        csv.starts_with("file,component,damping,period_s,psa_g,psv_cm_s,sd_cm,sa_g,sv_cm_s,rotd00_psa_g,rotd50_psa_g,rotd100_psa_g,"
                        "rotd100_deg\n\"a, b.csv\",360,0.05,0.1,"));
    CHECK(csv.find("\n\"a, b.csv\",\"360,90\",0.05,0.1,,,,,,") != std::string::npos);
    CHECK(count_lines(csv) == 1 + 3 * 4);

    CHECK(here.run("record spectrum 'a, b.csv' --rotd 360,90 -o spectra.SVG").exit_code == 0);
    const std::string svg = here.read("spectra.SVG");
    CHECK(svg.ends_with("</svg>\n"));
    for (const char* label : {">360<", ">90<", ">RotD00<", ">RotD50<", ">RotD100<", ">PSA [g]<", ">period [s]<"}) {
        CHECK_MESSAGE(svg.find(label) != std::string::npos, label);
    }

    const std::string table = here.run("record spectrum 'a, b.csv' --periods 0.1 1 4").out;
    CHECK(table.find("PSA [g]") != std::string::npos);
    CHECK(count_lines(table) == 2 * (2 + 4));

    const Outcome full = here.run("record spectrum 'a, b.csv' -o full.csv", kFullDisk);
    CHECK(full.exit_code == 3);
    CHECK(full.has_one_error_line());
    CHECK_FALSE(here.has("full.csv"));
}

TEST_CASE("a damping in percent is refused, with what to write instead") {
    const Workplace here;
    here.write("a.csv", make_csv());
    here.write("target.csv", "0.5,0.3\n0.6,0.3\n");
    for (const char* command : {"spectrum a.csv --damping 5", "spectrum a.csv --damping 0.05,5", "plot a.csv -o out.svg --damping 5",
                                "match synthetic --target target.csv -o out.csv --damping 5"}) {
        const Outcome outcome = here.run(std::string("record ") + command);
        CHECK_MESSAGE(outcome.exit_code == 2, command);
        CHECK_MESSAGE(outcome.err.starts_with("musim: error: --damping: 5 is 500 % of critical (at most 200 %); write 0.05 for 5 %; see "),
                      outcome.err);
    }
    CHECK(here.count() == 2);
    CHECK(here.run("record spectrum a.csv --damping 2 --periods 0.1 1 3").exit_code == 0);
    CHECK(here.run("record spectrum a.csv --damping 2.01 --periods 0.1 1 3").exit_code == 2);
}

TEST_CASE("what record spectrum cannot do is one error line") {
    const Workplace here;
    here.write("a.csv", make_csv());
    here.write("one.txt", "0.0 1.0\n0.1 2.0\n0.2 1.0\n0.3 0.5\n");
    for (const char* wrong :
         {"a.csv --component Up", "a.csv --rotd 360,Up", "a.csv --rotd 360,360", "one.txt --rotd 1,2", "a.csv -o nowhere/spectra.csv"}) {
        const Outcome outcome = here.run(std::string("record spectrum --json ") + wrong);
        CHECK_MESSAGE(outcome.exit_code == 3, wrong);
        CHECK_MESSAGE(outcome.has_one_error_line(), wrong, " gave ", outcome.err);
        CHECK_MESSAGE(outcome.out.empty(), wrong);
    }
    for (const char* wrong :
         {"", "a.csv --damping x", "a.csv --damping -0.05", "a.csv --periods 0 1 10", "a.csv --periods 2 1 10", "a.csv --periods 0.1 1 1",
          "a.csv --periods 0.1 1 2.5", "a.csv --periods 0.1 1 1e9", "a.csv -o spectra.xyz", "a.csv -o spectra", "a.csv --periods 0.1 1",
          "a.csv --rotd 360", "a.csv --rotd 360,", "a.csv --rotd 1,2,3", "a.csv --rotd 360,90 --component 360", "a.csv --quantity jerk"}) {
        const Outcome outcome = here.run(std::string("record spectrum ") + wrong);
        CHECK_MESSAGE(outcome.exit_code == 2, wrong);
        CHECK_MESSAGE(outcome.has_one_error_line(), wrong, " gave ", outcome.err);
    }
    CHECK(here.run("record spectrum a.csv --component Up").err.find("360, 90") != std::string::npos);
}

TEST_CASE("two records of one component each make a pair, also when both components have one name") {
    const Workplace here;
    for (const char* name : {"x.txt", "y.txt"}) {
        std::string text;
        for (int i = 0; i < 200; ++i) text += fmt::format("{} {}\n", 0.01 * i, std::sin(0.1 * i * (name[0] == 'x' ? 1.0 : 1.7)));
        here.write(name, text);
    }
    const auto object = spectrum(here, "x.txt y.txt --rotd 1,1 --periods 0.1 1 3");
    CHECK(object["spectra"].size() == 2);
    REQUIRE(object["rotd"].size() == 1);
    CHECK(object["rotd"][0]["file"] == "x.txt + y.txt");
    CHECK(object["rotd"][0]["rotd100_psa_g"][1] >= object["spectra"][0]["psa_g"][1]);

    // one that cannot be paired leaves the other one's spectra
    const Outcome outcome = here.run("record spectrum x.txt missing.txt --rotd 1,1 --json");
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.json()["spectra"].size() == 1);
    CHECK(here.run("record spectrum x.txt y.txt x.txt --rotd 1,1").exit_code == 3);
}
