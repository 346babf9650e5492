#include <doctest/doctest.h>
#include <hdf5.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "lsdem/results/checked_json.hpp"
#include "lsdem/results/checksum.hpp"
#include "lsdem/results/read_results.hpp"
#include "lsdem/results/write_results.hpp"
#include "lsdem/run/specimen_file.hpp"
#include "tests/study/made_run.hpp"
#include "tests/study/made_specimen.hpp"
#include "tests/support/damage.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using musim::tests::bytes_of;
using musim::tests::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

/// Number of damages of a file that `read` takes without a ResultError; the file is whole again afterwards.
int count_taken(const fs::path& file, const std::function<void()>& read) {
    const std::string whole = bytes_of(file);
    std::mt19937_64 random(1);
    int taken = 0;
    for (int i = 0; i < musim::tests::count_damages(); ++i) {
        const std::string damaged = musim::tests::damage(whole, random);
        std::ofstream(file, std::ios::binary) << damaged;
        try {
            read();
            ++taken;
        } catch (const ResultError&) {
        }
    }
    std::ofstream(file, std::ios::binary) << whole;
    return taken;
}

void write_made_run(const fs::path& directory) {
    ResultFolder folder(directory);
    folder.add_run("", make_made_run(20), {.scene = R"({"name":"made"})", .program_version = "9.9.9"});
    folder.commit();
}

}  // namespace

TEST_CASE("a damaged result is refused") {
    const TemporaryFolder folder;
    write_made_run(folder.path());
    CHECK(count_taken(folder.path() / "result.h5", [&] { read_run(folder.path()); }) == 0);
    CHECK_NOTHROW(read_run(folder.path()));
}

TEST_CASE("a damaged summary is refused or says the same") {
    const TemporaryFolder folder;
    write_made_run(folder.path());
    const fs::path file = folder.path() / "summary.json";
    const auto given = nlohmann::json::parse(bytes_of(file));
    // white space may change
    CHECK(count_taken(file, [&] {
              if (read_checked_json(file) == given) throw ResultError("the same");
          }) == 0);
    CHECK(count_taken(file, [&] {
              if (read_run(folder.path()).status == RunStatus::completed) throw ResultError("the same");
          }) == 0);
}

TEST_CASE("a summary that was cut and closed again is refused") {
    const TemporaryFolder folder;
    write_made_run(folder.path());
    auto summary = nlohmann::json::parse(bytes_of(folder.path() / "summary.json"));
    summary.erase("warnings");
    folder.write("summary.json", summary.dump());
    CHECK_THROWS_WITH_AS(read_run(folder.path()), doctest::Contains("summary.json: is damaged (its checksum does not match)"), ResultError);
    folder.write("summary.json", R"({"status": "completed"})");
    CHECK_THROWS_WITH_AS(read_run(folder.path()), doctest::Contains("summary.json: has no checksum"), ResultError);
}

TEST_CASE("a summary of another run than the result beside it is refused") {
    const TemporaryFolder folder;
    write_made_run(folder.path());
    const std::string summary = bytes_of(folder.path() / "summary.json");
    ResultFolder other(folder.path());
    other.add_run("", make_made_run(21), {.scene = R"({"name":"made"})", .program_version = "9.9.9"});
    other.commit();
    CHECK_NOTHROW(read_run(folder.path()));
    folder.write("summary.json", summary);
    CHECK_THROWS_WITH_AS(read_run(folder.path()), doctest::Contains("summary.json: is of another run than result.h5 beside it"),
                         ResultError);
}

TEST_CASE("a damaged specimen is refused") {
    const TemporaryFolder folder;
    const Specimen column = make_column(3);
    const fs::path file = folder.path() / "specimen.h5";
    PreparedSpecimen prepared;
    prepared.specimen = column;
    prepared.tilt = prepared.force = std::vector<double>(3, 0.0);
    write_specimen(file, prepared, "{}", "9.9.9");
    CHECK(count_taken(file, [&] { read_specimen(file); }) == 0);
    CHECK(count_taken(file, [&] { read_specimen_inputs(file); }) == 0);
    CHECK_NOTHROW(read_specimen(file));
}

