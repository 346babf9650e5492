#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "lsdem/fallen.hpp"
#include "lsdem/response/response.hpp"
#include "lsdem/results/outcome.hpp"
#include "lsdem/results/read_results.hpp"
#include "lsdem/results/run_warnings.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/run/drawn_places.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/scene/carriers.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/pair_member.hpp"
#include "tests/study/uneven_wall.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim;
using namespace musim::lsdem;

namespace {

using StoneJson = nlohmann::json;

constexpr double kFallingDensity = 2000.0, kFallingFriction = 0.6;  // [kg/m³], [-]

/// A scene of listed blocks.
StoneJson list_blocks(const StoneJson& blocks, double stiffness = 2e8) {
    return {{"schema", "musim-scene/1"},
            {"name", "listed"},
            {"material",
             {{"density", kFallingDensity},
              {"normal_stiffness", stiffness},
              {"shear_stiffness", 0.8 * stiffness},
              {"friction", kFallingFriction},
              {"restitution", 0.3}}},
            {"structure", {{"kind", "blocks"}, {"blocks", blocks}}},
            {"time", {{"duration", "1 ms"}}},
            {"output", {{"spine_rate", "1 kHz"}}}};
}

StoneJson with_preparation(StoneJson scene) {
    scene["preparation"] = {{"placing", "as_drawn"}};
    return scene;
}

/// Not prepared, on a base that moves by next to nothing, for long enough to fall.
StoneJson without_preparation(StoneJson scene) {
    scene["base_motion"] = {{"signal", "half_sine"}, {"amplitude", "1e-6 g"}, {"duration", "0.1 s"}, {"direction", "x"}};
    scene["time"]["duration"] = "0.7 s";
    return scene;
}

RunResult run_text(const StoneJson& scene) { return run_scene(parse_scene(scene.dump(), "test")); }

StoneJson stone(const std::array<double, 3>& size, const std::array<double, 3>& position) {
    return {{"size", size}, {"position", position}};
}

StoneJson held(StoneJson entry) {
    entry["fixed"] = true;
    return entry;
}

/// A block turned about y by an angle [rad], with the foot of a line along its own z axis at `foot`.
StoneJson inclined(const std::array<double, 3>& size, const std::array<double, 3>& foot, double along, double angle) {
    StoneJson entry = stone(size, {foot[0] + along * std::sin(angle), foot[1], foot[2] + along * std::cos(angle)});
    entry["quaternion"] = {std::cos(0.5 * angle), 0.0, std::sin(0.5 * angle), 0.0};
    return entry;
}

/// n plates of length L on a fixed table whose edge is at x = 0; the k-th from the top reaches out by part·L/(2k) over the one below.
StoneJson stack_overhang(int n, double part) {
    constexpr double length = 0.2, height = 0.01, table = 0.1;  // [m]
    StoneJson blocks = StoneJson::array({held(stone({0.4, 0.1, table}, {-0.2, 0.0, 0.5 * table}))});
    double tip = 0.0;
    for (int k = n; k >= 1; --k) {
        tip += part * length / (2.0 * k);
        blocks.push_back(stone({length, 0.1, height}, {tip - 0.5 * length, 0.0, table + height * (n - k + 0.5)}));
    }
    return list_blocks(blocks, 1e9);
}

/// A structure, and the blocks that statics says cannot stand; by rigid blocks: the centre of mass of what a joint carries is over it, and
/// the slope is below that of friction.
struct DrawnCase {
    const char* name;
    StoneJson blocks;
    std::vector<std::size_t> falls;
};

std::vector<DrawnCase> list_cases() {
    const std::array<double, 3> brick{0.2, 0.1, 0.06}, post{0.1, 0.1, 0.3}, beam{0.5, 0.1, 0.08};
    const auto course = [&](const std::vector<double>& x) {
        StoneJson blocks = StoneJson::array();
        for (std::size_t k = 0; k < x.size(); ++k) blocks.push_back(stone(brick, {x[k], 0.0, 0.06 * (static_cast<double>(k) + 0.5)}));
        return blocks;
    };
    const auto with = [](StoneJson blocks, const StoneJson& more) {
        blocks.push_back(more);
        return blocks;
    };
    const StoneJson posts = StoneJson::array({stone(post, {0.0, 0.0, 0.15}), stone(post, {0.6, 0.0, 0.15})});
    const StoneJson pillar = StoneJson::array({stone(post, {0.0, 0.0, 0.15})});
    const StoneJson table = StoneJson::array({held(stone(brick, {0.0, 0.0, 0.03}))});
    const auto on_slope = [&](double degrees) {
        const double angle = degrees * std::numbers::pi / 180.0;
        // the ramp's middle stands 0.5 m high; the brick on it
        return StoneJson::array(
            {held(inclined({1.0, 0.2, 0.1}, {0.0, 0.0, 0.5}, 0.0, angle)), inclined(brick, {0.0, 0.0, 0.5}, 0.08, angle)});
    };
    const auto tilted = [&](double degrees) {
        const double angle = degrees * std::numbers::pi / 180.0, reach = 0.05 * std::sin(angle) + 0.15 * std::cos(angle);
        return StoneJson::array({inclined(post, {0.0, 0.0, reach}, 0.0, angle)});
    };
    return {
        // a brick's centre is over its support up to an overhang of 0.1 m
        {"brick over by 0.09 m", course({0.0, 0.09}), {}},
        {"brick over by 0.12 m", course({0.0, 0.12}), {1}},
        {"column of five", course({0.0, 0.0, 0.0, 0.0, 0.0}), {}},
        // centre of the upper two: 0.03 m over the lowest
        {"three stairs of 0.02 m", course({0.0, 0.02, 0.04}), {}},
        // a beam reaches from post to post, 0.5 m apart
        {"lintel on both posts", with(posts, stone({0.7, 0.1, 0.08}, {0.3, 0.0, 0.34})), {}},
        {"lintel on one post, its middle beside it", with(posts, stone(beam, {0.26, 0.0, 0.34})), {2}},
        {"beam balanced on a pillar", with(pillar, stone(beam, {0.0, 0.0, 0.34})), {}},
        {"beam 10 mm within the pillar's edge", with(pillar, stone(beam, {0.04, 0.0, 0.34})), {}},
        {"beam 10 mm beyond the pillar's edge", with(pillar, stone(beam, {0.06, 0.0, 0.34})), {1}},
        // beam of 8 kg at 0.09 m and brick of 2.4 kg at -0.1 m: centre at 0.046 m, within 0.05 m
        {"cantilever with its counterweight", with(with(pillar, stone(beam, {0.09, 0.0, 0.34})), stone(brick, {-0.1, 0.0, 0.41})), {}},
        // the same brick at the other end: at 0.09 m and beyond
        {"cantilever with the weight at its tip",
         with(with(pillar, stone(beam, {0.03, 0.0, 0.34})), stone(brick, {0.18, 0.0, 0.41})),
         {1, 2}},
        {"brick on a fixed brick", with(table, stone(brick, {0.09, 0.0, 0.09})), {}},
        {"brick beyond a fixed brick", with(table, stone(brick, {0.12, 0.0, 0.09})), {1}},
        // tan 20° = 0.36 and tan 35° = 0.70 on either side of the friction
        {"brick on a slope of 20 degrees", on_slope(20.0), {}},
        {"brick on a slope of 35 degrees", on_slope(35.0), {1}},
        // a post's diagonal leans by atan(1/3) = 18.4°
        {"post leaning by 3 degrees", tilted(3.0), {}},
        {"post leaning by 25 degrees", tilted(25.0), {0}},
        // posts of unequal height: the beam tilts by 2/500 and stays
        {"lintel on posts 2 mm apart in height",
         with(StoneJson::array({stone({0.1, 0.1, 0.298}, {0.0, 0.0, 0.149}), stone(post, {0.5, 0.0, 0.15})}),
              stone(beam, {0.25, 0.0, 0.34})),
         {}},
        {"post leaning too far beside one that stands", with(tilted(25.0), stone(post, {-0.6, 0.0, 0.15})), {0}},
        // carried by 10 mm at one end
        {"brick over an opening",
         with(StoneJson::array({stone(brick, {0.0, 0.0, 0.03}), stone(brick, {0.5, 0.0, 0.03})}), stone(brick, {0.19, 0.0, 0.09})),
         {2}},
        // nothing to fall from
        {"brick let go in the air", StoneJson::array({stone(brick, {0.0, 0.0, 0.2})}), {}},
    };
}

std::vector<std::size_t> fallen_of(const RunResult& run) {
    std::vector<std::size_t> fallen;
    for (const MovedBlock& moved : run.rest->fallen) fallen.push_back(moved.block);
    return fallen;
}

bool has_words(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

}  // namespace

TEST_CASE("what statics says falls has fallen after a preparation, and what it says stands is shaken") {
    for (const DrawnCase& structure : list_cases()) {
        CAPTURE(std::string(structure.name));
        const RunResult run = run_text(with_preparation(list_blocks(structure.blocks)));
        REQUIRE(run.rest.has_value());
        // others may be pushed over, which statics does not say
        const std::vector<std::size_t> fallen = fallen_of(run);
        CHECK(std::includes(fallen.begin(), fallen.end(), structure.falls.begin(), structure.falls.end()));
        CHECK(fallen.empty() == structure.falls.empty());
        const bool stands = structure.falls.empty();
        CHECK(run.rest->collapsed == !stands);
        CHECK(run.status == (stands ? RunStatus::completed : RunStatus::collapsed));
        CHECK((run.steps == 0) == !stands);
        CHECK(find_outcome(run).fallen == fallen.size());
        CHECK(find_outcome(run).shaken == stands);
        if (stands) CHECK(*run.base_reaction_over_weight == doctest::Approx(1.0).epsilon(1e-3));
        CHECK(find_warnings(run).size() == (stands ? 0 : 1));
    }
}

TEST_CASE("without a preparation the same structures fall or stand, and no advice is given that would not help") {
    for (const DrawnCase& structure : list_cases()) {
        CAPTURE(std::string(structure.name));
        const RunResult run = run_text(without_preparation(list_blocks(structure.blocks)));
        CHECK((run.status == RunStatus::completed) == structure.falls.empty());
        for (const std::string& warning : find_warnings(run)) {
            CAPTURE(warning);
            CHECK_FALSE(has_words(warning, "\"none\""));
            CHECK(has_words(warning, "a \"preparation\" lets them come to rest before") == structure.falls.empty());
        }
    }
}

// [PatersonZwick09]: n equal blocks stand up to an overhang of (L/2)(1 + 1/2 + ... + 1/n). The joint under the upper k has d = 1 - part of
// L/(2k) left to its edge. Springs of K per area give under their weight w a wedge of 3d: it tilts them by 2w/(9 K W d²), which moves their
// centre by a part k h/2 · 2w/(9 K W d³) of d: below 6 % here.
TEST_CASE("the harmonic overhang stands just inside and falls just outside, prepared or not" * doctest::test_suite("slow")) {
    for (const auto& [blocks, left] : {std::pair(1, 0.01), std::pair(2, 0.01), std::pair(3, 0.02), std::pair(4, 0.03)}) {
        const int n = blocks;
        CAPTURE(n);
        const RunResult stands = run_text(with_preparation(stack_overhang(n, 1.0 - left))),
                        falls = run_text(with_preparation(stack_overhang(n, 1.0 + left)));
        CHECK(stands.rest->fallen.empty());
        CHECK(stands.rest->at_rest);
        CHECK_FALSE(falls.rest->fallen.empty());
        CHECK(falls.status == RunStatus::collapsed);
        if (n != 2) continue;
        CHECK(run_text(without_preparation(stack_overhang(n, 1.0 - left))).status == RunStatus::completed);
        StoneJson longer = without_preparation(stack_overhang(n, 1.0 + left));
        longer["time"]["duration"] = "1.2 s";
        CHECK(run_text(longer).status == RunStatus::collapsed);
    }
}

TEST_CASE("a fall in a preparation is reported with the block's name, and results of it can be read") {
    const DrawnCase overhang = list_cases()[1];
    StoneJson blocks = overhang.blocks;
    blocks[1]["name"] = "coping stone";
    const Scene scene = parse_scene(with_preparation(list_blocks(blocks)).dump(), "test");
    const RunResult run = run_scene(scene);
    REQUIRE(find_warnings(run).size() == 1);
    const std::string warning = find_warnings(run)[0];
    CAPTURE(warning);
    CHECK(
        has_words(warning, "block 1 (\"coping stone\") fell while the structure was prepared: drawn with its centre at (0.12, 0, 0.09) m"));
    CHECK(has_words(warning, "the motion was not run; draw it where it is supported"));
    CHECK(run.collapse_time == 0.0);
    CHECK(run.history.samples() == 1);
    CHECK(describe(find_outcome(run)) ==
          std::vector<std::string>{"1 of 2 blocks fell while the structure was prepared; the motion was not run"});

    const musim::tests::TemporaryFolder folder;
    ResultFolder results(folder.path());
    results.add_run("", run, {.scene = write_scene(scene), .program_version = "test"});
    results.commit();
    const StoredRun stored = read_run(folder.path());
    CHECK(stored.status == RunStatus::collapsed);
    CHECK(stored.collapsed_before());
    CHECK(stored.blocks.name == std::vector<std::string>{"", "coping stone"});
    const Response response = measure_response(stored);
    CHECK(response.speeds.empty());
    CHECK(response.damage.fallen == 1);
    CHECK_FALSE(response.failure.has_value());
    // nothing can be compared with it
    CHECK_THROWS_WITH_AS(lay_member("prototype", scene, scaling::Similitude()), doctest::Contains("block 1 (\"coping stone\") fell"),
                         SceneError);
}

TEST_CASE("a block has left its place when its joint has slipped by a quarter of its smallest edge, and of layers a few may") {
    for (const int layers : {6, 30}) {
        const Specimen upright = make_upright_specimen(parse_scene(
            R"({"schema": "musim-scene/1", "name": "slender", "material": "wood", "structure": {"kind": "column", "block": ["10 mm", "20 mm",
            "60 mm"], "height_deviation": "1 mm", "layers": )" +
                std::to_string(layers) + R"(}, "time": {"duration": "1 ms"}})",
            "test"));
        Kinematics now;
        for (const BoxPose& box : upright.drawn) now.position.push_back(box.position), now.orientation.push_back(box.orientation);
        CHECK(find_fallen(upright, now).empty());
        for (std::size_t b = 3; b < now.position.size(); ++b) now.position[b].x() += 0.99 * kLeftPlace * 10e-3;
        CHECK(find_fallen(upright, now).empty());
        for (std::size_t b = 3; b < now.position.size(); ++b) now.position[b].x() += 0.02 * kLeftPlace * 10e-3;
        Rest rest;
        note_fallen(upright, now, rest);
        REQUIRE(rest.fallen.size() == 1);
        CHECK(rest.fallen[0].block == 3);
        // one of six is more than one in twenty, one of thirty is not
        CHECK(rest.collapsed == (layers == 6));
    }
}

