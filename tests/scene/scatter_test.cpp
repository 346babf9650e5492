#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lsdem/block_height.hpp"
#include "lsdem/contact_law.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/specimen_seed.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/scene/made_scene.hpp"
#include "tests/support/relative.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;
using musim::lsdem::tests::relative;

namespace {

/// A hundred listed boxes of 0.1 x 0.2 x 0.3 m in ten rows, 40 mm apart, each second one turned by a quarter about z, the last one held.
std::string spread_blocks() {
    std::string list;
    for (int i = 0; i < 100; ++i) {
        if (i > 0) list += ", ";
        list += R"({"size": ["0.1 m", "0.2 m", "0.3 m"], "position": [)" + std::to_string(0.24 * (i % 10)) + ", " +
                std::to_string(0.24 * static_cast<double>(i / 10)) + R"(, "0.15 m"])" +
                (i % 2 == 1 ? R"(, "quaternion": [1, 0, 0, 1])" : "") + (i == 99 ? R"(, "fixed": true)" : "") + "}";
    }
    return R"({"kind": "blocks", "blocks": [)" + list + "]}";
}

Scene scattered(const std::string& structure, const std::string& scatter) {
    return parse_scene(make_scene_text(structure, R"(, "scatter": {)" + scatter + "}"));
}

const std::string kOpenWall =
    R"({"kind": "wall", "layers": 6, "blocks_per_layer": 5, "block": ["0.2 m", "0.4 m", "0.2 m"], "pitch": "0.205 m",
    "openings": [{"from": "0.5 m", "width": "0.6 m", "sill": 1, "courses": 3}], "returns": {"left": 2}})";

}  // namespace

// A normal deviate's absolute value has the mean sqrt(2/π) and the variance 1 − 2/π = 0.60281².
TEST_CASE("boxes that scatter in size are none longer than drawn, keep their heights, and have the deviation that is asked for") {
    const double deviation = 2e-3;
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (int seed = 1; seed <= 20; ++seed) {
        const Model model = make_model(scattered(spread_blocks(), R"("size": "2 mm", "seed": )" + std::to_string(seed)));
        for (std::size_t i = 0; i < model.blocks.size(); ++i) {
            const Vector3 size = 2.0 * half_extents(model, model.blocks[i]), lost = Vector3(0.1, 0.2, 0.3) - size;
            CHECK(lost.z() == 0.0);
            CHECK(model.blocks[i].mass == relative(800.0 * size.prod(), 1e-12));
            if (i == 99) {
                CHECK(lost.norm() == 0.0);  // held
                continue;
            }
            for (const int axis : {0, 1}) {
                CHECK(lost[axis] >= 0.0);
                sum += lost[axis] / deviation, squares += std::pow(lost[axis] / deviation, 2), ++count;
            }
        }
    }
    const double mean = sum / count, variance = squares / count - mean * mean;
    // five standard errors, with the fourth moment of the half normal law (3.87) for the variance; the cut at four deviations lowers it by
    // 0.003
    CHECK(std::abs(mean - 1.32359) < 5.0 / std::sqrt(count));
    CHECK(std::abs(variance - 0.997) < 5.0 * std::sqrt(2.87 / count));
}

TEST_CASE("blocks that scatter in place move across, with the deviation that is asked for where there is room") {
    const Model drawn = make_model(parse_scene(make_scene_text(spread_blocks())));
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (int seed = 1; seed <= 20; ++seed) {
        const Model model = make_model(scattered(spread_blocks(), R"("place": "2 mm", "seed": )" + std::to_string(seed)));
        for (std::size_t i = 0; i < model.blocks.size(); ++i) {
            const Vector3 moved = model.blocks[i].position - drawn.blocks[i].position;
            CHECK(moved.z() == 0.0);
            if (i == 99) {
                CHECK(moved.norm() == 0.0);
                continue;
            }
            for (const int axis : {0, 1}) sum += moved[axis] / 2e-3, squares += std::pow(moved[axis] / 2e-3, 2), ++count;
        }
    }
    CHECK(std::abs(sum / count) < 5.0 / std::sqrt(count));
    CHECK(std::abs(squares / count - 0.9989) < 5.0 * std::sqrt(2.0 / count));
}

TEST_CASE("nothing overlaps however much places scatter, and blocks without room stay") {
    // joints of 10 mm, and deviations of 5 mm: many moves are cut off. build_model refuses overlaps
    const Model drawn = make_model(parse_scene(make_scene_text(kOpenWall)));
    for (int seed = 1; seed <= 10; ++seed) {
        const Model model =
            make_model(scattered(kOpenWall, R"("place": "5 mm", "size": "2 mm", "friction": 0.1, "seed": )" + std::to_string(seed)));
        double farthest = 0.0;
        for (std::size_t i = 0; i < model.blocks.size(); ++i)
            farthest = std::max(farthest, (model.blocks[i].position - drawn.blocks[i].position).norm());
        CHECK(farthest > 4.9e-3);
        CHECK(farthest < 20e-3);  // half a joint, and what the two beside it have lost
    }
    // side by side without a joint
    const std::string touching = R"({"kind": "blocks", "blocks": [{"size": [1, 1, 1], "position": [0, 0, 0.5]},
        {"size": [1, 1, 1], "position": [1, 0, 0.5]}, {"size": [1, 1, 1], "position": [0, 0, 1.5]}]})";
    const Model model = make_model(scattered(touching, R"("place": "10 mm")"));
    CHECK(model.blocks[0].position == Vector3(0.0, 0.0, 0.5));
    CHECK(model.blocks[1].position == Vector3(1.0, 0.0, 0.5));
    CHECK(model.blocks[2].position != Vector3(0.0, 0.0, 1.5));  // it slides on the first
}

