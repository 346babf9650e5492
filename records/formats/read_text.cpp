#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/formats/detail/table.hpp"
#include "records/formats/resample_uneven.hpp"

namespace musim::records::detail {
namespace {

/// Two to three columns without time are components; more are one component written several values a line (docs/user/record_formats.md).
constexpr std::size_t kMostUntimedComponents = 3;

struct Row {
    std::size_t line = 0;   ///< index in the file
    std::size_t first = 0;  ///< of its values
    std::size_t size = 0;
};

/// All numbers of a file, row by row.
struct Table {
    std::vector<double> values;
    std::vector<Row> rows;
    std::string_view title;  ///< the line before the numbers, or the last comment there

    std::size_t columns() const { return rows.front().size; }
    double at(std::size_t row, std::size_t column) const { return values[rows[row].first + column]; }
};

bool is_comment(std::string_view line) { return line.starts_with('#') || line.starts_with('%') || line.starts_with("//"); }

constexpr std::string_view kCellSeparators = " \t,;";

bool is_numeric_row(std::string_view line) {
    for (std::string_view token = take_token(line, kCellSeparators); !token.empty(); token = take_token(line, kCellSeparators)) {
        if (!parse_real(token)) return false;
    }
    return true;
}

/// Number of commas that may be decimal ones: digits to both sides.
std::size_t count_commas_in_numbers(std::string_view line) {
    std::size_t count = 0;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
        if (line[i] == ',' && is_digit(line[i - 1]) && is_digit(line[i + 1])) ++count;
    }
    return count;
}

// "0,02 -3,0": blanks beside no comma part the cells, so that the commas are within them
bool has_blanks_between_cells(std::string_view line) {
    for (std::size_t i = 1; i < line.size(); ++i) {
        if (!is_blank(line[i - 1]) || is_blank(line[i]) || line[i] == ',') continue;
        if (line[line.find_last_not_of(" \t", i - 1)] != ',') return true;
    }
    return false;
}

// decimal commas and empty cells would shift values into other columns unseen
void refuse_ambiguous_separators(const TextFile& file, std::size_t index) {
    const std::string_view line = trim(file.line(index));
    if (line.find(';') != std::string_view::npos && line.find(',') != std::string_view::npos) {
        file.fail(index, "both ',' and ';' on a line (decimal commas are not read)", "write decimal points");
    }
    if (count_commas_in_numbers(line) > 0 && has_blanks_between_cells(line)) {
        file.fail(index, "both blanks and ',' between numbers (decimal commas are not read)", "write decimal points");
    }
    std::size_t values_since_separator = 0;
    for (std::string_view rest = line; !rest.empty(); rest.remove_prefix(1)) {
        if (rest.front() != ',' && rest.front() != ';') {
            values_since_separator += is_blank(rest.front()) ? 0 : 1;
            continue;
        }
        if (values_since_separator == 0) file.fail(index, "empty value between separators", "fill it or remove the row");
        values_since_separator = 0;
    }
}

Table read_table(const TextFile& file) {
    Table table;
    bool has_title = false;
    bool may_be_decimal_commas = true;  // "-1,5" in every row
    for (std::size_t index = 0; index < file.size(); ++index) {
        const std::string_view line = trim(file.line(index));
        if (line.empty()) continue;
        if (is_comment(line)) {
            if (table.rows.empty() && !has_title) table.title = line;
            continue;
        }
        if (table.rows.empty() && !is_numeric_row(line)) {
            if (has_title) {
                file.fail(index, fmt::format("unknown format ({} is no row of numbers)", quoted(line)),
                          "convert it to PEER AT2, CSMIP V1/V2 or columns of numbers");
            }
            has_title = true;
            table.title = line;
            continue;
        }
        refuse_ambiguous_separators(file, index);
        may_be_decimal_commas = may_be_decimal_commas && line.find('.') == std::string_view::npos && count_commas_in_numbers(line) == 1 &&
                                std::count(line.begin(), line.end(), ',') == 1;
        Row row{.line = index, .first = table.values.size()};
        std::string_view rest = line;
        for (std::string_view token = take_token(rest, kCellSeparators); !token.empty(); token = take_token(rest, kCellSeparators)) {
            table.values.push_back(checked_sample(file, index, token, table.rows.size() + 1, 1.0));
        }
        row.size = table.values.size() - row.first;
        table.rows.push_back(row);
    }
    if (may_be_decimal_commas && !table.rows.empty()) {
        file.fail(table.rows.front().line, "one ',' within every row, no '.' and no sign behind it (decimal commas are not read)",
                  "write decimal points, or a blank behind commas that part columns");
    }
    if (table.rows.empty()) file.fail("unknown format (no row of numbers)", "convert it to PEER AT2, CSMIP V1/V2 or columns of numbers");
    return table;
}

// "4684 0.0100" above one value a line: number of points and time step
bool has_counts_row(const Table& table) {
    if (table.rows.size() < 3 || table.columns() != 2 || table.at(0, 0) != std::floor(table.at(0, 0))) return false;
    for (std::size_t row = 1; row < table.rows.size(); ++row) {
        if (table.rows[row].size != 1) return false;
    }
    return true;
}

// rows are equally long; one component written several values a line may end in a shorter row
void require_even_rows(const TextFile& file, const Table& table) {
    for (std::size_t row = 1; row < table.rows.size(); ++row) {
        const std::size_t size = table.rows[row].size;
        const bool is_short_end = row + 1 == table.rows.size() && size < table.columns() && table.columns() > kMostUntimedComponents;
        if (size != table.columns() && !is_short_end) {
            file.fail(table.rows[row].line, fmt::format("{} values (the rows above have {})", size, table.columns()), "repair the row");
        }
    }
}

// time step when the first column is time: increases throughout and evenly; refuses what increases but unevenly
std::optional<double> find_time_step(const TextFile& file, const Table& table) {
    const std::size_t rows = table.rows.size();
    if (table.columns() < 2 || rows < 2) return std::nullopt;
    std::size_t increasing = 0;
    for (std::size_t row = 1; row < rows; ++row) increasing += table.at(row, 0) > table.at(row - 1, 0) ? 1U : 0U;
    // nine of ten: times with a slip in them still look like times, no motion rises that long
    if (10 * increasing < 9 * (rows - 1)) return std::nullopt;

    std::vector<double> times;
    std::vector<std::size_t> lines;
    for (std::size_t row = 0; row < rows; ++row) {
        times.push_back(table.at(row, 0));
        lines.push_back(table.rows[row].line);
    }
    return even_time_step(file, times, lines);
}

// a unit in parentheses in the title, as in "time(sec) N-S(cm/s/s) E-W(cm/s/s)"
std::optional<SampleUnit> find_title_unit(const TextFile& file, std::string_view title) {
    std::optional<SampleUnit> found;
    for (std::size_t open = title.find_first_of("(["); open != std::string_view::npos; open = title.find_first_of("([", open + 1)) {
        const std::size_t close = title.find_first_of(")]", open);
        if (close == std::string_view::npos) break;
        const std::optional<SampleUnit> unit = find_sample_unit(title.substr(open + 1, close - open - 1));
        if (!unit) continue;
        if (found && found->name != unit->name) {
            file.fail(fmt::format("title names two units, {} and {} (columns must hold one quantity)", found->name, unit->name),
                      Remedy{"split the file or give ", Setting::unit});
        }
        found = unit;
    }
    return found;
}

/// What the samples are in, and who says so.
struct ChosenUnit {
    SampleUnit unit;
    bool is_reported = true;
};

ChosenUnit choose_unit(const TextFile& file, std::string_view title, const ReadOptions& options) {
    if (!options.unit) {
        if (const std::optional<SampleUnit> unit = find_title_unit(file, title)) {
            if (options.quantity && *options.quantity != unit->quantity) {
                file.fail(fmt::format("title names the unit {} (asked for: {})", unit->name, to_string(*options.quantity)),
                          Remedy{"give ", Setting::unit});
            }
            return {*unit};
        }
    }
    return {requested_unit(file, options), options.unit.has_value()};
}

// every `step`-th value from `first`, in SI
std::vector<double> take_samples(const TextFile& file, const std::vector<double>& values, std::size_t first, std::size_t step, double si) {
    std::vector<double> samples;
    for (std::size_t i = first; i < values.size(); i += step) {
        samples.push_back(values[i] * si);
        if (!std::isfinite(samples.back())) file.fail(fmt::format("sample {} overflows in SI", samples.size()), "check the unit");
    }
    return samples;
}

GroundMotion parse_columns(const TextFile& file, const ReadOptions& options) {
    const Table table = read_table(file);
    const auto [unit, is_unit_told] = choose_unit(file, table.title, options);
    const bool has_counts = has_counts_row(table);
    if (!has_counts) require_even_rows(file, table);

    // where the clock comes from: the counts row, the first column, or the caller
    const std::optional<double> time_step = has_counts ? std::optional(table.at(0, 1)) : find_time_step(file, table);
    if (time_step) {
        refuse_contradictions(file, {.dt = options.dt}, unit, checked_dt(file, table.rows.front().line, *time_step));
    } else if (!options.dt) {
        file.fail("time step is unknown (first column is not an evenly increasing time)", Remedy{"give ", Setting::time_step});
    } else if (!(options.dt->value() > 0.0) || !std::isfinite(options.dt->value())) {
        file.fail(fmt::format("time step is {} s (must be positive)", options.dt->value()), Remedy{"correct ", Setting::time_step});
    }
    const bool has_time = time_step && !has_counts;
    const scaling::Time dt = time_step ? *time_step * scaling::si::seconds : *options.dt;
    const scaling::Time start = (has_time ? table.values.front() : 0.0) * scaling::si::seconds;
    if (has_counts && table.at(0, 0) != static_cast<double>(table.rows.size() - 1)) {
        file.fail(table.rows.front().line, fmt::format("{} points announced ({} follow)", table.at(0, 0), table.rows.size() - 1),
                  "correct the number or fetch the record again");
    }

    // columns become components, or the whole table is one
    GroundMotion motion{.source = file.path().string(), .format = "text"};
    const std::size_t first = has_counts ? 2 : has_time ? 1 : 0;
    const bool is_sequence = !has_time && (has_counts || table.columns() > kMostUntimedComponents);
    const std::size_t step = is_sequence ? 1 : table.columns();
    const std::size_t components = step - (has_time ? 1 : 0);
    for (std::size_t i = 0; i < components; ++i) {
        motion.components.push_back({.name = std::to_string(i + 1),
                                     .azimuth_deg = std::nullopt,
                                     .series = {unit.quantity, start, dt, take_samples(file, table.values, first + i, step, unit.si)}});
    }
    motion.history.push_back(fmt::format("read text from {} as {} in {}{}{}", file.path().filename().string(), to_string(unit.quantity),
                                         unit.name, is_unit_told ? "" : kUnitNotGiven,
                                         is_sequence && table.columns() > 1 ? ", several values a line" : ""));
    return motion;
}

}  // namespace

GroundMotion parse_text(const TextFile& file, const ReadOptions& options) {
    return file.line(0) == kMusimCsvTitle ? parse_musim_csv(file, options) : parse_columns(file, options);
}

}  // namespace musim::records::detail
