#include "records/formats/detail/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "records/detail/text.hpp"

namespace musim::records::detail {
namespace {

constexpr std::string_view kConvert = "convert it to PEER AT2, CSMIP V1/V2 or columns of numbers";

/// Letters of a line that mark it as a comment; zero for none.
std::size_t comment_mark(std::string_view line, bool is_header) {
    if (line.starts_with("//")) return 2;
    if (line.starts_with('#') || line.starts_with('%') || line.starts_with('!') || line.starts_with('$') || line.starts_with("**"))
        return 1;
    return is_header && line.starts_with('*') ? 1 : 0;
}

/// Takes the lines of a file one by one.
class TableReader {
  public:
    explicit TableReader(const TextFile& file) : file_(&file), table_{.syntax = find_cell_syntax(file)}, reader_(table_.syntax) {}

    TextTable read() {
        for (std::size_t index = 0; index < file_->size(); ++index) {
            const std::string_view line = trim(file_->line(index));
            if (!line.empty()) read_line(index, line);
        }
        if (table_.rows.empty()) refuse_text_alone();
        table_.zero = reader_.zero();
        table_.is_utc = reader_.is_utc();
        return std::move(table_);
    }

  private:
    void read_line(std::size_t index, std::string_view line) {
        if (const std::size_t mark = comment_mark(line, table_.rows.empty()); mark > 0) {
            const std::size_t text = line.find_first_not_of("#%/!$* \t", mark);
            // a keyword of a program, "*Amplitude, name=X", is no title
            const bool is_keyword = line.front() == '*' && !line.starts_with("**");
            const bool is_empty = is_keyword || text == std::string_view::npos;
            if (table_.rows.empty()) table_.header.push_back({index, is_empty ? "" : line.substr(text), true});
            return;
        }
        // blanks at the ends are cells where tabs part them
        split_row(table_.syntax.separator == '\t' ? file_->line(index) : line, table_.syntax, cells_);
        if (cells_.empty()) {
            if (!table_.rows.empty() && !empty_row_) empty_row_ = index;
            return;
        }
        if (const std::string_view text = read_cells(); !text.empty()) {
            take_text(index, line, text);
            return;
        }
        if (empty_row_) file_->fail(*empty_row_, "row without a value (rows below have some)", "fill it or cut the record there");
        add_row(index);
    }

    /// The first cell that is neither number nor time; none: a row. Above the first row, cells of a row cannot all be dates.
    std::string_view read_cells() {
        values_.clear();
        bool has_number = false;
        for (const std::string_view cell : cells_) {
            const Cell value = reader_.read(cell);
            if (value.kind == CellKind::text) return cell;
            has_number = has_number || value.kind == CellKind::number;
            values_.push_back(value);
        }
        return has_number || !table_.rows.empty() ? std::string_view{} : cells_.front();
    }

    void take_text(std::size_t index, std::string_view line, std::string_view cell) {
        if (!table_.rows.empty() && !begins_table_below(index)) refuse_cell(index, cell);
        if (!table_.rows.empty()) {
            for (const TextRow& row : table_.rows) table_.header.push_back({row.line, trim(file_->line(row.line)), false});
            table_.rows.clear();
            table_.values.clear();
            table_.kinds.clear();
        }
        table_.header.push_back({index, line, false});
    }

    /// Rows above a line of text may be numbers of a header: at most a few, not as long as the rows below.
    bool begins_table_below(std::size_t index) {
        constexpr std::size_t kMostRows = 5, kMostLines = 50;
        if (table_.rows.size() > kMostRows) return false;
        for (std::size_t below = index + 1; below < std::min(file_->size(), index + kMostLines); ++below) {
            split_row(trim(file_->line(below)), table_.syntax, cells_);
            if (cells_.empty() || !read_cells().empty()) continue;
            return std::all_of(table_.rows.begin(), table_.rows.end(), [&](const TextRow& row) { return row.size != cells_.size(); });
        }
        return false;
    }

    void add_row(std::size_t index) {
        table_.rows.push_back({.line = index, .first = table_.values.size(), .size = values_.size()});
        if (table_.kinds.size() < values_.size()) table_.kinds.resize(values_.size(), CellKind::missing);
        for (std::size_t i = 0; i < values_.size(); ++i) {
            CellKind& kind = table_.kinds[i];
            if (kind == CellKind::missing) kind = values_[i].kind;
            if (values_[i].kind != kind && values_[i].kind != CellKind::missing) refuse_cell(index, cells_[i], 0);
            table_.values.push_back(values_[i].value);
        }
    }

    [[noreturn]] void refuse_cell(std::size_t index, std::string_view cell, std::size_t next = 1) const {
        file_->fail(index, fmt::format("sample {} is {} (no finite number)", table_.rows.size() + next, quoted(cell)),
                    "repair the value or fetch the file again");
    }

