#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/pair_scene.hpp"
#include "lsdem/study/pair_text.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "tests/study/pushed_wall.hpp"

using namespace musim::lsdem;
using musim::lsdem::tests::make_pushed_wall;
using musim::scaling::GivenFactor;

namespace {

/// Expectation of theory (docs/theory/similitude.md, "Laws" and "When friction differs") for a law with these factors: a model is its
/// prototype in other units if λ_a = λ_g and λ_μ = 1, since every group is kept then; else blocks that slip and rock move in another way.
/// Friction of 0.4 times concrete's is below tan α = 0.32: what rocked slips.
struct LawCase {
    const char* law;
    std::vector<GivenFactor> set;  ///< besides the length
    bool agrees;
};

/// L: the length. λ_a: mu: μ g; froude and replicas: g; cauchy: E/(ρ L); of a restoring force F_R/(ρ L³), which is F_R = c L² of
/// cohesion, k_s L of springs, μ m g and m g tan α of friction and rocking.
std::vector<LawCase> list_cases(double L) {
    return {{"exact", {}, true},
            {"exact", {{"g", 3.0}, {"rho", 0.4}}, true},
            {"froude", {}, true},
            {"froude", {{"rho", 0.34}}, true},
            {"froude", {{"mu", 0.4}}, false},
            {"mu", {}, true},
            {"mu", {{"g", 2.0}}, true},
            {"mu", {{"mu", 0.63 / 0.59}}, false},
            {"cauchy", {}, false},
            {"cauchy", {{"g", 1.0 / L}}, true},
            {"cauchy", {{"E", L}}, true},
            {"centrifuge", {}, true},
            {"true_replica", {}, true},
            {"true_replica", {{"mu", 0.4}}, false},
            {"artificial_mass", {}, true},
            {"gravity_distorted", {{"a", 1.0}}, true},
            {"gravity_distorted", {{"a", 1.2}}, false},
            {"mechanics", {{"t", std::sqrt(L)}}, true},
            {"mechanics", {{"t", 0.8 * std::sqrt(L)}}, false},
            {"restoring_force", {{"F_R", L * L * L}}, true},
            {"restoring_force", {{"F_R", 1.3 * L * L * L}}, false},
            {"restoring_rocking", {}, true},
            {"restoring_rocking", {{"tan_alpha", 0.8}}, false},
            {"restoring_spring", {{"k_s", L * L}}, true},
            {"restoring_spring", {{"k_s", 0.7 * L * L}}, false},
            {"restoring_cohesion", {{"c_coh", L}}, true},
            {"restoring_cohesion", {{"c_coh", 0.7 * L}}, false},
            {"restoring_mixed", {}, true},
            {"restoring_mixed", {{"mu", 0.7}}, false}};
}

PairStudy run_cases(const Scene& scene, double length, const std::vector<LawCase>& cases) {
    std::vector<ModelChoice> choices;
    for (const LawCase& wanted : cases) choices.push_back({.length = length, .law = ChosenLaw{.name = wanted.law, .set = wanted.set}});
    return pair_scene(scene, choices, Materials::exact, {}, {.judging = {.twins = 2, .half_step = false}}).study;
}

void check_cases(const Scene& scene, double length) {
    CAPTURE(scene.name);
    CAPTURE(length);
    const std::vector<LawCase> cases = list_cases(length);
    const PairStudy study = run_cases(scene, length, cases);
    REQUIRE(study.models.size() == cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const PairedRun& model = study.models[i];
        CAPTURE(cases[i].law);
        CAPTURE(cases[i].set.size());
        CAPTURE(model.difference.max_velocity);
        CHECK(model.is_image == cases[i].agrees);
        CHECK(to_string(model.judgement.agreement) == (cases[i].agrees ? "agree" : "differ"));
    }
}

/// Three blocks of equal height that slip and rock.
Scene make_even_column() {
    return parse_scene(R"({"schema": "musim-scene/1", "name": "even column", "material": "concrete",
        "structure": {"kind": "column", "layers": 3, "block": ["54.4 mm", "112.8 mm", "170 mm"]},
        "base_motion": {"signal": "half_sine", "direction": "x", "amplitude": "0.8 g", "duration": "0.04 s"},
        "time": {"duration": "0.06 s"}, "output": {"spine_rate": "500 Hz"}})");
}

/// A block that lies and cannot turn: it slides.
Scene make_slider() {
    return parse_scene(R"({"schema": "musim-scene/1", "name": "slider", "material": "concrete",
        "structure": {"kind": "blocks", "blocks": [
            {"size": ["112.8 mm", "112.8 mm", "54.4 mm"], "position": ["0 m", "0 m", "27.2 mm"], "rotation_locked": true}]},
        "base_motion": {"signal": "half_sine", "direction": "x", "amplitude": "1.8 g", "duration": "0.1 s"},
        "time": {"duration": "0.2 s"}, "output": {"spine_rate": "500 Hz"}})");
}

}  // namespace

TEST_CASE("every law agrees with the prototype where it keeps all groups, and differs where it does not") {
    check_cases(make_even_column(), 1.0 / 20.0);
    check_cases(make_pushed_wall(), 1.0 / 20.0);
    check_cases(make_pushed_wall(), 0.3);
}

TEST_CASE("the table has every law that comes with musim but the one with two lengths") {
    const std::vector<LawCase> cases = list_cases(0.3);
    for (const std::string& name : musim::scaling::scale_law_names()) {
        CAPTURE(name);
        const bool is_there = std::any_of(cases.begin(), cases.end(), [&](const LawCase& each) { return each.law == name; });
        CHECK(is_there == (name != "mu_vertical_distortion"));
    }
    CHECK_THROWS_WITH_AS(run_cases(make_even_column(), 0.3, {{"mu_vertical_distortion", {}, false}}),
                         doctest::Contains("scenes are scaled by one length"), musim::scaling::SimilitudeError);
}

// assumptions A1 to A5 of docs/theory/similitude.md hold for a block that only slides, whatever its friction
TEST_CASE("the mu law keeps pure sliding at another friction, Froude's and Cauchy's do not") {
    const std::vector<LawCase> cases{{"mu", {{"mu", 0.63 / 0.59}}, true},
                                     {"mu", {{"mu", 0.18 / 0.59}}, true},
                                     {"froude", {{"mu", 0.63 / 0.59}}, false},
                                     {"cauchy", {}, false}};
    const PairStudy study = run_cases(make_slider(), 1.0 / 20.0, cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const PairedRun& model = study.models[i];
        CAPTURE(cases[i].law);
        CAPTURE(model.difference.max_velocity);
        CHECK_FALSE(model.is_image);
        CHECK(to_string(model.judgement.agreement) == (cases[i].agrees ? "agree" : "differ"));
    }
}

TEST_CASE("what a model starts from is said where it is not the prototype's specimen") {
    const PairStudy study =
        run_cases(make_pushed_wall(), 0.25, {{"froude", {}, true}, {"cauchy", {}, false}, {"mu", {{"mu", 0.5}}, false}});
    const std::vector<std::string> lines = describe_verdict(study);
    const auto says = [&](const std::string& text) {
        return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) { return line.find(text) != std::string::npos; });
    };
    CHECK(says("Model 1:4 is shaken by law froude: times x 0.5, accelerations x 1; it starts from the prototype's specimen."));
    CHECK(
        says("by law cauchy: times x 0.25, accelerations x 4; its blocks have the prototype's heights and settled anew, since contacts "
             "are 4 times as stiff for their weight."));
    CHECK(says("settled anew, since friction is 0.5 times the prototype's and contacts are 0.5 times as stiff for their weight."));
}
