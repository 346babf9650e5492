#include "records/formats/detail/announced_block.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"

namespace musim::records::detail {
namespace {

// without a format the first line of samples decides: eight right-justified numbers of equal width
FixedColumns infer_columns(const TextFile& file, std::size_t line, std::size_t count) {
    const FixedColumns usual;
    const std::size_t values = std::min(count, usual.per_line);
    const std::size_t length = file.line(line + 1).size();
    if (length == 0 || length % values != 0) {
        file.fail(line + 1, fmt::format("column width cannot be found ({} letters for {} values)", length, values),
                  "add the Fortran format, e.g. (8f10.3), to the line above");
    }
    return {.per_line = usual.per_line, .width = length / values};
}

SampleUnit read_unit(const TextFile& file, std::size_t index, const std::optional<SampleUnit>& usual) {
    const std::string_view line = file.line(index);
    for (const std::string_view phrase :
         {std::string_view("UNITS OF"), std::string_view("UNITS:"), std::string_view("IN UNITS"), std::string_view(", IN ")}) {
        const std::size_t found = find_ignoring_case(line, phrase);
        if (found == std::string_view::npos) continue;
        std::string_view rest = line.substr(found + phrase.size());
        const std::string_view name = take_token(rest, " )");
        if (const std::optional<SampleUnit> unit = find_sample_unit(name)) return *unit;
        file.fail(index, fmt::format("unit {} is unknown (known: {})", quoted(name), sample_unit_names()), "correct the line");
    }
    if (usual) return *usual;
    file.fail(index, "unit is missing (no 'units of')", "write e.g. 'in units of g'");
}

}  // namespace

bool announces_samples(std::string_view line) {
    return contains_ignoring_case(line, "ACCELEROGRAM POINTS AT") || contains_ignoring_case(line, "DATA EQUALLY SPACED AT");
}

BlockHeader read_block_header(const TextFile& file, std::size_t index, const std::optional<SampleUnit>& usual) {
    const std::string_view line = file.line(index);
    BlockHeader header{.line = index, .unit = read_unit(file, index, usual)};

    std::string_view rest = line;
    header.count = checked_count(file, index, take_token(rest));

    rest = line.substr(find_ignoring_case(line, " AT ") + 4);
    const std::string_view number = take_token(rest);
    const bool is_rate = find_ignoring_case(trim(rest), "PTS") == 0;
    const std::optional<double> step = parse_real(number);
    if (!step) file.fail(index, fmt::format("time step {} is no number", quoted(number)), "correct the line");
    header.dt = checked_dt(file, index, is_rate ? 1.0 / *step : *step);

    header.columns = find_columns(line).value_or(FixedColumns{});
    if (header.columns.width == 0) header.columns = infer_columns(file, index, header.count);
    return header;
}

}  // namespace musim::records::detail
