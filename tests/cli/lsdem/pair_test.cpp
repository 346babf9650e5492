#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>
#include <utility>

#include "tests/cli/lsdem/two_blocks.hpp"
#include "tests/cli/program.hpp"

using namespace musim::cli;

TEST_CASE("pair agrees in every bit at 1:16 and within the yardstick at 1:107, and draws it") {
    const Workplace here;
    here.write("scene.json", SceneText().text());
    const Outcome outcome = here.run("pair scene.json --length 1/16 --length 1/107 -o out --json");
    CHECK(outcome.exit_code == 0);
    const auto object = outcome.json();
    CHECK(object["consistent"] == true);
    CHECK(object["runs"].size() == 3);
    CHECK(object["agreement"] == "agree");
    CHECK(object["verdict"][0] == "The models agree with the prototype.");
    REQUIRE(object["pairs"].size() == 2);
    for (const char* key : {"length", "materials", "max_relative_velocity_difference", "rms_relative_velocity_difference",
                            "bitwise_identical", "distortions"}) {
        CHECK_MESSAGE(object["pairs"][1].contains(key), key);
    }
    CHECK(object["pairs"][0]["bitwise_identical"] == true);
    CHECK(object["pairs"][0]["rms_relative_velocity_difference"] == 0.0);
    CHECK(object["pairs"][1]["length"].get<double>() == 1.0 / 107.0);
    for (const char* name : {"prototype/result.h5", "departure.svg", "1-16/spine.csv", "1-107/summary.json", "pair.json"}) {
        CHECK_MESSAGE(here.has(std::string("out/") + name), name);
    }
    CHECK(here.read("out/spine.svg").starts_with("<svg"));
}

TEST_CASE("pair prints a table with a verdict for every run") {
    const Workplace here;
    here.write("scene.json", SceneText().text());
    const Outcome outcome = here.run("pair scene.json --twins 2");
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.out.starts_with("The models agree with the prototype.\n"));
    for (const char* word : {"prototype", "twin", "1:25", "1:107", "half step", "agrees to rounding"})
        CHECK_MESSAGE(outcome.out.find(word) != std::string::npos, word);
}

TEST_CASE("models of their own material list what they distort") {
    const Workplace here;
    here.write("scene.json", SceneText().text());
    const auto pair = here.run("pair scene.json --length 1/107 --materials own --json").json()["pairs"][0];
    CHECK(pair["materials"] == "own");
    CHECK(pair["distortions"].size() > 0);
    CHECK(here.run("pair scene.json --length 1/50 --materials own").exit_code == 3);
    const Outcome refused = here.run("pair scene.json --length 1/50 --materials own --material aluminium --accept 0.1%");
    CHECK(refused.exit_code == 6);
    CHECK(refused.out.starts_with("Model 1:50 of aluminium: "));
    CHECK(refused.out.find("NOT accepted") != std::string::npos);
    CHECK(refused.out.find("\nAt half the time step velocities agree to 0.1 % ") != std::string::npos);
    const Outcome accepted = here.run("pair scene.json --length 1/50 --materials own --material aluminium --accept 1e6");
    CHECK(accepted.exit_code == 0);
    // no other specimens were run
    CHECK(accepted.out.find("Accepted: all within 100000000 %") != std::string::npos);
    CHECK(accepted.out.find("specimens") == std::string::npos);
    CHECK(here.run("pair scene.json --accept 5%").exit_code == 2);
    // a scene as its own model
}

TEST_CASE("a scene of the same blocks is judged like an exact model, and what differs is named") {
    const Workplace here;
    SceneText text;
    here.write("a.json", text.text());
    const Outcome same = here.run("pair a.json a.json --no-half-step --accept 1%");
    CHECK(same.exit_code == 0);
    CHECK(same.out.starts_with("a.json: the structure of a.json, block by block, judged like an exact model.\nThe model agrees"));
    CHECK(same.out.find("Accepted: the prototype again, to rounding.") != std::string::npos);
    CHECK(same.out.find("% higher") == std::string::npos);
    text.restitution = "0.30001";
    here.write("b.json", text.text());
    const Outcome other = here.run("pair a.json b.json --no-half-step");
    CHECK(other.exit_code == 5);
    CHECK(other.out.find("Model b.json DIFFERS from the prototype: at ") != std::string::npos);
    CHECK(other.out.find("b.json differs from the prototype's scene in /material/restitution: 0.30001, not 0.3.\n") != std::string::npos);
    const auto pair = here.run("pair a.json b.json --no-half-step --json").json()["pairs"][0];
    CHECK(pair["materials"] == "exact");
    CHECK(pair["scene"]["file"] == "b.json");
    CHECK(pair["scene"]["same_structure"] == true);
    CHECK(pair["scene"]["differences"][0]["key"] == "/material/restitution");
    CHECK(pair["scene"]["differences"][0]["model"] == 0.30001);
    // what is asked for decides
    CHECK(here.run("pair a.json b.json --no-half-step --materials own").exit_code == 0);
    CHECK(here.run("pair a.json b.json --no-half-step --accept 50%").exit_code == 0);
    CHECK(here.run("pair a.json b.json --record a.at2").exit_code == 2);
    const auto by_law = here.run("pair a.json b.json --no-half-step --law froude --json").json()["pairs"][0];
    CHECK(by_law["materials"] == "own");
    CHECK(by_law["law"]["source"] == "chosen");
    CHECK(by_law["law"]["base_motion"]["time"] == 1.0);
}

