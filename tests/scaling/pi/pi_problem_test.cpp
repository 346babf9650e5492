#include "scaling/pi/pi_problem.hpp"

#include <doctest/doctest.h>

#include "tests/scaling/pi_problems.hpp"

namespace musim::scaling::tests {

namespace {

std::string refusal(const std::string& quantities) {
    return pi_error([&] { parse_pi_problem("{\"quantities\": " + quantities + "}", "p.json"); });
}

}  // namespace

TEST_CASE("a problem is read with units and values") {
    const auto quantities = parse_pi_problem(
        R"({"quantities": [{"name": "b", "unit": "mm", "value": 12.710}, {"name": "s", "unit": "1", "value": "1/107"}, {"name": "v", "unit": "m/s"}]})",
        "p.json");
    REQUIRE(quantities.size() == 3);
    CHECK(*quantities[0].value == 0.01271);
    CHECK(*quantities[1].value == 1.0 / 107.0);
    CHECK_FALSE(quantities[2].value.has_value());
    CHECK(quantities[2].dimension == make_pi_quantity("v", "cm/s").dimension);
}

TEST_CASE("a problem that cannot be is refused in one line that names the culprit") {
    CHECK(refusal("[]") == "p.json: no quantities; list those that the problem depends on");
    CHECK(
        refusal(R"([{"name": "v", "unit": "m/S"}])").find("p.json: /quantities/0 (v): \"m/S\": unknown unit \"S\" (did you mean \"s\"?)") ==
        0);
    CHECK(refusal(R"([{"name": "v", "unit": "m"}, {"name": "v", "unit": "s"}])") == "p.json: \"v\" is there twice; rename one");
    CHECK(refusal(R"([{"name": "v", "unti": "m", "unit": "m"}])") ==
          "p.json: /quantities/0 (v): unknown key \"unti\"; did you mean \"unit\"?");
    CHECK(refusal(R"([{"unit": "m"}])") == "p.json: /quantities/0: key \"name\" is missing; add \"name\": \"v\"");
    CHECK(refusal(R"([{"name": "v"}])").find("key \"unit\" is missing") != std::string::npos);
    CHECK(refusal(R"([{"name": "v", "unit": 3}])").find("\"unit\" is no text") != std::string::npos);
    CHECK(refusal(R"([{"name": "v", "unit": "m", "value": true}])").find("\"value\" is no number") != std::string::npos);
    CHECK(refusal(R"([{"name": "v", "unit": "m", "value": "3 m"}])").find("a number is wanted") != std::string::npos);
    for (const char* value : {"-3", "0"}) {
        CHECK(refusal(R"([{"name": "l", "unit": "m", "value": )" + std::string(value) + "}]") ==
              "p.json: l is " + std::string(value) +
                  " m (a value must be positive and finite: groups are products of powers); correct it or leave it out");
    }
    CHECK(refusal(R"([{"name": "v", "unit": "m", "value": "1/0"}])").find("division by zero") != std::string::npos);
    CHECK(refusal(R"([3])").find("/quantities/0: not an object") != std::string::npos);
    CHECK(refusal("3").find("no list of \"quantities\"") != std::string::npos);
    CHECK(refusal("[{]").find("parse error") != std::string::npos);
    for (const char* name : {"", "2v", "v/l", "a*b", "v ", "(v)", "a,b", "v^2"}) {
        CHECK_MESSAGE(!refusal("[{\"name\": \"" + std::string(name) + "\", \"unit\": \"m\"}]").empty(), name);
    }
    CHECK(pi_error([] { parse_pi_problem(R"({"quantity": []})", "p.json"); }) ==
          "p.json: unknown key \"quantity\"; did you mean \"quantities\"?");
    CHECK(pi_error([] { parse_pi_problem("[]", "p.json"); }).find("p.json: not an object") == 0);
}

}  // namespace musim::scaling::tests
