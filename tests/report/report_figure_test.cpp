#include "lsdem/report/report_figure.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <pugixml.hpp>

#include "lsdem/report/run_plots.hpp"
#include "tests/report/made_stored_run.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::report;

TEST_CASE("a figure says in numbers what it draws, and gives all of it as CSV") {
    const double none = std::numeric_limits<double>::quiet_NaN();
    const study::LinePlot plot{.title = "title",
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

    // well-formed, and the parts of its picture have names of their own
    const std::string html = to_html(figure);
    pugi::xml_document document;
    REQUIRE(document.load_string(html.c_str()));
    for (const pugi::xpath_node& node : document.select_nodes("//svg//*[@id]")) {
        CHECK(std::string(node.node().attribute("id").value()).starts_with("name-"));
    }
}

TEST_CASE("stacked curves tell for each run and row the peak, when it is, and the last value") {
    const study::StackedPlot plot{.title = "t",
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
    model.length = 1.0 / 16;
    model.time = model.velocity = 0.25;
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
