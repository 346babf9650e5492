#include "lsdem/run/equilibrium.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "lsdem/run/run.hpp"
#include "lsdem/run/scale_specimen.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/study/made_specimen.hpp"

using namespace musim::lsdem;
using musim::scaling::make_similitude;
using musim::scaling::Similitude;

namespace {

constexpr double kGravity = 9.80665, kHeight = 4.25;

Scene make_still(const std::string& structure, const std::string& more = "") {
    return parse_scene(R"({"schema": "musim-scene/1", "name": "still",
        "material": {"density": 2320, "normal_stiffness": "26.25 GN/m", "shear_stiffness": "25 GN/m", "friction": 0.59, "restitution": 0.5},
        "structure": )" + structure +
                           more + R"(, "time": {"duration": "0.5 s"}, "output": {"spine_rate": "100 Hz"}})",
                       "equilibrium_test");
}

const char* const kRingTower = R"({"kind": "tower", "layers": 6, "block": ["1.36 m", "2.82 m", "4.25 m"], "tiling": "ring_14"})";
const char* const kWall = R"({"kind": "wall", "layers": 5, "blocks_per_layer": 4, "block": ["1.36 m", "2.82 m", "4.25 m"]})";

double find_fastest(const RunResult& run) {
    double fastest = 0.0;
    for (const Vector3& velocity : run.history.spine_velocity) fastest = std::max(fastest, velocity.norm());
    return fastest;
}

}  // namespace

TEST_CASE("a column in equilibrium overlaps by what it carries over its stiffness") {
    Specimen column = make_column(4);
    double top = 0.0;
    for (Block& block : column.model.blocks) block.position.z() = top + 0.5, top += 1.0;
    const double step = 0.5 * compute_critical_time_step(column.model);
    const Specimen exact = make_column(4);
    const Equilibrium found = put_in_equilibrium(column, step);
    // rounding of a coordinate over an overlap of 1e-5
    CHECK(found.residual < 1e-9);
    // flush sides take about an overlap off every edge of a joint: twice the square of 1e-5 to 4e-5 of the cubes' size, summed up
    constexpr double kOfFlushSides = 2.0 * (1.0 + 4.0 + 9.0 + 16.0) * 1e-10;
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(std::abs(column.model.blocks[i].position.z() - exact.model.blocks[i].position.z()) < kOfFlushSides);
    }
}

TEST_CASE("a structure without a motion stands still from the start, whatever it is") {
    for (const char* structure : {kRingTower, kWall}) {
        const RunResult run = run_scene(make_still(structure));
        CHECK(std::abs(*run.start_reaction_over_weight - 1.0) < 1e-8);
        CHECK(find_fastest(run) < 1e-9 * std::sqrt(kGravity * kHeight));
    }
}

TEST_CASE("without preparation weight begins to act at once") {
    const RunResult run = run_scene(make_still(kRingTower, R"(, "preparation": "none")"));
    CHECK(std::abs(*run.start_reaction_over_weight) < 1e-6);
    CHECK(find_fastest(run) > 1e-3 * std::sqrt(kGravity * kHeight));
}

TEST_CASE("equilibrium is the same bits at scales that are powers of four") {
    Specimen first = make_upright_specimen(make_still(kWall));
    Specimen other = scale_specimen(first, make_similitude("exact", {.length = 0.25}));
    put_in_equilibrium(first, 1e-4);
    put_in_equilibrium(other, 0.5e-4);
    CHECK(first.model.preload.size() > 0);
    for (std::size_t b = 0; b < first.model.blocks.size(); ++b) {
        CHECK(Vector3(0.25 * first.model.blocks[b].position) == other.model.blocks[b].position);
        CHECK(first.model.blocks[b].orientation.coeffs() == other.model.blocks[b].orientation.coeffs());
    }
}

TEST_CASE("what does not stand on anything is left where it is") {
    Specimen column = make_column(2);
    column.model.blocks[1].position.z() += 0.5;
    const Vector3 before = column.model.blocks[0].position;
    const Equilibrium found = put_in_equilibrium(column, 1e-4);
    CHECK(found.residual > kInEquilibrium);
    CHECK(column.model.blocks[0].position == before);
    CHECK(column.model.preload.empty());
}

TEST_CASE("an arch and drums begin in equilibrium where they are drawn") {
    const char* const shapes =
        R"(, "shapes": {"drum": {"kind": "cylinder", "radius": "1 m", "height": "1 m"}, "key": {"kind": "box", "size": ["3 m", "3 m", "1 m"]}})";
    const char* const arch =
        R"({"kind": "arch", "radius": "5 m", "thickness": "0.8 m", "depth": "1 m", "embrace": "150 deg", "voussoirs": 11})";
    const char* const column = R"({"kind": "column", "blocks": ["drum", "drum", "drum", "key"]})";
    for (const char* structure : {arch, column}) {
        Specimen specimen = make_upright_specimen(make_still(structure, shapes));
        const double step = 0.8 * compute_critical_time_step(specimen.model);
        CHECK(put_in_equilibrium(specimen, step).residual < 1e-7);
        Simulation simulation(specimen.model, step, 1);
        simulation.advance(200);
        for (std::size_t b = 0; b < specimen.model.blocks.size(); ++b) {
            CHECK(simulation.velocity(b).norm() < 1e-8 * std::sqrt(kGravity * 1.0));
        }
    }
}

TEST_CASE("a hull that is drawn on an edge, a ten-thousandth from flat, is put on its face") {
    const char* const shapes =
        R"(, "shapes": {"stone": {"kind": "polyhedron", "vertices": [["-1 m", "-1 m", "-0.5 m"], ["1 m", "-1 m", "-0.5 m"],
        ["1 m", "1 m", "-0.5 m"], ["-1 m", "1 m", "-0.5 m"], ["-0.8 m", "-0.8 m", "0.5 m"], ["0.8 m", "-0.8 m", "0.5 m"],
        ["0.8 m", "0.8 m", "0.5 m"], ["-0.8 m", "0.8 m", "0.5 m"]]}})";
    const char* const flat = R"({"kind": "blocks", "blocks": [{"shape": "stone", "position": ["0 m", "0 m", "0.5 m"]}]})";
    Specimen specimen = make_upright_specimen(make_still(flat, shapes));
    Block& stone = specimen.model.blocks[0];
    const Quaternion upright = stone.orientation, turn(Eigen::AngleAxisd(1e-4, Vector3::UnitY()));
    const Vector3 edge{1.0, 0.0, 0.0};
    stone.position = edge + turn * (stone.position - edge);
    stone.orientation = turn * stone.orientation;
    CHECK(put_in_equilibrium(specimen, 0.8 * compute_critical_time_step(specimen.model)).residual < kInEquilibrium);
    CHECK(specimen.model.blocks[0].orientation.angularDistance(upright) < 1e-8);
}
