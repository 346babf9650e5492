#include <doctest/doctest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>

#include "records/atomic_file.hpp"
#include "records/formats/read_record.hpp"
#include "records/formats/write_record.hpp"
#include "records/synthesis/synthetic.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::si::seconds;

GroundMotion make_rescaled_motion() {
    GroundMotion motion{.format = "test", .event = "Quake, 1/1/2000", .station = "Place"};
    const scaling::Time dt = 0.005 * 0.0935543212345 * seconds;  // no short decimal
    motion.components.push_back({"360", 360.0, {SampleQuantity::acceleration, 0.1 * seconds, dt, {1.0 / 3.0, -2.0e-17, 9.80665, 0.0}}});
    motion.components.push_back({"Up", {}, {SampleQuantity::acceleration, 0.1 * seconds, dt, {0.1, 0.2}}});
    motion.integration_corner = scaling::Frequency::from_value(0.05 / 3.0);
    motion.history = {"made", "rescaled"};
    motion.time_zero = make_utc_time(2019, 7, 6, 3, 19, 23.0383);
    return motion;
}

/// No file may grow beyond some bytes while this lives: a full disk.
class FullDisk {
  public:
    explicit FullDisk(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &old_limit_);
        const rlimit limit{bytes, old_limit_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;
    ~FullDisk() {
        ::setrlimit(RLIMIT_FSIZE, &old_limit_);
        std::signal(SIGXFSZ, old_handler_);
    }

  private:
    void (*old_handler_)(int);
    rlimit old_limit_{};
};

TEST_CASE("a record written as CSV comes back to the last bit") {
    const tests::TemporaryFolder folder;
    GroundMotion motion = make_rescaled_motion();
    motion.components.push_back(motion.components.back());
    motion.components.back().name = "6", motion.components.back().up = true;

    write_csv(folder.path() / "a.csv", motion);
    const GroundMotion back = read_record(folder.path() / "a.csv");

    CHECK(back.format == "musim CSV");
    CHECK(back.event == motion.event);
    CHECK(back.station == motion.station);
    CHECK(back.history == motion.history);
    CHECK(back.integration_corner == motion.integration_corner);
    CHECK(back.time_zero == motion.time_zero);
    REQUIRE(back.components.size() == motion.components.size());
    for (std::size_t i = 0; i < motion.components.size(); ++i) {
        CHECK(back.components[i].name == motion.components[i].name);
        CHECK(back.components[i].azimuth_deg == motion.components[i].azimuth_deg);
        CHECK(back.components[i].up == motion.components[i].up);
        CHECK(back.components[i].series == motion.components[i].series);
    }
}

TEST_CASE("a record written as AT2 comes back with its clock and samples") {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = make_rescaled_motion();

    write_at2(folder.path() / "a.at2", motion, "360");
    const GroundMotion back = read_record(folder.path() / "a.at2");

    CHECK(back.format == "PEER AT2");
    CHECK(back.event == "Quake, 1/1/2000");
    CHECK(back.station == "Place");
    const TimeSeries& series = back.find_component("360").series;
    const TimeSeries& original = motion.find_component("360").series;
    CHECK(series.dt() == original.dt());
    REQUIRE(series.size() == original.size());
    // division by g and multiplication again: one unit in the last place each
    for (std::size_t i = 0; i < series.size(); ++i) {
        CHECK(std::abs(series.samples()[i] - original.samples()[i]) <= 3e-16 * std::abs(original.samples()[i]));
    }
}

TEST_CASE("an uncorrected record keeps its corner in every text format, and so its peak velocity") {
    const tests::TemporaryFolder folder;
    GroundMotion motion = make_rescaled_motion();
    std::erase_if(motion.components, [](const Component& component) { return component.name != "360"; });
    for (const double corner : {0.05, 0.05 * 10.688982}) {
        motion.integration_corner = corner * scaling::si::hertz;
        write_at2(folder.path() / "a.at2", motion, "360");
        write_cosmos(folder.path() / "a.v1", motion);
        write_csv(folder.path() / "a.csv", motion);
        for (const char* const file : {"a.at2", "a.v1", "a.csv"}) {
            CAPTURE(file);
            CHECK(read_record(folder.path() / file).integration_corner == motion.integration_corner);
        }
    }
    motion.integration_corner.reset();
    write_at2(folder.path() / "a.at2", motion, "360");
    write_cosmos(folder.path() / "a.v2", motion);
    for (const char* const file : {"a.at2", "a.v2"}) CHECK_FALSE(read_record(folder.path() / file).integration_corner);
}

TEST_CASE("a corner that is none is refused with its line") {
    const tests::TemporaryFolder folder;
    for (const char* const corner : {"-1", "0", "x", ""}) {
        CAPTURE(corner);
        std::ofstream(folder.path() / "a.at2") << "PEER\nQuake, Place, 90\nACCELERATION IN UNITS OF G, INTEGRATION CORNER= " << corner
                                               << " HZ\nNPTS= 2, DT= .01 SEC\n0.1 0.2\n";
        const std::string message = tests::message_of<ReadError>([&] { read_record(folder.path() / "a.at2"); });
        CHECK_MESSAGE(message.find("a.at2:3: integration corner") != std::string::npos, message);
    }
}

TEST_CASE("velocities are written as VT2 in cm/s") {
    const tests::TemporaryFolder folder;
    GroundMotion motion{.format = "test"};
    motion.components.push_back({"1", {}, {SampleQuantity::velocity, 0.0 * seconds, 0.5 * seconds, {0.0, 0.25}}});

    write_at2(folder.path() / "a.vt2", motion, "1");
    const GroundMotion back = read_record(folder.path() / "a.vt2");

    CHECK(back.format == "PEER VT2");
    CHECK(back.components.front().series.samples()[1] == relative(0.25, 1e-15));
}

TEST_CASE("displacements are written as DT2 in cm") {
    const tests::TemporaryFolder folder;
    GroundMotion motion{.format = "test"};
    motion.components.push_back({"1", {}, {SampleQuantity::displacement, 0.0 * seconds, 0.5 * seconds, {0.0, -0.25}}});

    write_at2(folder.path() / "a.dt2", motion, "1");
    const GroundMotion back = read_record(folder.path() / "a.dt2");

    CHECK(back.format == "PEER DT2");
    CHECK(tests::bytes_of(folder.path() / "a.dt2").find("UNITS OF CM\n") != std::string::npos);
    CHECK(back.components.front().series.quantity() == SampleQuantity::displacement);
    CHECK(back.components.front().series.samples()[1] == relative(-0.25, 1e-15));
}

TEST_CASE("components with different clocks do not go into one CSV") {
    const tests::TemporaryFolder folder;
    GroundMotion motion = make_rescaled_motion();
    motion.components.push_back({"90", {}, {SampleQuantity::acceleration, 0.0 * seconds, 0.5 * seconds, {1.0}}});

    CHECK_THROWS_AS(write_csv(folder.path() / "a.csv", motion), WriteError);
    CHECK_THROWS_AS(write_csv(folder.path() / "a.csv", GroundMotion{}), WriteError);
    CHECK(folder.count() == 0);
}

TEST_CASE("a full device gives a WriteError") {
    const std::string message = tests::message_of<WriteError>([] { write_csv("/dev/full", make_rescaled_motion()); });
    CHECK(message.find("/dev/full: cannot be written") == 0);
    CHECK(std::filesystem::exists("/dev/full"));
}

TEST_CASE("a disk that fills up leaves neither a partial file nor a temporary one, and the old file stays") {
    const tests::TemporaryFolder folder;
    const auto old_file = folder.write("old.csv", "old");
    const GroundMotion motion = make_synthetic_record();
    {
        const FullDisk full(10000);
        CHECK_THROWS_AS(write_csv(folder.path() / "new.csv", motion), WriteError);
        CHECK_THROWS_AS(write_at2(folder.path() / "new.at2", motion, "1"), WriteError);
        CHECK_THROWS_AS(write_csv(old_file, motion), WriteError);
    }
    CHECK(folder.count() == 1);
    CHECK(tests::bytes_of(old_file) == "old");
}

TEST_CASE("a folder that is missing, or a target that is one, gives a WriteError") {
    const tests::TemporaryFolder folder;
    const std::string none = (folder.path() / "none").string();
    CHECK_THROWS_WITH_AS(write_file_atomically(none + "/a", "x"),
                         (none + "/a: cannot be created (there is no folder " + none + "); create the folder").c_str(), WriteError);
    CHECK_FALSE(std::filesystem::exists(none));
    CHECK_THROWS_AS(write_file_atomically(folder.path(), "x"), WriteError);
}

TEST_CASE("writing replaces a file and follows a symbolic link") {
    const tests::TemporaryFolder folder;
    const auto file = folder.write("file", "old and longer");
    std::filesystem::create_symlink(file, folder.path() / "link");

    write_file_atomically(folder.path() / "link", "new");

    CHECK(tests::bytes_of(file) == "new");
    CHECK(std::filesystem::is_symlink(folder.path() / "link"));
    CHECK(folder.count() == 2);
}

TEST_CASE("the start time comes back from every format, with a clock and without") {
    const tests::TemporaryFolder folder;
    // a stretch of a record that begins 230 s after its first sample, and one of an own clock that begins before zero
    for (const double start : {230.5, -2.25}) {
        for (const std::optional<UtcTime>& zero : {std::optional<UtcTime>(), make_utc_time(2019, 7, 6, 3, 16, 8.25)}) {
            CAPTURE(start);
            CAPTURE(zero.has_value());
            GroundMotion motion{.format = "test", .event = "Quake", .station = "CI.CLC", .components = {}, .time_zero = zero};
            motion.components.push_back(
                {"360",
                 360.0,
                 {SampleQuantity::acceleration, start * scaling::si::seconds, 0.25 * scaling::si::seconds, {0.5, -1.0, 0.25}}});
            write_csv(folder.path() / "a.csv", motion);
            write_cosmos(folder.path() / "a.v2", motion);
            write_miniseed(folder.path() / "a.mseed", motion);
            write_at2(folder.path() / "a.at2", motion, "360");
            for (const std::string name : {"a.csv", "a.v2", "a.mseed", "a.at2"}) {
                CAPTURE(name);
                const bool is_miniseed = name == "a.mseed";
                const GroundMotion back = read_record(folder.path() / name, is_miniseed ? ReadOptions{.sensitivity = 1.0} : ReadOptions{});
                const TimeSeries& series = back.components.at(0).series;
                // miniSEED has one date for each stream: the first sample's
                const bool is_first_sample = is_miniseed && zero;
                CHECK(series.start().value() == (is_first_sample ? 0.0 : start));
                if (!zero) CHECK_FALSE(back.time_zero);
                if (zero && name != "a.at2") {
                    REQUIRE(back.time_zero);
                    CHECK(find_instant(*back.time_zero, series.start()) == find_instant(*zero, start * scaling::si::seconds));
                }
            }
        }
    }
    GroundMotion far{.format = "test", .event = "", .station = ""};
    far.components.push_back(
        {"360", 360.0, {SampleQuantity::acceleration, 1e7 * scaling::si::seconds, 0.25 * scaling::si::seconds, {0.5}}});
    CHECK_THROWS_WITH_AS(
        write_miniseed("far.mseed", far),
        "far.mseed: start 10000000 s of '360' cannot be held (miniSEED has a date, or less than a day of an unknown clock); "
        "write CSV",
        WriteError);
}

}  // namespace
}  // namespace musim::records
