#include "lsdem/results/write_results.hpp"

#include <doctest/doctest.h>
#include <hdf5.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "records/error.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/study/made_run.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using musim::tests::bytes_of;
using musim::tests::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

/// Files may not grow beyond `bytes` while this lives: stands in for a full disk.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    rlimit before_{};
    void (*handler_)(int);
};

/// Shape and units of a dataset, as text: "200 2 3 [m/s]".
std::string describe(hid_t set) {
    std::ostringstream text;
    const hid_t space = H5Dget_space(set);
    std::vector<hsize_t> shape(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, shape.data(), nullptr);
    H5Sclose(space);
    for (const hsize_t extent : shape) text << extent << ' ';
    if (H5Aexists(set, "units") > 0) {
        const hid_t attribute = H5Aopen(set, "units", H5P_DEFAULT);
        const hid_t type = H5Aget_type(attribute);
        std::string units(H5Tget_size(type), '\0');
        H5Aread(attribute, type, units.data());
        H5Tclose(type);
        H5Aclose(attribute);
        text << '[' << units.c_str() << ']';
    }
    return text.str();
}

/// All datasets of a file by path.
std::map<std::string, std::string> list_datasets(const fs::path& path) {
    std::map<std::string, std::string> sets;
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    REQUIRE(file >= 0);
    const auto visit = [](hid_t root, const char* name, const H5O_info_t* info, void* found) -> herr_t {
        if (info->type == H5O_TYPE_DATASET) {
            const hid_t set = H5Dopen2(root, name, H5P_DEFAULT);
            (*static_cast<std::map<std::string, std::string>*>(found))[name] = describe(set);
            H5Dclose(set);
        }
        return 0;
    };
    H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_NATIVE, visit, &sets, H5O_INFO_BASIC);
    H5Fclose(file);
    return sets;
}

std::string read_attribute(const fs::path& path, const std::string& name) {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t attribute = H5Aopen(file, name.c_str(), H5P_DEFAULT);
    REQUIRE(attribute >= 0);
    const hid_t type = H5Aget_type(attribute);
    std::string text(H5Tget_size(type), '\0');
    H5Aread(attribute, type, text.data());
    H5Tclose(type);
    H5Aclose(attribute);
    H5Fclose(file);
    return text.substr(0, text.find('\0'));
}

RunResult with_frames(RunResult run) {
    for (int k = 0; k < 3; ++k) {
        run.frames.time.push_back(0.5 * k);
        for (std::size_t b = 0; b < run.blocks.mass.size(); ++b) {
            run.frames.position.emplace_back(1.0F, 2.0F, 3.0F);
            run.frames.quaternion.emplace_back(1.0F, 0.0F, 0.0F, 0.0F);
            run.frames.velocity.emplace_back(0.0F, 0.0F, 0.0F);
            run.frames.contact_force.push_back(4.0F);
        }
    }
    return run;
}

const ResultHeader kHeader{.scene = R"({"name":"made"})", .program_version = "9.9.9"};

void write_results(const fs::path& directory, const RunResult& run, const ResultHeader& header) {
    ResultFolder folder(directory);
    folder.add_run("", run, header);
    folder.commit();
}

}  // namespace

