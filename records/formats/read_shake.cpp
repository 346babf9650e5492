#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/headers/fixed_columns.hpp"

namespace musim::records::detail {
namespace {

/// Numbers of a line in columns of one width, which may touch: their decimal points stand evenly.
struct PointedRow {
    std::size_t count = 0;
    std::size_t width = 0;        ///< letters from point to point; 0 of a single number
    std::size_t first_point = 0;  ///< letters before it
    std::size_t decimals = 0;     ///< letters behind a point, its exponent among them
    std::string_view index = {};  ///< whole number behind the columns
    bool touches = false;         ///< numbers stand without a blank between them

    bool continues(const PointedRow& above) const {
        return first_point == above.first_point && decimals == above.decimals && count <= above.count &&
               (width == above.width || count == 1) && index.empty() == above.index.empty();
    }
};

// digits and what Fortran's F, E and D formats put around them
bool is_of_numbers(std::string_view line) { return line.find_first_not_of(" 0123456789.+-eEdD") == std::string_view::npos; }

// letters of digits and exponent from `at` on
std::size_t length_of_decimals(std::string_view line, std::size_t at) {
    std::size_t end = at;
    while (end < line.size() && is_digit(line[end])) ++end;
    if (end + 1 < line.size() && std::string_view("eEdD").find(line[end]) != std::string_view::npos) {
        end += 2;  // the letter and a sign or digit
        while (end < line.size() && is_digit(line[end])) ++end;
    }
    return end - at;
}

std::optional<PointedRow> find_pointed_row(std::string_view line) {
    if (!is_of_numbers(line)) return std::nullopt;
    PointedRow row;
    std::size_t last = std::string_view::npos;
    for (std::size_t point = line.find('.'); point != std::string_view::npos; point = line.find('.', point + 1)) {
        if (row.count == 0) row.first_point = point;
        if (row.count == 1) row.width = point - last;
        if (row.count > 1 && point - last != row.width) return std::nullopt;
        if (row.count > 0) row.touches = row.touches || line.substr(last, point - last).find(' ') == std::string_view::npos;
        last = point;
        ++row.count;
    }
    if (row.count == 0) return std::nullopt;
    row.decimals = length_of_decimals(line, last + 1);
    row.index = trim(line.substr(last + 1 + row.decimals));
    if (!row.index.empty() && !parse_count(row.index)) return std::nullopt;
    return row;
}

/// Lines of numbers in columns below a header of any text.
struct ColumnLayout {
    std::size_t first = 0;  ///< line
    std::size_t end = 0;    ///< line behind the last that is not empty
    std::size_t rows = 0;
    std::size_t misfits = 0;  ///< rows whose numbers do not stand in the columns of the first
    PointedRow row;
    std::optional<FixedColumns> stated = {};  ///< Fortran format of the header
    bool touches = false;                     ///< numbers of some row stand without a blank between them
};

/// The first numbers of all rows: where they only rise they are times, and the rows a table.
struct FirstColumn {
    std::size_t rows = 0;
    double last = 0.0;
    bool rises = true;

