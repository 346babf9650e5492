#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lsdem/block_height.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/scene/made_scene.hpp"
#include "tests/support/relative.hpp"

using namespace musim;
using namespace musim::lsdem;
using namespace musim::lsdem::testing;
using musim::lsdem::tests::relative;

namespace {

// blocks of b = 0.2 m, w = 0.4 m, H = 0.2 m with joints of 2 mm: 2.008 m from face to face, 1.6 m high
constexpr double kWallThick = 0.2, kWallLong = 0.4, kWallHigh = 0.2, kWallPitch = 0.201, kWallJoint = 0.002;
constexpr int kPerCourse = 5, kCourses = 8;

/// A wall of such blocks with further keys, as JSON text.
std::string wall_text(const std::string& more) {
    return R"({"kind": "wall", "layers": 8, "blocks_per_layer": 5, "block": ["0.2 m", "0.4 m", "0.2 m"], "pitch": "0.201 m")" + more + "}";
}

Scene wall_scene(const std::string& more, const std::string& around = "") { return parse_scene(make_scene_text(wall_text(more), around)); }

std::string refuse_wall(const std::string& more) {
    return error_of([&] { wall_scene(more); });
}

const std::string kGranite = R"(, "materials": {"hard": "granite"})";
/// Jambs at borders of cells: 0.4 m is a whole block, 0.802 m two and a joint, so the hole takes four cells.
const std::string kWindow = R"(, "openings": [{"from": "0.4 m", "width": "0.806 m", "sill": 2, "courses": 3}])";

double volume_of(const Model& model) {
    double volume = 0.0;
    for (const Block& block : model.blocks) volume += 8.0 * half_extents(model, block).prod();
    return volume;
}

/// Volume of a plain wall of these blocks: odd courses of n whole ones, even ones of n − 1 and two halves of w − p.
double plain_volume(int layers, int blocks) {
    const double odd = blocks * kWallLong, even = (blocks - 1) * kWallLong + 2.0 * (kWallLong - kWallPitch);
    return kWallThick * kWallHigh * (((layers + 1) / 2) * odd + (layers / 2) * even);
}

/// A box along the world's axes.
struct Extent {
    Vector3 low, high;
};

std::vector<Extent> extents_of(const Model& model) {
    std::vector<Extent> extents;
    for (const Block& block : model.blocks) {
        const Vector3 half = block.orientation.toRotationMatrix().cwiseAbs() * half_extents(model, block);
        extents.push_back({block.position - half, block.position + half});
    }
    return extents;
}

/// Horizontal distance between blocks of a course that face each other across less than half a meter; infinite where none do.
double least_joint(const Model& model, const std::vector<int>& layer) {
    const std::vector<Extent> boxes = extents_of(model);
    double least = 1e9;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (layer[i] != layer[k]) continue;
            const Vector3 gap = (boxes[i].low - boxes[k].high).cwiseMax(boxes[k].low - boxes[i].high);
            least = std::min(least, std::max(gap.x(), gap.y()));
        }
    }
    return least;
}

/// Part of the base of each block above the first course that lies on blocks of the course below.
std::vector<double> borne_parts(const Model& model, const std::vector<int>& layer) {
    const std::vector<Extent> boxes = extents_of(model);
    std::vector<double> parts;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (layer[i] == 1) continue;
        double borne = 0.0;
        for (std::size_t k = 0; k < boxes.size(); ++k) {
            if (layer[k] != layer[i] - 1) continue;
            const Vector3 common = boxes[i].high.cwiseMin(boxes[k].high) - boxes[i].low.cwiseMax(boxes[k].low);
            borne += std::max(common.x(), 0.0) * std::max(common.y(), 0.0);
        }
        const Vector3 size = boxes[i].high - boxes[i].low;
        parts.push_back(borne / (size.x() * size.y()));
    }
    return parts;
}

}  // namespace