TEST_CASE("result.h5 holds every dataset of the contract in its shape and unit") {
    const TemporaryFolder scratch;
    write_results(scratch.path() / "run", with_frames(make_made_run(200)), kHeader);

    const std::map<std::string, std::string> expected{{"time", "200 [s]"},
                                                      {"base/displacement", "200 3 [m]"},
                                                      {"base/velocity", "200 3 [m/s]"},
                                                      {"base/acceleration", "200 3 [m/s^2]"},
                                                      {"spine/level", "2 [1]"},
                                                      {"spine/block", "2 [1]"},
                                                      {"spine/position", "200 2 3 [m]"},
                                                      {"spine/velocity", "200 2 3 [m/s]"},
                                                      {"spine/rotation_vector", "200 2 3 [rad]"},
                                                      {"blocks/size", "2 3 [m]"},
                                                      {"blocks/mass", "2 [kg]"},
                                                      {"blocks/layer", "2 [1]"},
                                                      {"blocks/initial_position", "2 3 [m]"},
                                                      {"blocks/initial_quaternion", "2 4 [1]"},
                                                      {"blocks/final_position", "2 3 [m]"},
                                                      {"blocks/final_quaternion", "2 4 [1]"},
                                                      {"energy/kinetic", "200 [J]"},
                                                      {"energy/potential", "200 [J]"},
                                                      {"energy/elastic", "200 [J]"},
                                                      {"energy/friction", "200 [J]"},
                                                      {"energy/damping", "200 [J]"},
                                                      {"energy/preparation", "200 [J]"},
                                                      {"energy/base_work", "200 [J]"},
                                                      {"blocks/fall_time", "2 [s]"},
                                                      {"blocks/fall_displacement", "2 3 [m]"},
                                                      {"losses/friction", "2 [J]"},
                                                      {"losses/damping", "2 [J]"},
                                                      {"losses/ground", "2 [J]"},
                                                      {"frames/time", "3 [s]"},
                                                      {"frames/position", "3 2 3 [m]"},
                                                      {"frames/quaternion", "3 2 4 [1]"},
                                                      {"frames/velocity", "3 2 3 [m/s]"},
                                                      {"frames/contact_force", "3 2 [N]"}};
    CHECK(list_datasets(scratch.path() / "run/result.h5") == expected);
}

TEST_CASE("result.h5 gives back the numbers, quaternions with w first, and its origin") {
    const TemporaryFolder scratch;
    RunResult run = make_made_run(50);
    run.similitude = musim::scaling::make_similitude("exact", {.length = 0.25});
    write_results(scratch.path(), run, kHeader);

    const fs::path path = scratch.path() / "result.h5";
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const auto read = [file](const char* name, std::size_t size) {
        std::vector<double> values(size);
        const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
        H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
        H5Dclose(set);
        return values;
    };
    CHECK(read("/time", 50) == run.history.time);
    const std::vector<double> velocity = read("/spine/velocity", 50UL * 2 * 3);
    CHECK(velocity[3 * (2 * 17 + 1) + 1] == run.history.spine_velocity[2 * 17 + 1].y());
    CHECK(read("/blocks/initial_quaternion", 8) == std::vector<double>{0.8, 0.6, 0, 0, 1, 0, 0, 0});
    H5Fclose(file);

    CHECK(read_attribute(path, "scene") == kHeader.scene);
    CHECK(read_attribute(path, "program_version") == "9.9.9");
    CHECK(read_attribute(path, "state_hash") == run.state_hash);
    CHECK(nlohmann::json::parse(read_attribute(path, "similitude"))["factors"]["time"] == 0.5);
}

TEST_CASE("a scene longer than the classic attribute limit of 64 KiB is stored whole") {
    const TemporaryFolder scratch;
    ResultHeader header = kHeader;
    header.scene = std::string(300000, 'x');
    write_results(scratch.path(), make_made_run(2), header);
    CHECK(read_attribute(scratch.path() / "result.h5", "scene") == header.scene);
}

TEST_CASE("spine.csv has a column per level and direction and a line per sample that reads back exactly") {
    const TemporaryFolder scratch;
    const RunResult run = make_made_run(30);
    write_results(scratch.path(), run, kHeader);

    std::istringstream csv(bytes_of(scratch.path() / "spine.csv"));
    std::string line;
    std::getline(csv, line);
    CHECK(line ==
          "time_s,base_vx_m_s,base_vy_m_s,base_vz_m_s,level1_vx_m_s,level1_vy_m_s,level1_vz_m_s,level2_vx_m_s,level2_vy_m_s,level2_vz_m_s");
    std::size_t rows = 0;
    while (std::getline(csv, line)) {
        CHECK(std::stod(line.substr(line.rfind(',') + 1)) == run.history.spine_velocity[2 * rows + 1].z());
        CHECK(std::stod(line) == run.history.time[rows]);
        ++rows;
    }
    CHECK(rows == 30);
}

