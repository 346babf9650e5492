#include "lsdem/results/block_shapes.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <string>

#include "lsdem/results/hdf5_reader.hpp"
#include "lsdem/results/read_results.hpp"
#include "lsdem/results/result_layout.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/results/write_xdmf.hpp"
#include "tests/study/made_run.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using musim::tests::bytes_of;
using musim::tests::TemporaryFolder;

namespace {

Solid make_wedge() {
    return {{make_polyhedron({Vector3(0, 0, 0), Vector3(2, 0, 0), Vector3(2, 0, 1), Vector3(0, 3, 0), Vector3(2, 3, 0), Vector3(2, 3, 1)},
                             {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {0, 2, 5, 3}})}};
}

/// An L of two boxes, the faces between them inner ones.
Solid make_compound_of_two() {
    Solid solid;
    solid.pieces.push_back(make_box_solid({1.0, 1.0, 1.0}).pieces.front());
    solid.pieces.push_back(moved(make_box_solid({1.0, 1.0, 1.0}), {Matrix3::Identity(), Vector3(1.0, 0.0, 0.0)}).pieces.front());
    solid.pieces[0].faces[1].outer = false;
    solid.pieces[1].faces[0].outer = false;
    return solid;
}

/// A run of a box and a block of the given shape.
RunResult make_run_of(Solid solid, double radius = 0.0) {
    RunResult run = make_made_run(5);
    run.blocks.shapes.list = {std::make_shared<const BlockShape>(BlockShape{"named", std::move(solid), radius})};
    run.blocks.shapes.of_block = {-1, 0};
    return run;
}

/// The same run, written and read.
StoredRun store(const RunResult& run, const TemporaryFolder& folder) {
    ResultFolder results(folder.path());
    results.add_run("", run, {.scene = "{}", .program_version = "9.9.9"});
    results.commit();
    return read_run(folder.path());
}

void check_same_surface(const Solid& read, const Solid& written) {
    REQUIRE(read.pieces.size() == written.pieces.size());
    for (std::size_t p = 0; p < read.pieces.size(); ++p) {
        CHECK(read.pieces[p].corners == written.pieces[p].corners);
        CHECK(read.pieces[p].loops == written.pieces[p].loops);
        REQUIRE(read.pieces[p].faces.size() == written.pieces[p].faces.size());
        for (std::size_t f = 0; f < read.pieces[p].faces.size(); ++f) {
            CHECK(read.pieces[p].faces[f].outer == written.pieces[p].faces[f].outer);
            CHECK((read.pieces[p].faces[f].plane.normal - written.pieces[p].faces[f].plane.normal).norm() < 1e-15);
        }
    }
}

}  // namespace

TEST_CASE("results hold the shapes of blocks that are no boxes") {
    for (const Solid& solid : {make_wedge(), make_compound_of_two()}) {
        const TemporaryFolder folder;
        const StoredRun stored = store(make_run_of(solid), folder);
        CHECK(stored.blocks.shapes.find(0) == nullptr);
        REQUIRE(stored.blocks.shapes.find(1) != nullptr);
        CHECK(stored.blocks.shapes.find(1)->name == "named");
        CHECK(stored.blocks.shapes.find(1)->radius == 0.0);
        check_same_surface(stored.blocks.shapes.find(1)->solid, solid);
        const auto drawn = list_drawn_shapes(stored.blocks.shapes, stored.blocks.size);
        CHECK(find_bounds(drawn[0]->solid).size() == Vector3(1.0, 2.0, 3.0));
        CHECK(drawn[1].get() == stored.blocks.shapes.find(1));
    }
    const TemporaryFolder folder;
    CHECK(store(make_run_of(make_ball_facets(2.0), 2.0), folder).blocks.shapes.find(1)->radius == 2.0);
}

TEST_CASE("results of boxes say nothing of shapes") {
    const TemporaryFolder folder;
    CHECK_FALSE(store(make_made_run(5), folder).blocks.shapes.any());
    const detail::Hdf5Reader file(folder.path() / "result.h5");
    for (const char* group : {"/shapes", "/surface", "/blocks/shape"}) CHECK_FALSE(file.has(group));
    CHECK(bytes_of(folder.path() / "result.xdmf").find("Polyvertex") != std::string::npos);
}

