#include "lsdem/report/report_figure.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <pugixml.hpp>

#include "lsdem/report/run_plots.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "tests/report/made_stored_run.hpp"

using namespace musim::lsdem;

TEST_CASE("a figure says in numbers what it draws, and gives all of it as CSV") {
    const double none = std::numeric_limits<double>::quiet_NaN();
    const LinePlot plot{.title = "title",
                        .subtitle = "",
                        .x_label = "x",
                        .y_label = "y",
                        .series = {{.label = "a \"b\", c", .x = {0.0, 1.0, 2.0, 3.0}, .y = {1.0, -4.0, none, 2.5}, .y_error = {}}}};
    const ReportFigure figure = make_figure("name", plot);
    CHECK(figure.csv ==
          "series,x,y\n\"a \"\"b\"\", c\",0,1\n\"a \"\"b\"\", c\",1,-4\n\"a \"\"b\"\", c\",2,nan\n\"a \"\"b\"\", c\",3,2.5\n");
    REQUIRE(figure.twin.rows.size() == 1);
    std::vector<std::string> cells;
    for (const HtmlCell& cell : figure.twin.rows[0]) cells.push_back(cell.text);
    CHECK(cells == std::vector<std::string>{"a \"b\", c", "3", "0", "3", "-4", "1", "2.5", "3"});
    CHECK(describe(figure) == "title: y over x. a \"b\", c: points 3, first x 0, last x 3, smallest -4, at x 1, largest 2.5, at x 3.");

    // well-formed, and the parts of its picture have names of their own
    const std::string html = to_html(figure);
    pugi::xml_document document;
    REQUIRE(document.load_string(html.c_str()));
    CHECK(document.select_node("//div[@role='img']").node().attribute("aria-label").value() == describe(figure));
    CHECK(document.select_node("//svg[@role='img']").node().attribute("aria-label").value() == std::string("title: y over x"));
    for (const pugi::xpath_node& node : document.select_nodes("//svg//*[@id]")) {
        CHECK(std::string(node.node().attribute("id").value()).starts_with("name-"));
    }
}

TEST_CASE("each energy is drawn under its name") {
    ReportedRun run = make_stored_run(2);
    run.run.history.energy = {{.gravitational = 5.0},
                              {.kinetic = 1.0,
                               .gravitational = 7.0,
                               .elastic_normal = 3.0,
                               .elastic_shear = 0.5,
                               .friction_loss = 4.0,
                               .damping_loss = 6.0,
                               .base_work = 8.0}};
    const ReportFigure figure = make_energy_figure(run);
    // at 0.02 s: kinetic 1, gravitational 7 − 5, elastic 3 + 1/2, ...
    for (const std::string line : {"kinetic,0.02,1\n", "\"gravitational, from the start\",0.02,2\n", "elastic,0.02,3.5\n",
                                   "lost by friction,0.02,4\n", "lost in dashpots,0.02,6\n", "work of the base,0.02,8\n"}) {
        CAPTURE(line);
        CHECK(figure.csv.find(line) != std::string::npos);
    }
}

TEST_CASE("stacked curves list for each run and row the peak, when it is, and the last value") {
    const StackedPlot plot{.title = "t",
                           .subtitle = "",
                           .x_label = "x",
                           .y_label = "y",
                           .row_labels = {"low", "high"},
                           .runs = {{.label = "run", .x = {0.0, 1.0, 2.0}, .y = {{0.0, -3.0, 2.0}, {1.0, 0.5, 0.25}}}}};
    const ReportFigure figure = make_figure("stack", plot);
    REQUIRE(figure.twin.rows.size() == 2);
    CHECK(figure.twin.rows[0][2].text == "-3");
    CHECK(figure.twin.rows[0][3].text == "1");
    CHECK(figure.twin.rows[1][4].text == "0.25");
    CHECK(figure.csv.find("run,high,2,0.25,\n") != std::string::npos);
}

TEST_CASE("models are drawn scaled back to their prototype, so that a similar one lies on it") {
    const ReportedRun prototype = make_stored_run(50);
    ReportedRun model = prototype;
    model.label = "1-16";
    model.run.similitude = musim::scaling::make_similitude("exact", {.length = 1.0 / 16});
    for (double& t : model.run.history.time) t *= 0.25;
    for (Vector3& v : model.run.history.spine_velocity) v *= 0.25;
    const std::optional<ReportFigure> spine = make_spine_figure({prototype, model});
    REQUIRE(spine);
    REQUIRE(spine->twin.rows.size() == 6);
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t cell = 2; cell < 5; ++cell) CHECK(spine->twin.rows[row][cell].text == spine->twin.rows[row + 3][cell].text);
    }
    // powers of four: the difference is zero, of which a logarithmic axis shows nothing
    CHECK_FALSE(make_difference_figure({prototype, model}));
    model.run.history.spine_velocity[3 * 20 + 1].x() += 0.25 * 0.1;
    const std::optional<ReportFigure> other = make_difference_figure({prototype, model});
    double largest = 0.0;
    for (std::size_t k = 0; k < 50; ++k) {
        double sum = 0.0;
        for (std::size_t s = 0; s < 3; ++s) sum += prototype.run.history.spine_velocity[3 * k + s].squaredNorm();
        largest = std::max(largest, sum);
    }
    CHECK(std::stod(other->twin.rows[0][6].text) == doctest::Approx(0.1 / std::sqrt(largest)).epsilon(1e-3));
    CHECK(other->twin.rows[0][7].text == "0.4");

    ReportedRun other_times = model;
    other_times.run.history.time.back() *= 1.01;
    CHECK_FALSE(make_difference_figure({prototype, other_times}));
}

