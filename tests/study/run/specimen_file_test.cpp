#include "lsdem/run/specimen_file.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "lsdem/block_height.hpp"
#include "lsdem/results/hdf5_file.hpp"
#include "lsdem/results/result_error.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/scene/build_model.hpp"
#include "tests/study/uneven_wall.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim;
using namespace musim::lsdem;
using musim::tests::TemporaryFolder;

TEST_CASE("a specimen from its file is that in memory: places to the bit, friction to its rounding, and at rest") {
    const TemporaryFolder folder;
    const lsdem::Scene scene = make_wall_scene(3);
    const Specimen upright = make_upright_specimen(scene);
    const double step = lsdem::compute_time_step(scene, upright.model).value();
    const PreparedSpecimen prepared = prepare(upright, step, find_preparation(scene, upright));
    const std::filesystem::path file = folder.path() / "wall.h5";
    write_specimen(file, prepared, "{}", "test");
    Specimen read = upright;
    take_places(file, read);
    const Model &memory = prepared.specimen.model, &stored = read.model;
    for (std::size_t i = 0; i < memory.blocks.size(); ++i) {
        CHECK(stored.blocks[i].position == memory.blocks[i].position);
        CHECK(stored.blocks[i].orientation.coeffs() == memory.blocks[i].orientation.coeffs());
    }
    // divided by a weight and multiplied by it again: two roundings
    constexpr double kTwoRoundings = 0x1p-52;
    REQUIRE(stored.preload.size() == memory.preload.size());
    REQUIRE(memory.preload.size() > 6);
    double held = 0.0;
    for (std::size_t i = 0; i < memory.preload.size(); ++i) {
        const Preload &a = stored.preload[i], &b = memory.preload[i];
        CHECK(a.leader == b.leader);
        CHECK(a.follower == b.follower);
        for (int axis = 0; axis < 3; ++axis)
            CHECK(std::abs(a.friction[axis] - b.friction[axis]) <= kTwoRoundings * std::abs(b.friction[axis]));
        CHECK(std::abs(a.couple - b.couple) <= kTwoRoundings * std::abs(b.couple));
        held = std::max(held, b.friction.norm());
    }
    // friction holds something
    CHECK(held > 1e-3 * memory.blocks[0].mass * memory.gravity.norm());
    // what differs by rounding stays so while nothing moves: both stand
    SettlingSimulation from_memory(Simulation(memory, step), prepared_rate(scene, upright));
    SettlingSimulation from_file(Simulation(stored, step), prepared_rate(scene, upright));
    const double height = 2.0 * half_extents(memory, memory.blocks[0]).z();
    from_memory.advance(500);
    from_file.advance(500);
    for (std::size_t i = 0; i < memory.blocks.size(); ++i) {
        CHECK((from_memory.state().position(i) - from_file.state().position(i)).norm() < 1e-12 * height);
    }
}

TEST_CASE("a file that is no specimen, or one of another wall, is refused with what to do") {
    const TemporaryFolder folder;
    lsdem::Scene scene = make_wall_scene(3);
    const std::filesystem::path file = make_specimens(make_batch(folder.path(), scene))[0].file;
    const auto message = [&](const lsdem::Scene& given) -> std::string {
        try {
            make_specimen(given);
        } catch (const ResultError& error) {
            return error.what();
        }
        return "";
    };
    const auto with_file = [](lsdem::Scene given, const std::filesystem::path& path) {
        given.preparation.emplace().specimen = path;
        return given;
    };
    CHECK(message(with_file(make_wall_scene(4), file)).find("prepare one of this") != std::string::npos);
    lsdem::Scene other = scene;
    std::get<lsdem::Wall>(other.structure).seed = 9;
    CHECK(message(with_file(other, file)).find("prepare a specimen of this scene") != std::string::npos);
    CHECK(message(with_file(scene, folder.path() / "nothing.h5")).find("nothing.h5") != std::string::npos);

    const Specimen upright = make_upright_specimen(scene);
    PreparedSpecimen damaged;
    damaged.specimen = upright;
    damaged.tilt.assign(upright.model.blocks.size(), 0.0);
    damaged.force = {1.0};
    const std::filesystem::path damaged_file = folder.path() / "damaged.h5";
    Preload stranger{.leader = 0, .follower = upright.model.blocks.size()}, friction{.leader = 0, .follower = 1}, couple = friction;
    friction.friction.x() = std::numeric_limits<double>::infinity();
    couple.couple = std::numeric_limits<double>::quiet_NaN();
    for (const Preload& bad : {stranger, friction, couple}) {
        damaged.specimen.model.preload = {bad};
        write_specimen(damaged_file, damaged, "{}", "test");
        CHECK(message(with_file(scene, damaged_file)).find("contact 0") != std::string::npos);
    }
    detail::Hdf5File old;
    old.exchange("/blocks/tilt", {damaged.tilt.size()}, damaged.tilt, "rad");
    old.write_attribute("format", "musim-specimen/4");
    const std::vector<char> bytes = old.image();
    std::ofstream(folder.path() / "old.h5", std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    const std::string why = message(with_file(scene, folder.path() / "old.h5"));
    CHECK(why == (folder.path() / "old.h5").string() +
                     ": it has format musim-specimen/4, this program reads musim-specimen/5 (another version wrote it); move it and "
                     "prepare it again");
    // nor is it taken where a file of its name is asked for
    std::filesystem::copy_file(folder.path() / "old.h5", file, std::filesystem::copy_options::overwrite_existing);
    CHECK_THROWS_WITH_AS(make_specimens(make_batch(folder.path(), scene)), doctest::Contains((file.string() + ": it has format").c_str()),
                         ResultError);
    std::ofstream(folder.path() / "text.h5") << "no HDF5";
    CHECK(message(with_file(scene, folder.path() / "text.h5")).find("text.h5") != std::string::npos);
}
