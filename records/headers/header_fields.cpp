#include "records/headers/header_fields.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "records/detail/text.hpp"
#include "records/headers/date_time.hpp"

namespace musim::records::detail {

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