/// Look of the sample beside a name in a picture's legend.
std::string look_of(const std::string& svg, const std::string& name) {
    const std::size_t text = svg.find(">" + name + "<");
    if (text == std::string::npos) return "no " + name;
    const std::size_t look = svg.find("stroke=", svg.rfind("<line", text));
    return svg.substr(look, svg.find("/>", look) - look);
}

TEST_CASE("a run looks the same in all plots, and twins have the colour of their prototype") {
    ReportedRun prototype = make_stored_run(5);
    prototype.label = "prototype";
    std::vector<ReportedRun> runs{prototype, prototype, prototype};
    for (ReportedRun& run : runs) {
        run.response->damage.levels.resize(2);
        for (const int level : {0, 1}) run.response->damage.levels[static_cast<std::size_t>(level)].level = level + 1;
    }
    runs[1].label = "1:25";
    runs[2].label = "1:50";
    for (std::size_t r = 1; r < 3; ++r) runs[r].run.history.spine_velocity[4].x() += 0.1 * static_cast<double>(r);
    // the pair has them in another order, and a run that is not among them
    const nlohmann::json pair = nlohmann::json::parse(R"({
        "twins_band": {"axis": 0, "rows": [0, 1, 2], "half_width_m_s": [[0, 1, 1, 1, 1], [0, 1, 1, 1, 1], [0, 1, 1, 1, 1]]},
        "departure": {"time_s": [0, 0.1], "twins": 8, "twins_low": [0, 1e-9], "twins_high": [0, 1e-8], "horizon_s": 0.1,
                      "models": [{"label": "1:50", "largest_difference": [0, 3e-9]}, {"label": "1:25", "largest_difference": [0, 1e-9]},
                                 {"label": "half the step", "largest_difference": [0, 1e-10]}]}})");
    const std::string spine = make_spine_figure(runs, pair)->svg, departure = make_departure_figure(runs, pair, "made")->svg,
                      difference = make_difference_figure(runs)->svg;
    const std::vector<ReportFigure> profiles = make_profile_figures(runs);
    for (const std::string model : {"1:25", "1:50"}) {
        CAPTURE(model);
        const std::string look = look_of(spine, model);
        CHECK(look.starts_with("stroke=\"#"));
        CHECK(look_of(departure, model) == look);
        CHECK(look_of(difference, model) == look);
        for (const ReportFigure& profile : profiles) CHECK_MESSAGE(look_of(profile.svg, model) == look, profile.name);
    }
    CHECK(look_of(spine, "1:25") != look_of(spine, "1:50"));
    CHECK(look_of(departure, "half the step") != look_of(departure, "1:25"));
    CHECK(look_of(departure, "half the step") != look_of(departure, "1:50"));

    // a band, filled alike
    const auto fill_of = [](const std::string& svg, const std::string& mark) {
        const std::size_t at = svg.find("fill=", svg.find(mark));
        return svg.substr(at, svg.find("/>", at) - at);
    };
    const std::string band = fill_of(spine, "class=\"band\"");
    const std::size_t twins = departure.find("fill-opacity");
    REQUIRE(twins != std::string::npos);
    CHECK(departure.find(band) != std::string::npos);
    CHECK(look_of(spine, "prototype, band of its twins").find(band.substr(6, 7)) != std::string::npos);
}

TEST_CASE("twins of a pair are a band about the prototype, and in the picture of departures") {
    const ReportedRun prototype = make_stored_run(3);
    nlohmann::json pair = nlohmann::json::parse(R"({
        "twins_band": {"axis": 0, "rows": [0, 1, 2], "half_width_m_s": [[0, 0.1, 0.2], [0, 0.1, 0.2], [0, 0.1, 0.2]]},
        "departure": {"time_s": [0, 0.1, 0.2], "twins": 8, "twins_low": [0, 1e-9, 1e-6], "twins_high": [0, 1e-8, 2e-3], "horizon_s": 0.2,
                      "models": [{"label": "1:25", "largest_difference": [0, 3e-9, null]}]}})");
    const std::optional<ReportFigure> spine = make_spine_figure({prototype, prototype}, pair);
    REQUIRE(spine);
    CHECK(spine->twin.rows[0].back().text == "20");
    // of a band that is not of the curves nothing is drawn
    pair["twins_band"]["half_width_m_s"][1] = std::vector<double>{0.0};
    CHECK(make_spine_figure({prototype, prototype}, pair)->twin.rows[0].size() == 5);

    const std::optional<ReportFigure> departure = make_departure_figure({}, pair, "a wall");
    REQUIRE(departure);
    REQUIRE(departure->twin.rows.size() == 3);
    CHECK(departure->twin.rows[0][0].text == "8 twins");
    CHECK(departure->twin.rows[0][6].text == "0.002");
    CHECK(departure->twin.rows[1][0].text == "1:25");
    CHECK(departure->twin.rows[2][0].text == "horizon, 0.2 s");
    CHECK(departure->csv.find("lower edge\",0.2,1e-06") != std::string::npos);
    pair.erase("departure");
    CHECK_FALSE(make_departure_figure({}, pair, "a wall").has_value());
}
