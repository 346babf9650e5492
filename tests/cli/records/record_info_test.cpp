#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

constexpr double kGravity = 9.80665;  // [m/s²]

/// A record of 10 s at 100 Hz in m/s² as musim writes it; `corner` as of an uncorrected one.
std::string make_channel(const std::function<double(double)>& acceleration, bool corner = false) {
    std::string text = "# musim ground motion 1\n# quantity: acceleration\n# unit: m/s^2\n# start_s: 0\n# dt_s: 0.01\n";
    if (corner) text += "# integration_corner_hz: 0.05\n";
    text += "time_s,360\n";
    for (int i = 0; i <= 1000; ++i) text += fmt::format("{},{}\n", 0.01 * i, acceleration(0.01 * i));
    return text;
}

nlohmann::json info(const Workplace& here, const std::string& arguments) {
    const Outcome outcome = here.run("record info --json " + arguments);
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    return outcome.json()["components"][0];
}

double number(const nlohmann::json& object, const char* key) { return object.at(key).get<double>(); }

}  // namespace

TEST_CASE("record info measures a constant acceleration as the closed forms do") {
    const Workplace here;
    here.write("a.csv", make_channel([](double) { return 3.0; }));
    const auto a = info(here, "a.csv");
    CHECK(number(a, "d5_75_s") == doctest::Approx(7.0).epsilon(1e-9));
    CHECK(number(a, "cav_m_s") == doctest::Approx(30.0).epsilon(1e-9));
    CHECK(number(a, "rms_g") == doctest::Approx(3.0 / kGravity).epsilon(1e-9));
    CHECK(number(a, "bracketed_s") == doctest::Approx(10.0).epsilon(1e-9));
    CHECK(number(a, "vmax_over_amax_s") == doctest::Approx(10.0).epsilon(1e-9));
    CHECK_FALSE(a.contains("groups"));
    CHECK(info(here, "a.csv --bracket 0.31")["bracketed_s"].is_null());
    CHECK(info(here, "a.csv --mean-period-band 51 60")["mean_period_s"].is_null());
}

TEST_CASE("record info notes a displacement that drifts") {
    const Workplace here;
    here.write("drift.csv", make_channel([](double t) { return std::sin(6.0 * t) + 0.1; }));
    here.write("rest.csv", make_channel([](double t) {
                   return t < 2.0 ? std::cos(2.0 * std::numbers::pi * t) - std::cos(3.0 * std::numbers::pi * t) : 0.0;
               }));
    const Outcome drift = here.run("record info drift.csv");
    CHECK(drift.err.starts_with("musim: note: drift.csv: displacement of 360 is largest at the end, "));
    CHECK(here.run("record info drift.csv --highpass 0.2").err.empty());
    CHECK(here.run("record info rest.csv").err.empty());
}

TEST_CASE("record info shows the files that it can use beside those that it cannot") {
    const Workplace here;
    here.write("good.csv", make_channel([](double) { return 3.0; }));
    here.write("bad.at2", "no record\n");
    for (const std::string files : {"good.csv bad.at2 good.csv", "bad.at2 good.csv good.csv"}) {
        const Outcome outcome = here.run("record info " + files);
        CHECK(outcome.exit_code == 3);
        CHECK(outcome.out.find("good.csv: musim CSV") != outcome.out.rfind("good.csv: musim CSV"));
        CHECK(outcome.err.starts_with("musim: error: bad.at2"));
        const Outcome json = here.run("record info --json " + files);
        CHECK(json.exit_code == 3);
        CHECK(json.json()["components"].size() == 2);
    }
}

