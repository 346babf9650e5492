#include "scaling/json_text.hpp"

#include <doctest/doctest.h>

#include <string>

#include "scaling/error.hpp"
#include "scaling/laws/scale_law_json.hpp"
#include "scaling/pi/pi_problem.hpp"
#include "scaling/shorten.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::scaling {
namespace {

std::string nest(std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); }

std::string json_message(const std::string& text) {
    return musim::tests::message_of<ParseError>([&] { parse_json_text(text); });
}

TEST_CASE("JSON nested deeper than people write is refused and not run through") {
    CHECK(parse_json_text(nest(kMostJsonLevels)).is_array());
    CHECK(json_message(nest(kMostJsonLevels + 1)) == "nested in more than 100 levels");
    CHECK(json_message(nest(100'000)) == "nested in more than 100 levels");
    // a law echoes what is no text in its lists
    const std::string law = R"({"schema": "musim-law/1", "name": "x", "title": "t", "held": [)" + nest(100'000) + "]}";
    CHECK(musim::tests::message_of<std::runtime_error>([&] { parse_scale_law(law, "law.json"); }) ==
          "law.json: nested in more than 100 levels; correct the JSON");
}

TEST_CASE("numbers beyond doubles and broken JSON are reported in a short line") {
    CHECK(json_message("[1e999]") == "number overflow parsing '1e999'");
    CHECK(json_message("{").starts_with("parse error at line 1, column 2: "));
    const std::string many = json_message("[" + std::string(5000, '9') + "]");
    CHECK(many.starts_with("number overflow parsing '9999"));
    CHECK(many.size() == 160);
}

TEST_CASE("a line has no control characters, and other letters stay") { CHECK(make_line("a\nb\x1b[31m\x7f \u03bb") == "a b [31m  \u03bb"); }

TEST_CASE("a message is one line whatever it quotes") {
    CHECK(std::string(SimilitudeError("a\nb").what()) == "a b");
    const auto message = musim::tests::message_of<PiError>(
        [] { parse_pi_problem(R"({"quantities": [{"name": "a", "unit": "g\n", "value": 2}, {"name": "b", "unit": "m"}]})", "p.json"); });
    CHECK(message.find("\"g \"") != std::string::npos);
}

TEST_CASE("long texts keep beginning and end, and no letter is parted") {
    CHECK(shorten("short") == "short");
    const std::string text = "begin" + std::string(500, 'x') + "end", shown = shorten(text);
    CHECK(shown.size() == 160);
    CHECK(shown.starts_with("beginxx"));
    CHECK(shown.ends_with("xxend"));
    std::string greek;
    for (int i = 0; i < 200; ++i) greek += "\u03bb";
    for (std::size_t most = 16; most < 22; ++most) {
        const std::string cut = shorten(greek, most);
        CHECK(cut.size() <= most);
        CHECK((cut.size() - 3) % 2 == 0);
        CHECK(cut.find("...") % 2 == 0);
    }
}

}  // namespace
}  // namespace musim::scaling