    [[noreturn]] void refuse_text_alone() const {
        std::size_t texts = 0;
        for (const TextLine& header : table_.header) {
            if (!header.is_comment && ++texts == 2) {
                file_->fail(header.line, fmt::format("unknown format ({} is no row of numbers)", quoted(header.text)), kConvert);
            }
        }
        file_->fail("unknown format (no row of numbers)", kConvert);
    }

    const TextFile* file_;
    TextTable table_;
    CellReader reader_;
    std::vector<std::string_view> cells_;
    std::vector<Cell> values_;
    std::optional<std::size_t> empty_row_;
};

std::optional<std::size_t> find_kind(const TextTable& table, CellKind kind) {
    const auto found = std::find(table.kinds.begin(), table.kinds.end(), kind);
    return found == table.kinds.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - table.kinds.begin()));
}

/// Times of day become instants, by the column of dates or by going on at midnight.
void join_dates(TextTable& table) {
    const std::optional<std::size_t> clock = find_kind(table, CellKind::clock), date = find_kind(table, CellKind::date);
    if (!clock) return;
    constexpr double kDay = 86400.0;
    double days = 0.0, last = 0.0;
    for (const TextRow& row : table.rows) {
        if (row.size <= *clock || (date && row.size <= *date)) continue;
        double& time = table.values[row.first + *clock];
        if (date) {
            time += table.values[row.first + *date];
            continue;
        }
        time += days;
        if (time < last - 0.5 * kDay) {
            days += kDay;
            time += kDay;
        }
        last = time;
    }
    table.kinds[*clock] = CellKind::instant;
}

}  // namespace

TextTable read_text_table(const TextFile& file) {
    TextTable table = TableReader(file).read();
    join_dates(table);
    return table;
}

void reshape(const TextFile& file, TextTable& table, std::size_t columns) {
    std::vector<TextRow> rows;
    rows.reserve(table.values.size() / columns + 1);
    const std::size_t first = table.rows.front().first;
    for (const TextRow& row : table.rows) {
        for (std::size_t i = row.first; i < row.first + row.size; ++i) {
            if ((i - first) % columns == 0) rows.push_back({.line = row.line, .first = i, .size = columns});
        }
    }
    const TextRow& last = table.rows.back();
    if ((last.first + last.size - first) % columns != 0) {
        file.fail(last.line, fmt::format("{} values in the last row (groups of {} are not complete)", last.size, columns),
                  "repair the row");
    }
    table.rows = std::move(rows);
}

void require_even_rows(const TextFile& file, const TextTable& table, bool may_end_short) {
    for (std::size_t row = 1; row < table.rows.size(); ++row) {
        const std::size_t size = table.rows[row].size;
        const bool is_short_end = may_end_short && row + 1 == table.rows.size() && size < table.columns();
        if (size != table.columns() && !is_short_end) {
            file.fail(table.rows[row].line, fmt::format("{} values (the rows above have {})", size, table.columns()), "repair the row");
        }
    }
}

void require_values(const TextFile& file, const TextTable& table, std::size_t column) {
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        if (!std::isnan(table.at(row, column))) continue;
        std::vector<std::string_view> cells;
        split_row(trim(file.line(table.rows[row].line)), table.syntax, cells);
        const std::string_view cell = column < cells.size() ? cells[column] : std::string_view{};
        if (cell.empty()) file.fail(table.rows[row].line, "empty value between separators", "fill it or remove the row");
        file.fail(table.rows[row].line, fmt::format("sample {} is {} (no finite number)", row + 1, quoted(cell)),
                  "repair the value or fetch the file again");
    }
}

double find_printed_step(const TextFile& file, const TextTable& table, std::size_t column) {
    constexpr std::size_t kRows = 1000;  // enough to see the most digits
    constexpr int kMostDigits = 15;
    int most = 0, fewest_with_exponent = kMostDigits;
    bool has_exponents = false;
    std::vector<std::string_view> cells;
    for (std::size_t row = 0; row < std::min(kRows, table.rows.size()); ++row) {
        split_row(file.line(table.rows[row].line), table.syntax, cells);
        if (column >= cells.size()) continue;
        const std::string_view cell = cells[column];
        const std::size_t point = cell.find_last_of(".,");
        const std::size_t end = point == std::string_view::npos ? point : cell.find_first_not_of("0123456789", point + 1);
        const int decimals = point == std::string_view::npos ? 0 : static_cast<int>(std::min(end, cell.size()) - point) - 1;
        const std::size_t letter = cell.find_first_of("eEdD");
        const std::optional<double> exponent = letter == std::string_view::npos ? std::nullopt : parse_real(cell.substr(letter + 1));
        most = std::max(most, decimals);
        if (!exponent || std::abs(*exponent) > 300.0) continue;
        has_exponents = true;
        fewest_with_exponent = std::min(fewest_with_exponent, decimals - static_cast<int>(*exponent));
    }
    return std::pow(10.0, -std::min(has_exponents ? fewest_with_exponent : most, kMostDigits));
}

}  // namespace musim::records::detail
