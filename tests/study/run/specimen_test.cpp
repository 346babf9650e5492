#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lsdem/block_height.hpp"
#include "lsdem/results/read_results.hpp"
#include "lsdem/run/prepare.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/run/specimen_batch.hpp"
#include "lsdem/run/specimen_file.hpp"
#include "lsdem/scene/build_model.hpp"
#include "lsdem/scene/scale_scene.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/study/uneven_wall.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim;
using namespace musim::lsdem;
using musim::tests::bytes_of;
using musim::tests::TemporaryFolder;

namespace {

double total_mass(const Model& model) {
    double mass = 0.0;
    for (const Block& block : model.blocks) mass += block.mass;
    return mass;
}

}  // namespace

TEST_CASE("blocks of unequal height come to rest before the motion, the base bears the weight, and nothing creeps") {
    const lsdem::Scene scene = make_wall_scene();
    const RunResult run = run_scene(scene);
    REQUIRE(run.rest.has_value());
    CHECK(run.rest->at_rest);
    CHECK(std::abs(run.rest->reaction_over_weight - 1.0) < 1e-5);
    CHECK(std::abs(*run.base_reaction_over_weight - 1.0) < 1e-4);
    CHECK(run.history.time.front() == 0.0);
    for (std::size_t i = 0; i < run.initial.position.size(); ++i) {
        CHECK((run.final.position[i] - run.initial.position[i]).norm() < 1e-6 * run.blocks.size[i].z());
    }
    // and they do lean
    const double lean = (run.initial.orientation.back() * Vector3::UnitZ()).head<2>().norm();
    CHECK(lean > 1e-4);
}

TEST_CASE("layer by layer or quickly or by resting planes the same blocks come to about the same places" * doctest::test_suite("slow")) {
    const lsdem::Scene scene = make_wall_scene();
    const Specimen upright = make_upright_specimen(scene);
    const double step = lsdem::compute_time_step(scene, upright.model).value();
    PreparationSettings settings = find_preparation(scene, upright);
    REQUIRE(settings.placing == lsdem::BlockPlacing::layers_mass_scaled);
    const PreparedSpecimen quick = prepare(upright, step, settings);
    settings.placing = lsdem::BlockPlacing::resting;
    const PreparedSpecimen resting = prepare(upright, step, settings);
    settings.placing = lsdem::BlockPlacing::layers;
    const PreparedSpecimen layers = prepare(upright, step, settings);
    REQUIRE(quick.rest.at_rest);
    REQUIRE(resting.rest.at_rest);
    REQUIRE(layers.rest.at_rest);
    double weight = 0.0;
    for (const Block& block : upright.model.blocks) weight += block.mass * upright.model.gravity.norm();
    double base_force = 0.0;
    for (const PreparedSpecimen* prepared : {&quick, &resting, &layers}) {
        REQUIRE(prepared->layers.size() == 4);
        CHECK(prepared->layers[0].max_tilt < 1e-4);
        CHECK(prepared->layers[3].mean_tilt > prepared->layers[0].mean_tilt);
        base_force = 2.0 * prepared->layers[0].mean_force;
        // two blocks stand on the ground
        CHECK(base_force == doctest::Approx(weight).epsilon(0.01));
    }
    // the tilt of a block is its height difference over its pitch: about 0.16 mm·√2/13 mm = 1 degree; where two faces carry it about as
    // well, the ways differ by as much
    for (std::size_t i = 0; i < resting.tilt.size(); ++i) {
        CHECK(std::abs(quick.tilt[i] - layers.tilt[i]) < 0.025);
        CHECK(std::abs(resting.tilt[i] - layers.tilt[i]) < 0.025);
    }
}

