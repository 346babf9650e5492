#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "records/formats/read_record.hpp"
#include "records/measures/intensity.hpp"
#include "records/measures/response_spectrum.hpp"
#include "records/processing/recipe.hpp"
#include "records/processing/scale_record.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::si::seconds;

constexpr const char* kEverything = R"({"schema": "musim-recipe/1", "steps": [
    {"step": "align"}, {"step": "level"}, {"step": "baseline", "order": 1}, {"step": "cut", "window": ["2 s", "18 s"]},
    {"step": "taper", "fraction": 0.1}, {"step": "pad", "before": "1 s", "after": 2},
    {"step": "filter", "low": "0.1 Hz", "high": "20 Hz", "order": 4, "phase": "zero"}, {"step": "filter", "high": 15, "phase": "causal"},
    {"step": "rotate", "azimuth_deg": 30}, {"step": "resample", "dt": "8 ms"}, {"step": "energy_window", "from": 0.01, "to": 0.99, "margin": 0.2},
    {"step": "rest"}, {"step": "amplify", "factor": 0.7}, {"step": "integrate"}, {"step": "differentiate"}, {"step": "integrate", "by": "frequency"}]})";

GroundMotion make_motion() {
    GroundMotion motion;
    motion.source = "made";
    for (const double azimuth : {0.0, 90.0}) {
        std::vector<double> samples;
        for (int i = 0; i < 2048; ++i) {
            const double t = 0.01 * i;
            samples.push_back((1.0 + 0.01 * azimuth) * std::exp(-std::pow((t - 9.0) / 3.0, 2)) * std::sin(12.0 * t + azimuth) + 0.01);
        }
        motion.components.push_back(
            {azimuth == 0.0 ? "N" : "E", azimuth, TimeSeries(SampleQuantity::acceleration, 0.0 * seconds, 0.01 * seconds, samples)});
    }
    return motion;
}

TEST_CASE("a recipe is read, written and read again to the same") {
    const Recipe recipe = parse_recipe(kEverything, "test");
    CHECK(recipe.size() == 16);
    const std::string text = write_recipe(recipe);
    CHECK(write_recipe(parse_recipe(text, "again")) == text);
    CHECK(write_recipe({}) == "{\n  \"schema\": \"musim-recipe/1\",\n  \"steps\": []\n}\n");
}

TEST_CASE("level says so where a record begins in motion") {
    const Recipe recipe{step::Level{}};
    GroundMotion resting = make_motion();
    for (Component& component : resting.components) component.series = pad(component.series, 1.0 * seconds, 0.0 * seconds);
    CHECK(process(resting, recipe).history.size() == 1);
    GroundMotion moving = make_motion();
    for (Component& component : moving.components) component.series = cut(component.series, {8.0 * seconds, 12.0 * seconds});
    const auto history = process(moving, recipe).history;
    REQUIRE(history.size() == 3);
    CHECK(history[1].starts_with("N begins in motion ("));
    CHECK(history[1].ends_with("): level took the mean of all samples"));
    CHECK(recipe_of(process(moving, recipe)).size() == 1);
}

TEST_CASE("a processed record says how it was made, and can be made again from that") {
    const GroundMotion motion = make_motion(), processed = process(motion, parse_recipe(kEverything, "test"));
    CHECK(processed.components[0].series.quantity() == SampleQuantity::velocity);
    const Recipe given = recipe_of(processed);
    CHECK(write_recipe(given) == write_recipe(parse_recipe(kEverything, "test")));
    const GroundMotion again = process(motion, given);
    for (std::size_t c = 0; c < 2; ++c) CHECK(again.components[c].series == processed.components[c].series);
    CHECK(again.history == processed.history);
    CHECK(recipe_of(motion).empty());
}

TEST_CASE("processing and rescaling can be exchanged, to the last bit for factors that are powers of two") {
    const GroundMotion motion = make_motion();
    const Recipe recipe = parse_recipe(kEverything, "test");
    for (const std::pair<double, double>& row : {std::pair(1.0 / 16.0, 0.0), std::pair(1.0 / 107.0, 1e-9)}) {
        const double length = row.first, tolerance = row.second;
        CAPTURE(length);
        const scaling::Similitude law =
            scaling::make_similitude("mu", {.length = length, .friction = length == 1.0 / 16.0 ? 1.0 : 0.63 / 0.59});
        const GroundMotion one = rescale(process(motion, recipe), law), two = process(rescale(motion, law), rescale(recipe, law));
        for (std::size_t c = 0; c < 2; ++c) {
            const TimeSeries &a = one.components[c].series, &b = two.components[c].series;
            REQUIRE(a.size() == b.size());
            CHECK(std::abs((a.start() - b.start()).value()) <= tolerance * a.dt().value());
            double most = 0.0, worst = 0.0;
            for (std::size_t i = 0; i < a.size(); ++i) {
                most = std::max(most, std::abs(a.samples()[i]));
                worst = std::max(worst, std::abs(a.samples()[i] - b.samples()[i]));
            }
            CHECK(worst <= tolerance * most);
        }
    }
}

