#include <doctest/doctest.h>

#include <string>

#include "records/formats/read_record.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

using scaling::si::seconds;

TEST_CASE("an evenly increasing first column is time and the others are components") {
    const tests::TemporaryFolder folder;
    for (const std::string content : {"0.01 1 -1\n0.02 2 -2\n0.03 3 -3\n", "# title\n0.01,1,-1\n\n0.02,2,-2\n0.03,3,-3,\n",
                                      "% a\n// b\n0.01;1;-1\n0.02; 2; -2\n0.03;3;-3\n", "0.01\t1\t-1\r\n0.02\t2\t-2\r\n0.03\t3\t-3"}) {
        CAPTURE(content);
        const GroundMotion motion = read_record(folder.write("a.txt", content));

        CHECK(motion.format == "text");
        CHECK(motion.component_names() == "1, 2");
        const TimeSeries& series = motion.find_component("2").series;
        CHECK(series.quantity() == SampleQuantity::acceleration);
        CHECK(series.start().value() == 0.01);
        CHECK(series.dt().value() == 0.01);
        REQUIRE(series.size() == 3);
        CHECK(series.samples()[2] == -3.0);
    }
}

TEST_CASE("without a time column the time step must be given, and the message says how") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("a.txt", "1\n2\n3\n");

    const std::string message = tests::message_of<ReadError>([&] { read_record(path); });
    CHECK(message.find("give the time step") != std::string::npos);

    const TimeSeries series = read_record(path, {.dt = 0.5 * seconds}).components.front().series;
    CHECK(series.dt().value() == 0.5);
    CHECK(series.start().value() == 0.0);
    CHECK(series.size() == 3);
    CHECK_THROWS_AS(read_record(path, {.dt = 0.0 * seconds}), ReadError);
    CHECK_THROWS_AS(read_record(path, {.dt = -1.0 * seconds}), ReadError);
}

TEST_CASE("two untimed columns are components, five are one component written five values a line") {
    const tests::TemporaryFolder folder;
    const ReadOptions options{.dt = 0.5 * seconds};

    CHECK(read_record(folder.write("a", "1 -1\n0 4\n"), options).component_names() == "1, 2");

    const GroundMotion lines = read_record(folder.write("b", "1 2 3 4 5\n-6 7 8\n"), options);
    REQUIRE(lines.components.size() == 1);
    CHECK(lines.components.front().series.size() == 8);
    CHECK(lines.components.front().series.samples()[5] == -6.0);
}

TEST_CASE("a counts row gives the time step and is checked against the values") {
    const tests::TemporaryFolder folder;

    const TimeSeries series = read_record(folder.write("a", "name\n3 0.01\n1\n2\n3\n")).components.front().series;
    CHECK(series.dt().value() == 0.01);
    CHECK(series.size() == 3);

    const std::string message = tests::message_of<ReadError>([&] { read_record(folder.write("a", "name\n4 0.01\n1\n2\n3\n")); });
    CHECK(message.find("a:2: 4 points announced (3 follow)") != std::string::npos);
}

TEST_CASE("unit and quantity come from the options, then from the title, then are SI accelerations") {
    const tests::TemporaryFolder folder;
    const auto plain = folder.write("a", "0 1\n0.1 2\n");
    const auto titled = folder.write("b", "# time(sec) N-S(cm/s/s)\n0 1\n1 2\n");
    const auto first = [](const GroundMotion& motion) { return motion.components.front().series.samples().front(); };

    CHECK(first(read_record(plain)) == 1.0);
    CHECK(first(read_record(plain, {.unit = "g"})) == 9.80665);
    CHECK(first(read_record(titled)) == 0.01);
    CHECK(first(read_record(titled, {.unit = "g"})) == 9.80665);
    CHECK(read_record(plain, {.unit = "cm/s"}).components.front().series.quantity() == SampleQuantity::velocity);
    CHECK(read_record(plain, {.quantity = SampleQuantity::displacement}).components.front().series.quantity() ==
          SampleQuantity::displacement);
    CHECK_THROWS_AS(read_record(plain, {.unit = "furlong"}), ReadError);
    CHECK_THROWS_AS(read_record(plain, {.unit = "g", .quantity = SampleQuantity::velocity}), ReadError);
}

TEST_CASE("every defect of a text file is reported with its line") {
    struct Case {
        std::string content;
        std::string said;
    };
    const tests::TemporaryFolder folder;
    for (const Case& row : {
             Case{"0 1\n1 nan\n2 3\n", "a:2: sample 2 is 'nan'"},
             Case{"0 1\n1 2\n2 oops\n", "a:3: sample 3 is 'oops'"},
             Case{"0 1\n1 2\n2.3 3\n3 4\n", "a:3: time is 2.3 s (even sampling gives 2 s)"},
             Case{"0 1\n1 2\n2\n", "a:3: 1 values (the rows above have 2)"},
             Case{"0 1\n1 2 3\n2 3\n", "a:2: 3 values (the rows above have 2)"},
             Case{"0,1,3\n1,,2\n2,1,4\n", "a:2: empty value between separators"},
             Case{"0,01;1.5\n0,02;2.5\n", "a:1: both ',' and '.' in numbers"},
             Case{"1,001;1,502\n1,002;2,512\n", "a:1: every ',' in a number has three digits behind it"},
             Case{"0,01 1,5\n0,02 2,5\n", "a:1: both blanks and ',' between numbers"},
             Case{"1,5\n-2,5\n", "a:1: one ',' within every row, no '.' and no sign behind it"},
             Case{"once upon a time\nthere was a record\n", "a:2: unknown format"},
             Case{"# nothing\n", "a: unknown format (no row of numbers)"},
             Case{std::string("\0\1\2\3binary", 10), "a: unknown format (binary data)"},
             Case{"", "a: file is empty"},
         }) {
        const auto path = folder.write("a", row.content);
        const std::string message = tests::message_of<ReadError>([&] { read_record(path); });
        CAPTURE(row.said);
        CAPTURE(message);
        CHECK(message.find(row.said) != std::string::npos);
        CHECK(message.find('\n') == std::string::npos);
    }
}

TEST_CASE("what is no readable file is refused") {
    const tests::TemporaryFolder folder;

    CHECK(tests::message_of<ReadError>([&] { read_record(folder.path() / "none"); }).find("no such file") != std::string::npos);
    CHECK(tests::message_of<ReadError>([&] { read_record(folder.path()); }).find("is a folder") != std::string::npos);
    CHECK(tests::message_of<ReadError>([&] { read_record("/dev/zero"); }).find("not a regular file") != std::string::npos);
    if (::geteuid() != 0) {  // root reads everything
        const auto locked = folder.write("locked", "1\n");
        std::filesystem::permissions(locked, std::filesystem::perms::none);
        CHECK(tests::message_of<ReadError>([&] { read_record(locked); }).find("cannot be opened") != std::string::npos);
    }
}

TEST_CASE("times printed with few digits still give the meant time step") {
    const tests::TemporaryFolder folder;
    std::string content;
    for (int i = 1; i <= 1991; ++i) content += std::to_string(0.01 * i) + ",1\n";

    const TimeSeries series = read_record(folder.write("a", content)).components.front().series;

    CHECK(series.dt().value() == 0.01);
    CHECK(series.start().value() == 0.01);
}

}  // namespace
}  // namespace musim::records