TEST_CASE("what has no time to come to rest with inertia added does so with its own, where it stands" * doctest::test_suite("one-thread")) {
    const lsdem::Scene scene = make_wall_scene();
    const Specimen upright = make_upright_specimen(scene);
    const double step = lsdem::compute_time_step(scene, upright.model).value();
    PreparationSettings settings = find_preparation(scene, upright);
    const PreparedSpecimen patient = prepare(upright, step, settings);
    // the layers have theirs, all of the whole is left to the blocks' own inertia
    settings.added_patience = settings.layer_patience;
    const PreparedSpecimen hasty = prepare(upright, step, settings);
    CHECK(hasty.rest.at_rest);
    CHECK(hasty.rest.kinetic <= settings.settling.rest);
    CHECK(std::abs(hasty.rest.reaction_over_weight - 1.0) <= settings.settling.reaction);
    // another way: steps are shorter, but sway dies out sooner
    CHECK(hasty.steps != patient.steps);
    CHECK_FALSE(hasty.specimen.model.preload == patient.specimen.model.preload);
    // both rest where the layers left them but for a last sway: a hundredth of the tilts
    for (std::size_t i = 0; i < patient.tilt.size(); ++i) CHECK(std::abs(hasty.tilt[i] - patient.tilt[i]) < 2e-4);
}

// Tipping grows with p²/α where α is far above p, so the time that is enough for weak damping, so many times 1/α, is not enough for strong
TEST_CASE("blocks laid under a damping far above their frequency parameter come to rest" * doctest::test_suite("slow")) {
    lsdem::Scene scene = make_wall_scene();
    scene.preparation.emplace();
    scene.preparation->placing = lsdem::BlockPlacing::layers;
    scene.preparation->damping_rate = musim::scaling::Frequency::from_value(192.0);
    const Specimen upright = make_upright_specimen(scene);
    const double step = lsdem::compute_time_step(scene, upright.model).value();
    PreparationSettings settings = find_preparation(scene, upright);
    const PreparationSettings weak;
    const double over =
        192.0 / (2.0 * lsdem::choose_damping_rate(2.0 * upright.model.shapes[0].half_extents, upright.model.gravity.norm()));
    CHECK(settings.settling.patience == doctest::Approx(weak.settling.patience * over * over));
    CHECK(settings.last_damping * over == doctest::Approx(weak.last_damping / 2.0));
    CHECK(prepare(upright, step, settings).rest.at_rest);
    settings.settling.patience = weak.settling.patience;
    settings.layer_patience = weak.layer_patience;
    settings.last_damping = weak.last_damping;
    CHECK_FALSE(prepare(upright, step, settings).rest.at_rest);
    // below p nothing changes
    scene.preparation->damping_rate = musim::scaling::Frequency::from_value(192.0 / over);
    CHECK(find_preparation(scene, upright).settling.patience == weak.settling.patience);
}

// The same blocks in the same places, so that differences block by block show more than two means. Forces have no such partners: a contact
// of the one may be open in the other.
TEST_CASE("specimens of layers with scaled mass are those of layer by layer in the mean and cost less" * doctest::test_suite("slow")) {
    lsdem::Scene scene = lsdem::parse_scene(
        R"({"schema": "musim-scene/1", "name": "ring", "material": "wood", "structure": {"kind": "tower", "layers": 4, "tiling": "ring_14",
        "block": ["12.710 mm", "26.355 mm", "39.780 mm"], "height_deviation": "0.155 mm", "seed": 1}, "time": {"duration": "10 ms"}})",
        "test");
    struct Sample {
        double sum = 0.0, squares = 0.0;
        int count = 0;
        void add(double x) { sum += x, squares += x * x, ++count; }
        double mean() const { return sum / count; }
        double variance() const { return squares / count - mean() * mean(); }
        double variance_of_mean() const { return variance() / count; }
    };
    constexpr int kSeeds = 3;
    Sample tilt_difference, tilt, quick_force, force;
    std::uint64_t quick_cost = 0, cost = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        std::get<lsdem::Tower>(scene.structure).seed = seed;
        const Specimen upright = make_upright_specimen(scene);
        const auto prepare_by = [&](lsdem::BlockPlacing placing) {
            PreparationSettings settings = find_preparation(scene, upright);
            settings.placing = placing;
            return prepare(upright, lsdem::compute_time_step(scene, upright.model).value(), settings);
        };
        const PreparedSpecimen quick = prepare_by(lsdem::BlockPlacing::layers_mass_scaled),
                               layers = prepare_by(lsdem::BlockPlacing::layers);
        REQUIRE(quick.rest.at_rest);
        REQUIRE(layers.rest.at_rest);
        quick_cost += quick.block_steps, cost += layers.block_steps;
        for (std::size_t i = 0; i < layers.tilt.size(); ++i) {
            if (upright.layer[i] == 1) continue;
            tilt.add(layers.tilt[i]);
            tilt_difference.add(quick.tilt[i] - layers.tilt[i]);
        }
        for (const double f : quick.force) quick_force.add(f);
        for (const double f : layers.force) force.add(f);
    }
    CHECK(std::abs(tilt_difference.mean()) < 3.0 * std::sqrt(tilt_difference.variance_of_mean()));
    CHECK(std::sqrt(tilt_difference.variance_of_mean()) < 0.02 * tilt.mean());
    CHECK(std::abs(quick_force.mean() - force.mean()) < 3.0 * std::sqrt(quick_force.variance_of_mean() + force.variance_of_mean()));
    CHECK(std::sqrt(quick_force.variance() / force.variance()) == doctest::Approx(1.0).epsilon(0.05));
    CHECK(static_cast<double>(quick_cost) < 0.4 * static_cast<double>(cost));
}

