#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"

using namespace musim::cli;

namespace {

constexpr const char* kTestTable =
    R"({"schema": "musim-table/1", "name": "test table", "axes": [{"names": ["x"], "displacement": "100 mm", "velocity": "1 m/s"}],
        "controller": {"rate": "2000 Hz", "rest": "0.5 s", "displacement": "mm"}})";

/// One component in m/s², 2 s at 100 Hz.
std::string make_record() {
    std::string text = "# musim ground motion 1\n# quantity: acceleration\n# unit: m/s^2\n# start_s: 0\n# dt_s: 0.01\ntime_s,360\n";
    for (int i = 0; i <= 200; ++i) text += fmt::format("{},{}\n", 0.01 * i, std::sin(9.0 * 0.01 * i));
    return text;
}

/// A record, a recipe, a table, a target, a link to the record, and a folder.
void lay_out(const Workplace& here) {
    here.write("a.csv", make_record());
    here.write("b.csv", make_record());
    here.write("table.json", kTestTable);
    here.write("recipe.json", R"({"schema": "musim-recipe/1", "steps": [{"step": "level"}]})");
    here.write("target.csv", "0.1,0.2\n0.2,0.2\n0.4,0.2\n");
    here.shell("ln -s a.csv link.csv; mkdir folder");
}

}  // namespace

TEST_CASE("no command writes over what it reads or what else it writes") {
    const Workplace here;
    lay_out(here);
    const long files = here.count();
    for (const char* arguments : {"rescale a.csv --length 1/4 -o a.csv",
                                  "rescale a.csv --length 1/4 -o ./folder/../a.csv",
                                  "rescale link.csv --length 1/4 -o a.csv",
                                  "rescale a.csv --length 1/4 -o link.csv",
                                  "rescale a.csv --length 1/4 -o \"$PWD/a.csv\"",
                                  "rescale a.csv --length 1/4 --station-xml b.csv -o b.csv",
                                  "record process a.csv --recipe recipe.json -o a.csv",
                                  "record process a.csv b.csv --recipe recipe.json -o b.csv",
                                  "record process a.csv --recipe b.csv -o b.csv",
                                  "record process a.csv --recipe recipe.json -o c.csv --save-recipe recipe.json",
                                  "record process a.csv --recipe recipe.json -o c.csv --save-recipe c.csv",
                                  "record plot a.csv b.csv -o c.svg --csv b.csv",
                                  "record plot a.csv -o c.svg --csv c.svg",
                                  "record match a.csv --target target.csv -o a.csv",
                                  "record match a.csv --target target.csv -o target.csv",
                                  "record spectrum a.csv b.csv -o b.csv",
                                  "table a.csv --limits table.json --length 1/4 --drive table.json",
                                  "table a.csv --limits table.json --length 1/4 --drive a.csv",
                                  "table a.csv --limits table.json --length 1/4 --save-recipe table.json",
                                  "table a.csv --limits table.json --length 1/4 --drive d.txt --save-recipe d.txt"}) {
        const Outcome outcome = here.run(arguments);
        CHECK_MESSAGE(outcome.exit_code == 3, arguments);
        CHECK_MESSAGE(outcome.has_one_error_line(), outcome.err);
        CHECK_MESSAGE(outcome.err.find("; name another file") != std::string::npos, outcome.err);
    }
    CHECK(here.count() == files);
    CHECK(here.read("a.csv") == make_record());
    CHECK(here.read("b.csv") == make_record());
    CHECK(here.read("table.json") == kTestTable);

    CHECK(here.run("rescale link.csv --length 1/4 -o folder/../a.csv").err ==
          "musim: error: folder/../a.csv: cannot be written (it is also the input link.csv); name another file\n");
    CHECK(here.run("record plot a.csv -o c.svg --csv ./c.svg").err ==
          "musim: error: ./c.svg: cannot be written (it is also the output c.svg); name another file\n");
}

TEST_CASE("files of other names are written, and devices more than once") {
    const Workplace here;
    lay_out(here);
    CHECK(here.run("rescale a.csv --length 1/4 -o folder/a.csv").exit_code == 0);
    CHECK(here.has("folder/a.csv"));
    CHECK(here.run("record process a.csv --recipe recipe.json --format csv -o /dev/null --save-recipe /dev/null").exit_code == 0);
    // the built-in record is no file
    CHECK(here.run("rescale synthetic --length 1/4 --format csv -o synthetic").exit_code == 0);
    CHECK(here.has("synthetic"));
}
