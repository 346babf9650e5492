#include "scaling/error.hpp"

#include <doctest/doctest.h>

#include <string>

#include "scaling/setting.hpp"

namespace musim {
namespace {

std::string_view bracketed(Setting setting) { return setting == Setting::unit ? "[unit]" : "[other]"; }

const scaling::SimilitudeError kError("a.txt: no unit (none is stated)", {"give ", Setting::unit, " or ", Setting::quantity});

TEST_CASE("a remedy names settings in plain words, or as its caller does") {
    CHECK(std::string(kError.what()) == "a.txt: no unit (none is stated); give the unit or the quantity");
    CHECK(kError.worded(bracketed) == "a.txt: no unit (none is stated); give [unit] or [other]");
}

TEST_CASE("an error that is seen from farther off keeps its remedy") {
    const auto farther = kError.seen_from<scaling::ParseError>("scene.json");
    CHECK(farther.worded(bracketed) == "scene.json: a.txt: no unit (none is stated); give [unit] or [other]");
    const Error plain("no remedy");
    CHECK(plain.worded(bracketed) == "no remedy");
    CHECK(std::string(plain.seen_from<Error>("here").what()) == "here: no remedy");
}

TEST_CASE("an error takes another remedy in the place of its own") {
    CHECK(std::string(kError.with<Error>("convert it").what()) == "a.txt: no unit (none is stated); convert it");
    CHECK(std::string(Error("no remedy").with<Error>("convert it").what()) == "no remedy; convert it");
}

}  // namespace
}  // namespace musim