TEST_CASE("a prepared specimen bears what it bore, and its blocks stay where they stand") {
    const lsdem::Scene scene = make_wall_scene(3);
    const Specimen upright = make_upright_specimen(scene);
    const double step = lsdem::compute_time_step(scene, upright.model).value();
    const PreparedSpecimen prepared = prepare(upright, step, find_preparation(scene, upright));
    REQUIRE(prepared.rest.at_rest);
    REQUIRE_FALSE(prepared.specimen.model.preload.empty());
    Simulation simulation(prepared.specimen.model, step);
    CHECK(simulation.base_reaction().z() == doctest::Approx(upright.model.gravity.norm() * total_mass(upright.model)).epsilon(1e-5));
    // one that is begun by its overlaps alone jumps
    double height = 0.0, lively = 0.0;
    SettlingSimulation settling(std::move(simulation), prepared_rate(scene, upright));
    for (int i = 0; i < 2000; ++i) {
        settling.advance(1);
        for (std::size_t b = 0; b < upright.model.blocks.size(); ++b) lively = std::max(lively, settling.state().velocity(b).norm());
    }
    // what is left is a ringing about the place of rest: no farther than the fastest block that counts as at rest comes in this time, and
    // no farther in four times as long
    for (const std::uint64_t more : {0U, 6000U}) {
        settling.advance(more);
        for (std::size_t b = 0; b < upright.model.blocks.size(); ++b) {
            height = 2.0 * half_extents(upright.model, upright.model.blocks[b]).z();
            const double speed = std::sqrt(2.0 * prepared.rest.kinetic * upright.model.gravity.norm() * height);
            CHECK((settling.state().position(b) - prepared.specimen.model.blocks[b].position).norm() < speed * 2000.0 * step);
        }
    }
    CHECK(lively < 1e-5 * std::sqrt(upright.model.gravity.norm() * height));
}

TEST_CASE("a specimen is made once from the same inputs, and again from others" * doctest::test_suite("one-thread")) {
    const TemporaryFolder folder;
    const lsdem::Scene scene = make_wall_scene(3);
    const auto first = make_specimens(make_batch(folder.path(), scene));
    REQUIRE(first.size() == 1);
    CHECK_FALSE(first[0].reused);
    lsdem::Scene renamed = scene;
    renamed.name = "other name, same wall";
    renamed.time.duration = 2.0 * scene.time.duration;
    // as a kill leaves it between the specimen and the end
    const std::filesystem::path checkpoint = first[0].file.string() + ".checkpoint";
    std::ofstream(checkpoint) << "left";
    const auto second = make_specimens(make_batch(folder.path(), renamed));
    CHECK_FALSE(std::filesystem::exists(checkpoint));
    CHECK(second[0].reused);
    CHECK(second[0].file == first[0].file);
    lsdem::Scene slippery = scene;
    slippery.material.friction = 0.5;
    CHECK(make_specimens(make_batch(folder.path(), slippery))[0].file != first[0].file);
    // what changes nothing names the same file
    const lsdem::Scene idle = make_wall_scene(3, R"(, "shape": {"kind": "box", "nodes_per_face": 9},
        "contact": {"nodes": "both"})");
    CHECK(make_specimens(make_batch(folder.path(), idle))[0].file == first[0].file);
    CHECK(read_specimen_inputs(first[0].file).find("nodes_per_face") == std::string::npos);
    SpecimenBatch other_seed = make_batch(folder.path(), scene);
    other_seed.seeds = {4};
    CHECK(make_specimens(other_seed)[0].file != first[0].file);
}