TEST_CASE("joints of a scene have the mean friction and the deviation that it asks for") {
    const Scene scene = scattered(kTower, R"("friction": 0.05, "seed": 9)");
    const Model model = make_model(scene);
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (std::size_t a = 0; a < model.blocks.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b, ++count) {
            const double part = find_joint_of_blocks(model, a, b).friction / 0.63 - 1.0;
            sum += part / 0.05, squares += std::pow(part / 0.05, 2);
        }
    }
    REQUIRE(count == 56 * 55 / 2);
    CHECK(std::abs(sum / count) < 5.0 / std::sqrt(count));
    CHECK(std::abs(squares / count - 0.9989) < 5.0 * std::sqrt(2.0 / count));
    CHECK(make_model(scattered(kTower, R"("seed": 9)")).scatter == JointScatter{});
}

TEST_CASE("a scene that scatters is written and read back, and its model is its image, bit for bit at powers of two") {
    const Scene scene = scattered(kOpenWall, R"("size": "1 mm", "place": "3 mm", "friction": 0.1, "seed": 7)");
    CHECK(parse_scene(write_scene(scene)) == scene);
    const Scene twin = scale_scene(scene, scaling::make_similitude("exact", {.length = 1.0 / 16.0}));
    const Model prototype = make_model(scene), model = make_model(twin);
    CHECK(model.scatter == prototype.scatter);
    REQUIRE(model.blocks.size() == prototype.blocks.size());
    for (std::size_t i = 0; i < model.blocks.size(); ++i) {
        CHECK(model.blocks[i].position == Vector3(prototype.blocks[i].position / 16.0));
        CHECK(half_extents(model, model.blocks[i]) == Vector3(half_extents(prototype, prototype.blocks[i]) / 16.0));
        CHECK(model.blocks[i].mass == prototype.blocks[i].mass / 4096.0);
    }
}

TEST_CASE("a scatter that is too large, negative or unknown is refused with what to do") {
    const auto refuse = [](const std::string& scatter) { return error_of([&] { make_model(scattered(kOpenWall, scatter)); }); };
    check_message(refuse(R"("friction": 0.3)"), {"/scatter/friction: 0.3", "use at most 0.2"});
    check_message(refuse(R"("friction": -0.1)"), {"/scatter/friction: -0.1 (must not be negative)"});
    check_message(refuse(R"("place": "-1 mm")"), {"/scatter/place: -1 mm (must not be negative)"});
    // beside the window 3·0.41 − 0.01 − 1.1 = 0.12 m of a block are left
    check_message(refuse(R"("size": "6 mm")"), {"/scatter/size: 6 mm (more than 1/40 of 120 mm", "use at most 3 mm"});
    check_message(refuse(R"("place": "11 mm")"), {"/scatter/place: 11 mm (more than 1/20 of 120 mm", "use at most 6 mm"});
    check_message(refuse(R"("sizes": "1 mm")"), {"/scatter", "sizes"});
}

TEST_CASE("a seed draws all of a specimen, of listed blocks too") {
    const Scene listed = scattered(spread_blocks(), R"("place": "2 mm", "friction": 0.1, "seed": 5)");
    CHECK(draws_specimen(listed));
    CHECK(seed_of(listed) == 5);
    const Scene other = with_seed(listed, 6);
    CHECK(seed_of(other) == 6);
    CHECK(make_model(other).scatter.seed == 6);
    CHECK(make_model(other).blocks[0].position != make_model(listed).blocks[0].position);
    CHECK(with_seed(other, 5) == listed);

    // heights and scatter keep their distance
    std::string uneven = kWall;
    uneven.insert(uneven.rfind('}'), R"(, "height_deviation": "0.1 mm", "seed": 3)");
    const Scene both = scattered(uneven, R"("friction": 0.1, "seed": 8)");
    CHECK(seed_of(both) == 3);
    const Scene next = with_seed(both, 4);
    CHECK(std::get<Wall>(next.structure).seed == 4);
    CHECK(next.scatter->seed == 9);

    CHECK_FALSE(draws_specimen(scattered(kWall, R"("seed": 4)")));
    const Scene single = parse_scene(make_scene_text(spread_blocks()));
    CHECK_FALSE(draws_specimen(single));
    CHECK(seed_of(single) == 1);
    check_message(error_of([&] { with_seed(single, 2); }), {"specimens differ by the heights", "add a \"scatter\""});
}
