#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "records/formats/read_record.hpp"
#include "tests/records/formats/text_file_shapes.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/shared_records.hpp"
#include "tests/support/temporary_folder.hpp"

/// Which columns of a text record are what, where titles do not say it, or the caller does.
namespace musim::records {
namespace {

using scaling::si::seconds;

using tests::check_shape;
using tests::kPulsePeak;
using tests::kPulseSamples;
using tests::kPulseStep;
using tests::pulse;
using tests::pulse_time;
using tests::read_shape;

/// Values side by side, `width` a line, each of its index.
std::string side_by_side(const std::string& header, std::size_t width, const std::string& separator,
                         const std::function<std::string(std::size_t)>& value) {
    return tests::lines(
        header,
        [&](std::size_t first) {
            std::string line;
            for (std::size_t i = first; i < std::min(first + width, kPulseSamples); ++i) line += (i > first ? separator : "") + value(i);
            return line;
        },
        width);
}

std::string pair_of(std::size_t i) { return fmt::format("{:.4f}, {:.8f}", pulse_time(i), pulse(i)); }

TEST_CASE("times and values side by side, several a line, are one component") {
    for (const std::size_t width : {std::size_t{3}, std::size_t{4}, std::size_t{5}, std::size_t{7}}) {
        for (const char* const header :
             {"", "*Amplitude, name=EQ, time=TOTAL TIME\n", "** quake\n*AMPLITUDE, NAME=A\n", "Time (s), Acc (m/s2)\n"}) {
            CAPTURE(width);
            CAPTURE(header);
            check_shape(read_shape(side_by_side(header, width, ", ", pair_of)), {kPulsePeak});
        }
    }
    check_shape(read_shape(side_by_side("TIME ACCEL TIME ACCEL\n", 2, " ",
                                        [](std::size_t i) { return fmt::format("{:.3f} {:.6f}", pulse_time(i), pulse(i)); })),
                {kPulsePeak});
    const auto triple = [](std::size_t i) { return fmt::format("{:.3f} {:.6f} {:.6f}", pulse_time(i), pulse(i), 0.5 * pulse(i)); };
    check_shape(read_shape(side_by_side("", 4, " ", triple)), {kPulsePeak, 0.5 * kPulsePeak});

    // a slip in one time is damage, not another layout
    tests::check_refused(tests::replaced(side_by_side("", 4, ", ", pair_of), "0.1000,", "0.1030,"),
                         "time is 0.103 s (even sampling gives 0.1 s)");
    tests::check_refused(side_by_side("", 3, ", ", pair_of) + "2.0000\n", "values (the rows above have 6)");
}

TEST_CASE("values side by side without times are one series or several components by what they hold") {
    const ReadOptions options{.dt = kPulseStep * seconds};
    const auto value = [](std::size_t i) { return fmt::format("{:.6f}", pulse(i)); };
    for (const std::size_t width : {std::size_t{4}, std::size_t{5}, std::size_t{8}}) {
        CAPTURE(width);
        const GroundMotion motion = read_shape(side_by_side("", width, " ", value), options);
        check_shape(motion, {kPulsePeak});
        CHECK(motion.history.front().ends_with("several values a line"));
        CHECK(motion.components.front().series.samples()[tests::kPulsePeakSample] == doctest::Approx(kPulsePeak).epsilon(1e-6));
    }
    const auto channels = [](const std::string& header, std::size_t count) {
        return tests::lines(header, [=](std::size_t i) {
            std::string line;
            for (std::size_t c = 1; c <= count; ++c)
                line += fmt::format("{}{:.6f}", c > 1 ? "," : "", pulse(i) / static_cast<double>(c * c));
            return line;
        });
    };
    for (const char* const header : {"AX (m/s2),AY (m/s2),AZ (m/s2),TBL (m/s2)\n", "CH1,CH2,CH3,CH4\n", ""}) {
        CAPTURE(header);
        check_shape(read_shape(channels(header, 4), options), {kPulsePeak, kPulsePeak / 4.0, kPulsePeak / 9.0, kPulsePeak / 16.0});
    }
    CHECK(read_shape(channels("AX (m/s2),AY (m/s2),AZ (m/s2),TBL (m/s2)\n", 4), options).component_names() == "AX, AY, AZ, TBL");

    // noise that is as unlike along lines as along columns
    const std::string noise = tests::lines("", [](std::size_t i) {
        const auto random = [&](std::size_t c) { return (7919 * (4 * i + c) * (4 * i + c + 3)) % 1009; };
        return fmt::format("{} {} {} {}", random(0), random(1), random(2), random(3));
    });
    tests::check_refused(noise, "4 values a line without titles or times", options);
    tests::check_refused(side_by_side("", 2, " ", value), "2 values a line without titles or times", options);
    check_shape(read_shape(side_by_side("", 2, " ", value), {.dt = kPulseStep * seconds, .columns = parse_column_choices("x=1-2")}),
                {kPulsePeak});
}

TEST_CASE("a column without title that is the integral of another is no component") {
    // velocity of the pulse [cm/s], from rest
    const auto velocity = [](std::size_t i) {
        return 100.0 * kPulsePeak / std::numbers::pi * (1.0 - std::cos(std::numbers::pi * pulse_time(i)));
    };
    const auto row = [&](std::size_t i) { return fmt::format("{:.3f} {:.6f} {:.6f}", pulse_time(i), pulse(i), velocity(i)); };
    tests::check_refused(tests::lines("", row), "column 3 is the integral of column 2");
    tests::check_refused(tests::lines("t,A,V\n", row), "column 3 'V' is the integral of column 2 'A'");
    check_shape(read_shape(tests::lines("", row), {.columns = parse_column_choices("time=1,x=2")}), {kPulsePeak});
    check_shape(read_shape(tests::lines("t a v\n", row)), {kPulsePeak});
}

TEST_CASE("a row of counts above several values a line gives the time step") {
    const auto value = [](std::size_t i) { return fmt::format("{:.6f}", pulse(i)); };
    check_shape(read_shape(side_by_side("Quake\n400 0.005\n", 8, " ", value)), {kPulsePeak});
}

TEST_CASE("columns and lines can be chosen") {
    const std::string content =
        "Station A\nby hand\n1 2 3\nSample,Time (s),Acc X (m/s2),Acc Z (m/s2)\n" +
        tests::lines("", [](std::size_t i) { return fmt::format("{},{:.3f},{:.6f},{:.6f}", i, pulse_time(i), pulse(i), 0.1 * pulse(i)); });
    const auto chosen = [&](const char* columns, std::optional<std::size_t> skip = {}) {
        return read_shape(content, {.columns = parse_column_choices(columns), .skipped_lines = skip});
    };
    CHECK(chosen("time=2,x=3", 4).component_names() == "x");
    check_shape(chosen("time=2,x=3", 4), {kPulsePeak});
    check_shape(chosen("time=2,x=4,y=3", 3), {0.1 * kPulsePeak, kPulsePeak});
    check_shape(chosen("time=Time (s),up=Acc Z,x=acc x (m/s2)", 3), {0.1 * kPulsePeak, kPulsePeak});
    const auto untimed = read_shape(content, {.dt = kPulseStep * seconds, .columns = parse_column_choices("x=3"), .skipped_lines = 4});
    check_shape(untimed, {kPulsePeak});

    tests::check_refused(content, "time step is unknown", {.columns = parse_column_choices("x=3"), .skipped_lines = 4});
    tests::check_refused(content, "a: no column '9' (the table has 4: Sample, Time (s)",
                         {.columns = parse_column_choices("x=9"), .skipped_lines = 3});
    tests::check_refused(content, "404 lines are to be skipped (the file has 404); correct the number of lines to skip",
                         {.skipped_lines = 404});
    tests::check_refused("000001D " + std::string(64, 'x'), "binary data have none", {.skipped_lines = 4});
    tests::check_refused("# musim ground motion 1\n# unit: g\n", "drop the columns", {.columns = parse_column_choices("x=2")});
    for (const std::pair<const char*, const char*>& row : {std::pair<const char*, const char*>{"time", "'time' is not NAME=COLUMN"},
                                                           {"x=", "'x=' is not"},
                                                           {"time=1", "no component"},
                                                           {"x=1,X=2", "'x' is named twice"},
                                                           {"", "'' is not"}}) {
        const std::string message = tests::message_of<ReadError>([&] { parse_column_choices(row.first); });
        CHECK_MESSAGE(message.find(row.second) != std::string::npos, message);
    }
    CHECK(to_string(parse_column_choices(" time = 2, x=Acc NS")) == "time=2,x=Acc NS");
}

TEST_CASE("decimal commas are read where other signs part the cells and no number has a point") {
    using tests::with_comma;
    for (const std::pair<std::string, std::string>& row : {std::pair<std::string, std::string>{";", "Zeit [s];Beschleunigung X [m/s²]\n"},
                                                           {"\t", "Zeit [s]\tBeschl. [m/s²]\n"},
                                                           {" ; ", ""}}) {
        CAPTURE(row.second);
        const std::string content =
            tests::lines(row.second, [part = row.first](std::size_t i) { return with_comma(pulse_time(i)) + part + with_comma(pulse(i)); });
        check_shape(read_shape(content), {kPulsePeak});
        CHECK_THROWS_AS(read_shape(content + "2,000" + row.first + "1.5\n"), ReadError);
    }
    const std::string quoted =
        tests::lines("", [](std::size_t i) { return '"' + with_comma(pulse_time(i)) + "\",\"" + with_comma(pulse(i)) + '"'; });
    check_shape(read_shape(quoted), {kPulsePeak});
    tests::check_refused(tests::table("Time (s),Acc (mm/s2)\n", {1.0}) + "2.000,\"1,017.8\"\n", "sample 401 is '1,017.8'");
}

TEST_CASE("UTF-16 is read by its byte-order mark") {
    const std::string text = tests::table("Time (s),Acc (cm/s\xC2\xB2)\n", {100.0});
    for (const bool is_little : {true, false}) {
        std::string bytes = is_little ? "\xFF\xFE" : "\xFE\xFF";
        for (std::size_t i = 0; i < text.size(); ++i) {
            unsigned letter = static_cast<unsigned char>(text[i]);
            if (letter == 0xC2) letter = static_cast<unsigned char>(text[++i]);
            const char low = static_cast<char>(letter & 0xFFU), high = static_cast<char>(letter >> 8U);
            bytes += is_little ? std::string{low, high} : std::string{high, low};
        }
        check_shape(read_shape(bytes), {kPulsePeak});
    }
    CHECK_THROWS_AS(read_shape("\xFF\xFE"), ReadError);
}

TEST_CASE("instants are times, and the clock of the record where they say their zone") {
    const auto second = [](std::size_t i) {
        return fmt::format("{:06.3f}", 58.147 + pulse_time(i) - (58.147 + pulse_time(i) >= 60.0 ? 60.0 : 0.0));
    };
    const auto minute = [](std::size_t i) { return 58.147 + pulse_time(i) >= 60.0 - 1e-9 ? "00" : "59"; };
    const auto hour = [](std::size_t i) { return 58.147 + pulse_time(i) >= 60.0 - 1e-9 ? "00" : "23"; };
    const auto day = [](std::size_t i) { return 58.147 + pulse_time(i) >= 60.0 - 1e-9 ? 3 : 2; };
    const auto clock = [&](std::size_t i) { return fmt::format("{}:{}:{}", hour(i), minute(i), second(i)); };

    const GroundMotion utc = read_shape(tests::lines(
        "time,ax (m/s2)\n", [&](std::size_t i) { return fmt::format("2024-04-{:02}T{}Z,{:.6f}", day(i), clock(i), pulse(i)); }));
    check_shape(utc, {kPulsePeak});
    REQUIRE(utc.time_zero.has_value());
    CHECK(to_string(*utc.time_zero) == "2024/04/02 23:59:58.147000");
    CHECK(utc.components.front().series.start().value() == 0.0);

    const GroundMotion ahead = read_shape(tests::lines(
        "time,ax (m/s2)\n", [&](std::size_t i) { return fmt::format("2024-04-{:02} {}+02:00,{:.6f}", day(i), clock(i), pulse(i)); }));
    REQUIRE(ahead.time_zero.has_value());
    CHECK(to_string(*ahead.time_zero) == "2024/04/02 21:59:58.147000");

    for (const std::string& content : {
             tests::lines("", [&](std::size_t i) { return fmt::format("2024-04-{:02} {} {:.6f}", day(i), clock(i), pulse(i)); }),
             tests::lines("Datum;Uhrzeit;a (m/s2)\n",
                          [&](std::size_t i) {
                              std::string text = clock(i);
                              text[text.find('.')] = ',';
                              return fmt::format("{:02}.04.2024;{};{}", day(i), text, tests::with_comma(pulse(i)));
                          }),
             tests::lines("clock\ta (m/s2)\n", [&](std::size_t i) { return clock(i) + fmt::format("\t{:.6f}", pulse(i)); }),
             tests::lines("Timestamp,a_mps2\n",
                          [](std::size_t i) { return fmt::format("4/2/2024 10:45:{:06.3f} PM,{:.6f}", 22.0 + pulse_time(i), pulse(i)); }),
         }) {
        const GroundMotion motion = read_shape(content);
        check_shape(motion, {kPulsePeak});
        CHECK_FALSE(motion.time_zero.has_value());
    }
    // milliseconds since 1970
    const GroundMotion epoch = read_shape(tests::lines(
        "timestamp_ms,ax (m/s2)\n", [](std::size_t i) { return fmt::format("{},{:.6f}", 1712097922147U + 5U * i, pulse(i)); }));
    check_shape(epoch, {kPulsePeak});
    REQUIRE(epoch.time_zero.has_value());
    CHECK(to_string(*epoch.time_zero) == "2024/04/02 22:45:22.147000");
}

TEST_CASE("times rounded as printed give a whole number of samples a second") {
    constexpr double kRate = 128.0;  // Hz; times are printed to a millisecond, 1/8 of a step
    const GroundMotion motion = read_shape(tests::lines(
        "time(s) acc(m/s2)\n", [](std::size_t i) { return fmt::format("{:.3f} {:.6f}", static_cast<double>(i) / kRate, pulse(i)); }));
    CHECK(motion.components.front().series.dt().value() == 1.0 / kRate);
}

TEST_CASE("exports of programs are read with their titles, units and times") {
    const auto row = [](const char* pattern, double unit) {
        return [=](std::size_t i) { return fmt::format(fmt::runtime(pattern), pulse_time(i), pulse(i) / unit, i); };
    };
    const std::vector<std::pair<std::string, std::function<std::string(std::size_t)>>> files{
        {"LabVIEW "
         "Measurement\nWriter_Version\t2\nSeparator\tTab\nDate\t2024/04/02\nTime\t22:45:22.147\n***End_of_Header***\n\nChannels\t1\n"
         "Samples\t400\nDate\t2024/04/02\nTime\t22:45:22.147\nY_Unit_Label\tg\nX_Dimension\tTime\nX0\t0.0E+0\nDelta_X\t0.005\n"
         "***End_of_Header***\nX_Value\tAcc\tComment\n",
         row("{:.6f}\t{:.8f}", tests::kPulseGravity)},
        {"\"TOA5\",\"CR6\",\"CR6\",\"1234\",\"CR6.Std.12\",\"CPU:acc.CR6\",\"5542\",\"Acc\"\n\"TIMESTAMP\",\"RECORD\",\"AccX\",\"PTemp_"
         "C\"\n"
         "\"TS\",\"RN\",\"g\",\"Deg C\"\n\"\",\"\",\"Smp\",\"Avg\"\n",
         [](std::size_t i) {
             return fmt::format("\"2024-04-02 22:45:{:06.3f}\",{},{:.8f},21.3", 22.0 + pulse_time(i), i, pulse(i) / tests::kPulseGravity);
         }},
        {"Vernier Format 2\nUntitled.txt 4/2/2024 22:45:22\nRun 1\nTime\tAcceleration\nt\ta\ns\tm/s²\n\n", row("{:.4f}\t{:.6f}", 1.0)},
        {"\"Time (s) Run #1\",\"Acceleration (m/s²) Run #1\"\n", row("{:.3f},{:.6f}", 1.0)},
        {"\"ID No.\",\"1\"\n\"Date\",\"2024/04/02\"\n\"Sampling frequency(Hz)\",200\n\"Unit\",\"gal\"\n\"Time(sec)\",\"ACC-X\"\n",
         row("{:.3f},{:.6f}", 0.01)},
        {"HBM_CATMAN_DATAFILE_40\nSample rate: 200 Hz\n\nTime  1 - default sample rate [s]\tMX840 CH 1 [g]\n",
         row("{:.4f}\t{:.8f}", tests::kPulseGravity)},
        {"# quake\n# t [s]  ax [cm/s^2]\n", row("{:.4f} {:.6f}", 0.01)},
        {"Record: X\nStation: Y\nTime (s), HNN (cm/s/s)\n", row("{:.3f}, {:.6f}", 0.01)},
        {"Time   N-S\n(sec)  (cm/s2)\n", row("{:.3f}  {:.6f}", 0.01)},
        {"$ Function file\n$ time  acceleration (g)\n", row("{:10.4f} {:12.8f}", tests::kPulseGravity)},
        {"# NPTS: 400, DT: 0.005 SEC\n# Units: g\n", row("{:.3f} {:.8f}", tests::kPulseGravity)},
        {"ACCELERATION TIME HISTORY IN UNITS OF %G\n", row("{:.3f} {:.8f}", 0.01 * tests::kPulseGravity)},
        {"# Time (ms), NS (g)\n", [](std::size_t i) { return fmt::format("{} {:.8f}", 5 * i, pulse(i) / tests::kPulseGravity); }},
        {"Time (s),Acc (g),,\n", row("{:.3f},{:.8f},,", tests::kPulseGravity)},
        {"", [](std::size_t i) { return fmt::format("{:.4f}D+00 {:.8f}D+00", pulse_time(i), pulse(i)); }},
    };
    for (const auto& file : files) {
        CAPTURE(file.first);
        check_shape(read_shape(tests::lines(file.first, file.second)), {kPulsePeak});
    }
    // three components under the titles of a broadband simulation, times in milliseconds
    const std::string milliseconds = tests::lines("# Time (ms), NS (g), EW (g), UD (g)\n", [](std::size_t i) {
        const double g = pulse(i) / tests::kPulseGravity;
        return fmt::format("{} {:.8f} {:.8f} {:.8f}", 5 * i, g, 0.5 * g, 0.2 * g);
    });
    check_shape(read_shape(milliseconds), {kPulsePeak, 0.5 * kPulsePeak, 0.2 * kPulsePeak});
}

TEST_CASE("a text file that may be two records, or lacks values, is refused with its line") {
    const std::string good = tests::table("Time (s),Acc (g)\n", {1.0});
    tests::check_refused(good + good, "a:402: sample 401 is 'Time (s)'");
    tests::check_refused(good + good.substr(good.find('\n') + 1), "a:402: time is 0 s (even sampling gives 2 s)");
    tests::check_refused(tests::replaced(good, "0.100,", "0.100,NaN,"), "values (the rows above have 2)");
    tests::check_refused(tests::replaced(good, "\n0.100,", "\n0.100,x"), "a:22: sample 21 is 'x");
    tests::check_refused(good + ",\n2.000,1\n", "a:402: row without a value");
    tests::check_refused("LabVIEW Measurement\nSome\nText\n1 2\n2 3\n", "a:2: unknown format ('Some' is no row of numbers)");
    tests::check_refused(tests::lines("Time (s),AccX (g),Time (s),AccY (g)\n",
                                      [](std::size_t i) {
                                          return fmt::format("{:.3f},{:.6f},{:.3f},{:.6f}", pulse_time(i), pulse(i), pulse_time(i) + 0.1,
                                                             pulse(i));
                                      }),
                         "columns 1 and 3 are both times, and differ");
    tests::check_refused("0.00x 1\n0.01 2\n0.02 3\n", "a:1: sample 1 is '0.00x'");
    tests::check_refused("0.00 x\n0.01 2\n0.02 3\n", "a:1: sample 1 is 'x'");
}

TEST_CASE("the cases that were read wrongly are read rightly") {
    const std::filesystem::path folder = tests::shared_records().parent_path() / "cases" / "records";
    if (!std::filesystem::exists(folder)) {
        MESSAGE("skipped: no folder of cases beside the checkout");
        return;
    }
    struct Case {
        const char* name;
        std::vector<double> peaks;  // g
        ReadOptions options = {};
    };
    const ReadOptions with_step{.dt = 0.005 * seconds};
    constexpr double kPeak = 0.30220;  // g
    for (const Case& row :
         {Case{"four_channels.csv", {kPeak, 0.4 * kPeak, 0.2 * kPeak, 0.5 * kPeak}, with_step}, Case{"abaqus_amplitude.inp", {kPeak}},
          Case{"pairs_on_a_line.txt", {kPeak}}, Case{"index_column.csv", {kPeak}, with_step}, Case{"time_in_ms.csv", {kPeak}},
          Case{"time_in_ms.csv", {kPeak}, with_step}, Case{"unit_mg.csv", {kPeak}}, Case{"comment_unit_first.txt", {kPeak}},
          Case{"acc_vel_disp.txt", {kPeak}}, Case{"acc_vel_disp.txt", {kPeak}, {.unit = "g"}}}) {
        CAPTURE(row.name);
        const GroundMotion motion = read_record(folder / row.name, row.options);
        REQUIRE(motion.components.size() == row.peaks.size());
        for (std::size_t i = 0; i < row.peaks.size(); ++i) {
            const TimeSeries& series = motion.components[i].series;
            CHECK(series.size() == 2000);
            CHECK(series.dt().value() == doctest::Approx(0.005).epsilon(1e-9));
            CHECK(find_largest(series.samples()) / tests::kPulseGravity == doctest::Approx(row.peaks[i]).epsilon(1e-4));
        }
    }
    CHECK(tests::message_of<ReadError>([&] { read_record(folder / "index_column.csv"); }).find("give the time step") != std::string::npos);
}

}  // namespace
}  // namespace musim::records
