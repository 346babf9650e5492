#include "scaling/uncertain.hpp"

#include <doctest/doctest.h>

#include <string>

#include "scaling/number.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/units.hpp"
#include "tests/scaling/expected.hpp"

namespace musim::scaling::tests {

namespace {

template <class Read>
std::string reading_message(const Read& read) {
    try {
        read();
    } catch (const ParseError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("an uncertain number is read in all its forms") {
    for (const char* text : {"0.63+/-0.03", "0.63 +/- 0.03", "0.63±0.03", " 0.63 ± 3e-2 ", "(0.63+/-0.03)"}) {
        CAPTURE(text);
        const UncertainRatio read = parse_uncertain_ratio(text);
        CHECK(read.numerator.value == 0.63);
        CHECK(read.numerator.uncertainty == 0.03);
        CHECK_FALSE(read.denominator.has_value());
    }
    CHECK_EXPECTED(parse_uncertain("0.63 +/- 5%").uncertainty, 0.05 * 0.63);
    CHECK_EXPECTED(parse_uncertain("0.63±5 %").relative(), 0.05);
    CHECK_EXPECTED(parse_uncertain("1/107+/-1%").relative(), 0.01);
    CHECK(parse_uncertain("1/107+/-1%").value == parse_number("1/107"));
    CHECK_EXPECTED(parse_uncertain("1/107+/-0.0001").uncertainty, 0.0001);
    CHECK_FALSE(parse_uncertain("0.63+/-0").is_uncertain());
}

TEST_CASE("a number without uncertainty is the same double as ever, whatever its sign") {
    for (const char* text : {"1/107", "0.63/0.59", "0.18", "-1", "0"}) {
        const UncertainRatio read = parse_uncertain_ratio(text);
        CHECK(read.value() == parse_number(text));
        CHECK_FALSE(read.is_uncertain());
    }
}

TEST_CASE("both values of a fraction with brackets keep their own uncertainty") {
    const UncertainRatio both = parse_uncertain_ratio("(0.63+/-5%)/(0.59 +/- 0.02)");
    CHECK(both.value() == parse_number("0.63/0.59"));
    CHECK_EXPECTED(both.numerator.uncertainty, 0.0315);
    REQUIRE(both.denominator.has_value());
    CHECK(both.denominator->uncertainty == 0.02);

    CHECK(parse_uncertain_ratio("(0.63+/-5%)/0.59").denominator->uncertainty == 0.0);
    const UncertainRatio below = parse_uncertain_ratio("0.63/(0.59+/-0.02)");
    CHECK(below.numerator.uncertainty == 0.0);
    CHECK(below.denominator->uncertainty == 0.02);
}

TEST_CASE("an uncertain quantity is read with its unit behind both numbers, behind each, or behind brackets") {
    for (const char* text : {"42.4+/-0.5 cm/s", "42.4 cm/s +/- 0.5 cm/s", "(42.4+/-0.5) cm/s", "42.4±0.5cm/s", "0.424 m/s +/- 5 mm/s"}) {
        CAPTURE(text);
        const auto read = parse_uncertain_quantity<Velocity>(text);
        CHECK(read.value == parse_quantity<Velocity>("42.4 cm/s"));
        CHECK_EXPECTED(read.uncertainty.value(), 0.005);
    }
    for (const char* text : {"0.511+/-2% g", "0.511 g +/- 2%", "(0.511+/-2%) g", "0.511g+/-2%"}) {
        CAPTURE(text);
        const auto read = parse_uncertain_quantity<Acceleration>(text);
        CHECK(read.value == parse_quantity<Acceleration>("0.511 g"));
        CHECK_EXPECTED(read.si().relative(), 0.02);
    }
    CHECK(parse_uncertain_quantity<Acceleration>("0.511 g").uncertainty == Acceleration{});
    CHECK(parse_uncertain_si("0.3+/-0.01", Dimension{}).uncertainty == 0.01);
}

TEST_CASE("what cannot be an uncertain number is refused with the culprit") {
    struct Case {
        const char* text;
        const char* message;
    };
    for (const Case& wanted : {
             Case{"0.63+/--0.03", "\"0.63+/--0.03\": the uncertainty is -0.03 (must not be negative); drop the sign"},
             Case{"0.63+/--5%", "the uncertainty is -0.0315 (must not be negative)"},
             Case{"0.63+/-nan", "the uncertainty \"nan\" is not a finite number; write one such as 0.03 or 5%"},
             Case{"0.63+/-inf", "the uncertainty \"inf\" is not a finite number"},
             Case{"0.63+/-", "the uncertainty \"\" is not a finite number"},
             Case{"1e300+/-1e300%", "the uncertainty is too large for a double"},
             Case{"-0.63+/-0.03", "the value is -0.63 (must be positive to carry an uncertainty)"},
             Case{"0+/-0.03", "the value is 0 (must be positive"},
             Case{"(0.63+/-5%)/(-0.59+/-5%)", "\"-0.59+/-5%\": the value is -0.59"},
             Case{"(0.63+/-5%)/0", "division by zero"},
             Case{"(0.63+/-5%", "a closing bracket is missing"},
             Case{"(0.63+/-5%)(0.59)", "unexpected \"(0.59)\" after the bracket"},
             Case{"(0.63+/-5%)/(0.59)2", "unexpected \"2\" behind the fraction"},
             Case{"0.63+/-0.03/0.59", "it is not clear what is divided; put brackets around both"},
             Case{"0.63+/-(0.03)", "a bracket must begin the number or follow a \"/\""},
             Case{"0.63+/-0.03 m", "unexpected \"m\" after the uncertainty; a plain number has no unit"},
             Case{"abc+/-0.03", "does not begin with a finite number"},
             Case{"", "does not begin with a finite number"},
         }) {
        CAPTURE(wanted.text);
        const std::string message = reading_message([&] { parse_uncertain_ratio(wanted.text); });
        CHECK_MESSAGE(message.find(wanted.message) != std::string::npos, message);
    }
    for (const Case& wanted : {
             Case{"42.4", "\"42.4\": the unit is missing"},
             Case{"42.4+/-0.5", "the unit is missing"},
             Case{"42.4 cm/s +/- 0.5", "the uncertainty has no unit; give it one, or a percentage"},
             Case{"42.4 cm/s +/- 1% cm/s", "there are two units; a percentage needs none of its own"},
             Case{"(42.4 cm/s +/- 1%) cm/s", "the unit belongs behind the brackets"},
             Case{"(42.4+/-0.5 cm/s", "a closing bracket is missing"},
             Case{"42.4+/-0.5 g", "a velocity is wanted"},
             Case{"-42.4+/-0.5 cm/s", "the value is -0.424 (must be positive"},
         }) {
        CAPTURE(wanted.text);
        const std::string message = reading_message([&] { parse_uncertain_quantity<Velocity>(wanted.text); });
        CHECK_MESSAGE(message.find(wanted.message) != std::string::npos, message);
    }
}

}  // namespace musim::scaling::tests
