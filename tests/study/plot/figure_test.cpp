#include "lsdem/plot/figure.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "lsdem/plot/picture_file.hpp"
#include "lsdem/plot/plot_panel.hpp"
#include "lsdem/plot/svg.hpp"
#include "records/error.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using detail::PicturePoint;
using detail::thin_path;

namespace {

/// `samples` of a decaying sine over 100 s, one peak of 3 at sample `peak`.
PlotSeries make_shaking(std::size_t samples, std::size_t peak) {
    PlotSeries series{.label = "", .x = {}, .y = {}, .y_error = {}};
    for (std::size_t i = 0; i < samples; ++i) {
        const double t = 100.0 * static_cast<double>(i) / static_cast<double>(samples - 1);
        series.x.push_back(t);
        series.y.push_back(i == peak ? 3.0 : std::sin(40.0 * t) * std::exp(-0.01 * t));
    }
    return series;
}

Figure make_figure(const PlotSeries& series) {
    const LinePlot panel{.title = "a < b & c", .subtitle = "", .x_label = "t", .y_label = "a", .series = {series}};
    return {.title = "Figure",
            .key_headings = {"name", "peak"},
            .key = {{0, {"first", "3"}}},
            .columns = {{.width = 400.0, .common_x = true, .panels = {panel, panel}, .second_x = {{"twice", 2.0}}}, {.panels = {panel}}},
            .caption = {"One line."}};
}

std::string bytes(const std::filesystem::path& path) { return musim::tests::bytes_of(path); }

/// Four bytes of a PNG file as a number, most significant first.
unsigned read_big_endian(const std::string& text, std::size_t at) {
    unsigned number = 0;
    for (std::size_t i = 0; i < 4; ++i) number = 256 * number + static_cast<unsigned char>(text.at(at + i));
    return number;
}

}  // namespace

TEST_CASE("a thinned path keeps the lowest and the highest point of every pixel column, in their order") {
    const std::vector<PicturePoint> path{{0.0, 1.0}, {0.2, 5.0}, {0.4, -2.0}, {0.9, 0.0}, {1.0, 4.0}, {1.5, 3.0}, {2.0, 2.0}};
    CHECK(thin_path(path) == std::vector<PicturePoint>{{0.2, 5.0}, {0.4, -2.0}, {1.0, 4.0}, {1.5, 3.0}, {2.0, 2.0}});
    CHECK(thin_path({{0.1, 1.0}, {0.2, 1.0}, {0.3, 1.0}}).size() == 1);
    CHECK(thin_path({}).empty());
}

TEST_CASE("a curve of a figure has two points a pixel column at most, and its peak") {
    const std::string svg = make_svg(make_figure(make_shaking(32000, 12345)));
    pugi::xml_document document;
    REQUIRE(document.load_string(svg.c_str()));
    const auto paths = document.select_nodes("//path");
    REQUIRE(paths.size() == 3);
    for (const pugi::xpath_node& path : paths) {
        const std::string d = path.node().attribute("d").value();
        const auto points = 1 + std::count(d.begin(), d.end(), 'L');
        // 400 columns between the axes, and one begun at each end
        CHECK(points <= 2 * 402);
        CHECK(points > 400);
    }
    CHECK(svg.size() < 60000);

    // the peak alone is as high as what is drawn with it
    const auto highest = [](const std::string& text) {
        pugi::xml_document picture;
        REQUIRE(picture.load_string(text.c_str()));
        std::string d = picture.select_node("//path").node().attribute("d").value();
        std::replace_if(
            d.begin(), d.end(), [](char c) { return c == 'M' || c == 'L'; }, ' ');
        std::istringstream numbers(d);
        double x = 0.0, y = 0.0, top = 1e9;
        while (numbers >> x >> y) top = std::min(top, y);
        return top;
    };
    PlotSeries few = make_shaking(32000, 12345);
    const double least = *std::min_element(few.y.begin(), few.y.end());
    few.x = {0.0, few.x[12345], 50.0, 100.0};
    few.y = {0.0, 3.0, least, 0.0};
    CHECK(highest(svg) == doctest::Approx(highest(make_svg(make_figure(few)))).epsilon(1e-9));
}

TEST_CASE("text is shortened in its middle, by whole letters, to the room there is") {
    // advance widths of the font: H 0.752, a 0.613, i 0.278
    CHECK(detail::find_text_width("Hai", 10.0) == doctest::Approx(16.43).epsilon(1e-12));
    CHECK(detail::find_text_width("λₜ", 10.0) == 20.0);
    CHECK(detail::shorten("abcdef", 10.0, detail::find_text_width("abcdef", 10.0)) == "abcdef");
    const std::string name = "λλλλλλλλλλ";
    // five letters are as wide as the room, one of them is the sign
    CHECK(detail::shorten(name, 10.0, 50.0) == "λλ…λλ");
    CHECK(detail::shorten(name, 10.0, 49.0) == "λλ…λ");
    CHECK(detail::shorten(name, 10.0, 0.0) == "…");
}

