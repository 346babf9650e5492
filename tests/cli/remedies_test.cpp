#include <doctest/doctest.h>

#include "cli/option_name.hpp"
#include "scaling/setting.hpp"
#include "tests/cli/program.hpp"

using namespace musim;
using namespace musim::cli;

TEST_CASE("every setting has a name in plain words and one of the command line") {
    for (int i = 0; i <= static_cast<int>(Setting::sequence_resumption); ++i) {
        const auto setting = static_cast<Setting>(i);
        CHECK_MESSAGE(!plain_name(setting).empty(), i);
        CHECK_MESSAGE(plain_name(setting).find("--") == std::string_view::npos, plain_name(setting));
        CHECK_MESSAGE(!option_name(setting).empty(), plain_name(setting));
    }
}

TEST_CASE("what a record lacks is asked for by options, in a scene by keys") {
    const Workplace here;
    here.write("a.txt", "1\n2\n3\n2\n1\n");
    const std::string place = "musim: error: a.txt: time step is unknown (first column is not an evenly increasing time); ";
    CHECK(here.run("record info a.txt --unit g").err == place + "give --dt SECONDS\n");
    CHECK(here.run("rescale a.txt --length 1/25 --unit g -o b.csv").err == place + "give --dt SECONDS\n");

    here.write("scene.json", R"({"schema": "musim-scene/1", "material": "wood",
        "structure": {"kind": "column", "layers": 2, "block": ["12.710 mm", "26.355 mm", "39.780 mm"]},
        "base_motion": {"record": "a.txt", "unit": "g", "components": {"x": "1"}}, "time": {"duration": "0.1 s"}})");
    const std::string scene = here.run("check scene.json").err;
    CHECK_MESSAGE(scene.ends_with("(first column is not an evenly increasing time); give \"dt\"\n"), scene);
}
