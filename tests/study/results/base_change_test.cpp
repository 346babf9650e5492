#include "lsdem/results/base_change.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "scaling/units.hpp"

using namespace musim::lsdem;

namespace {

constexpr double kG = 9.80665;  // [m/s²]

/// Velocity samples 0.1 s apart whose slopes are 0.25 g, 0.5 g, -0.5 g and -0.25 g.
BaseComponent make_component() { return {.start = 0.0, .dt = 0.1, .velocity = {0.0, 0.025 * kG, 0.075 * kG, 0.025 * kG, 0.0}}; }

/// The motion of a record whose peak is 0.6 g, or of a formula that has it.
BaseComponents make_motion(bool of_record) {
    BaseComponents motion;
    motion.shift[0] = make_component();
    motion.shift[0].source.peak_acceleration = of_record ? 0.0 : 0.6 * kG;
    if (!of_record) return motion;
    motion.shift[0].source.velocity = motion.shift[0].velocity;
    motion.shift[0].source.acceleration = {0.1 * kG, 0.4 * kG, 0.6 * kG, -0.6 * kG, 0.1 * kG};
    return motion;
}

}  // namespace

TEST_CASE("a base is held against its record over the part that has run") {
    const BaseChanges whole = find_base_changes(make_motion(true), 1.0);
    REQUIRE(whole[0].has_value());
    CHECK(whole[0]->of_record);
    CHECK(whole[0]->peaks.base.pga.value() == doctest::Approx(0.5 * kG));
    CHECK(whole[0]->peaks.record.pga.value() == doctest::Approx(0.6 * kG));
    // slopes 0.25, 0.5, -0.5, -0.25 g against means 0.25, 0.5, 0, -0.25 g
    CHECK(whole[0]->peaks.difference.pga.value() == doctest::Approx(0.5 * kG));
    CHECK_FALSE(whole[1].has_value());
    CHECK(describe_base(0.5 * kG, whole[0]).starts_with("PGA 0.5 g (record 0.6 g, -16.7 %), PGV "));
    // its first interval only
    const BaseChanges first = find_base_changes(make_motion(true), 0.1);
    CHECK(first[0]->peaks.record.pga.value() == doctest::Approx(0.4 * kG));
    CHECK(first[0]->peaks.base.pga.value() == doctest::Approx(0.25 * kG));
    CHECK(first[0]->peaks.record.pgv.value() == doctest::Approx(0.025 * kG));
    // into its second
    CHECK(find_base_changes(make_motion(true), 0.15)[0]->peaks.base.pga.value() == doctest::Approx(0.5 * kG));
}

TEST_CASE("a formula is named where the base has another peak") {
    const BaseChanges whole = find_base_changes(make_motion(false), 1.0);
    CHECK(describe_base(0.5 * kG, whole[0]) == "PGA 0.5 g (formula 0.6 g)");
    // a run that ends before its peak has nothing to hold against it
    CHECK(describe_base(0.25 * kG, find_base_changes(make_motion(false), 0.1)[0]) == "PGA 0.25 g");
    CHECK(describe_base(0.0, whole[1]) == "PGA 0 g");
    CHECK(warn_of_changes(whole).empty());
}

TEST_CASE("a changed PGA or PGV is warned of with its reason") {
    auto motion = make_motion(true);
    const std::vector<std::string> treated = warn_of_changes(find_base_changes(motion, 1.0));
    REQUIRE(treated.size() == 1);
    CHECK(treated[0].starts_with(
        "the base makes PGA 0.5 g where its record has 0.6 g (-16.7 %) along x (it was cut, filtered or brought to rest); choose"));
    // means of the record's samples as slopes: straight lines alone
    motion.shift[0].source.acceleration = {0.1 * kG, 0.4 * kG, 0.6 * kG, -1.6 * kG, 1.1 * kG};
    const std::vector<std::string> straight = warn_of_changes(find_base_changes(motion, 1.0));
    REQUIRE(straight.size() == 1);
    CHECK(straight[0].find("(its velocity is linear between samples, so that its acceleration is the mean of two)") != std::string::npos);
    motion.shift[0].source.acceleration.clear();
    CHECK(warn_of_changes(find_base_changes(motion, 1.0)).empty());
}

TEST_CASE("changes survive in results and go back to the prototype") {
    const BaseChanges changes = find_base_changes(make_motion(true), 1.0);
    const nlohmann::json json = to_json(changes);
    CHECK(json[0]["source"]["pga_g"].get<double>() == doctest::Approx(0.6));
    CHECK(json[0]["base"]["pgv_m_s"].get<double>() == doctest::Approx(0.075 * kG));
    CHECK(json[0]["of"] == "record");
    CHECK(json[1].is_null());
    const BaseChanges read = parse_base_changes(json);
    CHECK(to_json(read) == json);
    CHECK_FALSE(read[2].has_value());
    CHECK_THROWS_AS(parse_base_changes({{"of", "record"}}), nlohmann::json::exception);
    const BaseChanges back = scale_back(changes, {2.0, 1.0, 1.0}, {0.5, 1.0, 1.0}, {0.125, 1.0, 1.0});
    CHECK(back[0]->peaks.record.pga.value() == changes[0]->peaks.record.pga.value() / 2.0);
    CHECK(back[0]->peaks.base.pgv.value() == changes[0]->peaks.base.pgv.value() * 2.0);
    CHECK(back[0]->peaks.difference.pgd.value() == changes[0]->peaks.difference.pgd.value() * 8.0);
}