TEST_CASE("the spectrum of a model at scaled periods is the prototype's times the factor of accelerations") {
    const TimeSeries motion = make_motion().components[0].series;
    const std::vector<scaling::Time> periods = make_periods(0.05 * seconds, 5.0 * seconds, 15);
    for (const double length : {1.0 / 25.0, 1.0 / 107.0}) {
        const scaling::Similitude law = scaling::make_similitude("mu", {.length = length, .friction = 0.63 / 0.59});
        std::vector<scaling::Time> scaled;
        for (const scaling::Time& period : periods) scaled.push_back(law.to_model(period));
        const std::vector<double> one = compute_response_spectrum(motion, periods).pseudo_acceleration(),
                                  two = compute_response_spectrum(rescale(motion, law), scaled).pseudo_acceleration();
        for (std::size_t i = 0; i < periods.size(); ++i) CHECK(two[i] == relative(law.acceleration() * one[i], 1e-10));
    }
}

TEST_CASE("China Lake high-passed at 0.064 Hz peaks at the published 42.4 cm/s") {
    if (!tests::have_shared_records()) return;
    GroundMotion record = read_record(tests::shared_records() / "csmip" / "CICLC.v1");
    const Recipe recipe =
        parse_recipe(R"({"schema": "musim-recipe/1", "steps": [{"step": "level"}, {"step": "filter", "low": "0.064 Hz"}]})", "test");
    const GroundMotion processed = process(record, recipe);
    CHECK_FALSE(processed.integration_corner);
    const Intensity intensity = compute_intensity(processed.find_component("360").series, processed.integration_corner);
    CHECK(std::abs(intensity.pgv->value.value()) == relative(0.424, 0.0005 / 0.424));
}

TEST_CASE("a recipe that cannot be followed says where, what and what to do") {
    const auto steps = [](const std::string& list) { return R"({"schema": "musim-recipe/1", "steps": [)" + list + "]}"; };
    const auto message = [](const std::string& text) {
        try {
            parse_recipe(text, "r.json");
        } catch (const ReadError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    CHECK(message("{").starts_with("r.json: is no JSON (parse error at line 1, column 2:"));
    CHECK(message("{").ends_with("); write {\"schema\": \"musim-recipe/1\", \"steps\": [...]}"));
    CHECK(message("[1e999]").starts_with("r.json: is no JSON (number overflow parsing '1e999')"));
    CHECK(message("[]") == "r.json: is no recipe; add \"schema\": \"musim-recipe/1\"");
    CHECK(message(R"({"schema": "musim-recipe/1"})") == "r.json: has no list of steps; add \"steps\": [...]");
    CHECK(message(R"({"schema": "musim-recipe/1", "steps": [], "stps": 1})") == "r.json: \"stps\" is no key of a recipe; remove it");
    CHECK(message(steps(R"("filter")")) == "r.json: step 1: is no object; write {\"step\": NAME, ...}");
    CHECK(message(steps(R"({"low": 1})")) == "r.json: step 1: has no name; add \"step\": \"filter\" or another");
    CHECK(message(steps(R"({"step": "level"}, {"step": "filtre"})"))
              .starts_with("r.json: step 2 (filtre): is no step; take one of align, level"));
    CHECK(message(steps(R"({"step": "filter"})")) == "r.json: step 1 (filter): has no corner; add \"low\", \"high\" or both");
    CHECK(message(steps(R"({"step": "filter", "low": "0.1 s"})")).starts_with("r.json: step 1 (filter): low: "));
    CHECK(message(steps(R"({"step": "filter", "low": 1, "phase": "min"})")) ==
          "r.json: step 1 (filter): phase is neither \"zero\" nor \"causal\"; write one of them");
    CHECK(message(steps(R"({"step": "taper", "part": 0.1})")) ==
          "r.json: step 1 (taper): \"part\" is none of its settings; remove it, or correct its name");
    CHECK(message(steps(R"({"step": "cut", "window": "all"})")) ==
          "r.json: step 1 (cut): window is no pair of times; write [\"10 s\", \"40 s\"]");
    CHECK(message(steps(R"({"step": "baseline", "order": 1.5})")) ==
          "r.json: step 1 (baseline): order is no whole number; write one, without quotes");
    CHECK(message(steps(R"({"step": "pad", "before": 1})")) == "r.json: step 1 (pad): after is missing; add it");
    const Recipe late = parse_recipe(steps(R"({"step": "level"}, {"step": "cut", "window": [90, 99]})"), "r.json");
    CHECK_THROWS_WITH_AS(process(make_motion(), late),
                         "step 2 (cut): window 90 s to 99 s does not fit (record lasts from 0 s to 20.47 s); change the window",
                         ProcessingError);
}

}  // namespace
}  // namespace musim::records
