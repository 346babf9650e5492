#include <doctest/doctest.h>

#include <cmath>

#include "records/formats/read_record.hpp"
#include "records/formats/write_record.hpp"
#include "records/synthesis/synthetic.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

using scaling::si::seconds;

GroundMotion make_seed_motion() {
    GroundMotion motion{.format = "test", .station = "CI.CLC China Lake"};
    motion.time_zero = make_utc_time(2019, 7, 6, 3, 19, 23.038317);
    std::vector<double> samples;
    samples.reserve(1000);
    for (int i = 0; i < 1000; ++i) samples.push_back(1.0 / (3.0 + i));  // several records of 4096 bytes
    motion.components.push_back({"360", 360.0, {SampleQuantity::acceleration, 0.25 * seconds, 0.005 * seconds, samples}});
    motion.components.push_back({"Up", {}, {SampleQuantity::acceleration, 0.0 * seconds, 0.005 * seconds, {0.1, -2e-17}}});
    motion.components.push_back({"45", 45.0, {SampleQuantity::velocity, 0.0 * seconds, 0.02 * seconds, {0.5}}});
    return motion;
}

TEST_CASE("a record written as miniSEED comes back to the last bit, with its clock and codes") {
    const tests::TemporaryFolder folder;
    const GroundMotion motion = make_seed_motion();

    write_miniseed(folder.path() / "a", motion);
    const GroundMotion back = read_record(folder.path() / "a", {.sensitivity = 1.0});

    CHECK(back.format == "miniSEED");
    CHECK(back.station == "CI.CLC");
    CHECK(back.component_names() == "HNN, HNZ, BH3");
    CHECK(back.time_zero == motion.time_zero);
    for (std::size_t i = 0; i < motion.components.size(); ++i) {
        CHECK(back.components[i].series == motion.components[i].series);
    }
    CHECK(tests::bytes_of(folder.path() / "a").size() % 4096 == 0);
}

TEST_CASE("displacement comes back when it is asked for, and a channel code is kept") {
    const tests::TemporaryFolder folder;
    GroundMotion motion{.format = "test", .station = "some place"};
    motion.components.push_back({"LYX", {}, {SampleQuantity::displacement, 1.5 * seconds, 2.0 * seconds, {0.1, 0.2}}});

    write_miniseed(folder.path() / "a", motion);
    const GroundMotion back = read_record(folder.path() / "a", {.quantity = SampleQuantity::displacement, .sensitivity = 1.0});

    CHECK(back.station == "XX.MUSIM");
    CHECK(back.component_names() == "LYX");
    CHECK_FALSE(back.time_zero);
    CHECK(back.components[0].series.start().value() == 1.5);
    CHECK(back.components[0].series.samples()[1] == 0.2);
}

TEST_CASE("what miniSEED cannot hold is refused, and no file is left") {
    const tests::TemporaryFolder folder;
    const auto message = [&](const GroundMotion& motion) {
        return tests::message_of<WriteError>([&] { write_miniseed(folder.path() / "a", motion); });
    };
    CHECK(message(GroundMotion{}).find("a: record has no components; nothing to write") != std::string::npos);

    GroundMotion twice = make_seed_motion();
    twice.components.push_back(twice.components.front());
    CHECK(message(twice).find("a: component '360' would be a second HNN") != std::string::npos);

    GroundMotion odd{.format = "test"};
    odd.components.push_back({"1", {}, {SampleQuantity::acceleration, 0.0 * seconds, std::sqrt(2.0) * 1e-9 * seconds, {0.0}}});
    CHECK(message(odd).find("cannot be held (miniSEED 2 has") != std::string::npos);
    CHECK(folder.count() == 0);
}

}  // namespace
}  // namespace musim::records
