#include <doctest/doctest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "records/formats/write_record.hpp"
#include "tests/support/shared_records.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

using scaling::si::seconds;

std::vector<std::string> lines_of(const std::filesystem::path& path) {
    std::istringstream stream(tests::bytes_of(path));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

// header value `number`, counted from 1, in the block of fixed columns that follows line `title`
std::string header_value(const std::vector<std::string>& lines, std::size_t title, std::size_t per_line, std::size_t width,
                         std::size_t number) {
    return lines.at(title + 1 + (number - 1) / per_line).substr((number - 1) % per_line * width, width);
}

constexpr std::size_t kIntegers = 13;  // line of "100 Integer-header values", counted from 0
constexpr std::size_t kReals = 24;
constexpr std::size_t kComments = 45;

double integer_of(const std::vector<std::string>& lines, std::size_t number) {
    return std::stod(header_value(lines, kIntegers, 10, 8, number));
}
double real_of(const std::vector<std::string>& lines, std::size_t number) { return std::stod(header_value(lines, kReals, 5, 15, number)); }

GroundMotion make_motion() {
    GroundMotion motion{.format = "test", .event = "Quake", .station = "CE.23837 Pomona"};
    motion.time_zero = make_utc_time(2018, 12, 31, 23, 59, 59.5);
    motion.components.push_back(
        {"45", 45.0, {SampleQuantity::acceleration, 0.75 * seconds, 0.005 * seconds, {1.0 / 3.0, -0.5, 0.25, 0.125}}});
    motion.components.push_back({"Up", {}, {SampleQuantity::displacement, 0.0 * seconds, 0.005 * seconds, {0.01}}});
    return motion;
}

TEST_CASE("a COSMOS section has its headers in the places that readers look at") {
    const tests::TemporaryFolder folder;
    write_cosmos(folder.path() / "a", make_motion());
    const std::vector<std::string> lines = lines_of(folder.path() / "a");

    CHECK(lines.at(0) == "Corrected acceleration    (Format v01.20 with 13 text lines)");
    CHECK(lines.at(1) == "Quake");
    CHECK(lines.at(4) == "Statn No: -999 Code:CE-23837  musim Pomona");
    CHECK(lines.at(7) == "Rcrd start time: 2019/01/01, 00:00:00.250 UTC");
    CHECK(lines.at(8) == "Sta Chan   1: 45 deg (Rcrdr Chan   1)");
    CHECK(lines.at(kIntegers) == " 100 Integer-header values follow on  10 lines, Format= (10I8)");
    CHECK(lines.at(kReals) == " 100 Real-header values follow on  20 lines, Format= (5F15.6)");
    CHECK(lines.at(kComments) == "   2 Comment line(s) follow, each starting with a \"|\":");
    for (std::size_t i = 1; i <= 10; ++i) CHECK(lines.at(kIntegers + i).size() == 80);
    for (std::size_t i = 1; i <= 20; ++i) CHECK(lines.at(kReals + i).size() == 75);

    // stage, parameter, unit, version; date and time of the first sample; azimuth
    struct Value {
        std::size_t number;
        double value;
    };
    for (const Value& row : {Value{1, 2}, Value{2, 1}, Value{3, 4}, Value{4, 120}, Value{5, -999}, Value{40, 2019}, Value{41, 1},
                             Value{42, 1}, Value{43, 1}, Value{44, 0}, Value{45, 0}, Value{50, 1}, Value{54, 45}, Value{100, -999}}) {
        CAPTURE(row.number);
        CHECK(integer_of(lines, row.number) == row.value);
    }
    // second; step in ms, length, peak and its time
    for (const Value& row : {Value{1, -999}, Value{30, 0.25}, Value{62, 5}, Value{63, 0.02}, Value{64, -50}, Value{65, 0.005}}) {
        CAPTURE(row.number);
        CHECK(real_of(lines, row.number) == row.value);
    }

    CHECK(lines.at(48) == "       4 acceleration pts, approx    0 secs, units=cm/sec2(04),Format=(3E25.16)");
    CHECK(lines.at(49).size() == 75);
    CHECK(std::stod(lines.at(49).substr(0, 25)) == 1.0 / 3.0 * 100.0);
    CHECK(std::stod(lines.at(49).substr(25, 25)) == -50.0);
    CHECK(std::stod(lines.at(50)) == 12.5);
    CHECK(lines.at(51) == "End-of-data for Chan   1 acceleration");

    CHECK(lines.at(52) == "Corrected displacement    (Format v01.20 with 13 text lines)");
    CHECK(lines.at(52 + 8) == "Sta Chan   2: Up (Rcrdr Chan   2)");
    CHECK(header_value(lines, 52 + kIntegers, 10, 8, 54) == "     400");
    CHECK(lines.at(52 + 47) == "       1 displacement pts, approx    0 secs, units=cm(06),Format=(3E25.16)");
    CHECK(lines.size() == 52 + 50);
}

TEST_CASE("an uncorrected motion is written as V1, and unknown times stay unknown") {
    const tests::TemporaryFolder folder;
    GroundMotion motion = make_motion();
    motion.integration_corner = 0.05 * scaling::si::hertz;
    motion.time_zero.reset();
    write_cosmos(folder.path() / "a", motion);
    const std::vector<std::string> lines = lines_of(folder.path() / "a");

    CHECK(lines.at(0) == "Uncorrected acceleration  (Format v01.20 with 13 text lines)");
    CHECK(integer_of(lines, 1) == 1);
    CHECK(integer_of(lines, 40) == -999);
    CHECK(real_of(lines, 30) == -999);
    CHECK(lines.at(7) == "Rcrd start time: unknown");
}

TEST_CASE("header values that do not fit their columns are unknown, and a time step that does not is refused") {
    const tests::TemporaryFolder folder;
    GroundMotion motion{.format = "test"};
    motion.components.push_back({"1", {}, {SampleQuantity::acceleration, 0.0 * seconds, 0.01 * seconds, {1e-9}}});
    write_cosmos(folder.path() / "a", motion);
    CHECK(real_of(lines_of(folder.path() / "a"), 64) == -999);

    motion.components.front().series = {SampleQuantity::acceleration, 0.0 * seconds, 0.01 / 3.0 * seconds,
                                        std::vector<double>(1000000, 1.0)};
    CHECK(tests::message_of<WriteError>([&] {
              write_cosmos(folder.path() / "b", motion);
          }).find("cannot be held (COSMOS counts whole nanoseconds)") != std::string::npos);
    CHECK_THROWS_AS(write_cosmos(folder.path() / "b", GroundMotion{}), WriteError);
    CHECK(folder.count() == 1);
}

TEST_CASE("titles and columns of the headers are those of a network's file") {
    if (!tests::have_shared_records()) return;
    const tests::TemporaryFolder folder;
    write_cosmos(folder.path() / "a", make_motion());
    const std::vector<std::string> ours = lines_of(folder.path() / "a");
    const std::vector<std::string> theirs = lines_of(tests::shared_records() / "cosmos/us1000hyfh_akbmrp_AKBMR--n.1000hyfh.BNZ.--.acc.V2c");

    CHECK(ours.at(0) == theirs.at(0));
    CHECK(ours.at(kIntegers) == theirs.at(kIntegers));
    CHECK(ours.at(kReals) == theirs.at(kReals));
    CHECK(ours.at(kComments).substr(5) == theirs.at(kComments).substr(5));
    // theirs: V2 acceleration in cm/s² of 2018-11-30 17:29:39.137490, 5 ms, 210 s, peak -6.851512 cm/s² at 76.215 s
    for (const std::size_t number : {1U, 2U, 3U, 4U}) CHECK(integer_of(ours, number) == integer_of(theirs, number));
    CHECK(integer_of(theirs, 40) == 2018);
    CHECK(integer_of(theirs, 45) == 29);
    CHECK(real_of(theirs, 30) == 39.137490);
    CHECK(real_of(theirs, 62) == 5.0);
    CHECK(real_of(theirs, 64) == -6.851512);
    CHECK(real_of(theirs, 65) == 76.215);
}

}  // namespace
}  // namespace musim::records
