#include "lsdem/plot/plot.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace musim::lsdem;

namespace {

/// Two levels, two runs, `samples` zeros each.
StackedPlot make_flat_plot(std::size_t samples) {
    StackedPlot plot{
        .title = "Tower", .subtitle = "of blocks", .x_label = "t*", .y_label = "v*", .row_labels = {"level 1", "level 3"}, .runs = {}};
    for (const char* label : {"prototype", "1:25"}) {
        PlotCurves run{.label = label, .x = {}, .y = {std::vector<double>(samples, 0.0), std::vector<double>(samples, 0.0)}};
        for (std::size_t i = 0; i < samples; ++i) run.x.push_back(static_cast<double>(i));
        plot.runs.push_back(run);
    }
    return plot;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

/// Highest and lowest point [px] of the path `index` in the picture, following its relative moves.
struct Extent {
    double top = 0.0;
    double bottom = 0.0;
};
Extent path_extent(const std::string& svg, std::size_t index) {
    const std::regex path("<path d=\"M([-0-9.e]+) ([-0-9.e]+)l([^\"]*)\"");
    auto found = std::sregex_iterator(svg.begin(), svg.end(), path);
    std::advance(found, static_cast<std::ptrdiff_t>(index));
    double y = std::stod((*found)[2]);
    Extent extent{y, y};
    std::istringstream moves((*found)[3]);
    for (double dx = 0.0, dy = 0.0; moves >> dx >> dy;) {
        y += dy;
        extent.top = std::min(extent.top, y);
        extent.bottom = std::max(extent.bottom, y);
    }
    return extent;
}

}  // namespace

TEST_CASE("the scale bar has the unit of the rows") {
    StackedPlot plot = make_flat_plot(3);
    for (double& value : plot.runs[0].y[0]) value = 2.0;
    CHECK(make_svg(plot).find("bar: 2<") != std::string::npos);
    plot.y_label = "v [cm/s], one row per level";
    CHECK(make_svg(plot).find("bar: 2 cm/s<") != std::string::npos);
}

TEST_CASE("a mark is a dashed line through all rows, with its words") {
    StackedPlot plot = make_flat_plot(3);
    const std::string dashes = "stroke-dasharray=\"5 4\"", without = make_svg(plot);
    plot.mark = {1.0, "horizon, 1 s"};
    const std::string with = make_svg(plot);
    CHECK(count(with, dashes) == count(without, dashes) + 1);
    CHECK(count(with, ">horizon, 1 s<") == 1);
    // the middle of the samples 0, 1, 2 is that of the frame
    std::smatch line, frame;
    REQUIRE(std::regex_search(with, line, std::regex("<line x1=\"([0-9.]+)\"[^>]*" + dashes)));
    REQUIRE(std::regex_search(with, frame, std::regex("<rect x=\"([0-9.]+)\" y=\"[0-9.]+\" width=\"([0-9.]+)\"")));
    CHECK(std::stod(line[1]) == doctest::Approx(std::stod(frame[1]) + 0.5 * std::stod(frame[2])).epsilon(1e-3));
}

TEST_CASE("a stacked plot draws every run once in every row and names rows, runs and axes") {
    const std::string svg = make_svg(make_flat_plot(10));
    CHECK(count(svg, "<path ") == 4);
    for (const char* label : {"Tower", "of blocks", "t*", "v*", "level 1", "level 3", "prototype", "1:25"})
        CHECK(count(svg, std::string(">") + label + "<") == 1);
}

TEST_CASE("runs differ in colour and in dashes") {
    const std::string svg = make_svg(make_flat_plot(10));
    const std::regex line("<path [^>]*stroke=\"(#[0-9A-F]{6})\"[^>]*?(stroke-dasharray=\"[^\"]*\")?[^>]*>");
    std::sregex_iterator path(svg.begin(), svg.end(), line);
    const std::string first_color = (*path)[1];
    ++path;
    CHECK(first_color != std::string((*path)[1]));
    CHECK(count(svg, "stroke-dasharray") == 3);  // the second run: two rows and the legend
}

TEST_CASE("thinning a long curve keeps a peak of a single sample") {
    StackedPlot plot = make_flat_plot(100001);
    plot.runs[1].y[0][70007] = 3.0;
    const std::string svg = make_svg(plot);
    const Extent flat = path_extent(svg, 0);
    const Extent peaked = path_extent(svg, 1);
    CHECK(flat.top == doctest::Approx(flat.bottom));
    CHECK(peaked.bottom - peaked.top == doctest::Approx(52.0));  // the largest value fills one row spacing
    CHECK(svg.size() < 200000);
}

TEST_CASE("values that are not finite leave a gap, not a broken picture") {
    StackedPlot plot = make_flat_plot(10);
    plot.runs[1].y[0][5] = std::numeric_limits<double>::quiet_NaN();
    const std::string svg = make_svg(plot);
    CHECK(count(svg, "nan") == 0);
    CHECK(count(svg, "<path ") == 4);
}

TEST_CASE("labels with markup are escaped") {
    StackedPlot plot = make_flat_plot(2);
    plot.title = "a<b & \"c\"";
    CHECK(count(make_svg(plot), "a&lt;b &amp; &quot;c&quot;") == 2);  // as heading and as the name of the picture
}

TEST_CASE("a run with another number of rows or values than the plot is refused") {
    StackedPlot plot = make_flat_plot(4);
    plot.runs[1].y.pop_back();
    CHECK_THROWS_AS(make_svg(plot), std::invalid_argument);
    plot = make_flat_plot(4);
    plot.runs[0].x.pop_back();
    CHECK_THROWS_AS(make_svg(plot), std::invalid_argument);
}
