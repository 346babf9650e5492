#include "scaling/json_reader.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <string>

#include "scaling/error.hpp"
#include "scaling/units.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::scaling::tests {
namespace {

class Rules final : public JsonRules {
  public:
    void raise(const std::string& message) const override { throw SimilitudeError(message); }
};

class StrictRules final : public JsonRules {
  public:
    void raise(const std::string& message) const override { throw SimilitudeError(message); }
    bool is_strict() const override { return true; }
};

const Rules kRules;

/// Message about the value at "a" of an object of this text.
template <class Value>
std::string refuse(const char* text, const JsonRules& rules = kRules) {
    const auto json = JsonReader::Json::parse(text);
    return musim::tests::message_of<SimilitudeError>([&] { JsonReader(json, rules, "f.json: /").get<Value>("a"); });
}

template <class Value>
Value read(const char* text) {
    const auto json = JsonReader::Json::parse(text);
    return JsonReader(json, kRules, "f.json: /").get<Value>("a");
}

}  // namespace

TEST_CASE("a value of a JSON file is read as what is asked for") {
    CHECK(read<bool>(R"({"a": true})"));
    CHECK(read<int>(R"({"a": -3})") == -3);
    CHECK(read<double>(R"({"a": "1/4"})") == 0.25);
    CHECK(read<std::string>(R"({"a": "b"})") == "b");
    CHECK(read<Length>(R"({"a": "25 mm"})").value() == 0.025);
    CHECK(read<std::array<Length, 3>>(R"({"a": ["1 m", 2, "3 m"]})")[1].value() == 2.0);
}

TEST_CASE("a value of another kind is refused with its place and what is wanted") {
    CHECK(refuse<bool>(R"({"a": 1})") == "f.json: /a: number 1 found (true or false is wanted); correct the value");
    CHECK(refuse<double>(R"({"a": {"b": 1}})") ==
          "f.json: /a: object found (a number or a fraction such as \"1/107\" is wanted); correct the value");
    CHECK(refuse<std::array<Length, 3>>(R"({"a": ["1 m"]})") ==
          "f.json: /a: array found (a list of three values is wanted); correct the value");
    CHECK(refuse<std::array<Length, 3>>(R"({"a": [1, 2, "3 s"]})").find("f.json: /a/2: ") == 0);
    CHECK(refuse<Length>(R"({"b": 1})") == "f.json: /: key \"a\" is missing; add it");
}

TEST_CASE("integers that do not fit are refused and not wrapped") {
    CHECK(refuse<int>(R"({"a": 4294967299})").find("(a whole number from -2147483647 to 2147483647 is wanted)") != std::string::npos);
    CHECK(refuse<int>(R"({"a": 18446744073709551615})").find("number 18446744073709551615 found") != std::string::npos);
    CHECK(refuse<std::uint64_t>(R"({"a": -1})").find("(a whole number from 0 to 9223372036854775807 is wanted)") != std::string::npos);
}

TEST_CASE("null is no value and a fraction a number unless the rules are strict") {
    const StrictRules strict;
    CHECK(refuse<double>(R"({"a": null})").find("key \"a\" is missing") != std::string::npos);
    CHECK(refuse<double>(R"({"a": null})", strict).find("f.json: /a: null found") == 0);
    CHECK(refuse<double>(R"({"a": "1/4"})", strict).find("f.json: /a: string \"1/4\" found") == 0);
}

TEST_CASE("keys that are not known or that nobody asked for are refused with the nearest") {
    const auto json = JsonReader::Json::parse(R"({"length": "1 m", "widh": "2 m"})");
    const JsonReader object(json, kRules, "f.json: /");
    const std::string said = "f.json: /widh: unknown key \"widh\"; did you mean \"width\"?";
    CHECK(musim::tests::message_of<SimilitudeError>([&] { object.object({"length", "width"}); }) == said);
    CHECK(object.get<Length>("length").value() == 1.0);
    CHECK_FALSE(object.find<Length>("width").has_value());
    CHECK(musim::tests::message_of<SimilitudeError>([&] { object.refuse_unknown_keys(); }) == said);
}

}  // namespace musim::scaling::tests
