#include "scaling/number.hpp"

#include <doctest/doctest.h>

#include <string>

namespace musim::scaling::tests {

namespace {

std::string number_message(const char* text) {
    try {
        parse_number(text);
    } catch (const ParseError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("numbers and fractions are read to the last bit") {
    CHECK(parse_number("0.18") == 0.18);
    CHECK(parse_number("1e-3") == 1e-3);
    CHECK(parse_number("+2.5E+2") == 250.0);
    CHECK(parse_number("-.5") == -0.5);
    CHECK(parse_number("3.") == 3.0);
    CHECK(parse_number("0") == 0.0);
    CHECK(parse_number("1/107") == 1.0 / 107.0);
    CHECK(parse_number("0.63/0.59") == 0.63 / 0.59);
    CHECK(parse_number("  1 / 25\t") == 0.04);
    CHECK(parse_number("1/-4") == -0.25);
}

TEST_CASE("text that is no number is refused with the reason") {
    for (const char* junk : {"", "  ", "abc", "nan", "inf", "-inf", "+", ".", "e5", "/2", "--1"}) {
        CHECK(number_message(junk).find("does not begin with a finite number") != std::string::npos);
    }
    for (const char* trailing : {"1x", "1 2", "1/2/3", "1/", "1/nan", "1,5", "0x10", "1e", "5 m"}) {
        CHECK(number_message(trailing).find("after the number") != std::string::npos);
    }
    CHECK(number_message("1/0").find("division by zero") != std::string::npos);
    CHECK(number_message("1/0.0e7").find("division by zero") != std::string::npos);
    for (const char* out_of_range : {"1e400", "1e-400", "1e99999999999999999999", "1e2147483647", "1/1e-400"}) {
        CHECK(number_message(out_of_range).find("for a double") != std::string::npos);
    }
    CHECK(number_message("1e300/1e-300").find("the fraction is too large or too small") != std::string::npos);
    CHECK(number_message("1e-300/1e300").find("the fraction is too large or too small") != std::string::npos);
}

}  // namespace musim::scaling::tests
