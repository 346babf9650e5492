#include "lsdem/scene/block_heights.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lsdem/block_height.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/scene/made_scene.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;

namespace {

/// A structure of made_scene.hpp whose heights vary by 0.16 mm, as those of the wooden blocks in [Harmon23].
std::string varied(std::string structure, int seed = 1) {
    structure.pop_back();
    return structure + R"(, "height_deviation": "0.16 mm", "seed": )" + std::to_string(seed) + "}";
}

Scene varied_scene(const std::string& structure, int seed = 1) { return parse_scene(make_scene_text(varied(structure, seed))); }

std::vector<double> offsets_of(const Model& model) {
    std::vector<double> offsets;
    for (const Block& block : model.blocks) offsets.push_back(block.height_offset);
    return offsets;
}

}  // namespace

TEST_CASE("heights are drawn from the normal distribution, cut off at four deviations, and depend on the seed alone") {
    constexpr std::size_t kCount = 200'000;
    const std::vector<double> draws = draw_deviates(kCount, 1);
    double sum = 0.0, squares = 0.0, fourth = 0.0, largest = 0.0;
    std::size_t within = 0;
    for (const double z : draws) {
        sum += z, squares += z * z, fourth += z * z * z * z;
        largest = std::max(largest, std::abs(z));
        within += std::abs(z) < 1.0 ? 1 : 0;
    }
    const auto n = static_cast<double>(kCount);
    // four standard errors of mean, variance, fourth moment and the share within one deviation; the cut lowers the variance by 0.0011 and
    // the fourth moment by 0.02
    CHECK(std::abs(sum / n) < 4.0 / std::sqrt(n));
    CHECK(std::abs(squares / n - 0.9989) < 4.0 * std::sqrt(2.0 / n));
    CHECK(std::abs(fourth / n - 2.98) < 4.0 * std::sqrt(96.0 / n));
    CHECK(std::abs(static_cast<double>(within) / n - 0.6827) < 4.0 * std::sqrt(0.6827 * 0.3173 / n));
    CHECK(largest <= kMostDeviates);
    CHECK(largest > 3.5);

    CHECK(draw_deviates(kCount, 1) == draws);
    CHECK(draw_deviates(100, 1) == std::vector<double>(draws.begin(), draws.begin() + 100));
    CHECK(draw_deviates(100, 2) != draw_deviates(100, 1));
}

TEST_CASE("blocks of unequal height share their shapes, weigh what they measure and stand clear of the layer below") {
    for (const std::string& structure : {kColumn, kTower, kWall}) {
        CAPTURE(structure);
        const Scene scene = varied_scene(structure);
        const BuiltModel built = build_model(scene);
        const Model& model = built.model;
        const Model even = make_model(parse_scene(make_scene_text(structure)));
        const std::vector<double> deviates = draw_deviates(model.blocks.size(), 1);
        REQUIRE(model.blocks.size() == even.blocks.size());
        CHECK(model.shapes.size() == even.shapes.size());
        CHECK(model.materials.size() == even.materials.size());

        const auto levels = static_cast<std::size_t>(built.structure.layer.back()) + 2;
        std::vector<double> top(levels, 0.0), bottom(levels, 1e9);
        for (std::size_t i = 0; i < model.blocks.size(); ++i) {
            const Block& block = model.blocks[i];
            const auto layer = static_cast<std::size_t>(built.structure.layer[i]);
            const Vector3 size = 2.0 * half_extents(model, block);
            CHECK(block.height_offset == deviates[i] * 0.16e-3);
            CHECK(size.z() == doctest::Approx(0.03978 + block.height_offset).epsilon(1e-15));
            CHECK(block.mass == doctest::Approx(800.0 * size.prod()).epsilon(1e-14));
            CHECK(block.position.head<2>() == even.blocks[i].position.head<2>());
            top[layer] = std::max(top[layer], block.position.z() + 0.5 * size.z());
            bottom[layer] = std::min(bottom[layer], block.position.z() - 0.5 * size.z());
        }
        // the tallest block carries the next layer; rounding of a position
        for (std::size_t layer = 1; layer + 1 < top.size(); ++layer) CHECK(std::abs(bottom[layer] - top[layer - 1]) < 1e-16);
    }
}

TEST_CASE("other seeds give other heights, and no deviation gives none whatever the seed") {
    CHECK(offsets_of(make_model(varied_scene(kTower, 1))) == offsets_of(make_model(varied_scene(kTower, 1))));
    CHECK(offsets_of(make_model(varied_scene(kTower, 1))) != offsets_of(make_model(varied_scene(kTower, 2))));
    Scene scene = varied_scene(kTower, 3);
    std::get<Tower>(scene.structure).height_deviation = {};
    for (const double offset : offsets_of(make_model(scene))) CHECK(offset == 0.0);
}

TEST_CASE("a twin has the blocks of its prototype, bit for bit at powers of two") {
    for (const std::string& structure : {kColumn, kTower, kWall}) {
        CAPTURE(structure);
        const Scene scene = varied_scene(structure);
        const scaling::Similitude similitude = scaling::make_similitude("exact", {.length = 1.0 / 16.0});
        const Scene twin = scale_scene(scene, similitude);
        const Model prototype = make_model(scene), model = make_model(twin);
        for (std::size_t i = 0; i < model.blocks.size(); ++i) {
            CHECK(model.blocks[i].height_offset == prototype.blocks[i].height_offset / 16.0);
            CHECK(model.blocks[i].position == Vector3(prototype.blocks[i].position / 16.0));
            CHECK(model.blocks[i].mass == prototype.blocks[i].mass / 4096.0);
        }
        CHECK(compute_time_step(twin, model).value() == compute_time_step(scene, prototype).value() * similitude.time());
    }
}

TEST_CASE("a scene with heights is written and read back as it was") {
    for (const std::string& structure : {kColumn, kTower, kWall}) {
        const Scene scene = varied_scene(structure, 42);
        CHECK(find_height_variation(scene)->seed == 42);
        CHECK(parse_scene(write_scene(scene)) == scene);
    }
}

TEST_CASE("heights that vary too much, negatively, or in an explicit list are refused") {
    const auto refuse = [](const std::string& structure, const std::string& members) {
        std::string text = structure;
        text.insert(text.rfind('}'), members);
        return error_of([&] { parse_scene(make_scene_text(text)); });
    };
    for (const std::string& structure : {kColumn, kTower, kWall}) {
        check_message(refuse(structure, R"(, "height_deviation": "2 mm")"),
                      {"/structure/height_deviation: 2 mm", "a twentieth of the height 39.78 mm", "use at most 1.989 mm"});
        check_message(refuse(structure, R"(, "height_deviation": "-1 mm")"), {"/structure/height_deviation: -1 mm (must not be negative)"});
    }
    check_message(refuse(kBlocks, R"(, "height_deviation": "1 mm")"), {"/structure", "height_deviation"});
}
