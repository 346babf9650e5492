#include "lsdem/results/source_pga.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "scaling/units.hpp"

using namespace musim::lsdem;

namespace {

constexpr double kG = 9.80665;  // [m/s²]

/// Velocity samples 0.1 s apart whose slopes are 0.25 g, 0.5 g, -0.5 g and -0.25 g, from a record whose peak is 0.6 g.
std::array<BaseComponent, 3> make_motion(bool is_processed) {
    std::array<BaseComponent, 3> motion;
    motion[0] = {.start = 0.0, .dt = 0.1, .velocity = {0.0, 0.025 * kG, 0.075 * kG, 0.025 * kG, 0.0}};
    motion[0].source = {.peak_acceleration = 0.6 * kG, .is_record = true, .is_processed = is_processed};
    return motion;
}

}  // namespace

TEST_CASE("a base whose PGA is not that of its record says both and why") {
    const auto plain = find_source_pga(make_motion(false), 1.0), filtered = find_source_pga(make_motion(true), 1.0);
    CHECK(describe_pga(0.5 * kG, plain[0]) == "PGA 0.5 g at the base (0.6 g in the record at this scale: velocity linear between samples)");
    CHECK(describe_pga(0.5 * kG, filtered[0]) ==
          "PGA 0.5 g at the base (0.6 g in the record at this scale: cut, filtered or brought to rest for the base)");
    // the first interval only
    const auto cut = find_source_pga(make_motion(true), 0.1);
    CHECK(describe_pga(0.25 * kG, cut[0]) == "PGA 0.25 g at the base (0.6 g in the record at this scale: the run ends before its peak)");
    // the peak has begun
    CHECK(find_source_pga(make_motion(false), 0.15)[0].why == plain[0].why);
}

TEST_CASE("a base with the PGA of its record says it once") {
    const auto sources = find_source_pga(make_motion(false), 1.0);
    CHECK(describe_pga(0.6 * kG, sources[0]) == "PGA 0.6 g");
    // the same in the digits that are printed
    CHECK(describe_pga(0.60001 * kG, sources[0]) == "PGA 0.6 g");
    // of an axis at rest nothing is known
    CHECK(describe_pga(0.0, sources[1]) == "PGA 0 g");
}

TEST_CASE("the PGA of records survives in results") {
    const auto sources = find_source_pga(make_motion(true), 1.0);
    const nlohmann::json json = to_json(sources);
    CHECK(json[0]["pga_g"].get<double>() == doctest::Approx(0.6));
    CHECK(json[0]["of"] == "record");
    CHECK(json[1].is_null());
    const auto read = parse_source_pga(json);
    CHECK(read[0].acceleration == doctest::Approx(0.6 * kG));
    CHECK(read[0].why == sources[0].why);
    CHECK(read[0].is_record);
    CHECK(read[2].acceleration == 0.0);
    CHECK_THROWS_AS(parse_source_pga({{"of", "record"}}), nlohmann::json::exception);
}
