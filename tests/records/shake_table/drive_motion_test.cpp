#include <doctest/doctest.h>

#include <cmath>
#include <sstream>

#include "records/formats/read_record.hpp"
#include "records/shake_table/drive_motion.hpp"
#include "records/shake_table/write_drive_file.hpp"
#include "records/synthesis/synthetic.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
namespace si = scaling::si;
using musim::tests::bytes_of;
using musim::tests::TemporaryFolder;

double largest(const TimeSeries& series) {
    double peak = 0.0;
    for (const double sample : series.samples()) peak = std::max(peak, std::abs(sample));
    return peak;
}

GroundMotion make_ten_seconds() { return make_synthetic_record({.duration = 10.0 * si::seconds}); }

AxisMotion make_axis(const std::string& name, scaling::Time dt = 0.25 * si::seconds) {
    const TimeSeries acceleration(SampleQuantity::acceleration, 0.0 * si::seconds, dt, {0.0, 0.8, -1.6, 0.8, 0.0});
    return {name, add_rest(integrate_twice(acceleration), 0.25 * si::seconds)};
}

ControllerFormat make_format() {
    ControllerFormat format{.rate = 4.0 / si::seconds};
    format.displacement = *find_sample_unit("mm");
    format.velocity = *find_sample_unit("cm/s");
    format.acceleration = *find_sample_unit("m/s^2");
    format.digits = 4;
    return format;
}

}  // namespace

TEST_CASE("a table's motion starts and ends at rest, its parts are integrals of each other") {
    DriveSettings settings;
    settings.dt = 0.003 * si::seconds;
    settings.high_pass = 0.3 / si::seconds;
    settings.low_pass = 20.0 / si::seconds;
    settings.amplitude = 0.5;
    const DriveMotion bare = make_drive_motions(make_ten_seconds(), settings).front();
    CHECK(bare.acceleration.dt() == *settings.dt);
    CHECK(bare.velocity == integrate(bare.acceleration));
    CHECK(bare.displacement == integrate(bare.velocity));
    // the polynomial that brings to rest does so to the rounding of its sums
    CHECK(std::abs(bare.velocity.samples().back()) < 1e-12 * largest(bare.velocity));
    CHECK(std::abs(bare.displacement.samples().back()) < 1e-12 * largest(bare.displacement));
    // filters leave a little of the taper's zero
    CHECK(std::abs(bare.acceleration.samples().back()) < 1e-3 * largest(bare.acceleration));

    const DriveMotion resting = add_rest(bare, 0.3 * si::seconds);
    CHECK(resting.displacement.size() == bare.displacement.size() + 200);
    for (const TimeSeries* series : {&resting.acceleration, &resting.velocity, &resting.displacement}) {
        for (std::size_t i = 0; i < 100; ++i) {
            CHECK(series->samples()[i] == 0.0);
            CHECK(series->samples()[series->size() - 1 - i] == 0.0);
        }
    }
    CHECK_THROWS_AS(integrate_twice(bare.velocity), ProcessingError);
}

TEST_CASE("a table makes the motion of a base") {
    GroundMotion record = make_ten_seconds();
    GroundMotion uncorrected = record;
    uncorrected.integration_corner = 0.1 / si::seconds;
    for (const GroundMotion& motion : {record, uncorrected}) {
        for (const AtRest at_rest : {AtRest::home, AtRest::displaced, AtRest::as_given}) {
            const TimeSeries table = make_drive_motions(motion, {.at_rest = at_rest}).front().velocity;
            const TimeSeries base = make_base_motion(motion, "1", {.at_rest = at_rest}).velocity;
            REQUIRE(table.size() == base.size());
            double difference = 0.0;
            for (std::size_t i = 0; i < base.size(); ++i)
                difference = std::max(difference, std::abs(table.samples()[i] - base.samples()[i]));
            CHECK(difference < 1e-12 * largest(base));
        }
    }
}

TEST_CASE("velocities and displacements are differentiated first, uncorrected records filtered at their corner") {
    const GroundMotion record = make_ten_seconds();
    const auto steps = [](const GroundMotion& motion) { return write_recipe(make_drive_recipe(motion)); };
    const auto has = [](const std::string& text, const std::string& step) { return text.find("\"" + step + "\"") != std::string::npos; };
    CHECK_FALSE(has(steps(record), "differentiate"));
    CHECK_FALSE(has(steps(record), "filter"));
    GroundMotion velocity = record;
    velocity.components[0].series = integrate(record.components[0].series);
    CHECK(has(steps(velocity), "differentiate"));
    CHECK(largest(make_drive_motions(velocity).front().velocity) == relative(largest(velocity.components[0].series), 0.02));
    GroundMotion uncorrected = record;
    uncorrected.integration_corner = 0.1 / si::seconds;
    CHECK(has(steps(uncorrected), "filter"));
    CHECK(has(steps(uncorrected), "baseline"));
    GroundMotion two = record;
    two.components.push_back(record.components[0]);
    CHECK(has(steps(two), "align"));
}