TEST_CASE("summary.json has the keys of the contract, with null where there is nothing to say") {
    const TemporaryFolder scratch;
    write_results(scratch.path(), make_made_run(3), kHeader);
    const auto summary = nlohmann::json::parse(bytes_of(scratch.path() / "summary.json"));
    for (const char* key : {"status", "blocks", "steps", "dt_s", "wall_s", "contacts", "contact_nodes", "state_hash", "energy_closure",
                            "max_overlap_over_height", "base_reaction_over_weight"}) {
        CHECK_MESSAGE(summary.contains(key), key);
    }
    CHECK(summary["status"] == "completed");
    CHECK(summary["blocks"] == 2);
    CHECK(summary["base_reaction_over_weight"].is_null());
}

TEST_CASE("result.xdmf names every frame, or the first and last instant of a run without frames") {
    const TemporaryFolder scratch;
    const auto grids = [&](const RunResult& run) {
        write_results(scratch.path(), run, kHeader);
        const std::string xdmf = bytes_of(scratch.path() / "result.xdmf");
        std::size_t n = 0;
        for (const char* field : {"Name=\"size [m]\"", "Name=\"quaternion\""}) CHECK(xdmf.find(field) != std::string::npos);
        for (std::size_t at = xdmf.find("<Time "); at != std::string::npos; at = xdmf.find("<Time ", at + 1)) ++n;
        return n;
    };
    CHECK(grids(with_frames(make_made_run(3))) == 3);
    CHECK(grids(make_made_run(3)) == 2);
}

TEST_CASE("a full disk gives one clear error and leaves nothing behind") {
    const TemporaryFolder scratch;
    const RunResult run = make_made_run(2000);
    {
        const FileSizeLimit limit(4096);
        CHECK_THROWS_WITH_AS(write_results(scratch.path() / "a/b", run, kHeader), doctest::Contains("result.h5"),
                             musim::records::WriteError);
    }
    CHECK(scratch.count() == 0);
}

TEST_CASE("results that cannot be written leave older ones untouched") {
    const TemporaryFolder scratch;
    write_results(scratch.path(), make_made_run(5), kHeader);
    const std::string before = bytes_of(scratch.path() / "result.h5");
    {
        const FileSizeLimit limit(4096);
        CHECK_THROWS_AS(write_results(scratch.path(), make_made_run(2000), kHeader), musim::records::WriteError);
    }
    CHECK(bytes_of(scratch.path() / "result.h5") == before);
    CHECK(scratch.count() == 4);
}

TEST_CASE("an output directory below a file is refused") {
    const TemporaryFolder scratch;
    std::ofstream(scratch.path() / "file") << "kept";
    CHECK_THROWS_AS(write_results(scratch.path() / "file/run", make_made_run(2), kHeader), musim::records::WriteError);
    CHECK_THROWS_AS(write_results(scratch.path() / "file", make_made_run(2), kHeader), musim::records::WriteError);
    CHECK(bytes_of(scratch.path() / "file") == "kept");
}

TEST_CASE("several runs and texts appear together or not at all") {
    const TemporaryFolder scratch;
    {
        ResultFolder folder(scratch.path() / "pair");
        folder.add_run("prototype", make_made_run(3), kHeader);
        folder.add_text("spine.svg", "<svg/>");
        CHECK_FALSE(fs::exists(scratch.path() / "pair/prototype"));
    }
    CHECK(scratch.count() == 0);

    ResultFolder folder(scratch.path() / "pair");
    folder.add_run("prototype", make_made_run(3), kHeader);
    folder.add_text("spine.svg", "<svg/>");
    folder.commit();
    CHECK(fs::exists(scratch.path() / "pair/prototype/result.h5"));
    CHECK(bytes_of(scratch.path() / "pair/spine.svg") == "<svg/>");
}
