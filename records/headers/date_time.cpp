#include "records/headers/date_time.hpp"

#include <array>

#include "records/detail/text.hpp"

namespace musim::records::detail {
namespace {

// three fields: between separators, or of fixed width when there are none
std::array<std::string_view, 3> split(std::string_view text, char separator, std::size_t first_width) {
    if (text.find(separator) != std::string_view::npos) {
        const std::string_view separators(&separator, 1);
        const std::string_view first = take_token(text, separators);
        const std::string_view second = take_token(text, separators);
        return {first, second, text.substr(text.empty() ? 0 : 1)};
    }
    if (text.size() < first_width + 4) return {};
    return {text.substr(0, first_width), text.substr(first_width, 2), text.substr(first_width + 2)};
}

// a number of at most four digits; -1, which no date holds, for anything else
int small_number(std::string_view text) {
    const std::optional<std::size_t> number = text.size() <= 4 ? parse_count(text) : std::nullopt;
    return number ? static_cast<int>(*number) : -1;
}

}  // namespace

std::optional<UtcTime> parse_date_time(std::string_view text, double hours_ahead) {
    constexpr std::string_view kGaps = " \t_-";
    constexpr std::size_t kYearDigits = 4;
    auto [year, month, day] = split(take_token(text, kGaps), '/', kYearDigits);
    if (day.size() == kYearDigits) std::swap(year, day);
    const auto [hour, minute, second_text] = split(take_token(text, kGaps), ':', 2);
    const std::optional<double> second = parse_real(second_text);
    if (!second) return std::nullopt;
    return make_utc_time(small_number(year), small_number(month), small_number(day), small_number(hour), small_number(minute), *second,
                         hours_ahead);
}

}  // namespace musim::records::detail
