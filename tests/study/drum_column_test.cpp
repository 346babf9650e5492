#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/pair_scene.hpp"

using namespace musim::lsdem;

namespace {

/// Five drums of marble that taper, on each other, rocking under a wavelet that a single drum of their height would rock under, too.
Scene make_drum_scene() {
    std::string blocks;
    for (int i = 0; i < 5; ++i) {
        blocks +=
            std::string(i > 0 ? ", " : "") + R"({"shape": "drum", "position": ["0 m", "0 m", ")" + std::to_string(0.6 * i + 0.3) + " m\"]}";
    }
    return parse_scene(R"({"schema": "musim-scene/1", "name": "column of drums", "material": "marble",
        "shapes": {"drum": {"kind": "cylinder", "radius": "0.4 m", "height": "0.6 m", "top_radius": "0.38 m"}},
        "structure": {"kind": "blocks", "blocks": [)" +
                           blocks + R"(]},
        "base_motion": {"signal": "ricker", "direction": "x", "amplitude": "0.4 g", "frequency": "1.5 Hz"},
        "time": {"duration": "1.5 s"}, "output": {"spine_rate": "200 Hz"}})",
                       "drum_column_test");
}

}  // namespace

TEST_SUITE("slow") {
    TEST_CASE("a column of drums rocks as its model at 1:25 does, to its end, and keeps its energy") {
        const ScenePair pair = pair_scene(make_drum_scene(), {{1.0 / 25.0, {}}}, {}, {}, {.judging = {.twins = 2}});
        const PairStudy& study = pair.study;
        CHECK(study.consistent());
        CHECK(study.same_bits == true);
        REQUIRE(study.models.size() == 1);
        CHECK(study.models[0].judgement.agreement == Agreement::agree);
        CHECK(study.models[0].difference.rms_velocity < 1e-5);
        // twins agree to the end of the run: so far the motion is known
        for (const PairedTwin& twin : study.twins) CHECK(twin.difference.rms_velocity < 1e-5);
        // it does rock: the top has moved by more than a drum on the ground slips
        CHECK(study.prototype.energy_closure < 1e-2);
        CHECK((study.prototype.final.position[4] - study.prototype.initial.position[4]).norm() > 0.05);
        MESSAGE("1:25 " << study.models[0].difference.rms_velocity << ", twins " << study.twins[0].difference.rms_velocity << ", "
                        << study.twins[1].difference.rms_velocity << ", balance open by " << study.prototype.energy_closure);
    }
}