TEST_CASE("layers that settle into their gaps have not fallen, however many they are") {
    const Specimen upright = make_upright_specimen(make_wall_scene(12));
    Kinematics now;
    double sunk = 0.0;
    int layer = 1;
    for (std::size_t b = 0; b < upright.drawn.size(); ++b) {
        // a tenth of a height of room below every layer
        if (upright.layer[b] != layer) sunk += 0.1 * 39.78e-3, layer = upright.layer[b];
        now.position.emplace_back(upright.drawn[b].position);
        now.orientation.push_back(upright.drawn[b].orientation);
    }
    Specimen lifted = upright;
    double lift = 0.0;
    layer = 1;
    for (std::size_t b = 0; b < upright.drawn.size(); ++b) {
        if (upright.layer[b] != layer) lift += 0.1 * 39.78e-3, layer = upright.layer[b];
        lifted.drawn[b].position.z() += lift;
    }
    CHECK(sunk > kFallenDrop * 39.78e-3);
    CHECK(find_fallen(lifted, now).empty());
}

TEST_CASE("what carries a block is found at any orientation and scale, and blocks side by side carry nothing") {
    for (const double scale : {1.0, 0x1p-20}) {
        CAPTURE(scale);
        std::vector<BoxPose> boxes{{{1, 1, 1}, {0, 0, 0.5}, Quaternion::Identity()},
                                   {{1, 1, 1}, {1, 0, 0.5}, Quaternion::Identity()},
                                   {{1, 1, 1.2}, {2, 0, 0.6}, Quaternion::Identity()},
                                   {{2, 1, 0.5}, {0.5, 0, 1.3}, Quaternion::Identity()},
                                   {{0.5, 0.5, 0.5}, {0.5, 0, 3.0}, Quaternion(Eigen::AngleAxisd(0.3, Vector3::UnitY()))}};
        for (BoxPose& box : boxes) box.size *= scale, box.position *= scale;
        const auto carriers = find_carriers(boxes, true);
        for (std::size_t b = 0; b < 3; ++b) {
            REQUIRE(carriers[b].size() == 1);
            CHECK_FALSE(carriers[b][0].block.has_value());
        }
        REQUIRE(carriers[3].size() == 2);
        CHECK(carriers[3][0].block == 0);
        CHECK(carriers[3][1].block == 1);
        CHECK(carriers[3][0].gap == doctest::Approx(0.05 * scale));
        CHECK(carriers[4].empty());
    }
}
