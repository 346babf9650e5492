#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/table.hpp"
#include "records/headers/header_checks.hpp"

namespace musim::records::detail {
namespace {

/// Two numbers of a line, as they are printed.
struct NumberPair {
    std::string_view first;
    std::string_view second;
};

std::optional<NumberPair> find_pair(std::string_view line) {
    constexpr std::string_view kPairSeparators = " \t,";
    NumberPair pair;
    pair.first = take_token(line, kPairSeparators);
    pair.second = take_token(line, kPairSeparators);
    if (!parse_real(pair.first) || !parse_real(pair.second) || !take_token(line, kPairSeparators).empty()) return std::nullopt;
    return pair;
}

std::size_t first_written_line(const TextFile& file) {
    std::size_t line = 0;
    while (line < file.size() && trim(file.line(line)).empty()) ++line;
    return line;
}

// the header's step where it makes the times as they are printed; else that of the times, where the header rounds it
scaling::Time choose_step(const TextFile& file, std::size_t index, const NumberPair& counts, const NumberTable& table) {
    const std::vector<double>& times = table.columns[0];
    const double of_times = even_time_step(file, times, table.lines);
    const double stated = *parse_real(counts.second);
    const double spans = static_cast<double>(times.size() - 1);
    const double printed = 2.0 * half_last_digit(text_in_table(file, table, table.rows() - 1, 0));
    if (std::abs(times.back() - times.front() - spans * stated) <= printed + 1e-9 * spans * stated) return checked_dt(file, index, stated);
    if (std::abs(of_times - stated) <= half_last_digit(counts.second)) return checked_dt(file, index, of_times);
    file.fail(index, fmt::format("time step is {} s (the times below are {} s apart)", counts.second, of_times),
              "correct the step or fetch the record again");
}

}  // namespace

bool looks_like_deepsoil(const TextFile& file) {
    const std::size_t index = first_written_line(file);
    const std::optional<NumberPair> counts = find_pair(file.line(index));
    const std::optional<NumberPair> first = find_pair(file.line(index + 1));
    const std::optional<NumberPair> second = find_pair(file.line(index + 2));
    if (!counts || !first || !second || !parse_count(counts->first)) return false;

    // a time would not fall from the first row to the second, and rows are the step apart that the first one names
    const double stated = *parse_real(counts->second);
    const double start = *parse_real(first->first);
    const double step = *parse_real(second->first) - start;
    const double printed = half_last_digit(first->first) + half_last_digit(second->first) + half_last_digit(counts->second);
    return start < *parse_real(counts->first) && step > 0.0 && stated > 0.0 && std::abs(step - stated) <= printed + 1e-9 * stated;
}

GroundMotion parse_deepsoil(const TextFile& file, const ReadOptions& options) {
    const std::size_t index = first_written_line(file);
    const std::optional<NumberPair> counts = find_pair(file.line(index));
    if (!counts)
        file.fail(std::min(index, file.size()), "first line is no number of points and time step", "write both, as in '2000 0.005'");
    const std::size_t count = checked_count(file, index, counts->first);

    // DEEPSOIL takes accelerations in g; the file does not say so
    const bool is_unit_given = options.unit || options.quantity;
    const SampleUnit unit = is_unit_given ? requested_unit(file, options) : *find_sample_unit("g");
    NumberTable table = read_table(file, index + 1, std::array{1.0, unit.si});
    check_rows(file, table, {count, "number of points"});
    const scaling::Time dt = choose_step(file, index, *counts, table);
    refuse_contradictions(file, {.dt = options.dt}, unit, dt);

    GroundMotion motion{.source = file.path().string(), .format = "DEEPSOIL"};
    motion.components.push_back(
        {.name = "1", .series = {unit.quantity, table.columns[0].front() * scaling::si::seconds, dt, std::move(table.columns[1])}});
    motion.history.push_back(fmt::format("read {} from {} in {}{}", motion.format, file.path().filename().string(), unit.name,
                                         is_unit_given ? "" : kUnitNotGiven));
    return motion;
}

}  // namespace musim::records::detail