TEST_CASE("specimens made side by side are those made one by one") {
    const TemporaryFolder together, apart;
    const lsdem::Scene scene = make_wall_scene(2);
    SpecimenBatch batch = make_batch(together.path(), scene);
    batch.seeds = {3, 4, 5, 6};
    batch.threads = 2;
    std::vector<double> progress;
    batch.on_progress = [&](double fraction) { progress.push_back(fraction); };
    const auto side_by_side = make_specimens(batch);
    // not only when one is done
    CHECK(progress.size() > 4 * batch.seeds.size());
    CHECK(progress.back() == doctest::Approx(1.0));
    // forward only, also in the final settling
    CHECK(std::is_sorted(progress.begin(), progress.end()));
    batch.on_progress = {};
    batch.folder = apart.path();
    batch.threads = 1;
    const auto one_by_one = make_specimens(batch);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(side_by_side[i].seed == 3 + i);
        CHECK(side_by_side[i].file.filename() == one_by_one[i].file.filename());
        REQUIRE_FALSE(bytes_of(one_by_one[i].file).empty());
        CHECK(bytes_of(side_by_side[i].file) == bytes_of(one_by_one[i].file));
    }
}

TEST_CASE("a specimen serves other materials and scales" * doctest::test_suite("slow")) {
    const TemporaryFolder folder;
    lsdem::Scene scene = make_wall_scene(3);
    const std::filesystem::path file = make_specimens(make_batch(folder.path(), scene))[0].file;
    scene.preparation.emplace().specimen = file;
    const Specimen taken = make_specimen(scene);
    REQUIRE(taken.settling.has_value());
    // where it was prepared it is at rest as it is: as many checks as it takes to believe that
    CHECK(run_scene(scene).rest->steps <= 4 * 64);
    // stiffer, more slippery blocks take the same places: nothing jumps, nothing slides far
    lsdem::Scene other = scene;
    other.material.normal_stiffness *= 16.0;
    other.material.shear_stiffness *= 16.0;
    other.material.friction = 0.4;
    const RunResult run = run_scene(other);
    CHECK(run.rest->at_rest);
    for (std::size_t i = 0; i < run.initial.position.size(); ++i) {
        CHECK((run.initial.position[i] - taken.model.blocks[i].position).norm() < 2e-3 * run.blocks.size[i].z());
    }

    // a power of four: the same bits
    const lsdem::Scene small = lsdem::scale_scene(scene, scaling::make_similitude("exact", {.length = 1.0 / 16.0}));
    const Specimen scaled = make_specimen(small);
    for (std::size_t i = 0; i < taken.model.blocks.size(); ++i) {
        CHECK(scaled.model.blocks[i].position * 16.0 == taken.model.blocks[i].position);
        CHECK(scaled.model.blocks[i].orientation.coeffs() == taken.model.blocks[i].orientation.coeffs());
    }

    // what friction bears goes with weights, a couple with weight times height
    PreparedSpecimen twisted;
    twisted.specimen = taken;
    twisted.tilt.assign(taken.model.blocks.size(), 0.0);
    twisted.force = {1.0};
    REQUIRE(twisted.specimen.model.preload.size() > 1);
    twisted.specimen.model.preload[1].couple = 3e-5;
    const std::filesystem::path twisted_file = folder.path() / "twisted.h5";
    write_specimen(twisted_file, twisted, "{}", "test");
    Specimen here = make_upright_specimen(scene), there = make_upright_specimen(small);
    take_places(twisted_file, here);
    take_places(twisted_file, there);
    const Preload &large = here.model.preload[1], &little = there.model.preload[1];
    CHECK(large.couple == doctest::Approx(3e-5).epsilon(1e-12));
    CHECK(little.couple * std::pow(16.0, 4) == large.couple);
    CHECK(little.friction * std::pow(16.0, 3) == large.friction);
}