TEST_CASE("lists that make no shape are refused with their reason") {
    const detail::ShapeLists lists = detail::ShapeLists::of({"", make_compound_of_two(), 0.0});
    const auto refuse = [&](const auto& damage, const char* why) {
        detail::ShapeLists damaged = lists;
        damage(damaged);
        CHECK_THROWS_WITH_AS(damaged.make(""), why, std::invalid_argument);
    };
    refuse([](auto& l) { l.face_corners[5] = 99; }, "a face names a corner that is not there");
    refuse([](auto& l) { l.first[3] = 1000; }, "its faces have no corners of their own");
    refuse([](auto& l) { l.first[3] = l.first[2] + 2; }, "a face has fewer than three corners");
    refuse([](auto& l) { l.corners[2].x() = std::nan(""); }, "a corner is no place");
    refuse([](auto& l) { l.radius[0] = -1.0; }, "its radius is none");
    refuse([](auto& l) { l = {{}, {}, {}, {}, {}, {0.0}}; }, "it has no faces");
    refuse([](auto& l) { std::swap(l.face_corners[0], l.face_corners[1]); }, "an edge belongs to two faces in the same direction");
}

TEST_CASE("lists of a surface place each corner by position and quaternion of its block") {
    const RunResult run = make_run_of(make_wedge());
    const detail::Surface surface = detail::list_surface(run.blocks);
    CHECK(surface.block.size() == 6 + 5);
    CHECK(surface.topology.size() == 6 * (2 + 4) + 2 * (2 + 3) + 3 * (2 + 4));
    REQUIRE(surface.position.size() == 3 * (8 + 6));
    std::vector<double> p, q;
    for (std::size_t b = 0; b < 2; ++b) {
        const Quaternion& turn = run.initial.orientation[b];
        for (const double number : {turn.w(), turn.x(), turn.y(), turn.z()}) q.push_back(number);
        for (int axis = 0; axis < 3; ++axis) p.push_back(run.initial.position[b][axis]);
    }
    const auto shapes = list_drawn_shapes(run.blocks.shapes, run.blocks.size);
    for (std::size_t c = 0; c < 14; ++c) {
        const std::size_t block = c < 8 ? 0 : 1;
        const Vector3 corner = shapes[block]->solid.pieces[0].corners[c < 8 ? c : c - 8];
        const Vector3 expected = run.initial.position[block] + run.initial.orientation[block] * corner;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t n = 3 * c + axis;
            const double w = q[surface.quaternion[n]], a = q[surface.quaternion_i[n]], b = q[surface.quaternion_j[n]],
                         d = q[surface.quaternion_k[n]], x = surface.body_i[n], y = surface.body_j[n], z = surface.body_k[n];
            const double place = p[surface.position[n]] + x + 2.0 * (w * (b * z - d * y) + a * (b * y + d * z) - (b * b + d * d) * x);
            CHECK(place == doctest::Approx(expected[static_cast<Eigen::Index>(axis)]).epsilon(1e-14));
        }
    }
}

TEST_CASE("blocks of one shape that differ in height have a shape each") {
    Model model;
    model.shapes = {make_solid_shape(make_wedge()), make_box_shape({1.0, 1.0, 1.0}, {2, 2, 2}), make_sphere_shape(0.5, 20, 0.1)};
    const double height = 2.0 * model.shapes[0].half_extents.z();
    for (const auto& [shape, offset] : {std::pair<std::size_t, double>{0, 0.0}, {1, 0.0}, {0, 0.5 * height}, {0, 0.0}, {2, 0.0}}) {
        Block block;
        block.shape = shape;
        block.height_offset = offset;
        model.blocks.push_back(block);
    }
    const BlockShapes shapes = list_block_shapes(model, {"wedge", "box", "ball"});
    CHECK(shapes.of_block == std::vector<int>{0, -1, 1, 0, 2});
    REQUIRE(shapes.list.size() == 3);
    CHECK(shapes.list[1]->name == "wedge");
    CHECK(find_bounds(shapes.list[1]->solid).size().z() == doctest::Approx(1.5 * find_bounds(shapes.list[0]->solid).size().z()));
    CHECK(shapes.list[2]->radius == 0.5);
    model.blocks.resize(2);
    model.blocks[0].shape = 1;
    CHECK_FALSE(list_block_shapes(model, {}).any());
}
