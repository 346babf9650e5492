#include "records/formats/detail/text_heading.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "records/detail/text.hpp"
#include "records/formats/detail/text_features.hpp"

namespace musim::records::detail {
namespace {

using Texts = std::vector<std::string_view>;

bool is_direction(std::string_view text) {
    for (const std::string_view name : {"x",  "y",  "z",  "n", "e", "v", "h",   "ns",  "ew",  "ud",   "n-s",   "e-w",  "u-d",
                                        "up", "h1", "h2", "r", "t", "l", "hnn", "hne", "hnz", "vert", "north", "east", "vertical"})
        if (equal_ignoring_case(text, name)) return true;
    return false;
}

/// Parts of a line between gaps of two blanks or more, or between blanks, what stands in brackets left whole.
Texts split_at_gaps(std::string_view line, std::size_t least) {
    Texts parts;
    std::size_t first = 0;
    int depth = 0;
    for (std::size_t i = 0; i <= line.size(); ++i) {
        if (i < line.size() && (line[i] == '(' || line[i] == '[')) ++depth;
        if (i < line.size() && (line[i] == ')' || line[i] == ']')) depth = std::max(0, depth - 1);
        if (i < line.size() && (depth > 0 || !is_blank(line[i]))) continue;
        std::size_t end = i;
        while (end < line.size() && is_blank(line[end])) ++end;
        const bool has_tab = line.substr(i, end - i).find('\t') != std::string_view::npos;
        // a unit in brackets belongs to the name before it
        const bool goes_on = end < line.size() && ((end - i < least && !has_tab) || line[end] == '(' || line[end] == '[');
        if (!goes_on || end >= line.size()) {
            if (i > first) parts.push_back(trim(line.substr(first, i - first)));
            first = end;
        }
        i = std::max(i, end > i ? end - 1 : i);
    }
    return parts;
}

/// Parts of a line that end with a bracket: "Time (s) NS acceleration (g)" has two.
Texts split_behind_brackets(std::string_view line) {
    Texts parts;
    while (!line.empty()) {
        const std::size_t end = line.find_first_of(")]");
        const std::size_t size = end == std::string_view::npos ? line.size() : end + 1;
        const std::string_view part = trim(line.substr(0, size));
        if (!part.empty()) parts.push_back(part);
        line.remove_prefix(size);
        line.remove_prefix(std::min(line.find_first_not_of(" ,;|\t"), line.size()));
    }
    return parts;
}

/// Is a cell a unit and nothing else?
bool is_unit(std::string_view cell) {
    const ColumnUnit unit = read_column_unit(cell);
    return unit.motion || unit.seconds;
}

/// Makes as many cells as the table has columns: a unit behind a comma, "Time, s, Acc, g", belongs to the name before it; columns to the
/// right may have no titles; what is beyond the last column has no values.
void fit_cells(Texts& cells, std::size_t columns) {
    if (cells.size() < 2) return;
    for (std::size_t i = cells.size(); cells.size() > columns && --i > 0;) {
        if (!is_unit(cells[i]) || is_unit(cells[i - 1])) continue;
        const char* const end = cells[i].data() + cells[i].size();
        cells[i - 1] = std::string_view(cells[i - 1].data(), static_cast<std::size_t>(end - cells[i - 1].data()));
        cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (cells.size() > columns && std::any_of(cells.begin() + static_cast<std::ptrdiff_t>(columns), cells.end(), is_unit))
        return cells.clear();
    cells.resize(columns);
}

/// Cells of a line of titles, and whether they are parted by signs that stand for nothing else.
struct TitleCells {
    Texts cells;
    bool is_parted = false;
};

/// As many cells as the table has columns, by the first way to part the line that gives them; none when no way does.
TitleCells split_titles(std::string_view line, const CellSyntax& syntax, std::size_t columns) {
    if (columns == 1) {
        while (!line.empty() && std::string_view(",;\t").find(line.back()) != std::string_view::npos) line.remove_suffix(1);
        return line.find_first_of(";\t") == std::string_view::npos ? TitleCells{{line}, false} : TitleCells{};
    }
    for (const char separator : {syntax.separator, '\t', ';', ',', '|'}) {
        if (separator == CellSyntax::kBlanks || separator == CellSyntax::kAnything) continue;
        if (line.find(separator) == std::string_view::npos) continue;
        Texts cells;
        split_row(line, {.separator = separator}, cells);
        if (separator == syntax.separator) fit_cells(cells, columns);
        if (cells.size() == columns) return {cells, true};
    }
    for (const std::size_t least : {std::size_t{2}, std::size_t{1}}) {
        Texts cells = split_at_gaps(line, least);
        if (cells.size() == columns) return {cells, least == 2};
        if (least == 2) {
            cells = split_behind_brackets(line);
            if (cells.size() == columns) return {cells, false};
        }
    }
    return {};
}

bool is_row_of_units(const Texts& cells) {
    std::size_t known = 0, strange = 0;
    for (const std::string_view cell : cells) {
        if (is_empty_unit(cell)) continue;
        const ColumnUnit unit = read_column_unit(cell);
        if (unit.motion || unit.seconds) {
            ++known;
        } else if (unit.foreign.empty()) {
            ++strange;
            if (read_column_title(cell).is_understood()) return false;
        }
    }
    return known > strange;
}

bool has_values(const Texts& cells) {
    CellReader reader(CellSyntax{});
    return std::any_of(cells.begin(), cells.end(), [&](std::string_view cell) {
        const Cell value = reader.read(cell);
        constexpr double kFullCircle = 360.0;  // numbers up to it may name directions
        const bool may_be_direction =
            value.kind == CellKind::number && cell.size() <= 3 && value.value <= kFullCircle && value.value >= 0.0;
        return value.kind != CellKind::text && value.kind != CellKind::missing && !may_be_direction;
    });
}

/// Word that begins what a header says of its sampling.
struct SamplingKey {
    std::string_view name;
    bool is_rate;
};

constexpr SamplingKey kSamplingKeys[] = {
    {"dt", false},
    {"delta t", false},
    {"deltat", false},
    {"delta_t", false},
    {"delta_x", false},
    {"time step", false},
    {"timestep", false},
    {"time_step", false},
    {"sampling interval", false},
    {"sample interval", false},
    {"sampling period", false},
    {"time increment", false},
    {"time interval", false},
    {"sampling rate", true},
    {"sample rate", true},
    {"sampling_rate", true},
    {"sample_rate", true},
    {"samplerate", true},
    {"sampling frequency", true},
    {"sample frequency", true},
    {"sampling freq", true},
    {"samples per second", true},
    {"fs", true},
    {"@", true},
};

bool is_name_letter(char letter) { return (to_lower(letter) >= 'a' && to_lower(letter) <= 'z') || is_digit(letter) || letter == '_'; }

/// Time step [s] of a number with the words beside it; nothing for a unit that is none of times or rates, or a step that no record has.
std::optional<double> step_of(double value, bool is_rate, const std::vector<std::string_view>& words) {
    std::optional<double> seconds;
    for (const std::string_view word : words) {
        const std::string unit = plain_unit_text(word);
        if (unit == "hz" || unit == "sps" || unit == "1/s" || unit == "samples/s" || unit == "s/s") {
            is_rate = true;
            seconds = 1.0;
        } else if (unit == "khz") {
            is_rate = true;
            seconds = 1e-3;
        } else if (const ColumnUnit time = read_column_unit(word); time.seconds && !seconds) {
            if (is_rate) return std::nullopt;
            seconds = time.seconds;
        }
    }
    if (!(value > 0.0)) return std::nullopt;
    const double step = (is_rate ? 1.0 / value : value) * seconds.value_or(1.0);
    const bool is_usual = step >= kShortestStep * (1.0 - 1e-9) && step <= kLongestStep * (1.0 + 1e-9);
    return seconds || is_usual ? std::optional(step) : std::nullopt;
}

/// "dt = 0.005 s", "Sampling rate (Hz): 200", "Sample interval<tab>5 ms" [s].
std::optional<double> read_sampling(std::string_view line) {
    for (const SamplingKey& key : kSamplingKeys) {
        const std::size_t at = find_ignoring_case(line, key.name);
        if (at == std::string_view::npos || (at > 0 && is_name_letter(line[at - 1]))) continue;
        std::string_view rest = line.substr(at + key.name.size());
        if (!rest.empty() && is_name_letter(rest.front())) continue;
        std::vector<std::string_view> words;
        std::optional<double> value;
        for (std::size_t k = 0; k < 4 && !rest.empty(); ++k) {
            const std::string_view token = take_token(rest, " \t:=,;\"'()[]");
            const std::size_t digits = std::min(token.find_first_not_of("0123456789+-."), token.size());
            if (!value && digits > 0) {
                value = parse_real(token);
                // "200Hz"
                if (!value) {
                    value = parse_real(token.substr(0, digits));
                    words.push_back(token.substr(digits));
                }
                if (!value) break;
                continue;
            }
            words.push_back(token);
            if (value || words.size() > 2) break;
        }
        if (value) return step_of(*value, key.is_rate, words);
    }
    return std::nullopt;
}

/// Are the cells of a line titles? Lines parted by blanks only may be sentences.
bool are_titles(const TitleCells& split, const std::vector<ColumnTitle>& titles, const TextLine& line, bool is_nearest) {
    if (has_values(split.cells) || read_sampling(line.text)) return false;
    // "Unit g, g = 9.81 m/s2"
    if (line.is_comment && line.text.find(" = ") != std::string_view::npos) return false;
    if (std::all_of(split.cells.begin(), split.cells.end(), is_empty_unit)) return false;
    const bool is_sentence = contains_ignoring_case(line.text, "unit") || contains_ignoring_case(line.text, " vs");
    if (!split.is_parted && is_sentence) return false;
    if (titles.size() == 1) return titles.front().quantity.has_value() || titles.front().unit.motion;
    const auto count = [&](auto is) { return static_cast<std::size_t>(std::count_if(titles.begin(), titles.end(), is)); };
    const std::size_t understood = count([](const ColumnTitle& title) { return title.is_understood() && title.unit.foreign.empty(); });
    const std::size_t times = count([](const ColumnTitle& title) { return title.is_time; });
    // "Acceleration, m/s2" is one text
    const bool has_unit_alone = std::any_of(split.cells.begin(), split.cells.end(), is_unit);
    if (has_unit_alone && times == 0 && !std::all_of(split.cells.begin(), split.cells.end(), is_unit)) return false;
    if (understood == titles.size() || (times > 0 && (titles.size() > 2 || split.is_parted))) return true;
    if (times > 0 && titles.front().is_time) return true;
    if (split.is_parted && understood > 0) return true;
    if (std::all_of(split.cells.begin(), split.cells.end(), is_direction)) return true;
    return split.is_parted && is_nearest && !line.is_comment;
}

/// Do titles call a column a time that does not rise, beside a first one that does? They are a sentence, or stand in another order.
bool is_time_misplaced(const std::vector<ColumnTitle>& titles, const TextTable& table) {
    const std::size_t rows = table.rows.size();
    const bool is_even = std::all_of(table.rows.begin(), table.rows.end(), [&](const TextRow& row) { return row.size == titles.size(); });
    if (!is_even || titles.size() < 2 || rows < 3 || titles.front().is_time || !is_rising(table, 0, rows)) return false;
    for (std::size_t column = 1; column < titles.size(); ++column) {
        if (titles[column].is_time && table.kind(column) == CellKind::number && !is_rising(table, column, rows)) return true;
    }
    return false;
}

/// Adds what a line states; one that says "unit" stands above brackets in other lines.
void add_statement(const TextFile& file, const TextLine& line, TextHeading& heading) {
    const UnitStatement found = read_unit_statement(line.text);
    UnitStatement& stated = heading.stated;
    if (found.quantity && stated.quantity && *found.quantity != *stated.quantity) stated.quantity.reset();
    if (found.quantity && !heading.stated_line) stated.quantity = found.quantity;
    if (found.seconds) stated.seconds = found.seconds;
    if (found.rotation) stated.rotation = found.rotation;
    const bool says_unit = found.motion || !found.unknown.empty();
    if (!says_unit || (stated.is_explicit && !found.is_explicit)) return;
    const bool is_other = found.motion && stated.motion && found.motion->name != stated.motion->name;
    if (is_other && found.is_explicit == stated.is_explicit) {
        file.fail(line.line,
                  fmt::format("title names two units, {} and {} (columns must hold one quantity)", stated.motion->name, found.motion->name),
                  {"split the file or give ", Setting::unit});
    }
    stated.motion = found.motion;
    stated.unknown = found.unknown;
    stated.is_explicit = found.is_explicit;
    heading.stated_line = line.line;
}

}  // namespace

TextHeading read_text_heading(const TextFile& file, const TextTable& table) {
    constexpr std::size_t kTitleLines = 60;  // lines above the numbers where titles are looked for
    TextHeading heading;
    std::vector<ColumnTitle> units_alone;
    Texts units;
    std::vector<const TextLine*> others;
    bool is_nearest = true;
    for (std::size_t above = 0; above < table.header.size(); ++above) {
        const TextLine& line = table.header[table.header.size() - 1 - above];
        const TitleCells split = above < kTitleLines ? split_titles(line.text, table.syntax, table.columns()) : TitleCells{};
        const bool has_cells = !split.cells.empty() && !line.text.empty();
        const bool lacks_units = units.empty() && std::none_of(heading.titles.begin(), heading.titles.end(),
                                                               [](const auto& title) { return title.unit.is_known(); });
        if (lacks_units && has_cells && is_row_of_units(split.cells)) {
            units = split.cells;
            heading.titles_line = line.line;
            continue;
        }
        if (heading.titles.empty() && has_cells) {
            std::vector<ColumnTitle> titles;
            for (const std::string_view cell : split.cells) titles.push_back(read_column_title(cell));
            if (are_titles(split, titles, line, is_nearest || !units.empty()) && !is_time_misplaced(titles, table)) {
                heading.titles = std::move(titles);
                heading.titles_line = line.line;
                continue;
            }
        }
        if (!line.is_comment) is_nearest = false;
        others.push_back(&line);
    }
    if (!units.empty()) {
        heading.titles.resize(table.columns());
        for (std::size_t i = 0; i < units.size(); ++i) add_unit(heading.titles[i], units[i]);
    }
    heading.is_understood =
        std::any_of(heading.titles.begin(), heading.titles.end(), [](const ColumnTitle& title) { return title.is_understood(); });

    std::reverse(others.begin(), others.end());
    std::size_t texts = 0;
    for (const TextLine* line : others) {
        if (!line->is_comment && ++texts == 2) heading.free_text = line->line;
        add_statement(file, *line, heading);
        if (!heading.dt) heading.dt = read_sampling(line->text);
    }
    return heading;
}

}  // namespace musim::records::detail