TEST_CASE("an opening at borders of the bond leaves half blocks at its jambs, and its lintel bears by half a block") {
    const BuiltModel built = build_model(wall_scene(kWindow));
    const Model& model = built.model;
    // 4 odd courses of 5 blocks and 4 even ones of 6; the hole takes two whole blocks of two odd courses, 3 and 5, and of course 4 one
    // whole block and half of two, which stay as half blocks. In course 6 the lintel goes from cell 1 to 7 of 10: where a half block ends
    // to where a whole one does, so that it takes the place of three
    CHECK(model.blocks.size() == 4U * 5 + 4 * 6 - 2 * 2 - 1 - 3 + 1);
    const double wall = plain_volume(kCourses, kPerCourse), course = kWallThick * kWallHigh;
    const double hole = course * (2 * 2 * kWallLong + kWallLong + 2 * (kWallLong - (kWallLong - kWallPitch)));
    // it fills its two joints
    const double lintel = course * 2.0 * kWallJoint;
    CHECK(volume_of(model) == relative(wall - hole + lintel, 1e-12));
    CHECK(model.shapes.size() == 3);  // whole, half, lintel
    const auto longest = std::max_element(model.blocks.begin(), model.blocks.end(), [&](const Block& a, const Block& b) {
        return half_extents(model, a).y() < half_extents(model, b).y();
    });
    CHECK(2.0 * half_extents(model, *longest).y() == relative(0.806 + 2.0 * (kWallLong - kWallPitch), 1e-12));
    const auto index = static_cast<std::size_t>(longest - model.blocks.begin());
    CHECK(built.structure.layer[index] == 6);
    // the left face of the wall is at −5p + g/2; the lintel begins half a block before the jamb
    const double jamb = -5.0 * kWallPitch + 0.5 * kWallJoint + 0.4;
    CHECK(extents_of(model)[index].low.x() == relative(jamb - (kWallLong - kWallPitch), 1e-12));
    CHECK(least_joint(model, built.structure.layer) == relative(kWallJoint, 1e-9));
    // nothing hangs: the lintel bears on two half blocks and all else on the course below
    for (const double part : borne_parts(model, built.structure.layer)) CHECK(part > 0.3);
}

TEST_CASE("blocks are cut at jambs anywhere, and of a sliver the neighbour takes the length") {
    // 2.008 m long; from 0.05 m steps all kinds of pieces come up
    for (const double from : {0.3, 0.45, 0.5, 0.55, 0.6, 0.62, 0.7, 0.79}) {
        CAPTURE(from);
        const std::string text = fmt::format(
            R"(, "openings": [{{"from": {}, "width": "0.7 m", "sill": 1, "courses": 4}}], "lintel": {{"bearing": "0.15 m"}})", from);
        const BuiltModel built = build_model(wall_scene(text));
        const double left = -5.0 * kWallPitch + 0.5 * kWallJoint;
        const std::vector<Extent> boxes = extents_of(built.model);
        std::vector<double> length(static_cast<std::size_t>(kCourses) + 1, 0.0), count(length.size(), 0.0);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const auto layer = static_cast<std::size_t>(built.structure.layer[i]);
            const double size = boxes[i].high.x() - boxes[i].low.x();
            length[layer] += size, count[layer] += 1.0;
            CHECK(size > (0.25 - 1e-6) * kWallLong);
            if (size > 1.0 - 1e-9) continue;  // the lintel
            CHECK(size < (1.25 + 1e-6) * kWallLong + kWallJoint);
            // the hole is clear
            const bool beside = boxes[i].high.x() < left + from + 1e-9 || boxes[i].low.x() > left + from + 0.7 - 1e-9;
            CHECK((layer == 1 || layer > 5 || beside));
        }
        for (std::size_t layer = 1; layer < length.size(); ++layer) {
            const bool open = layer >= 2 && layer <= 5;
            // from end to end less the hole, whose jambs are faces, and one joint between every two blocks
            const double joints = (count[layer] - (open ? 2.0 : 1.0)) * kWallJoint;
            CHECK(length[layer] + joints == relative(10.0 * kWallPitch - kWallJoint - (open ? 0.7 : 0.0), 1e-9));
        }
        for (const double part : borne_parts(built.model, built.structure.layer)) CHECK(part > 0.2);
    }
}

TEST_CASE("a lintel may be of a material of its own, and an opening up to the top has none") {
    const Scene scene = wall_scene(kWindow + R"(, "lintel": {"material": "hard"})", kGranite);
    const Model model = make_model(scene);
    REQUIRE(model.materials.size() == 2);
    std::size_t of_granite = 0;
    for (const Block& block : model.blocks) {
        if (block.material == 0) continue;
        ++of_granite;
        const double density = scene.materials.at("hard").density.value();
        CHECK(block.mass == relative(density * 8.0 * half_extents(model, block).prod(), 1e-12));
    }
    CHECK(of_granite == 1);
    const Model notched = make_model(wall_scene(R"(, "openings": [{"from": "0.4 m", "width": "0.806 m", "sill": 5, "courses": 3}])"));
    // courses 6 and 8 keep 6 − 1 blocks, course 7 keeps 5 − 2
    CHECK(notched.blocks.size() == 4U * 5 + 4 * 6 - 1 - 2 - 1);
    // a preset by its name alone
    CHECK(make_model(wall_scene(kWindow + R"(, "lintel": {"material": "granite"})")).materials.size() == 2);
}