TEST_CASE("record info names the start, the clock and what turned the file into motion") {
    const Workplace here;
    std::string text = make_channel([](double t) { return std::sin(8.0 * t); }, true);
    text.replace(text.find("# start_s: 0"), 12, "# start_s: 12.5\n# time_zero_utc: 2019/07/06 03:16:08.000000");
    text.replace(text.find("\n0,"), 3, "\n12.5,");
    for (int i = 1; i <= 1000; ++i) {
        const std::string old = fmt::format("\n{},", 0.01 * i);
        text.replace(text.find(old), old.size(), fmt::format("\n{},", 12.5 + 0.01 * i));
    }
    here.write("a.csv", text);
    const auto a = info(here, "a.csv");
    CHECK(number(a, "start_s") == 12.5);
    CHECK(a.at("first_sample_utc") == "2019/07/06 03:16:20.500000");
    CHECK(a.at("begins_in_motion") == true);
    const Outcome shown = here.run("record info a.csv");
    CHECK(shown.out.find("starts at 12.5 s, 2019/07/06 03:16:20.500000 UTC, in motion: its level is the mean of all samples") !=
          std::string::npos);

    // written as miniSEED and read with a sensitivity: that is named
    here.write("r.json", R"({"schema": "musim-recipe/1", "steps": [{"step": "amplify", "factor": 1}]})");
    REQUIRE(here.run("record process a.csv --recipe r.json -o a.mseed").exit_code == 0);
    const Outcome counts = here.run("record info a.mseed --sensitivity 2");
    CHECK(counts.out.find("2019/07/06 03:16:20.500000 UTC") != std::string::npos);
    CHECK(counts.out.find(" 2 counts per m/s^2") != std::string::npos);
}

// [Housner52]: the area below PSV. A constant acceleration A moves an undamped oscillator by 2A/ω²: PSV = 2A/ω = A T/π, at 5 % damping
// (1 + e^{−ζπ/√(1−ζ²)})/2 of it; its area from T₁ to T₂ is A (T₂² − T₁²)/(2π) of the same.
TEST_CASE("record info has Housner's spectrum intensity") {
    const Workplace here;
    here.write("a.csv", make_channel([](double) { return 3.0; }));
    const double overshoot = 0.5 * (1.0 + std::exp(-0.05 * std::numbers::pi / std::sqrt(1.0 - 0.05 * 0.05)));
    const auto expected = [&](double first, double last) {
        return 100.0 * 3.0 * (last * last - first * first) / (2.0 * std::numbers::pi) * overshoot;
    };
    CHECK(number(info(here, "a.csv"), "housner_cm") == doctest::Approx(expected(0.1, 2.5)).epsilon(1e-4));
    CHECK(number(info(here, "a.csv --intensity-band 0.05 1"), "housner_cm") == doctest::Approx(expected(0.05, 1.0)).epsilon(1e-4));
    CHECK(here.run("record info a.csv --intensity-band 1 0.5").exit_code == 2);
}

TEST_CASE("record info finds the period of a sine") {
    const Workplace here;
    here.write("a.csv", make_channel([](double t) { return 2.0 * std::sin(4.0 * std::numbers::pi * t); }));
    const auto a = info(here, "a.csv");
    // 1001 samples are no whole number of periods: 1 % for what leaks; 200 periods are 2 % apart; 5 % damping shifts by less
    CHECK(number(a, "mean_period_s") == doctest::Approx(0.5).epsilon(0.01));
    CHECK(number(a, "predominant_period_s") == doctest::Approx(0.5).epsilon(0.02));
    CHECK(number(a, "pulse_period_s") == doctest::Approx(0.5).epsilon(0.02));
}

TEST_CASE("record info puts a record in proportion to a structure") {
    const Workplace here;
    here.write("a.csv", make_channel([](double) { return 3.0; }));
    const auto groups = info(here, "a.csv --friction 0.2 --length 2 --slenderness 45").at("groups");
    const double yield = 0.2 * kGravity;
    CHECK(number(groups, "pga_over_mu_g") == doctest::Approx(3.0 / yield).epsilon(1e-9));
    CHECK(number(groups, "pgv_over_sqrt_mu_g_l") == doctest::Approx(30.0 / std::sqrt(yield * 2.0)).epsilon(1e-9));
    CHECK(number(groups, "pga_over_g_tan_alpha") == doctest::Approx(3.0 / kGravity).epsilon(1e-9));
    CHECK(number(groups, "newmark_sliding_m") == doctest::Approx(0.5 * (3.0 - yield) * 100.0).epsilon(1e-9));
    CHECK(number(groups, "newmark_sliding_over_length") == doctest::Approx(0.25 * (3.0 - yield) * 100.0).epsilon(1e-9));

    // what one option does not give is null
    const auto slenderness_only = info(here, "a.csv --slenderness 45").at("groups");
    CHECK(slenderness_only.at("newmark_sliding_m").is_null());
    CHECK(number(slenderness_only, "pga_over_g_tan_alpha") == doctest::Approx(3.0 / kGravity).epsilon(1e-9));
    const std::string table = here.run("record info a.csv --friction 0.2").out;
    CHECK(table.find("PGA/(mu g)") != std::string::npos);
    CHECK(here.run("record info a.csv").out.find("PGA/(mu g)") == std::string::npos);
}

