#include "records/headers/station_codes.hpp"

#include <algorithm>

#include "records/detail/text.hpp"

namespace musim::records::detail {
namespace {

bool is_code(std::string_view text, std::size_t longest) {
    return !text.empty() && text.size() <= longest &&
           std::all_of(text.begin(), text.end(), [](char letter) { return is_digit(letter) || (letter >= 'A' && letter <= 'Z'); });
}

}  // namespace

StationCodes split_station(std::string_view text, std::string_view unknown) {
    constexpr std::size_t kNetwork = 2;
    constexpr std::size_t kStation = 5;
    std::string_view rest = text;
    const std::string_view codes = take_token(rest);
    const std::size_t dot = codes.find('.');
    if (dot != std::string_view::npos && is_code(codes.substr(0, dot), kNetwork) && is_code(codes.substr(dot + 1), kStation)) {
        return {std::string(codes.substr(0, dot)), std::string(codes.substr(dot + 1)), printable(trim(rest))};
    }
    return {.station = std::string(unknown), .name = printable(trim(text))};
}

}  // namespace musim::records::detail