TEST_CASE("text is wrapped at spaces") {
    CHECK(detail::wrap("λλ λλ λ", 10.0, detail::find_text_width("λλ λλ", 10.0)) == std::vector<std::string>{"λλ λλ", "λ"});
    CHECK(detail::wrap("λλλ λ", 10.0, 5.0) == std::vector<std::string>{"λλλ", "λ"});
    CHECK(detail::wrap("", 10.0, 5.0).empty());
}

TEST_CASE("as many styles as are given differ, and the two blues in their dashes") {
    for (const CurveStyles choice : {CurveStyles::apart, CurveStyles::pairs}) {
        const std::size_t count = count_styles(choice);
        Figure figure = make_figure(make_shaking(100, 50));
        figure.styles = choice;
        figure.key.clear();
        figure.columns.clear();
        for (std::size_t i = 0; i < count; ++i) figure.key.push_back({static_cast<int>(i), {"a", "b"}});
        pugi::xml_document document;
        REQUIRE(document.load_string(make_svg(figure).c_str()));
        // samples of the key: colour and dash
        std::set<std::string> styles;
        std::set<std::string> of_blues;
        for (const pugi::xpath_node& found : document.select_nodes("//line")) {
            const std::string color = found.node().attribute("stroke").as_string(),
                              dash = found.node().attribute("stroke-dasharray").as_string();
            styles.insert(color + " " + dash);
            if (color == "#0072B2" || color == "#56B4E9") of_blues.insert(dash);
        }
        CHECK(styles.size() == count);
        // three dashes for each blue
        CHECK(of_blues.size() == (choice == CurveStyles::apart ? 6 : 0));
    }
}

TEST_CASE("a long title and long names stay within the figure, and numbers are whole") {
    Figure figure = make_figure(make_shaking(100, 50));
    const std::string number = "-0.4079 at 123.45 s";
    figure.title = "IMPERIAL VALLEY 10/15/79 2316, EL CENTRO ARRAY #12, 140 (USGS STATION 931), and a great deal more of the same kind";
    figure.key_headings = {"component", "first", "second"};
    figure.key = {{0, {"A COMPONENT NAMED AFTER ALL THAT IS KNOWN OF IT, 140", number, number}}, {1, {"90", number, number}}};
    pugi::xml_document document;
    REQUIRE(document.load_string(make_svg(figure).c_str()));
    const double width = document.first_child().attribute("width").as_double();
    int numbers = 0;
    for (const pugi::xpath_node& found : document.select_nodes("//text[@text-anchor='start']")) {
        const pugi::xml_node text = found.node();
        const bool is_title = text.attribute("class").as_string() == std::string("title");
        // small text has 11.5 px; a title's size is its own, its bold letters are up to 1.26 times as wide
        const double size = is_title ? 1.26 * std::stod(std::string(text.attribute("style").as_string()).substr(10)) : 11.5;
        CHECK_MESSAGE(text.attribute("x").as_double() + detail::find_text_width(text.text().as_string(), size) <= width,
                      text.text().as_string());
        numbers += text.text().as_string() == number ? 1 : 0;
    }
    CHECK(numbers == 4);
    // a title that fits is as it was
    figure.title = "Short";
    CHECK(make_svg(figure).find("style=\"font-size:15.00px\">Short<") != std::string::npos);
}

TEST_CASE("pictures are files of the kind their name implies") {
    const musim::tests::TemporaryFolder folder;
    const std::string svg = make_svg(make_figure(make_shaking(100, 50)));
    pugi::xml_document document;
    REQUIRE(document.load_string(svg.c_str()));
    write_picture(folder.path() / "a.svg", svg);
    CHECK(bytes(folder.path() / "a.svg") == svg);
    CHECK_THROWS_AS(require_picture_name("a.gif"), musim::records::WriteError);
    CHECK_THROWS_AS(require_picture_name("a"), musim::records::WriteError);
    if (!can_write_png()) {
        CHECK_THROWS_AS(write_picture(folder.path() / "a.png", svg), musim::records::WriteError);
        return;
    }
    write_picture(folder.path() / "a.png", svg);
    const std::string png = bytes(folder.path() / "a.png");
    CHECK(png.starts_with("\x89PNG\r\n\x1a\n"));
    // 2.5 pixels for each of the document's
    CHECK(read_big_endian(png, 16) == std::ceil(2.5 * document.first_child().attribute("width").as_double()));
    CHECK(read_big_endian(png, 20) == std::ceil(2.5 * document.first_child().attribute("height").as_double()));
    write_picture(folder.path() / "a.pdf", svg);
    CHECK(bytes(folder.path() / "a.pdf").starts_with("%PDF-"));
}
