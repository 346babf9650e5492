#include "records/formats/column_choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "records/detail/text.hpp"
#include "records/error.hpp"

namespace musim::records {

ColumnChoices parse_column_choices(std::string_view text) {
    ColumnChoices choices;
    while (true) {
        const std::size_t comma = text.find(',');
        const std::string_view entry = detail::trim(text.substr(0, comma));
        const std::size_t equals = entry.find('=');
        if (equals == std::string_view::npos) {
            throw ReadError(fmt::format("columns: '{}' is not NAME=COLUMN", entry), "write time=2,x=3, columns counted from 1");
        }
        choices.push_back({std::string(detail::trim(entry.substr(0, equals))), std::string(detail::trim(entry.substr(equals + 1)))});
        if (comma == std::string_view::npos) break;
        text.remove_prefix(comma + 1);
    }
    check_column_choices(choices);
    return choices;
}

void check_column_choices(const ColumnChoices& choices) {
    std::size_t components = 0;
    for (const ColumnChoice& choice : choices) {
        if (choice.name.empty() || choice.column.empty()) {
            throw ReadError(fmt::format("columns: '{}={}' is not NAME=COLUMN", choice.name, choice.column),
                            "write time=2,x=3, columns counted from 1");
        }
        if (!detail::equal_ignoring_case(choice.name, kTimeColumn)) ++components;
        const auto is_same = [&](const ColumnChoice& other) { return detail::equal_ignoring_case(other.name, choice.name); };
        if (std::count_if(choices.begin(), choices.end(), is_same) > 1) {
            throw ReadError(fmt::format("columns: '{}' is named twice", choice.name), "name each column once");
        }
    }
    if (components == 0) throw ReadError("columns: no component is among them (the time alone is no motion)", "add one, as x=2");
}

std::string to_string(const ColumnChoices& choices) {
    std::string text;
    for (const ColumnChoice& choice : choices) text += (text.empty() ? "" : ",") + choice.name + '=' + choice.column;
    return text;
}

}  // namespace musim::records