TEST_CASE("a specimen with a block in no place is refused though its checksum is right") {
    const TemporaryFolder folder;
    const Specimen column = make_column(3);
    PreparedSpecimen prepared;
    prepared.tilt = prepared.force = std::vector<double>(3, 0.0);
    const std::filesystem::path file = folder.path() / "specimen.h5";
    const auto write_changed = [&](const auto& change) {
        prepared.specimen = column;
        change(prepared.specimen.model.blocks[1]);
        write_specimen(file, prepared, "{}", "9.9.9");
        Specimen taken = column;
        take_places(file, taken);
    };
    CHECK_NOTHROW(write_changed([](musim::lsdem::Block&) {}));
    const char* const damaged = "specimen.h5: the place of block 1 is damaged";
    CHECK_THROWS_WITH_AS(write_changed([](musim::lsdem::Block& block) { block.position.x() = std::numeric_limits<double>::quiet_NaN(); }),
                         doctest::Contains(damaged), ResultError);
    CHECK_THROWS_WITH_AS(write_changed([](musim::lsdem::Block& block) { block.orientation.coeffs() *= 0.5; }), doctest::Contains(damaged),
                         ResultError);
}

TEST_CASE("a specimen with a block in a layer that cannot be is refused though its checksum is right") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "specimen.h5";
    for (const int layer : {-1, 4, 1 << 30}) {
        CAPTURE(layer);
        PreparedSpecimen prepared;
        prepared.tilt = prepared.force = std::vector<double>(3, 0.0);
        prepared.specimen = make_column(3);
        prepared.specimen.layer[1] = layer;
        write_specimen(file, prepared, "{}", "9.9.9");
        CHECK_THROWS_WITH_AS(read_specimen(file), doctest::Contains("/blocks/layer has a layer"), ResultError);
        Specimen taken = make_column(3);
        CHECK_THROWS_AS(take_places(file, taken), ResultError);
    }
}

TEST_CASE("a file without its checksum is refused and the line says what to do") {
    const TemporaryFolder folder;
    write_made_run(folder.path());
    const std::string whole = bytes_of(folder.path() / "result.h5");
    folder.write("result.h5", whole.substr(0, whole.rfind("musim-checksum")));
    CHECK_THROWS_WITH_AS(read_run(folder.path()),
                         ((folder.path() / "result.h5").string() +
                          ": has no checksum at its end (it is damaged, or an older musim wrote it); remove it and make it again with the "
                          "command that made it")
                             .c_str(),
                         ResultError);
}

TEST_CASE("a result of what no run is like is refused though its checksum is right") {
    const auto refuses = [](const char* message, const auto& change) {
        const TemporaryFolder directory;
        RunResult run = make_made_run(20);
        change(run);
        ResultFolder folder(directory.path());
        folder.add_run("", run, {.scene = R"({"name":"made"})", .program_version = "9.9.9"});
        folder.commit();
        CHECK_THROWS_WITH_AS(read_run(directory.path()), doctest::Contains(message), ResultError);
    };
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    refuses("/blocks/layer has a layer -1", [](RunResult& run) { run.blocks.layer[1] = -1; });
    refuses("/spine/level has a layer 3", [](RunResult& run) { run.spine.level[1] = 3; });
    refuses("/time does not go on at sample 7", [](RunResult& run) { run.history.time[7] = run.history.time[6]; });
    refuses("/time does not go on at sample 0", [](RunResult& run) { run.history.time[0] = kNone; });
    refuses("/spine/position has no place for level 1", [](RunResult& run) { run.history.spine_position[1].z() = kNone; });
}

TEST_CASE("a result that says that it holds more than it does is refused and takes no memory") {
    const TemporaryFolder folder;
    write_made_run(folder.path());
    const fs::path file = folder.path() / "result.h5";
    const std::string whole = bytes_of(file);
    folder.write("result.h5", whole.substr(0, whole.rfind("musim-checksum")));
    const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    REQUIRE(H5Ldelete(opened, "/time", H5P_DEFAULT) >= 0);
    // pieces that nobody writes are not kept
    const hsize_t claimed = hsize_t{1} << 60U, piece = 1;
    const hid_t space = H5Screate_simple(1, &claimed, nullptr), creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(creation, 1, &piece);
    const hid_t set = H5Dcreate2(opened, "/time", H5T_IEEE_F64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    REQUIRE(set >= 0);
    H5Dclose(set);
    H5Pclose(creation);
    H5Sclose(space);
    H5Fclose(opened);
    const std::string changed = bytes_of(file);
    std::vector<char> stamped(changed.begin(), changed.end());
    detail::append_checksum(stamped);
    folder.write("result.h5", {stamped.data(), stamped.size()});
    CHECK_THROWS_WITH_AS(read_run(folder.path()), doctest::Contains("/time says that it holds more than there is"), ResultError);
}
