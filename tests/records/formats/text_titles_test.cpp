#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "records/formats/read_record.hpp"
#include "scaling/angle.hpp"
#include "tests/records/formats/text_file_shapes.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

/// Titles, rows of units and comments say what the columns of a text record are.
namespace musim::records {
namespace {

using scaling::si::seconds;

using tests::check_shape;
using tests::kPulsePeak;
using tests::kPulseSamples;
using tests::kPulseStep;
using tests::read_shape;

bool history_says(const GroundMotion& motion, std::string_view text) {
    return std::any_of(motion.history.begin(), motion.history.end(),
                       [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

TEST_CASE("a unit in a title is understood as people write it") {
    const std::vector<std::pair<std::string, double>> units{
        {"g", tests::kPulseGravity},
        {"G's", tests::kPulseGravity},
        {"mg", 1e-3 * tests::kPulseGravity},
        {"milli-g", 1e-3 * tests::kPulseGravity},
        {"%g", 0.01 * tests::kPulseGravity},
        {"% g", 0.01 * tests::kPulseGravity},
        {"GAL", 0.01},
        {"mGal", 1e-5},
        {"cm/s²", 0.01},
        {"cm s-2", 0.01},
        {"cm·s⁻²", 0.01},
        {"cm/s/s", 0.01},
        {"m s^-2", 1.0},
        {"m/sec^2", 1.0},
        {"m/s**2", 1.0},
        {"m.s-2", 1.0},
        {"mm/s2", 1e-3},
        {"ft/s2", 0.3048},
        {"in/s2", 0.0254},
        {"in/sec/sec", 0.0254},
        {"cm/s\xB2", 0.01},
        {"cm/s^2", 0.01},
        {"micro-g", 1e-6 * tests::kPulseGravity},
        {"meters per second squared", 1.0},
    };
    for (const auto& row : units) {
        const std::string& unit = row.first;
        const double si = row.second;
        for (const char* const title : {"Acc ({})", "Acc [{}]", "acc, {}", "acc / {}"}) {
            CAPTURE(unit);
            CAPTURE(title);
            const std::string header = "Time (s);" + fmt::format(fmt::runtime(title), unit) + '\n';
            const GroundMotion motion = read_shape(tests::table(header, {1.0 / si}, ';'));
            check_shape(motion, {kPulsePeak});
            CHECK_FALSE(history_says(motion, kUnitNotGiven));
        }
    }
}

TEST_CASE("a unit ends a name without brackets") {
    const std::vector<std::pair<std::string, double>> titles{
        {"acc_g", tests::kPulseGravity},
        {"a_mps2", 1.0},
        {"acc_cm_s2", 0.01},
        {"acc_cms2", 0.01},
        {"Acc g", tests::kPulseGravity},
        {"ACC_G", tests::kPulseGravity},
        {"AccX_ms2", 1.0},
        {"accel_ft_s2", 0.3048},
        {"ax_mg", 1e-3 * tests::kPulseGravity},
        {"acc in gal", 0.01},
        {"NS_g", tests::kPulseGravity},
        {"Acceleration:cm/s2", 0.01},
        {"acc-g", tests::kPulseGravity},
        {"Acc.mg", 1e-3 * tests::kPulseGravity},
        {"Acc|g", tests::kPulseGravity},
        {"NS g", tests::kPulseGravity},
        {"accG", tests::kPulseGravity},
        {"ACCmg", 1e-3 * tests::kPulseGravity},
        {"acc%g", 0.01 * tests::kPulseGravity},
        {"Acccm/s2", 0.01},
        {"acc_cm_per_s2", 0.01},
        {"acc_cm_per_sec2", 0.01},
        {"acc_cm_s_s", 0.01},
        {"acc_cmss", 0.01},
        {"acc_cmpss", 0.01},
        {"acc_g_x", tests::kPulseGravity},
        {"a_g_", tests::kPulseGravity},
        {"cm/s^2 NS", 0.01},
        {"Acc\xEF\xBC\x88gal\xEF\xBC\x89", 0.01},
        {"g", tests::kPulseGravity},
        {"cm/s2", 0.01},
    };
    for (const auto& row : titles) {
        const std::string& title = row.first;
        const double si = row.second;
        CAPTURE(title);
        const GroundMotion motion = read_shape(tests::table("t_s," + title + "\n", {1.0 / si}));
        check_shape(motion, {kPulsePeak});
        CHECK_FALSE(history_says(motion, kUnitNotGiven));
    }
    for (const char* const title : {"acc_x", "acc_n", "channel m", "ch 1", "acc_V", "CH-A", "H1-V", "acc-s", "g_x"}) {
        CAPTURE(title);
        CHECK(history_says(read_shape(tests::table(std::string("t_s,") + title + "\n", {1.0})), kUnitNotGiven));
    }
}

TEST_CASE("velocities and displacements are known by their units and words") {
    const auto quantity = [](const std::string& header) {
        return read_shape(tests::table(header, {1.0})).components.front().series.quantity();
    };
    for (const char* const unit : {"cm/s", "m/s", "mm/s", "in/s", "ft/s", "kine", "ips", "cm s-1"}) {
        CAPTURE(unit);
        CHECK(quantity(fmt::format("Time (s),x ({})\n", unit)) == SampleQuantity::velocity);
    }
    for (const char* const unit : {"mm", "cm", "m", "in", "ft", "um", "µm", "inches"}) {
        CAPTURE(unit);
        CHECK(quantity(fmt::format("Time (s),x ({})\n", unit)) == SampleQuantity::displacement);
    }
    CHECK(quantity("Time,Velocity\n") == SampleQuantity::velocity);
    CHECK(quantity("t,d\n") == SampleQuantity::displacement);
}

TEST_CASE("a unit that stands in a title and is not understood is asked for") {
    tests::check_refused(tests::table("Time (s),Acc (furlong/h2)\n", {1.0}),
                         "a:1: column 2 'Acc (furlong/h2)' names the unit 'furlong/h2'");
    tests::check_refused(tests::table("Time (s),Acceleration (cm/s)\n", {1.0}), "names the unit 'cm/s'");
    tests::check_refused(tests::table("# Units: furlong\n", {1.0}), "a:1: unit 'furlong' is none that is known of a motion");
    tests::check_refused(tests::table("# Units: V\n", {1.0}), "a:1: unit 'V' is none");
    tests::check_refused(tests::table("# a (g)\n# b (cm/s2)\n", {1.0}), "title names two units, g and cm/s^2");
    tests::check_refused(tests::table("Time (s),NS (g),EW\n", {1.0, 0.5}), "column 3 'EW' names no unit (column 2 'NS (g)' is in g)");

    check_shape(read_shape(tests::table("Time (s),Acc (furlong/h2)\n", {1.0}), {.unit = "g"}), {kPulsePeak * tests::kPulseGravity});
    check_shape(read_shape(tests::table("Time (s),NS (g),EW\n", {1.0, 0.5}), {.unit = "g"}),
                {kPulsePeak * tests::kPulseGravity, 0.5 * kPulsePeak * tests::kPulseGravity});
}

TEST_CASE("voltages and counts are refused by name, other columns beside motions are left out and named") {
    for (const char* const unit : {"V", "mV", "volts"}) {
        tests::check_refused(tests::table(fmt::format("Time (s),Acc ({})\n", unit), {1.0}), "holds a voltage (no motion)");
        tests::check_refused(tests::table(fmt::format("Time (s),Acc ({})\n", unit), {1.0}), "holds a voltage (no motion)", {.unit = "g"});
    }
    tests::check_refused(tests::table("time,ch1_mV\n", {1.0}), "column 2 'ch1_mV' holds a voltage");
    tests::check_refused(tests::table("Time (s),Acc (counts)\n", {1.0}), "holds counts");
    tests::check_refused(tests::table("Time (s),Temp (°C)\n", {1.0}), "holds a temperature");

    const GroundMotion motion =
        read_shape(tests::table("Time (s),Acc X (m/s2),Temp (°C),LVDT (mV),gyro_x_dps,Battery\n", {1.0, 0.1, 0.2, 0.3, 0.4}));
    check_shape(motion, {kPulsePeak, 0.3 * kPulsePeak * scaling::kDegree});
    CHECK(motion.component_names() == "Acc X, gyro_x");
    CHECK(motion.components[1].series.quantity() == SampleQuantity::angular_velocity);
    CHECK(history_says(motion, "note: a: column 4 'LVDT (mV)' is left out (a voltage)"));
    CHECK(history_says(motion, "column 6 'Battery' is left out"));
}

TEST_CASE("accelerations stand alone beside velocities and displacements, or what is asked for does") {
    const std::string content =
        tests::table("Time [sec]\tAcceleration [g]\tVelocity [cm/sec]\tDisplacement [cm]\n", {1.0 / tests::kPulseGravity, 20.0, 3.0}, '\t');
    check_shape(read_shape(content), {kPulsePeak});
    check_shape(read_shape(content, {.unit = "g"}), {kPulsePeak});
    check_shape(read_shape(content, {.quantity = SampleQuantity::velocity}), {0.2 * kPulsePeak});
    check_shape(read_shape(content, {.unit = "cm"}), {0.03 * kPulsePeak});
    CHECK(history_says(read_shape(content), "column 3 'Velocity [cm/sec]' is left out (velocity)"));

    check_shape(read_shape(tests::table("t a v d\n", {1.0, 20.0, 3.0}, ' ')), {kPulsePeak});
    tests::check_refused(tests::table("t / s,v / (cm/s),u / cm\n", {1.0, 2.0}), "columns hold velocities and displacements");
    tests::check_refused(tests::table("Time (s),Acc (g)\n", {1.0}), "title names the unit g (asked for: cm/s)", {.unit = "cm/s"});
    const GroundMotion overruled = read_shape(tests::table("Time (s),Acc (g)\n", {1.0}), {.unit = "cm/s2"});
    check_shape(overruled, {0.01 * kPulsePeak});
    CHECK(history_says(overruled, "is read in cm/s^2 as asked for (its title names g)"));
}

TEST_CASE("the length of a vector beside its components is left out") {
    const std::string header =
        "\"Time (s)\",\"Linear Acceleration x (m/s^2)\",\"Linear Acceleration y (m/s^2)\",\"Absolute acceleration (m/s^2)\"\n";
    const std::string content = tests::lines(header, [](std::size_t i) {
        return fmt::format("{:.9E},{:.9E},{:.9E},{:.9E}", tests::pulse_time(i), tests::pulse(i), -0.5 * tests::pulse(i),
                           1.2 * std::abs(tests::pulse(i)));
    });
    const GroundMotion motion = read_shape(content);
    check_shape(motion, {kPulsePeak, 0.5 * kPulsePeak});
    CHECK(motion.component_names() == "Linear Acceleration x, Linear Acceleration y");
    CHECK(history_says(motion, "is left out (the length of a vector)"));
    CHECK(motion.find_component("2").name == "Linear Acceleration y");  // by its number, too
}

TEST_CASE("a comment or line of text states the unit, wherever it stands") {
    const std::vector<std::pair<std::string, double>> texts{
        {"# Units: (g)\n# station ABC\n", tests::kPulseGravity},
        {"# units g\n# station ABC\n", tests::kPulseGravity},
        {"% unit = cm/s^2\n", 0.01},
        {"# acceleration in g\n# x (rock)\n", tests::kPulseGravity},
        {"# (gal)\n", 0.01},
        {"! Units are cm/sec/sec\n", 0.01},
        {"# g\n", tests::kPulseGravity},
        {"# Data: mg\n", 1e-3 * tests::kPulseGravity},
        {"# Acc. unit: [mm/s2]\n", 1e-3},
        {"// Acceleration, cm/s2\n", 0.01},
        {"UNITS OF G\n", tests::kPulseGravity},
        {"# Einheit: g\n", tests::kPulseGravity},
        {"# Units: seconds, mg\n", 1e-3 * tests::kPulseGravity},
        {"Acceleration (cm/s2) vs. Time (s)\n", 0.01},
        {"# Units: cm/s2\n# PGA 0.3 (g)\n", 0.01},
        {"# PGA = 296 cm/s2\n# values in g\n", tests::kPulseGravity},
        {"# UNITS - CM/SEC/SEC\n", 0.01},
        {"# All accelerations in g, time in seconds\n", tests::kPulseGravity},
        {"# acceleration (cm/s2), time (s)\n", 0.01},
    };
    for (const auto& row : texts) {
        const std::string& text = row.first;
        const double si = row.second;
        CAPTURE(text);
        const GroundMotion motion = read_shape(tests::table(text, {1.0 / si}, ' '));
        check_shape(motion, {kPulsePeak});
        CHECK_FALSE(history_says(motion, kUnitNotGiven));
    }
}

TEST_CASE("a title gives the unit of times") {
    for (const std::pair<std::string, double>& row : {std::pair<std::string, double>{"Time (ms)", 1e3},
                                                      {"t_us", 1e6},
                                                      {"Time [µs]", 1e6},
                                                      {"Time (min)", 1.0 / 60.0},
                                                      {"time, msec", 1e3},
                                                      {"Elapsed [sec]", 1.0},
                                                      {"millis", 1e3}}) {
        CAPTURE(row.first);
        const std::string content = tests::lines(row.first + ";Acc (m/s2)\n", [factor = row.second](std::size_t i) {
            return fmt::format("{:.10g};{:.6f}", tests::pulse_time(i) * factor, tests::pulse(i));
        });
        check_shape(read_shape(content), {kPulsePeak});
        check_shape(read_shape(content, {.dt = kPulseStep * seconds}), {kPulsePeak});
        tests::check_refused(content, "file states its time step 0.005 s (asked for: 0.01 s)", {.dt = 0.01 * seconds});
    }
    // below it, too, and in the last column
    check_shape(
        read_shape(tests::lines("Time,Acceleration\nms,g\n",
                                [](std::size_t i) { return fmt::format("{},{:.8f}", 5 * i, tests::pulse(i) / tests::kPulseGravity); })),
        {kPulsePeak});
    check_shape(
        read_shape(tests::lines(
            "ax (g),Time (s)\n",
            [](std::size_t i) { return fmt::format("{:.8f},{:.3f}", tests::pulse(i) / tests::kPulseGravity, tests::pulse_time(i)); })),
        {kPulsePeak});
}

TEST_CASE("units times a number, and days or ticks, are asked for") {
    tests::check_refused(tests::table("Time (s),Acc (x 0.001 g)\n", {1.0}), "names the unit 'x 0.001 g'");
    tests::check_refused(tests::table("Time (days),Acc (g)\n", {1.0}), "column 1 'Time (days)' is in 'days'");
    tests::check_refused(tests::table("Time (ticks),Acc (g)\n", {1.0}), "column 1 'Time (ticks)' is in 'ticks'");
}

TEST_CASE("names of directions are no units") {
    const GroundMotion motion = read_shape(tests::table("Time,NS,EW,UD\n", {1.0, 0.5, 0.2}));
    check_shape(motion, {kPulsePeak, 0.5 * kPulsePeak, 0.2 * kPulsePeak});
    CHECK(motion.component_names() == "NS, EW, UD");
    const std::string alone = tests::lines("NS\n", [](std::size_t i) { return fmt::format("{:.6f}", tests::pulse(i)); });
    check_shape(read_shape(alone, {.dt = kPulseStep * seconds}), {kPulsePeak});
    check_shape(read_shape(tests::table("Time (s),Acc (N) [m/s2],Acc (V) [m/s2]\n", {1.0, 0.5})), {kPulsePeak, 0.5 * kPulsePeak});
    const std::string nanoseconds = tests::lines(
        "time_ns,ax_g\n", [](std::size_t i) { return fmt::format("{},{:.8f}", 5000000 * i, tests::pulse(i) / tests::kPulseGravity); });
    check_shape(read_shape(nanoseconds), {kPulsePeak});
}

TEST_CASE("a step that records do not have needs a unit of time or the step") {
    const auto with_step = [](const std::string& header, double step) {
        return tests::lines(header,
                            [=](std::size_t i) { return fmt::format("{:.10g},{:.6f}", step * static_cast<double>(i), tests::pulse(i)); });
    };
    for (const double step : {5.0, 5000.0, 5e-6, 0.2}) {
        CAPTURE(step);
        tests::check_refused(with_step("Time,Acc\n", step), "a row (no unit of time is named");
    }
    check_shape(read_shape(with_step("Time,Acc\n", 5.0), {.dt = kPulseStep * seconds}), {kPulsePeak});
    check_shape(read_shape(with_step("", 5000.0), {.dt = kPulseStep * seconds}), {kPulsePeak});
    tests::check_refused(with_step("Time,Acc\n", 5.0), "in no unit of time that is 0.004 s", {.dt = 0.004 * seconds});
    tests::check_refused(with_step("Time,Acc\n", kPulseStep), "file states its time step 0.005 s", {.dt = 0.004 * seconds});
    CHECK(read_shape(with_step("Time,Acc\n", 0.1)).components.front().series.dt().value() == 0.1);
    CHECK(read_shape(with_step("Time (s),Acc\n", 0.2)).components.front().series.dt().value() == 0.2);
}

TEST_CASE("whole numbers that rise by one are an index unless a title says that they are times") {
    for (const char* const header : {",acc (g)\n", "No.,a [g]\n", "Sample #,acc_g\n", "index,acc (g)\n", "N,acc (g)\n", "# Units: g\n"}) {
        for (const int first : {0, 1}) {
            CAPTURE(header);
            const std::string content = tests::lines(header, [=](std::size_t i) {
                return fmt::format("{},{:.8f}", i + static_cast<std::size_t>(first), tests::pulse(i) / tests::kPulseGravity);
            });
            tests::check_refused(content, "counts rows, and is no time");
            check_shape(read_shape(content, {.dt = kPulseStep * seconds}), {kPulsePeak});
        }
    }
    const std::string of_seconds =
        tests::lines("Time (s),acc (m/s2)\n", [](std::size_t i) { return fmt::format("{},{:.6f}", i, tests::pulse(i)); });
    CHECK(read_shape(of_seconds).components.front().series.dt().value() == 1.0);
    // an index beside times
    check_shape(read_shape(tests::lines(
                    "", [](std::size_t i) { return fmt::format("{} {:.3f} {:.6f}", i + 1, tests::pulse_time(i), tests::pulse(i)); })),
                {kPulsePeak});
}

TEST_CASE("text above the numbers states the time step") {
    for (const char* const header :
         {"# dt = 0.005 s\n", "# Sampling rate: 200 Hz\n", "# sample interval (ms): 5\n", "# fs=200\n", "Sampling frequency,200 Hz\n"}) {
        CAPTURE(header);
        const std::string content = tests::lines(header, [](std::size_t i) { return fmt::format("{:.6f}", tests::pulse(i)); });
        check_shape(read_shape(content), {kPulsePeak});
        tests::check_refused(content, "file states its time step 0.005 s", {.dt = 0.01 * seconds});
    }
    tests::check_refused(tests::lines("# dt = 5\n", [](std::size_t i) { return fmt::format("{:.6f}", tests::pulse(i)); }),
                         "time step is unknown");
}

}  // namespace
}  // namespace musim::records