TEST_CASE("two leaves are two walls, tied by courses that go through both") {
    const BuiltModel loose = build_model(wall_scene(R"(, "leaves": {"gap": "0.1 m"})"));
    CHECK(loose.model.blocks.size() == 2U * (4 * 5 + 4 * 6));
    CHECK(volume_of(loose.model) == relative(2.0 * plain_volume(kCourses, kPerCourse), 1e-12));
    CHECK(loose.structure.spine.block.size() == 5);  // courses 1, 3, 5, 7 and the top
    for (const Block& block : loose.model.blocks) CHECK(std::abs(block.position.y()) == relative(0.15, 1e-12));

    const BuiltModel tied = build_model(wall_scene(kWindow + R"(, "leaves": {"gap": "0.1 m", "headers_every": 4})"));
    for (std::size_t i = 0; i < tied.model.blocks.size(); ++i) {
        const bool header = tied.structure.layer[i] % 4 == 0;
        const Block& block = tied.model.blocks[i];
        CHECK(2.0 * half_extents(tied.model, block).x() == relative(header ? 0.5 : 0.2, 1e-12));
        CHECK(std::abs(std::abs(block.position.y()) - (header ? 0.0 : 0.15)) < 1e-15);
    }
    // a header over both leaves and the gap bears by four fifths at least of where it lies on the wall; at the window by half of that
    for (const double part : borne_parts(tied.model, tied.structure.layer)) CHECK(part > 0.24);
    CHECK(least_joint(tied.model, tied.structure.layer) == relative(kWallJoint, 1e-9));
}

TEST_CASE("a corner is interlocked: courses run through it in turn") {
    const BuiltModel built = build_model(wall_scene(R"(, "returns": {"left": 2, "right": 3})"));
    const Model& model = built.model;
    CHECK(least_joint(model, built.structure.layer) == relative(kWallJoint, 1e-9));
    const std::vector<Extent> boxes = extents_of(model);
    const double right = 5.0 * kWallPitch - 0.5 * kWallJoint, outer = -0.5 * kWallThick;
    for (int course = 1; course <= kCourses; ++course) {
        // the block that holds the corner
        std::size_t holders = 0;
        double farthest = 0.0;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            if (built.structure.layer[i] != course) continue;
            farthest = std::max(farthest, boxes[i].high.y());
            const bool holds = boxes[i].high.x() > right - 1e-9 && boxes[i].low.y() < outer + 1e-9;
            if (!holds) continue;
            ++holders;
            const Vector3 size = boxes[i].high - boxes[i].low;
            CHECK((course % 2 == 1 ? size.x() : size.y()) == relative(kWallLong, 1e-12));
        }
        CHECK(holders == 1);
        CHECK(farthest == relative(outer + 6.0 * kWallPitch - kWallJoint, 1e-12));
    }
    // each course covers the same ground but for its joints
    for (const double part : borne_parts(model, built.structure.layer)) CHECK(part > 0.97);
    // of the wall itself courses 1, 3, ... have 5 blocks and even ones 4, between returns of 2 and 3, less a cell in odd courses: w = 2b,
    // so that the half block goes
    CHECK(model.blocks.size() == 4U * (5 + 2 + 3) + 4 * (4 + 2 + 3));
}