TEST_CASE("what friction holds may be said of either block of a contact") {
    const lsdem::Scene scene = make_wall_scene(3);
    const Specimen upright = make_upright_specimen(scene);
    const double step = lsdem::compute_time_step(scene, upright.model).value();
    Model model = prepare(upright, step, find_preparation(scene, upright)).specimen.model;
    Model swapped = model;
    std::size_t changed = 0;
    for (Preload& preload : swapped.preload) {
        if (!preload.follower) continue;
        // force on the other block; the couple is along the normal force on it, which turns about, too
        preload = {.leader = *preload.follower, .follower = preload.leader, .friction = -preload.friction, .couple = preload.couple};
        ++changed;
    }
    std::reverse(swapped.preload.begin(), swapped.preload.end());
    REQUIRE(changed > 3);
    Model none = model;
    none.preload.clear();
    Simulation as_found(model, step), other(swapped, step), bare(none, step);
    for (Simulation* simulation : {&as_found, &other, &bare}) simulation->advance(200);
    for (std::size_t i = 0; i < model.blocks.size(); ++i) {
        CHECK(as_found.position(i) == other.position(i));
        CHECK(as_found.orientation(i).coeffs() == other.orientation(i).coeffs());
        CHECK(as_found.velocity(i) == other.velocity(i));
    }
    // and it counts
    CHECK(bare.position(model.blocks.size() - 1) != as_found.position(model.blocks.size() - 1));
}

TEST_CASE("a scene with blocks of unequal height and its twin at 1:16 settle and run to the same bits" *
          doctest::test_suite("one-thread")) {
    const lsdem::Scene scene = make_wall_scene(3);
    const scaling::Similitude similitude = scaling::make_similitude("exact", {.length = 1.0 / 16.0});
    const RunResult large = run_scene(scene), small = run_scene(lsdem::scale_scene(scene, similitude));
    REQUIRE(large.rest->steps > 0);
    CHECK(large.rest->steps == small.rest->steps);
    for (std::size_t i = 0; i < large.final.position.size(); ++i) {
        CHECK(small.final.position[i] * 16.0 == large.final.position[i]);
        CHECK(small.final.velocity[i] * 4.0 == large.final.velocity[i]);
    }
}

TEST_CASE("a preparation that a scene asks for is read, written, scaled and checked") {
    const lsdem::Scene scene = make_wall_scene(3, R"(, "preparation": {"placing": "layers", "damping_rate": "30 Hz"})");
    REQUIRE(scene.preparation.has_value());
    CHECK(scene.preparation->placing == lsdem::BlockPlacing::layers);
    CHECK(lsdem::parse_scene(lsdem::write_scene(scene)) == scene);
    const auto twin = lsdem::scale_scene(scene, scaling::make_similitude("exact", {.length = 1.0 / 16.0}));
    CHECK(twin.preparation->damping_rate->value() == 120.0);
    const auto refused = [](const std::string& more) { CHECK_THROWS_AS(make_wall_scene(3, more), lsdem::SceneError); };
    refused(R"(, "preparation": {"placing": "thrown"})");
    refused(R"(, "preparation": {"damping_rate": "0 Hz"})");
    refused(R"(, "preparation": {"placing": "layers", "specimen": "a.h5"})");
    CHECK_THROWS_AS(lsdem::parse_scene(R"({"schema": "musim-scene/1", "material": "wood", "structure": {"kind": "blocks", "blocks":
        [{"size": ["1 cm", "2 cm", "3 cm"], "position": [0, 0, "1.5 cm"]}]}, "time": {"duration": "1 s"},
        "preparation": {"placing": "resting"}})"),
                    lsdem::SceneError);
}
