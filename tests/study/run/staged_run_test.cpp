#include "lsdem/run/staged_run.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <string>

#include "lsdem/rotation.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/pair_scene.hpp"
#include "tests/support/relative.hpp"

using namespace musim::lsdem;
using musim::lsdem::tests::relative;

namespace {

/// Two blocks that slide and turn under two motions with a pause between them, and a third without one.
Scene make_staged_scene() {
    return parse_scene(R"({"schema": "musim-scene/1", "name": "shaken again",
        "material": {"density": 2320, "normal_stiffness": "2 GN/m", "shear_stiffness": "2 GN/m", "friction": 0.3, "restitution": 0.3},
        "structure": {"kind": "column", "layers": 2, "block": ["1.5 m", "2 m", "1 m"]},
        "motions": [
          {"base_motion": {"signal": "sine", "direction": "x", "amplitude": "0.6 g", "frequency": "4 Hz", "cycles": 1}, "duration": "0.3 s"},
          {"base_motion": {"signal": "sine", "direction": "y", "amplitude": "0.7 g", "frequency": "5 Hz", "cycles": 1}, "duration": "0.2 s"},
          {"base_motion": {"signal": "sine", "direction": "x", "amplitude": "0.5 g", "frequency": "5 Hz", "cycles": 1}, "duration": "0.2 s",
           "settle": false}],
        "output": {"spine_rate": "200 Hz", "frame_rate": "50 Hz"}})");
}

}  // namespace

TEST_CASE("a pair of several motions agrees to the last bit at a power of four, and else as twins do") {
    const ScenePair pair = pair_scene(make_staged_scene(), {{.length = 1.0 / 16.0}, {.length = 0.3}}, Materials::exact, {.threads = 2},
                                      {.judging = {.twins = 2}});
    CHECK(pair.study.models[0].difference.bitwise_identical);
    CHECK(pair.study.same_bits == true);
    CHECK(pair.study.agreement() == Agreement::agree);
    REQUIRE(pair.study.half_step.has_value());
    CHECK(pair.study.half_step->difference.rms_velocity < 0.1);

    // the stages as one run
    const RunResult& run = pair.study.prototype;
    const History& history = run.history;
    REQUIRE(history.samples() == 60 + 40 + 40 + 1);
    REQUIRE(history.spine_rotation.size() == history.samples() * run.spine.size());
    CHECK(run.frames.time.size() == 15 + 10 + 10 + 1);
    for (std::size_t k = 1; k < history.samples(); ++k) CHECK(history.time[k] > history.time[k - 1]);
    CHECK(history.time.back() == relative(0.7, 1e-3));
    const Energy& end = history.energy.back();
    CHECK(run.losses->total().total() == relative(end.friction_loss + end.damping_loss, 1e-9));
    CHECK(run.losses->total().total() > 0.0);
    const std::size_t top = run.spine.block.back();
    const Vector3 turned = rotation_vector(run.initial.orientation[top], run.final.orientation[top]);
    CHECK((history.spine_rotation.back() - turned).norm() < 1e-12);
    CHECK((history.spine_position.back() - run.final.position[top]).norm() == 0.0);
    // the pauses are cut out of the times, the base stays where it was moved to
    CHECK(history.base.back().displacement.norm() > 0.0);
}