    void add(std::string_view text) {
        const double number = parse_real(trim(text)).value_or(last);
        rises = rises && (rows == 0 || number > last);
        last = number;
        ++rows;
    }
    bool is_time() const {
        constexpr std::size_t kFewest = 5;  // rows; no motion rises at every eighth sample for longer
        return rises && rows >= kFewest;
    }
};

// a row that one of the next lines continues: damage of a line between them must not make a header of the first
std::optional<PointedRow> find_first_row(const TextFile& file, std::size_t index) {
    constexpr std::size_t kNext = 3;  // lines
    const std::optional<PointedRow> row = find_pointed_row(file.line(index));
    if (!row || row->count < 2) return std::nullopt;
    for (std::size_t next = index + 1; next <= index + kNext; ++next) {
        const std::optional<PointedRow> below = find_pointed_row(file.line(next));
        if (below && below->count > 1 && below->continues(*row)) return row;
    }
    return std::nullopt;
}

// rows of numbers in even columns, whatever stands above them; nothing where their first numbers are times
std::optional<ColumnLayout> find_layout(const TextFile& file) {
    constexpr std::size_t kLongestHeader = 30;  // lines
    ColumnLayout layout;
    std::optional<PointedRow> first;
    for (; layout.first < std::min(file.size(), kLongestHeader); ++layout.first) {
        first = find_first_row(file, layout.first);
        if (first) break;
        if (!layout.stated) layout.stated = find_columns(file.line(layout.first));
    }
    if (!first) return std::nullopt;

    layout.row = *first;
    FirstColumn first_column;
    for (std::size_t index = layout.first; index < file.size(); ++index) {
        if (trim(file.line(index)).empty()) continue;
        layout.end = index + 1;
        const std::optional<PointedRow> row = find_pointed_row(file.line(index));
        ++layout.rows;
        if (!row || !row->continues(layout.row)) {
            ++layout.misfits;
            continue;
        }
        layout.touches = layout.touches || row->touches;
        first_column.add(file.line(index).substr(0, row->first_point + 1 + row->decimals));
    }
    if (first_column.is_time()) return std::nullopt;
    return layout;
}

// a header line of nothing but numbers, or all but a letter or two, is a damaged row
void refuse_rows_in_header(const TextFile& file, const ColumnLayout& layout) {
    constexpr std::ptrdiff_t kMostPoints = 2;
    constexpr std::ptrdiff_t kMostLetters = 2;
    for (std::size_t index = 0; index < layout.first; ++index) {
        const std::string_view line = file.line(index);
        const auto points = std::count(line.begin(), line.end(), '.');
        const auto letters =
            std::count_if(line.begin(), line.end(), [](char letter) { return !is_of_numbers(std::string_view(&letter, 1)); });
        if (points <= kMostPoints || letters > kMostLetters) continue;
        file.fail(index, fmt::format("{} does not stand in the columns of line {}", quoted(line), layout.first + 1),
                  "repair the line or fetch the file again");
    }
}

/// Numbers and unit in the text of the header.
struct ShakeHeader {
    std::optional<double> step = {};  ///< [s]
    std::optional<std::size_t> count = {};
    std::size_t step_line = 0;
    std::size_t count_line = 0;
    std::optional<SampleUnit> unit = {};
};

// the number behind a label and its "=", ":" or unit: "DT = 0.02 SEC", "TIME STEP (s): 0.02"
std::optional<double> number_behind(std::string_view line, std::string_view label) {
    const std::size_t at = find_ignoring_case(line, label);
    if (at == std::string_view::npos ||
        (at > 0 && !is_blank(line[at - 1]) && std::string_view(",;(").find(line[at - 1]) == std::string_view::npos))
        return std::nullopt;
    std::string_view rest = line.substr(at + label.size());
    if (!rest.empty() && std::string_view(" \t=:(").find(rest.front()) == std::string_view::npos) return std::nullopt;
    if (trim(rest).starts_with('(')) rest = rest.substr(std::min(rest.find(')'), rest.size() - 1) + 1);
    return parse_real(take_token(rest, " \t=:,;"));
}

// a unit in parentheses, "(cm/s2)", or behind the word: "UNITS OF G", "Units: cm/sec/sec"
std::optional<SampleUnit> find_shake_unit(std::string_view line) {
    for (std::size_t open = line.find('('); open != std::string_view::npos; open = line.find('(', open + 1)) {
        const std::size_t close = line.find(')', open);
        if (close == std::string_view::npos) break;
        if (const std::optional<SampleUnit> unit = find_sample_unit(line.substr(open, close - open))) return unit;
    }
    constexpr std::string_view kWord = "UNITS";
    const std::size_t at = find_ignoring_case(line, kWord);
    std::string_view rest = at == std::string_view::npos ? std::string_view{} : line.substr(at + kWord.size());
    constexpr int kWords = 3;  // "are", "of", ...
    for (int i = 0; i < kWords; ++i)
        if (const std::optional<SampleUnit> unit = find_sample_unit(take_token(rest, " \t:=,"))) return unit;
    return std::nullopt;
}

void read_shake_line(const TextFile& file, std::size_t index, ShakeHeader& header) {
    const std::string_view line = file.line(index);
    for (const std::string_view label : {"DT", "DELTA T", "TIME STEP", "TIME INTERVAL", "SAMPLING INTERVAL"}) {
        const std::optional<double> step = number_behind(line, label);
        if (!step || header.step) continue;
        header.step = step;
        header.step_line = index;
    }
    for (const std::string_view label : {"NO. OF POINTS", "NUMBER OF POINTS", "NUMBER OF VALUES", "NO. OF VALUES", "NPTS", "NV"}) {
        const std::optional<double> count = number_behind(line, label);
        constexpr double kMost = 1e9;  // values; more no text file holds
        if (!count || header.count || !(*count >= 1.0 && *count <= kMost) || *count != std::floor(*count)) continue;
        header.count = static_cast<std::size_t>(*count);
        header.count_line = index;
    }
    if (!header.unit) header.unit = find_shake_unit(line);

    // "2000 0.005"
    std::string_view rest = line;
    const std::optional<std::size_t> count = parse_count(take_token(rest));
    const std::optional<double> step = parse_real(take_token(rest));
    constexpr double kLongestStep = 1.0;  // [s]
    if (count && *count > 0 && step && *step > 0.0 && *step < kLongestStep && !header.count && !header.step) {
        header.count = count;
        header.step = step;
        header.count_line = header.step_line = index;
    }
}

ShakeHeader read_shake_header(const TextFile& file, const ColumnLayout& layout) {
    ShakeHeader header;
    for (std::size_t index = 0; index < layout.first; ++index) read_shake_line(file, index, header);
    return header;
}

scaling::Time find_shake_step(const TextFile& file, const ShakeHeader& header, const ReadOptions& options) {
    if (header.step) return checked_dt(file, header.step_line, *header.step);
    if (!options.dt) file.fail("time step is unknown (columns of one component, no time)", Remedy{"give ", Setting::time_step});
    if (!(options.dt->value() > 0.0) || !std::isfinite(options.dt->value())) {
        file.fail(fmt::format("time step is {} s (must be positive)", options.dt->value()), Remedy{"correct ", Setting::time_step});
    }
    return *options.dt;
}

// the columns of one line, checked against those of the first
void read_shake_row(const TextFile& file, std::size_t index, const ColumnLayout& layout, double si, std::vector<double>& samples) {
    const std::string_view line = file.line(index);
    const std::optional<PointedRow> row = find_pointed_row(line);
    if (!row || !row->continues(layout.row) || (row->count < layout.row.count && index + 1 < layout.end)) {
        file.fail(index,
                  fmt::format("{} does not stand in the columns of line {} ({} numbers of {} letters)", quoted(line), layout.first + 1,
                              layout.row.count, layout.row.width),
                  "repair the line or fetch the file again");
    }
    for (std::size_t i = 0; i < row->count; ++i) {
        const std::size_t end = row->first_point + 1 + row->decimals + i * layout.row.width;
        const std::size_t begin = end > layout.row.width ? end - layout.row.width : 0;
        samples.push_back(checked_sample(file, index, trim(line.substr(begin, end - begin)), samples.size() + 1, si));
    }
    if (layout.row.index.empty()) return;
    const std::size_t expected = *parse_count(layout.row.index) + index - layout.first;
    if (parse_count(row->index) != expected) {
        file.fail(index, fmt::format("line is numbered {} (expected: {}; a line is missing or repeated)", row->index, expected),
                  "fetch the file again");
    }
}

// a last line filled up with zeros has more values than are announced
void cut_to_count(const TextFile& file, const ShakeHeader& header, std::size_t per_line, std::vector<double>& samples) {
    if (!header.count || *header.count == samples.size()) return;
    const bool is_filled = *header.count < samples.size() && samples.size() - *header.count < per_line &&
                           std::all_of(samples.begin() + static_cast<std::ptrdiff_t>(*header.count), samples.end(),
                                       [](double sample) { return sample == 0.0; });
    if (!is_filled) {
        file.fail(header.count_line, fmt::format("{} values announced (found: {})", *header.count, samples.size()),
                  "correct the number or fetch the file again");
    }
    samples.resize(*header.count);
}

}  // namespace

// columns that blanks alone would not part (numbers touch), or would part wrongly (an index behind them), that a header describes, or
// SHAKE's own (8F9.6)
bool looks_like_shake(const TextFile& file) {
    const std::optional<ColumnLayout> layout = find_layout(file);
    if (!layout) return false;
    const PointedRow& row = layout->row;
    // blanks part numbers of any width; damage is rare
    constexpr std::size_t kRowsOfDamage = 10;
    if (!layout->touches && kRowsOfDamage * layout->misfits > layout->rows) return false;
    if (layout->touches || layout->stated || (row.count == 8 && row.width == 9 && row.decimals == 6)) return true;
    // two or three numbers, and a whole one behind them, may be any table
    constexpr std::size_t kFewestInRow = 4;
    if (row.count < kFewestInRow) return false;
    const std::optional<PointedRow> second = find_pointed_row(file.line(layout->first + 1));
    const bool is_numbered = !row.index.empty() && second && parse_count(second->index) == *parse_count(row.index) + 1;
    return is_numbered || (layout->first > 0 && read_shake_header(file, *layout).step);
}

GroundMotion parse_shake(const TextFile& file, const ReadOptions& options) {
    const std::optional<ColumnLayout> layout = find_layout(file);
    if (!layout) file.fail("no lines of numbers in columns", "check the file");
    refuse_rows_in_header(file, *layout);
    const ShakeHeader header = read_shake_header(file, *layout);
    if (layout->stated && (layout->stated->width != layout->row.width || layout->stated->per_line != layout->row.count)) {
        file.fail(layout->first,
                  fmt::format("{} numbers, {} letters apart (the header's format has {} of {} letters)", layout->row.count,
                              layout->row.width, layout->stated->per_line, layout->stated->width),
                  "correct the format");
    }

    // SHAKE takes accelerations in g; without a header the file does not say so
    const bool is_unit_given = header.unit || options.unit || options.quantity;
    const SampleUnit unit = header.unit ? *header.unit : is_unit_given ? requested_unit(file, options) : *find_sample_unit("g");
    const scaling::Time dt = find_shake_step(file, header, options);
    refuse_contradictions(file, {.dt = options.dt, .unit = header.unit ? options.unit : std::nullopt, .quantity = options.quantity}, unit,
                          dt);

    std::vector<double> samples;
    for (std::size_t index = layout->first; index < layout->end; ++index) read_shake_row(file, index, *layout, unit.si, samples);
    cut_to_count(file, header, layout->row.count, samples);

    GroundMotion motion{.source = file.path().string(), .format = "SHAKE columns"};
    if (layout->first > 0) motion.event = trim(file.line(0));
    const std::size_t count = samples.size();
    motion.components.push_back({.name = "1", .series = {unit.quantity, 0.0 * scaling::si::seconds, dt, std::move(samples)}});
    motion.history.push_back(fmt::format("read {} from {}, {} values, {} a line in columns of {} letters, in {}{}", motion.format,
                                         file.path().filename().string(), count, layout->row.count, layout->row.width, unit.name,
                                         is_unit_given ? "" : kUnitNotGiven));
    return motion;
}

}  // namespace musim::records::detail
