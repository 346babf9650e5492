#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <regex>
#include <string>
#include <vector>

#include "lsdem/plot/line_plot.hpp"

using namespace musim::lsdem;

namespace {

struct Place {
    double x = 0.0, y = 0.0;
};

/// Where the points of the only series with marks lie [px].
std::vector<Place> find_marks(const std::string& svg) {
    static const std::regex kMark("<circle cx=\"([-0-9.]+)\" cy=\"([-0-9.]+)\"");
    std::vector<Place> marks;
    for (std::sregex_iterator mark(svg.begin(), svg.end(), kMark), end; mark != end; ++mark)
        marks.push_back({std::stod((*mark)[1]), std::stod((*mark)[2])});
    return marks;
}

LinePlot make_plot(std::vector<double> x, std::vector<double> y) {
    return {.title = "",
            .subtitle = "",
            .x_label = "",
            .y_label = "",
            .series = {{.label = "", .x = std::move(x), .y = std::move(y), .marks = true, .line = false, .y_error = {}}}};
}

bool has_tick(const std::string& svg, const std::string& text) { return svg.find(">" + text + "</text>") != std::string::npos; }

}  // namespace

// places are written with one decimal
constexpr double kRounding = 0.11;  // [px]

TEST_CASE("decades are as long as each other on a logarithmic axis, values on a linear one") {
    LinePlot plot = make_plot({0.01, 0.1, 1.0, 10.0}, {1.0, 2.0, 3.0, 4.0});
    plot.x_logarithmic = true;
    const auto marks = find_marks(make_svg(plot));
    REQUIRE(marks.size() == 4);
    for (std::size_t i = 1; i + 1 < marks.size(); ++i) {
        CHECK(std::abs(marks[i + 1].x - 2.0 * marks[i].x + marks[i - 1].x) < 2.0 * kRounding);
        CHECK(std::abs(marks[i + 1].y - 2.0 * marks[i].y + marks[i - 1].y) < 2.0 * kRounding);
    }

    plot = make_plot({1.0, 2.0, 3.0, 4.0}, {0.01, 0.1, 1.0, 10.0});
    plot.y_logarithmic = true;
    const auto upward = find_marks(make_svg(plot));
    REQUIRE(upward.size() == 4);
    for (std::size_t i = 1; i + 1 < upward.size(); ++i) {
        CHECK(upward[i].y > upward[i + 1].y);
        CHECK(std::abs(upward[i + 1].y - 2.0 * upward[i].y + upward[i - 1].y) < 2.0 * kRounding);
    }
}

TEST_CASE("a logarithmic axis has round ticks over many decades, few, and less than one") {
    const auto draw = [](double first, double last) {
        LinePlot plot = make_plot({first, last}, {7.0, 7.0});
        plot.x_logarithmic = true;
        return make_svg(plot);
    };
    const std::string many = draw(1e-3, 1e3), few = draw(0.1, 10.0), less = draw(0.3, 0.7);
    for (const char* tick : {"0.001", "0.01", "0.1", "1", "10", "100", "1000"}) CHECK_MESSAGE(has_tick(many, tick), tick);
    CHECK_FALSE(has_tick(many, "0.2"));
    for (const char* tick : {"0.1", "0.2", "0.5", "1", "2", "5", "10"}) CHECK_MESSAGE(has_tick(few, tick), tick);
    for (const char* tick : {"0.3", "0.4", "0.5", "0.6", "0.7"}) CHECK_MESSAGE(has_tick(less, tick), tick);
}

TEST_CASE("what a logarithmic axis cannot show is left out") {
    LinePlot plot = make_plot({1.0, 2.0, 3.0, 4.0, 5.0}, {0.0, -1.0, 3.0, std::numeric_limits<double>::infinity(), 4.0});
    plot.series[0].y_error = {0.0, 0.0, 5.0, 0.0, 1.0};
    plot.y_logarithmic = true;
    const std::string svg = make_svg(plot);
    CHECK(find_marks(svg).size() == 2);
    CHECK(svg.find("nan") == std::string::npos);
    CHECK(svg.find("inf") == std::string::npos);
    // one bar, that of the last point
    static const std::regex kBar("stroke-width=\"1\"/>");
    CHECK(std::distance(std::sregex_iterator(svg.begin(), svg.end(), kBar), std::sregex_iterator()) == 1);

    plot.series.clear();
    CHECK(make_svg(plot).ends_with("</svg>\n"));
}

TEST_CASE("what lies between two curves is shaded, and counts for the axis") {
    LinePlot plot{.title = "t", .subtitle = "", .x_label = "x", .y_label = "y", .series = {}};
    plot.y_logarithmic = true;
    plot.series.push_back({.label = "band", .x = {0.0, 1.0, 2.0}, .y = {1e-3, 1e-2, 1e-1}, .y_error = {}, .y_low = {1e-6, 1e-5, 1e-4}});
    const std::string svg = make_svg(plot);
    CHECK(svg.find("fill-opacity=\"0.3\"") != std::string::npos);
    CHECK(svg.find(">10⁻⁶<") != std::string::npos);
    plot.series[0].y_low.pop_back();
    CHECK_THROWS_AS(make_svg(plot), std::invalid_argument);
}