TEST_CASE("record info measures uncorrected records above their initial level") {
    const Workplace here;
    const auto shake = [](double t) { return t < 1.0 ? 0.0 : 3.0 * std::sin(5.0 * t) * std::exp(-0.3 * t); };
    here.write("level.csv", make_channel(shake, true));
    here.write("offset.csv", make_channel([&](double t) { return shake(t) + 5.0; }, true));
    const auto level = info(here, "level.csv --friction 0.1"), offset = info(here, "offset.csv --friction 0.1");
    // rounding of the offset samples
    for (const char* key : {"d5_75_s", "cav_m_s", "rms_g", "mean_period_s"})
        CHECK_MESSAGE(number(offset, key) == doctest::Approx(number(level, key)).epsilon(1e-9), key);
    for (const char* key : {"bracketed_s", "predominant_period_s", "pulse_period_s"})
        CHECK_MESSAGE(number(offset, key) == number(level, key), key);
    CHECK(number(offset["groups"], "newmark_sliding_m") == doctest::Approx(number(level["groups"], "newmark_sliding_m")).epsilon(1e-9));
}

TEST_CASE("a model's record has the prototype's measures, scaled") {
    // 1:16 in the same material: time 1/4, the same acceleration
    const Workplace here;
    REQUIRE(here.run("rescale synthetic --length 1/16 -o model.csv").exit_code == 0);
    const auto prototype = info(here, "synthetic --friction 0.2 --length 16"),
               model = info(here, "model.csv --mean-period-band 1 80 --friction 0.2 --length 1");
    for (const char* key :
         {"d5_75_s", "cav_m_s", "bracketed_s", "vmax_over_amax_s", "mean_period_s", "predominant_period_s", "pulse_period_s"})
        CHECK_MESSAGE(4.0 * number(model, key) == doctest::Approx(number(prototype, key)).epsilon(1e-12), key);
    for (const char* key : {"pga_over_mu_g", "pgv_over_sqrt_mu_g_l", "newmark_sliding_over_length"})
        CHECK_MESSAGE(number(model["groups"], key) == doctest::Approx(number(prototype["groups"], key)).epsilon(1e-12), key);
}

TEST_CASE("a velocity record has no measures of acceleration") {
    const Workplace here;
    here.write("v.txt", "0.0 1.0\n0.1 2.0\n0.2 1.0\n0.3 0.5\n");
    const auto v = info(here, "v.txt --quantity velocity --friction 0.2 --length 2");
    for (const char* key :
         {"d5_75_s", "cav_m_s", "rms_g", "bracketed_s", "vmax_over_amax_s", "mean_period_s", "predominant_period_s", "pulse_period_s"})
        CHECK_MESSAGE(v.at(key).is_null(), key);
    CHECK(number(v["groups"], "pgv_over_sqrt_mu_g_l") == doctest::Approx(2.0 / std::sqrt(0.4 * kGravity)).epsilon(1e-9));
    CHECK(v["groups"].at("newmark_sliding_m").is_null());
}

TEST_CASE("settings of record info that make no sense are one error line") {
    const Workplace here;
    for (const auto& [code, arguments] : {std::pair{2, "--bracket 0"},
                                          {2, "--bracket -1"},
                                          {2, "--mean-period-band 20 0.25"},
                                          {2, "--mean-period-band 0 20"},
                                          {2, "--friction 0"},
                                          {2, "--length -2"},
                                          {2, "--slenderness 0"},
                                          {2, "--slenderness 90"}}) {
        const std::string wrong = arguments;
        const Outcome outcome = here.run("record info synthetic " + wrong);
        CHECK_MESSAGE(outcome.exit_code == code, wrong);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
        CHECK(outcome.out.empty());
    }
    CHECK(here.run("record info synthetic --mean-period-band 1").exit_code == 2);
}
