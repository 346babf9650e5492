#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lsdem/run/prepare.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/pair_scene.hpp"

using namespace musim::lsdem;

namespace {

Scene make_uneven(const std::string& structure, const std::string& more = "") {
    return parse_scene(R"({"schema": "musim-scene/1", "name": "uneven", "material": "wood", "structure": {)" + structure +
                           R"(, "block": ["12.710 mm", "26.355 mm", "39.780 mm"], "height_deviation": "0.155 mm", "seed": 3},
        "time": {"duration": "10 ms"}, "output": {"spine_rate": "4800 Hz"})" +
                           more + "}",
                       "test");
}

/// Report of a preparation at one look.
struct Reported {
    double part = 0.0, spare = 0.0;
};

struct Preparing {
    std::vector<Reported> given;
    double block_steps = 0.0;  ///< of all of it
};

Preparing prepare_telling(const Scene& scene, const WorkToFollow& to_follow) {
    const Specimen upright = make_upright_specimen(scene);
    Preparing preparing;
    double spare = 0.0;
    RunSettings settings;
    settings.observer = {.on_progress =
                             [&](double part) {
                                 preparing.given.push_back({part, spare});
                             },
                         .on_preparation_spare = [&](double part) { spare = part; }};
    const double time_step = compute_time_step(scene, upright.model).value();
    const PreparedSpecimen prepared = prepare(upright, time_step, find_preparation(scene, upright), settings, {}, to_follow);
    preparing.block_steps = static_cast<double>(prepared.block_steps);
    return preparing;
}

}  // namespace

TEST_CASE("the work that is left of coming to rest is in the range that is given") {
    for (const char* structure :
         {R"("kind": "wall", "layers": 3, "blocks_per_layer": 2)", R"("kind": "wall", "layers": 4, "blocks_per_layer": 2)"}) {
        CAPTURE(structure);
        const Scene scene = make_uneven(structure);
        const Preparing alone = prepare_telling(scene, {});
        const double all = alone.block_steps;
        CHECK(alone.given.back().part == 1.0);
        // as much work again after it reports how much is done
        const Preparing followed = prepare_telling(scene, {.block_steps = all});
        REQUIRE(followed.given.size() == alone.given.size());
        CHECK(followed.given.back().part == doctest::Approx(0.5));
        for (std::size_t i = 0; i < alone.given.size(); ++i) {
            const auto& [part, spare] = alone.given[i];
            const double done = all / (1.0 / followed.given[i].part - 1.0 / part), left = all - done;
            // early on, where an estimate is of use
            if (done < 0.02 * all || done > 0.6 * all) continue;
            CAPTURE(done / all);
            CHECK(done * (1.0 / part - 1.0) > 0.9 * left);
            CHECK(done * (1.0 / part - 1.0) < 2.0 * left);
            CHECK(done * ((1.0 - spare) / part - 1.0) < 1.1 * left);
        }
    }
}

TEST_CASE("the specimens that a pair lays are one scale with its runs" * doctest::test_suite("slow")) {
    const Scene scene = make_uneven(R"("kind": "wall", "layers": 3, "blocks_per_layer": 2)");
    std::vector<double> given;
    std::size_t preparing = 0;
    RunSettings settings;
    settings.observer.on_preparation = [&](double part) {
        if (given.empty() || part > given.back()) ++preparing;
        given.push_back(part);
    };
    PairSceneSettings how;
    how.specimen = PairSpecimen::each;
    how.judging.twins = 0;
    how.judging.half_step = false;
    const ScenePair pair = pair_scene(scene, {{.length = 0.25}, {.length = 0.1}}, Materials::exact, settings, how);
    CHECK(std::is_sorted(given.begin(), given.end()));
    // three specimens, each worth a third: the last two count, too
    REQUIRE(preparing > 3);
    const Specimen upright = make_upright_specimen(scene);
    const double prepared = prepare_telling(scene, {}).block_steps;
    const double runs = 3.0 * static_cast<double>(make_time_plan(scene, upright.model).steps() * upright.model.blocks.size());
    CHECK(given.back() == doctest::Approx(3.0 * prepared / (3.0 * prepared + runs)).epsilon(0.01));
}
