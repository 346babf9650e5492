#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>

#include "records/formats/read_record.hpp"
#include "tests/records/published_extremes.hpp"
#include "tests/records/published_peaks.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;

TEST_CASE("every real record has the extremes that its header prints, to the printed digit") {
    if (!tests::have_shared_records()) return;
    for (const tests::PublishedExtreme& row : tests::kPublishedExtremes) {
        CAPTURE(row.file);
        CAPTURE(row.component);
        CAPTURE(row.value);
        const GroundMotion motion = read_record(tests::shared_records() / row.file, {.quantity = row.quantity});
        REQUIRE(motion.components.size() > row.component);
        const TimeSeries& series = motion.components[row.component].series;
        REQUIRE(series.quantity() == row.quantity);
        const double si = find_sample_unit(row.unit)->si;

        const auto first = series.samples().begin(), last = series.samples().end();
        const auto extreme = row.value > 0.0 ? std::max_element(first, last) : std::min_element(first, last);
        // half a unit of the last digit, and the rounding of those that lie half-way
        const double tolerance = 0.5 * std::pow(10.0, -row.decimals) + 1e-9 * std::abs(row.value);
        CAPTURE(*extreme / si);
        CHECK(std::abs(*extreme / si - row.value) <= tolerance);
        if (row.time >= 0.0) {
            CHECK(static_cast<double>(extreme - first) * series.dt().value() == relative(row.time, 1e-9));
        }
    }
}

TEST_CASE("every shared record is in a table of published numbers or has a test of its own") {
    if (!tests::have_shared_records()) return;
    // counts about their mean (K-NET), uneven pairs, SAC and miniSEED need what a table cannot say; spectra are
    // test_reference_spectra.cpp's
    std::set<std::string, std::less<>> tested = {"csmip/BadHeader.V2",
                                                 "csmip/CE89146.V3",
                                                 "csmip/ce23583r_HESPERIA.RAW",
                                                 "csmip/NEWPORT.RAW",
                                                 "cosmos/Cosmos12TimeSeriesTest2.v1",
                                                 "cosmos/NP1795-n.305.v0c",
                                                 "smc/np01002r_4225a_u.smc",
                                                 "bhrc/5526-1.V1",
                                                 "renadic/vallenar1002271.v1",
                                                 "usc/017m30cc.y0a"};
    const std::set<std::string_view> tested_folders = {"knet", "kiknet", "sac", "mseed", "reference"};
    for (const tests::PublishedPeak& row : tests::kPublishedPeaks) tested.emplace(row.file);
    for (const tests::PublishedExtreme& row : tests::kPublishedExtremes) tested.emplace(row.file);

    for (const auto& entry : std::filesystem::recursive_directory_iterator(tests::shared_records())) {
        if (!entry.is_regular_file()) continue;
        const std::filesystem::path file = entry.path().lexically_relative(tests::shared_records());
        CAPTURE(file.string());
        const bool is_described = file == "README.md" || tested_folders.contains(file.begin()->string()) || tested.contains(file.string());
        CHECK(is_described);
    }
}

}  // namespace
}  // namespace musim::records
