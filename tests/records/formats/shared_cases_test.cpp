#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "records/formats/read_record.hpp"
#include "records/measures/intensity.hpp"
#include "tests/records/refusal.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;

std::filesystem::path shared_cases() { return tests::shared_records() / ".." / "cases" / "records"; }

bool have_shared_cases() {
    if (std::filesystem::is_directory(shared_cases())) return true;
    MESSAGE("skipped: there are no cases in ../shared/cases/records");
    return false;
}

TEST_CASE("files of one pulse give its peak, length and step, whatever their format") {
    if (!have_shared_cases()) return;
    struct Case {
        std::string_view file;
        ReadOptions options;
        std::size_t size;
        double digits;  ///< what the samples are printed to, relative to the peak
    };
    const scaling::Time step = 0.005 * scaling::si::seconds;
    const ReadOptions none, counts{.sensitivity = 1.0}, untimed{.dt = step}, si{.unit = "m/s^2"};
    ReadOptions removed = counts;
    removed.quantity = SampleQuantity::acceleration;
    for (const Case& row : {Case{"deepsoil.txt", none, 2000, 1e-7}, Case{"shake_8f9.txt", untimed, 2000, 2e-6},
                            Case{"csmnc_china.dat", none, 2000, 1e-6}, Case{"miniseed3.mseed3", counts, 2000, 1e-12},
                            Case{"hhe_acceleration_float.mseed", removed, 4000, 1e-6}, Case{"sac_leven_minus1.sac", si, 2000, 1e-6}}) {
        CAPTURE(row.file);
        const GroundMotion motion = read_record(shared_cases() / row.file, row.options);
        REQUIRE(motion.components.size() == 1);
        const TimeSeries& series = motion.components.front().series;
        CHECK(series.quantity() == SampleQuantity::acceleration);
        CHECK(series.dt() == step);
        CHECK(series.size() == row.size);
        // the largest sample of 3 sin(2 pi 1.5 t) exp(-((t-5)/1.5)^2) m/s^2
        double largest = 0.0;
        for (std::size_t i = 0; i < 2000; ++i) {
            const double t = 0.005 * static_cast<double>(i);
            largest = std::max(largest, std::abs(3.0 * std::sin(2.0 * M_PI * 1.5 * t) * std::exp(-std::pow((t - 5.0) / 1.5, 2.0))));
        }
        CHECK(find_largest(series.samples()) == relative(largest, row.digits));
    }
}

TEST_CASE("a strong GeoNet record is read whose samples are printed to whole millimetres") {
    if (!have_shared_cases()) return;
    const auto peaks = [](SampleQuantity quantity, std::initializer_list<double> expected) {
        const GroundMotion motion = read_record(shared_cases() / "geonet_wtmc.V2A", {.quantity = quantity});
        REQUIRE(motion.components.size() == expected.size());
        auto component = motion.components.begin();
        for (const double peak : expected) CHECK(1e3 * find_largest((component++)->series.samples()) == relative(peak, 1e-12));
    };
    peaks(SampleQuantity::acceleration, {9733.1, 7966.4, 18021.9});
    peaks(SampleQuantity::velocity, {1017.0, 686.0, 395.0});
}

TEST_CASE("an ASA record of CICESE has the peaks, names and clock of its header") {
    if (!have_shared_cases()) return;
    const GroundMotion motion = read_record(shared_cases() / "cicese_asa2.dat");
    CHECK(motion.component_names() == "N90E, N00E, V");
    CHECK(motion.time_zero == make_utc_time(2010, 4, 4, 22, 45, 22.147));
    auto component = motion.components.begin();
    for (const double peak : {72.8008, 64.4431, 59.2262}) {
        CHECK(component->series.size() == 17880);
        CHECK(component->series.dt().value() == 0.005);
        CHECK(1e2 * find_largest((component++)->series.samples()) == relative(peak, 1e-12));
    }
}

TEST_CASE("a StationXML file that gives an accelerometer's counts per length is refused") {
    if (!have_shared_cases()) return;
    const std::string message = tests::message_of<ReadError>(
        [] { read_record(shared_cases() / "UU.HRU.01.ENE.mseed", {.station_xml = shared_cases() / "UU.HRU.xml"}); });
    CHECK(message.find("UU.HRU.01.ENE is an accelerometer by its code N (UU.HRU.xml gives counts per m)") != std::string::npos);
}

}  // namespace
}  // namespace musim::records
