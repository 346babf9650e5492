#include <doctest/doctest.h>

#include <string>

#include "lsdem/run/run.hpp"
#include "lsdem/scene/scene_json.hpp"

using namespace musim;
using namespace musim::lsdem;

namespace {

/// Density and face stiffness of a stone, and the base of the block that has it.
constexpr double kStoneDensity = 2300.0, kStoneStiffness = 4e6, kStoneBase = 0.2 * 0.1;  // [kg/m³], [N/m], [m²]

const std::string kStoneText =
    R"({"density": 2300, "normal_stiffness": 4e6, "shear_stiffness": 1.6e6, "friction": 0.6, "restitution": 0.4})";

Scene parse_stones(const std::string& blocks, const std::string& more = "") {
    return parse_scene(R"({"schema": "musim-scene/1", "material": )" + kStoneText + R"(, "structure": {"kind": "blocks", "blocks": [)" +
                       blocks + R"(]}, "time": {"duration": 0.002}, "output": {"spine_rate": 1000},
                       "preparation": {"placing": "as_drawn"})" +
                       more + "}");
}

}  // namespace

// A face of pressure ρ g H on springs of K per area sinks by ρ g H/K, whatever its area.
TEST_CASE("blocks of one stone sink alike, whatever their length") {
    const RunResult run = run_scene(parse_stones(R"({"size": [0.2, 0.1, 0.1], "position": [0, 0, 0.05]},
        {"size": [0.1, 0.1, 0.1], "position": [0.3, 0, 0.05]}, {"size": [0.8, 0.1, 0.1], "position": [1, 0, 0.05]})"));
    const double sink = kStoneDensity * scaling::kStandardGravity.value() * 0.1 / (kStoneStiffness / kStoneBase);
    for (const Vector3& position : run.initial.position) {
        // rest is found to 1e-6 of the weight
        CHECK(0.05 - position.z() == doctest::Approx(sink).epsilon(1e-5));
    }
}
