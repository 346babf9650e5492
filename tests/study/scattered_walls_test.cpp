#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "lsdem/run/run.hpp"
#include "lsdem/run/specimen_batch.hpp"
#include "lsdem/run/standing.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/ensemble_members.hpp"
#include "lsdem/study/second_scene.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;

namespace {

constexpr double kHeight = 0.2;  // of a course [m]

/// A wall with a window, a granite lintel and a corner.
Scene make_open_wall(const std::string& more) {
    return parse_scene(R"({"schema": "musim-scene/1", "name": "wall", "material": "limestone",
        "structure": {"kind": "wall", "layers": 6, "blocks_per_layer": 4, "block": ["0.2 m", "0.4 m", "0.2 m"], "pitch": "0.201 m",
            "openings": [{"from": "0.4 m", "width": "0.6 m", "sill": 1, "courses": 3}], "lintel": {"material": "granite"},
            "returns": {"right": 2}},
        "time": {"duration": "20 ms"}, "output": {"spine_rate": "1 kHz", "frame_rate": "1 kHz"})" +
                       more + "}");
}

/// Two listed posts with a beam.
Scene make_posts(const std::string& more) {
    return parse_scene(R"({"schema": "musim-scene/1", "name": "posts", "material": "limestone", "structure": {"kind": "blocks", "blocks": [
        {"size": [0.2, 0.2, 0.4], "position": [-0.3, 0, 0.2]}, {"size": [0.2, 0.2, 0.4], "position": [0.3, 0, 0.2]},
        {"size": [0.8, 0.2, 0.2], "position": [0, 0, 0.5], "name": "beam"}]},
        "time": {"duration": "10 ms"}, "output": {"spine_rate": "1 kHz"})" +
                       more + "}");
}

}  // namespace

TEST_CASE("a wall with a window stands, its lintel too, with joints and places that scatter") {
    for (const char* scatter : {"", R"(, "scatter": {"friction": 0.1, "place": "0.5 mm", "size": "0.2 mm", "seed": 2})"}) {
        CAPTURE(scatter);
        const Scene scene = make_open_wall(scatter);
        const Specimen upright = make_upright_specimen(scene);
        CHECK(find_standing(scene, upright).begins == SceneStanding::Begins::in_equilibrium);
        const RunResult run = run_scene(scene);
        CHECK(run.status == RunStatus::completed);
        double farthest = 0.0;
        const std::vector<Block>& blocks = upright.model.blocks;
        const std::vector<Eigen::Vector3f>& frames = run.frames.position;
        REQUIRE(frames.size() == 21 * blocks.size());
        for (std::size_t i = 0; i < blocks.size(); ++i)
            farthest = std::max(farthest, (frames[20 * blocks.size() + i].cast<double>() - blocks[i].position).norm());
        // joints give under six courses of a stone of some 10 GPa: 1e-5 of a height each at most
        CHECK(farthest < 6.0 * 1e-5 * kHeight);
        CHECK(farthest > 0.0);
    }
}

TEST_CASE("members of an ensemble of listed blocks differ by their scatter") {
    const std::string scatter = R"(, "scatter": {"friction": 0.1, "place": "1 mm", "seed": 3})";
    const auto members = plan_ensemble(make_posts(scatter), 4, "1.0");
    std::set<std::string> names;
    std::set<double> places;
    for (std::size_t i = 0; i < members.size(); ++i) {
        CHECK(members[i].seed == 3 + i);
        names.insert(members[i].name);
        const Specimen specimen = make_upright_specimen(members[i].scene);
        CHECK(specimen.model.scatter == JointScatter{.friction = 0.1, .seed = 3 + i});
        places.insert(specimen.model.blocks[0].position.x());
    }
    CHECK(names.size() == 4);
    CHECK(places.size() == 4);
    CHECK_THROWS_WITH_AS(plan_ensemble(make_posts(""), 2, "1"), doctest::Contains("\"scatter\""), SceneError);
}

TEST_CASE("specimens of listed blocks that scatter are laid, kept and run from their files") {
    const musim::tests::TemporaryFolder folder;
    const Scene scene = make_posts(R"(, "scatter": {"friction": 0.1, "place": "1 mm", "seed": 3})");
    SpecimenBatch batch{.scene = scene, .seeds = {3, 4}, .folder = folder.path(), .version = "test", .threads = 1};
    const auto reports = make_specimens(batch);
    REQUIRE(reports.size() == 2);
    CHECK(reports[0].stands());
    CHECK(reports[0].file != reports[1].file);
    CHECK(make_specimens(batch)[1].reused);
    Scene from_file = scene;
    from_file.preparation.emplace().specimen = reports[0].file;
    const RunResult run = run_scene(parse_scene(write_scene(from_file)));
    CHECK(run.status == RunStatus::completed);
    // the file of another seed is of other places, not of other blocks; that of other sizes is refused
    from_file.scatter->size = 2.0 * from_file.scatter->place;
    CHECK_THROWS(run_scene(from_file));
}

TEST_CASE("a second scene with another scatter has other blocks") {
    const Scene first = make_posts(R"(, "scatter": {"friction": 0.1, "seed": 3})");
    CHECK_FALSE(find_other_structure(first, first));
    CHECK(*find_other_structure(first, make_posts(R"(, "scatter": {"friction": 0.1, "seed": 4})")) ==
          "its scatter is drawn anew, from another seed");
    CHECK(*find_other_structure(first, make_posts("")) == "the friction of its joints is drawn anew");
}
