#include "records/headers/header_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
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

std::optional<HeaderField> HeaderFields::find(std::string_view name) const {
    for (std::size_t index = 0; index < std::min(end_, file_->size()); ++index) {
        std::string_view line = file_->line(index);
        if (line.starts_with('#')) line.remove_prefix(1);
        line = trim(line);
        if (!equal_ignoring_case(line.substr(0, name.size()), name)) continue;
        line.remove_prefix(name.size());
        // a longer name that starts like this one is another field
        if (!line.empty() && !is_blank(line.front()) && line.front() != ':') continue;
        line = trim(line);
        if (line.starts_with(':')) line = trim(line.substr(1));
        if (line.empty()) return std::nullopt;
        return HeaderField{index, line};
    }
    return std::nullopt;
}

std::string_view HeaderFields::text(std::string_view name) const { return find(name).value_or(HeaderField{}).text; }

HeaderField HeaderFields::require(std::string_view name) const {
    const std::optional<HeaderField> field = find(name);
    if (!field) file_->fail(fmt::format("header has no '{}' (missing or empty)", name), "fetch the record again");
    return *field;
}

std::size_t HeaderFields::require_count(std::string_view name) const {
    const HeaderField field = require(name);
    const std::optional<std::size_t> count = parse_count(field.text);
    if (!count || *count == 0) {
        file_->fail(field.line, fmt::format("{} is {} (must be a positive integer)", name, quoted(field.text)), "correct the header");
    }
    return *count;
}

double HeaderFields::require_positive(std::string_view name) const {
    const HeaderField field = require(name);
    const std::optional<double> value = parse_real(field.text);
    if (!value || !(*value > 0.0)) {
        file_->fail(field.line, fmt::format("{} is {} (must be a positive number)", name, quoted(field.text)), "correct the header");
    }
    return *value;
}

SampleUnit HeaderFields::require_acceleration(std::string_view name) const {
    const HeaderField field = require(name);
    std::string_view rest = field.text;
    const std::optional<SampleUnit> unit = find_sample_unit(take_token(rest));
    if (unit && unit->quantity == SampleQuantity::acceleration) return *unit;
    file_->fail(field.line, fmt::format("{} is {} (no unit of acceleration)", name, quoted(field.text)), "correct the header");
}

std::optional<UtcTime> HeaderFields::find_time(std::string_view name, double hours_ahead) const {
    const std::optional<HeaderField> field = find(name);
    if (!field) return std::nullopt;
    const std::optional<UtcTime> time = parse_date_time(field->text, hours_ahead);
    if (!time) {
        file_->fail(field->line, fmt::format("{} is {} (no date and time)", name, quoted(field->text)), "correct the header");
    }
    return time;
}

}  // namespace musim::records::detail
