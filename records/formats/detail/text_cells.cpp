#include "records/formats/detail/text_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "records/detail/text.hpp"

namespace musim::records::detail {
namespace {

constexpr std::size_t kSyntaxLines = 2000;  // lines of numbers that show a file's syntax

/// Might a line be a row of numbers and times?
bool looks_like_numbers(std::string_view line) {
    constexpr std::string_view kFirst = "0123456789+-.,;\"\t";
    constexpr std::string_view kLetters = "0123456789+-.,;:/eEdDTZ\"' \tNaAPMpmn";
    return !line.empty() && kFirst.find(line.front()) != std::string_view::npos &&
           line.find_first_of("0123456789") != std::string_view::npos && line.find_first_not_of(kLetters) == std::string_view::npos;
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

// "1,234" or "1,234.5", never "0,005"
bool has_thousands(std::string_view cell) {
    if (!cell.empty() && (cell.front() == '-' || cell.front() == '+')) cell.remove_prefix(1);
    const std::size_t comma = cell.find(',');
    if (comma == std::string_view::npos || comma == 0 || comma > 3 || cell.front() == '0') return false;
    const std::size_t end = std::min(cell.find_first_not_of("0123456789", comma + 1), cell.size());
    return end - comma == 4;
}

bool is_number(std::string_view text, bool has_decimal_commas) {
    return CellReader({.separator = CellSyntax::kBlanks, .has_decimal_commas = has_decimal_commas}).read(text).kind != CellKind::text;
}

/// Features that all lines of numbers of a file share.
class SyntaxSample {
  public:
    explicit SyntaxSample(const TextFile& file) : file_(&file) {
        for (std::size_t index = 0; index < file.size() && lines_.size() < kSyntaxLines; ++index) {
            if (looks_like_numbers(trim(file.line(index)))) lines_.push_back(index);
        }
    }

    bool empty() const { return lines_.empty(); }

    /// Do most lines hold this letter?
    bool has(std::string_view letters) const {
        std::size_t count = 0;
        for (const std::size_t index : lines_) count += file_->line(index).find_first_of(letters) != std::string_view::npos ? 1U : 0U;
        return 2 * count > lines_.size();
    }

    /// Are most lines made of readable cells?
    bool fits(const CellSyntax& syntax) const {
        std::size_t count = 0;
        std::vector<std::string_view> cells;
        for (const std::size_t index : lines_) {
            split_row(file_->line(index), syntax, cells);
            const bool fits =
                std::all_of(cells.begin(), cells.end(), [&](auto cell) { return is_number(cell, syntax.has_decimal_commas); });
            count += fits ? 1U : 0U;
        }
        return 2 * count > lines_.size();
    }

    /// The syntax with this separator: with decimal commas where its cells hold commas.
    CellSyntax with(char separator) const {
        CellSyntax syntax{.separator = separator};
        std::size_t commas = 0, points = 0, thousands = 0, point_line = 0;
        std::vector<std::string_view> cells;
        for (const std::size_t index : lines_) {
            split_row(file_->line(index), syntax, cells);
            for (const std::string_view cell : cells) {
                const bool is_moment = cell.find(':') != std::string_view::npos || std::count(cell.begin(), cell.end(), '.') > 1;
                if (!is_moment && cell.find('.') != std::string_view::npos) {
                    ++points;
                    if (points == 1) point_line = index;
                }
                if (is_moment || cell.find(',') == std::string_view::npos) continue;
                ++commas;
                thousands += has_thousands(cell) ? 1U : 0U;
            }
        }
        if (commas > 0 && points > 0) {
            file_->fail(point_line, "both ',' and '.' in numbers (one of them may part thousands)",
                        "write decimal points, and no thousands");
        }
        if (commas > 0 && commas == thousands) {
            file_->fail(lines_.front(), "every ',' in a number has three digits behind it (it may part thousands)",
                        "write decimal points, and no thousands");
        }
        syntax.has_decimal_commas = commas > 0;
        return syntax;
    }

    /// Refuses lines where a comma may part cells or be a decimal one.
    void refuse_ambiguous_commas() const {
        bool is_one_comma = true;
        for (const std::size_t index : lines_) {
            const std::string_view line = trim(file_->line(index));
            if (count_commas_in_numbers(line) > 0 && has_blanks_between_cells(line) && line.find(':') == std::string_view::npos) {
                file_->fail(index, "both blanks and ',' between numbers (decimal commas are not read)", "write decimal points");
            }
            is_one_comma = is_one_comma && line.find('.') == std::string_view::npos && count_commas_in_numbers(line) == 1 &&
                           std::count(line.begin(), line.end(), ',') == 1;
        }
        if (is_one_comma && !has_title_cells()) {
            file_->fail(lines_.front(), "one ',' within every row, no '.' and no sign behind it (decimal commas are not read)",
                        "write decimal points, or a blank behind commas that part columns");
        }
    }

  private:
    // a line of two titles above the numbers, none of which is a unit for itself, shows that commas part columns
    bool has_title_cells() const {
        for (std::size_t above = lines_.front(); above-- > 0;) {
            std::string_view line = trim(file_->line(above));
            if (line.empty()) continue;
            if (std::count(line.begin(), line.end(), ',') != 1) return false;
            const std::string_view second = trim(line.substr(line.find(',') + 1));
            return second.size() > 2 && second.find_first_of("/^") == std::string_view::npos;
        }
        return false;
    }

    const TextFile* file_;
    std::vector<std::size_t> lines_;
};

std::string_view unquote(std::string_view cell) {
    cell = trim(cell);
    if (cell.size() > 1 && (cell.front() == '"' || cell.front() == '\'') && cell.back() == cell.front())
        cell = cell.substr(1, cell.size() - 2);
    return trim(cell);
}

/// Numbers of a text between separators; nothing unless it has as many as the list and nothing else.
template <std::size_t Count>
std::optional<std::array<int, Count>> split_numbers(std::string_view text, char separator) {
    std::array<int, Count> numbers{};
    for (std::size_t i = 0; i < Count; ++i) {
        const std::size_t end = i + 1 < Count ? text.find(separator) : text.size();
        if (end == std::string_view::npos) return std::nullopt;
        const std::optional<std::size_t> number = end <= 4 ? parse_count(text.substr(0, end)) : std::nullopt;
        if (!number) return std::nullopt;
        numbers.at(i) = static_cast<int>(*number);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return numbers;
}

/// A date: year, month, day.
struct Date {
    std::array<int, 3> ymd{};
    bool is_ambiguous = false;  ///< "04/02/2024"
};

std::optional<Date> parse_date(std::string_view text) {
    for (const char separator : {'-', '/', '.'}) {
        const auto parts = split_numbers<3>(text, separator);
        if (!parts) continue;
        auto [a, b, c] = *parts;
        constexpr int kFirstYear = 1000;
        if (a >= kFirstYear) return Date{{a, b, c}};
        if (c < kFirstYear) return std::nullopt;
        // days come first with points; with strokes and hyphens either may
        if (separator == '.') return Date{{c, b, a}};
        return Date{{c, a > 12 ? b : a, a > 12 ? a : b}, a <= 12 && b <= 12 && a != b};
    }
    return std::nullopt;
}

/// "22:45:22.147", "10:45:22,147 PM" [s after midnight].
std::optional<double> parse_clock(std::string_view text) {
    double noon = 0.0;
    bool is_half_day = false;
    for (const auto& [mark, hours] : {std::pair{"AM", 0.0}, std::pair{"PM", 12.0}}) {
        if (text.size() < 3 || !equal_ignoring_case(text.substr(text.size() - 2), mark)) continue;
        is_half_day = true;
        noon = hours;
        text = trim(text.substr(0, text.size() - 2));
    }
    const std::size_t last = text.rfind(':');
    if (last == std::string_view::npos) return std::nullopt;
    // "02:22.147" are minutes and seconds
    const bool has_hours = text.find(':') != last;
    if (!has_hours && text.find_first_of(".,", last) == std::string_view::npos) return std::nullopt;
    const auto hour_minute = split_numbers<2>((has_hours ? "" : "0:") + std::string(text.substr(0, last)), ':');
    std::string second(text.substr(last + 1));
    std::replace(second.begin(), second.end(), ',', '.');
    const std::optional<double> seconds = !second.empty() && is_digit(second.front()) ? parse_real(second) : std::nullopt;
    if (!hour_minute || !seconds || *seconds >= 61.0 || (*hour_minute)[1] > 59 || (*hour_minute)[0] > 24) return std::nullopt;
    const double hour = is_half_day ? (*hour_minute)[0] % 12 + noon : (*hour_minute)[0];
    return 3600.0 * hour + 60.0 * (*hour_minute)[1] + *seconds;
}

/// Takes a zone off the end of a time: "Z", "UTC", "+02:00", "-0330" [h ahead of UTC].
std::optional<double> take_zone(std::string_view& text) {
    for (const std::string_view mark : {"Z", "UTC", "GMT"}) {
        if (text.size() > mark.size() && equal_ignoring_case(text.substr(text.size() - mark.size()), mark)) {
            text = trim(text.substr(0, text.size() - mark.size()));
            return 0.0;
        }
    }
    const std::size_t sign = text.find_last_of("+-");
    if (sign == std::string_view::npos || text.find(':') > sign) return std::nullopt;
    const std::string_view zone = text.substr(sign + 1);
    const bool has_colon = zone.size() == 5 && zone[2] == ':';
    if (!has_colon && zone.size() != 4 && zone.size() != 2) return std::nullopt;
    const std::optional<std::size_t> hours = parse_count(zone.substr(0, 2));
    const std::optional<std::size_t> minutes =
        zone.size() == 2 ? std::optional<std::size_t>(0) : parse_count(zone.substr(has_colon ? 3 : 2));
    if (!hours || !minutes) return std::nullopt;
    const double ahead = static_cast<double>(*hours) + static_cast<double>(*minutes) / 60.0;
    const bool is_behind = text[sign] == '-';
    text = trim(text.substr(0, sign));
    return is_behind ? -ahead : ahead;
}

bool is_missing(std::string_view text) {
    for (const std::string_view mark : {"", "nan", "na", "n/a", "null", "none", "-", "--", "---", "#n/a", "-nan", "1.#qnan"})
        if (equal_ignoring_case(text, mark)) return true;
    return false;
}

}  // namespace

CellSyntax find_cell_syntax(const TextFile& file) {
    const SyntaxSample sample(file);
    if (sample.empty()) return {};
    const CellSyntax anything{.separator = CellSyntax::kAnything};
    if (sample.has(";")) {
        const CellSyntax syntax = sample.with(';');
        return sample.fits(syntax) || !sample.fits(anything) ? syntax : anything;
    }
    if (sample.has("\t")) {
        if (const CellSyntax points{.separator = '\t'}; sample.fits(points)) return points;
        const CellSyntax commas{.separator = '\t', .has_decimal_commas = true};
        if (sample.has(",") && sample.fits(commas)) return sample.with('\t');
    }
    if (sample.has(",")) {
        const CellSyntax quoted{.separator = ',', .has_decimal_commas = true};
        const CellSyntax syntax{.separator = ','};
        if (sample.has("\"") && !sample.fits(syntax) && sample.fits(quoted)) return sample.with(',');
        sample.refuse_ambiguous_commas();
        return sample.fits(syntax) || !sample.fits(anything) ? syntax : anything;
    }
    return {};
}

void split_row(std::string_view line, const CellSyntax& syntax, std::vector<std::string_view>& cells) {
    cells.clear();
    if (syntax.separator == CellSyntax::kBlanks || syntax.separator == CellSyntax::kAnything) {
        const std::string_view separators = syntax.separator == CellSyntax::kBlanks ? " \t\v\f\r" : " \t\v\f\r,;";
        for (std::string_view cell = take_token(line, separators); !cell.empty(); cell = take_token(line, separators)) {
            cells.push_back(unquote(cell));
        }
        return;
    }
    std::size_t first = 0;
    bool is_quoted = false;
    for (std::size_t i = 0; i <= line.size(); ++i) {
        if (i < line.size() && line[i] == '"') is_quoted = !is_quoted;
        if (i < line.size() && (is_quoted || line[i] != syntax.separator)) continue;
        cells.push_back(unquote(line.substr(first, i - first)));
        first = i + 1;
    }
    while (!cells.empty() && cells.back().empty()) cells.pop_back();
}

Cell CellReader::read(std::string_view text) {
    if (syntax_.has_decimal_commas && text.find(',') != std::string_view::npos) {
        std::string plain(text);
        std::replace(plain.begin(), plain.end(), ',', '.');
        if (const std::optional<double> value = parse_real(plain)) return {CellKind::number, *value};
    } else if (const std::optional<double> value = parse_real(text)) {
        return {CellKind::number, *value};
    }
    if (is_missing(text)) return {CellKind::missing, std::numeric_limits<double>::quiet_NaN()};
    return read_moment(text);
}

Cell CellReader::read_moment(std::string_view text) {
    if (text.empty() || !is_digit(text.front())) return {};
    if (text.find(':') != std::string_view::npos && text.find(':') <= 2) {
        const std::optional<double> clock = parse_clock(text);
        return clock ? Cell{CellKind::clock, *clock} : Cell{};
    }
    const std::size_t gap = text.find_first_of(" \tT_");
    const std::optional<Date> date = parse_date(text.substr(0, gap));
    if (!date) return {};
    if (date->is_ambiguous) {
        if (ambiguous_date_.empty()) ambiguous_date_ = text.substr(0, gap);
        if (ambiguous_date_ != text.substr(0, gap)) return {};
    }
    double seconds = 0.0;
    std::optional<double> zone;
    if (gap != std::string_view::npos) {
        std::string_view rest = trim(text.substr(gap + 1));
        zone = take_zone(rest);
        const std::optional<double> clock = parse_clock(rest);
        if (!clock) return {};
        seconds = *clock;
    }
    const std::optional<UtcTime> day = make_utc_time(date->ymd[0], date->ymd[1], date->ymd[2], 0, 0, 0.0, zone.value_or(0.0));
    if (!day) return {};
    if (!zero_) {
        zero_ = *day;
        is_utc_ = zone.has_value() && !date->is_ambiguous;
    }
    seconds += std::chrono::duration<double>(*day - *zero_).count();
    return {gap == std::string_view::npos ? CellKind::date : CellKind::instant, seconds};
}

}  // namespace musim::records::detail