TEST_CASE("pair scales by another law, as data") {
    const Workplace here;
    here.write("scene.json", SceneText().text());
    const auto centrifuge = here.run("pair scene.json --length 1/16 --law centrifuge --json").json();
    CHECK(centrifuge["pairs"][0]["bitwise_identical"] == true);
    CHECK(centrifuge["consistent"] == true);
    CHECK(here.run("pair scene.json --length 1/16 --law nonsense").exit_code == 3);
    CHECK(here.run("pair scene.json --length 1/16 --law froude --set l=1/16").exit_code == 3);
    CHECK(here.run("pair scene.json --length 1/16 --set mu=1").exit_code == 2);
}

TEST_CASE("pair shakes a model of its own material by the law that is asked for, and says which") {
    const Workplace here;
    here.write("scene.json", SceneText().text());
    const std::string own = "pair scene.json --length 1/107 --materials own --twins 0 --no-half-step --law ";
    const Outcome froude = here.run(own + "froude");
    CHECK(froude.exit_code == 0);
    CHECK(froude.out.find("\nModel 1:107 is shaken by law froude: times x 0.09667, accelerations x 1; ") != std::string::npos);
    CHECK(froude.out.find("\nDistortions of 1:107, wood that law froude does not allow\n") != std::string::npos);
    const auto law = here.run(own + "gravity_distorted --set a=1.5 --json").json()["pairs"][0]["law"];
    CHECK(law["name"] == "gravity_distorted");
    CHECK(law["source"] == "chosen");
    CHECK(law["acceleration"] == 1.5);
    CHECK(here.run(own + "gravity_distorted").exit_code == 3);
    CHECK(here.run(own + "mu_vertical_distortion").exit_code == 3);
}

TEST_CASE("pair says by which law a scene is shaken, given by its record, by --law, or measured") {
    const Workplace here;
    REQUIRE(here.run("rescale synthetic --length 1 --law froude -o record.csv").exit_code == 0);
    REQUIRE(here.run("rescale synthetic --length 1/16 --law froude -o scaled.csv").exit_code == 0);
    // blocks of 1/16, on contacts that bear them alike
    const auto write = [&](const std::string& file, const std::string& base, double length) {
        const std::string size = fmt::format("\"size\": [{0}, {0}, {1}]", 2.0 * length, length);
        here.write(file, fmt::format(R"({{"schema": "musim-scene/1", "name": "{}", "material": {{"density": 2320, "normal_stiffness": {},
            "shear_stiffness": {}, "friction": 0.3, "restitution": 0.3}}, "structure": {{"kind": "blocks", "blocks": [
            {{{}, "position": [0, 0, {}]}}, {{{}, "position": [0, 0, {}]}}]}}, "base_motion": {{{}}},
            "time": {{"duration": "0.2 s"}}, "output": {{"spine_rate": "200 Hz"}}}})",
                                     file, 2e9 * length * length, 2e9 * length * length, size, 0.5 * length, size, 1.5 * length, base));
    };
    const std::string record = R"("record": "record.csv", "window": ["5 s", "6 s"])";
    write("prototype.json", record + R"(, "components": {"x": "1"})", 1.0);
    write("named.json", record + R"(, "components": {"x": "1"}, "scale": {"law": "froude", "length": "1/16"})", 1.0 / 16.0);
    write("file.json", R"("record": "scaled.csv", "window": ["1.25 s", "1.5 s"], "components": {"x": "1"})", 1.0 / 16.0);
    const auto law_of = [&](const std::string& model) {
        return here.run("pair prototype.json " + model + " --twins 0 --no-half-step --json").json()["pairs"][0];
    };
    for (const auto& each :
         {std::pair{"named.json", "scene"}, std::pair{"file.json", "measured"}, std::pair{"file.json --law froude", "chosen"}}) {
        CAPTURE(each.first);
        const auto pair = law_of(each.first);
        CHECK(pair["law"]["name"] == "froude");
        CHECK(pair["law"]["source"] == each.second);
        CHECK(pair["law"]["acceleration"] == 1.0);
        CHECK(pair["distortions"].empty());
    }
    const auto other = law_of("file.json --law cauchy")["law"];
    CHECK(other["name"] == "cauchy");
    CHECK(other["base_motion"]["time"].get<double>() == doctest::Approx(0.25).epsilon(1e-4));
}

TEST_CASE("pair --record shakes with the strong motion of a record and says what it did") {
    const Workplace here;
    here.write("scene.json", SceneText().text());
    REQUIRE(here.run("rescale synthetic --length 1 --law froude -o record.csv").exit_code == 0);
    const Outcome outcome = here.run("pair scene.json --length 1/16 --record record.csv --duration 0.2 --json");
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.find("along x") != std::string::npos);
    CHECK(outcome.err.find("strong motion from") != std::string::npos);
    CHECK(outcome.json()["pairs"][0]["bitwise_identical"] == true);
    CHECK(here.run("pair scene.json --record missing.at2").exit_code == 3);
    CHECK(here.run("pair scene.json --record record.csv --component x=nope").exit_code == 3);
    CHECK(here.run("pair scene.json --record record.csv --component 360").exit_code == 2);
}
