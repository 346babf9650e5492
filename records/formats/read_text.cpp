#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/text_clock.hpp"
#include "records/formats/detail/text_heading.hpp"
#include "records/formats/detail/text_layout.hpp"
#include "records/formats/detail/text_samples.hpp"
#include "records/formats/detail/text_table.hpp"

namespace musim::records::detail {
namespace {

/// Lines of text above the numbers are titles when they are understood; a longer text may be a format that nobody knows here.
void refuse_unknown_header(const TextFile& file, const TextHeading& heading, const ReadOptions& options) {
    if (!heading.free_text || heading.is_understood || options.columns || options.skipped_lines) return;
    file.fail(*heading.free_text, fmt::format("unknown format ({} is no row of numbers)", quoted(trim(file.line(*heading.free_text)))),
              {"convert it to PEER AT2, CSMIP V1/V2 or columns of numbers, or give ", Setting::skipped_lines});
}

/// Refuses a line that begins like a row of the table and holds a wrong number: it is no title.
void refuse_damaged_first_row(const TextFile& file, const TextTable& table) {
    if (table.header.empty() || table.header.back().is_comment) return;
    const TextLine& last = table.header.back();
    std::vector<std::string_view> cells;
    split_row(last.text, table.syntax, cells);
    const bool begins_with_number = !cells.empty() && cells.size() == table.columns() && cells.size() > 1 &&
                                    cells.front().find('.') != std::string_view::npos &&
                                    std::string_view("0123456789+-.").find(cells.front().front()) != std::string_view::npos;
    if (!begins_with_number) return;
    CellReader reader(table.syntax);
    const auto bad =
        std::find_if(cells.begin(), cells.end(), [&](std::string_view cell) { return reader.read(cell).kind == CellKind::text; });
    if (bad == cells.end()) return;
    file.fail(last.line, fmt::format("sample 1 is {} (no finite number)", quoted(*bad)), "repair the value or fetch the file again");
}

/// Values of a column, in SI.
std::vector<double> take_samples(const TextFile& file, const TextTable& table, const SampleColumn& chosen) {
    std::vector<double> samples;
    samples.reserve(table.rows.size());
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        samples.push_back(table.at(row, chosen.column) * chosen.unit.si);
        if (!std::isfinite(samples.back()))
            file.fail(table.rows[row].line, fmt::format("sample {} overflows in SI", row + 1), "check the unit");
    }
    return samples;
}

/// The name of a component: its column's, or its number where it has none or shares it.
std::string name_component(const std::vector<SampleColumn>& columns, std::size_t i) {
    const auto has_name = [&](const SampleColumn& other) { return equal_ignoring_case(other.name, columns[i].name); };
    const bool is_own = !columns[i].name.empty() && std::count_if(columns.begin(), columns.end(), has_name) == 1;
    return is_own ? columns[i].name : std::to_string(i + 1);
}

std::string list_units(const ChosenSamples& chosen) {
    std::vector<std::string_view> units;
    for (const SampleColumn& column : chosen.columns)
        if (std::find(units.begin(), units.end(), column.unit.name) == units.end()) units.push_back(column.unit.name);
    return fmt::format("{}", fmt::join(units, ", "));
}

std::string list_quantities(const ChosenSamples& chosen) {
    std::vector<std::string_view> quantities;
    for (const SampleColumn& column : chosen.columns) {
        const std::string_view name = to_string(column.unit.quantity);
        if (std::find(quantities.begin(), quantities.end(), name) == quantities.end()) quantities.push_back(name);
    }
    return fmt::format("{}", fmt::join(quantities, " and "));
}

GroundMotion parse_columns(const TextFile& file, const ReadOptions& options) {
    TextTable table = read_text_table(file);
    const TextHeading heading = read_text_heading(file, table);
    refuse_unknown_header(file, heading, options);
    refuse_damaged_first_row(file, table);
    const TextLayout layout = find_text_layout(file, table, heading, options);
    const ChosenSamples chosen = choose_samples(file, table, heading, layout, options);
    const TextClock clock = find_text_clock(file, table, heading, layout, options);
    const scaling::Time dt = clock.dt * scaling::si::seconds;
    refuse_contradictions(file, {.dt = options.dt}, chosen.columns.front().unit, dt);

    GroundMotion motion{.source = file.path().string(), .format = std::string(kTextFormat)};
    motion.time_zero = clock.zero;
    for (std::size_t i = 0; i < chosen.columns.size(); ++i) {
        motion.components.push_back({.name = name_component(chosen.columns, i),
                                     .azimuth_deg = std::nullopt,
                                     .series = {chosen.columns[i].unit.quantity, clock.start * scaling::si::seconds, dt,
                                                take_samples(file, table, chosen.columns[i])}});
    }
    const std::string name = file.path().filename().string();
    motion.history.push_back(fmt::format("read text from {} as {} in {}{}{}", name, list_quantities(chosen), list_units(chosen),
                                         chosen.is_unit_given ? "" : kUnitNotGiven, layout.is_series ? ", several values a line" : ""));
    for (const std::string& note : chosen.notes) motion.history.push_back(fmt::format("{}{}: {}", kReadingNote, name, note));
    return motion;
}

}  // namespace

GroundMotion parse_text(const TextFile& file, const ReadOptions& options) {
    if (file.line(0) != kMusimCsvTitle) return parse_columns(file, options);
    if (options.columns) file.fail("format is musim CSV (its columns are known)", {"drop ", Setting::columns});
    return parse_musim_csv(file, options);
}

}  // namespace musim::records::detail