TEST_CASE("a wall with all of it is written, read back and scaled, bit for bit at powers of two") {
    const Scene scene = wall_scene(
        R"(, "openings": [{"from": "0.55 m", "width": "0.5 m", "sill": 2, "courses": 3}], "lintel": {"bearing": "0.15 m", "material": "hard"},
            "leaves": {"gap": "0.03 m", "headers_every": 3}, "returns": {"right": 3}, "height_deviation": "1 mm", "seed": 4)",
        kGranite);
    CHECK(parse_scene(write_scene(scene)) == scene);
    const scaling::Similitude similitude = scaling::make_similitude("exact", {.length = 1.0 / 16.0});
    const Scene twin = scale_scene(scene, similitude);
    const Model prototype = make_model(scene), model = make_model(twin);
    REQUIRE(model.blocks.size() == prototype.blocks.size());
    for (std::size_t i = 0; i < model.blocks.size(); ++i) {
        CHECK(model.blocks[i].position == Vector3(prototype.blocks[i].position / 16.0));
        CHECK(half_extents(model, model.blocks[i]) == Vector3(half_extents(prototype, prototype.blocks[i]) / 16.0));
        CHECK(model.blocks[i].mass == prototype.blocks[i].mass / 4096.0);
    }
    // at any other scale there are the same blocks
    const Scene small = scale_scene(scene, scaling::make_similitude("exact", {.length = 1.0 / 107.0}));
    CHECK(make_model(small).blocks.size() == prototype.blocks.size());
    CHECK(make_model(small).shapes.size() == prototype.shapes.size());
}

TEST_CASE("openings, lintels, leaves and corners that do not fit are refused with what to do") {
    const auto opening = [](const std::string& keys) { return R"(, "openings": [{)" + keys + "}]"; };
    check_message(refuse_wall(opening(R"("from": "0.4 m", "width": "0.8 m", "sill": 6, "courses": 3)")),
                  {"/structure/openings/0/courses: 3 courses above a sill of 6 reach beyond the 8 of the wall", "make it lower"});
    check_message(refuse_wall(opening(R"("from": "1.5 m", "width": "0.8 m", "sill": 2, "courses": 3)")),
                  {"/structure/openings/0: it reaches beyond the wall in course 3 (which goes from 0 m to 2.008 m there)"});
    check_message(refuse_wall(opening(R"("from": "0.1 m", "width": "0.8 m", "sill": 2, "courses": 3)")),
                  {"/structure/openings/0: its lintel reaches beyond the wall in course 6"});
    check_message(
        refuse_wall(opening(R"("from": "0.4 m", "width": "0.4 m", "courses": 3}, {"from": "0.7 m", "width": "0.4 m", "courses": 3)")),
        {"/structure/openings/1: it meets opening 0 in course 1", "move them apart"});
    check_message(
        refuse_wall(opening(R"("from": "0.4 m", "width": "0.4 m", "courses": 3}, {"from": "1 m", "width": "0.4 m", "courses": 3)")),
        {"/structure/openings/1: it meets opening 0 in course 4 (lintels count with their bearing)"});
    check_message(
        refuse_wall(opening(R"("from": "0.05 m", "width": "0.8 m", "sill": 2, "courses": 3)") + R"(, "lintel": {"bearing": "0.04 m"})"),
        {"/structure/openings: in course 3 a piece of 50 mm is left by itself", "a quarter of a block, 100 mm"});
    check_message(refuse_wall(opening(R"("from": "0.4 m", "width": "0.8 m", "sill": -1, "courses": 3)")),
                  {"/structure/openings/0/sill: -1 (must be from 0 to"});
    check_message(refuse_wall(opening(R"("from": "0.4 m", "width": "0.8 m", "sill": 1, "courses": 0)")),
                  {"/structure/openings/0/courses: 0"});
    check_message(refuse_wall(opening(R"("from": "0.4 m", "width": "0 m", "courses": 1)")), {"/structure/openings/0/width: 0 m"});
    check_message(refuse_wall(opening(R"("from": "0.4 m", "courses": 1)")), {"/structure/openings/0", "\"width\""});
    check_message(refuse_wall(R"(, "openings": {"from": 1})"), {"/structure/openings: a list"});
    check_message(refuse_wall(R"(, "lintel": {"bearing": "0.1 m"})"), {"/structure/lintel: there is no opening to cross"});
    check_message(refuse_wall(kWindow + R"(, "lintel": {"material": "gold"})"), {"/structure/lintel/material", "gold"});
    check_message(refuse_wall(R"(, "leaves": {"gap": "-1 mm"})"), {"/structure/leaves/gap: -1 mm (must not be negative)"});
    check_message(refuse_wall(R"(, "leaves": {"gap": "1 m"}, "returns": {"right": 2})"),
                  {"/structure/returns/right: too short for a corner"});
    check_message(refuse_wall(R"(, "returns": {"right": -2})"), {"/structure/returns/right: -2 (must be from 0 to"});
}