TEST_CASE("a drive file has the controller's columns, units and separators") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "drive.csv";
    ControllerFormat format = make_format();
    write_drive_file(path, {make_axis("x")}, format);
    // trapezoids of 0, 0.8, -1.6, 0.8, 0 m/s² at 0.25 s
    CHECK(bytes_of(path) ==
          "time [s],x displacement [mm],x velocity [cm/s],x acceleration [m/s^2]\n"
          "0,0,0,0\n0.25,0,0,0\n0.5,12.5,10,0.8\n0.75,25,0,-1.6\n1,12.5,-10,0.8\n1.25,0,0,0\n1.5,0,0,0\n");

    format.columns = {DriveColumn::time, DriveColumn::velocity};
    format.separator = '\t';
    format.header = false;
    write_drive_file(path, {make_axis("x"), make_axis("y")}, format);
    CHECK(bytes_of(path).starts_with("0\t0\t0\n0.25\t0\t0\n0.5\t10\t10\n"));
}

TEST_CASE("a drive file is a record again, of the quantity that is asked for") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "drive.csv";
    write_drive_file(path, {make_axis("x"), make_axis("y")}, make_format());
    const auto peak = [&](SampleQuantity quantity) {
        const GroundMotion motion = read_record(path, {.quantity = quantity});
        REQUIRE(motion.components.size() == 2);
        CHECK(motion.components[1].series.quantity() == quantity);
        CHECK(motion.components[1].series.dt().value() == 0.25);
        CHECK(motion.components[1].series.size() == 7);
        return largest(motion.components[1].series);
    };
    CHECK(peak(SampleQuantity::acceleration) == relative(1.6, 1e-12));
    CHECK(peak(SampleQuantity::velocity) == relative(0.1, 1e-12));
    CHECK(peak(SampleQuantity::displacement) == relative(0.025, 1e-12));
}

// x and y of accelerations, a rate about z, a drive file of six columns and more
TEST_CASE("a drive file of translations and rotations is read back") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "drive.csv";
    GroundMotion model = make_ten_seconds();
    const TimeSeries translation = model.components[0].series;
    for (const char* const name : {"ry", "rz"}) {
        std::vector<double> samples(translation.samples().begin(), translation.samples().end());
        model.components.push_back({name, {}, integrate(translation.with_samples(SampleQuantity::angular_acceleration, samples))});
    }
    CHECK(write_recipe(make_drive_recipe(model)).find("to_acceleration") != std::string::npos);
    const std::vector<DriveMotion> motions = make_drive_motions(model);
    REQUIRE(motions.size() == 3);
    CHECK(motions[1].displacement.quantity() == SampleQuantity::angle);
    std::vector<AxisMotion> axes;
    for (std::size_t c = 0; c < 3; ++c) axes.push_back({c == 0 ? "x" : c == 1 ? "pitch" : "yaw", add_rest(motions[c], 0.5 * si::seconds)});
    ControllerFormat format = make_format();
    format.rate = 1.0 / translation.dt();
    format.angle = *find_sample_unit("deg");
    format.angular_velocity = *find_sample_unit("deg/s");
    format.angular_acceleration = *find_sample_unit("rad/s^2");
    format.columns = {DriveColumn::displacement, DriveColumn::acceleration};
    format.digits = 17;
    write_drive_file(path, axes, format);
    CHECK(bytes_of(path).starts_with("x displacement [mm],x acceleration [m/s^2],pitch angle [deg],pitch angular acceleration [rad/s^2],"));

    for (const SampleQuantity quantity : {SampleQuantity::displacement, SampleQuantity::acceleration}) {
        const GroundMotion again = read_record(path, {.dt = translation.dt(), .quantity = quantity});
        REQUIRE(again.components.size() == 3);
        for (std::size_t c = 0; c < 3; ++c) {
            const DriveMotion& made = axes[c].motion;
            const TimeSeries& wanted = quantity == SampleQuantity::displacement ? made.displacement : made.acceleration;
            CHECK(again.components[c].series.quantity() == wanted.quantity());
            REQUIRE(again.components[c].series.size() == wanted.size());
            for (std::size_t i = 0; i < wanted.size(); ++i)
                CHECK(std::abs(again.components[c].series.samples()[i] - wanted.samples()[i]) <= 1e-12 * largest(wanted));
        }
    }
    const std::vector<ComponentChange> changes = compare_drive_motions(model);
    CHECK(std::holds_alternative<MotionChange>(changes[0]));
    CHECK(std::get<RotationChange>(changes[1]).base.rate.value() == largest(motions[1].velocity));
}

TEST_CASE("axes on different clocks make no drive file") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "drive.csv";
    CHECK_THROWS_WITH(write_drive_file(path, {}, make_format()), (path.string() + ": there is no motion to write; give one").c_str());
    CHECK_THROWS_WITH(write_drive_file(path, {make_axis("x"), make_axis("y", 0.5 * si::seconds)}, make_format()),
                      (path.string() + ": the axes have different clocks; align them first").c_str());
    CHECK_THROWS_WITH(write_drive_file(path, {make_axis("x", 0.5 * si::seconds)}, make_format()),
                      (path.string() + ": the motion has 2 samples a second, the controller 4; resample it").c_str());
    CHECK_FALSE(std::filesystem::exists(path));
}

}  // namespace musim::records
