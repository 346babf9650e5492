#include "records/formats/detail/text_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/error.hpp"
#include "records/formats/detail/text_features.hpp"

namespace musim::records::detail {
namespace {

class LayoutFinder {
  public:
    LayoutFinder(const TextFile& file, TextTable& table, const TextHeading& heading, const ReadOptions& options)
        : file_(&file), table_(&table), heading_(&heading), options_(&options) {}

    TextLayout find() {
        if (options_->columns) {
            follow_choice(*options_->columns);
        } else if (!heading_->titles.empty() && table_->columns() > 1 && !join_titled_groups()) {
            require_even_rows(*file_, *table_, false);
            use_titles();
        } else {
            use_values();
        }
        for (std::size_t column : layout_.samples) require_values(*file_, *table_, column);
        if (layout_.time) require_values(*file_, *table_, *layout_.time);
        return std::move(layout_);
    }

  private:
    const ColumnTitle* title(std::size_t column) const { return column < heading_->titles.size() ? &heading_->titles[column] : nullptr; }

    void add(std::size_t column) {
        layout_.samples.push_back(column);
        layout_.names.push_back(title(column) != nullptr ? title(column)->name : "");
    }

    void follow_choice(const ColumnChoices& choices) {
        check_column_choices(choices);
        if (choices.size() == 1 && choices.front().column.find('-') != std::string::npos && !find_title(choices.front().column)) {
            return take_range(choices.front());
        }
        require_even_rows(*file_, *table_, false);
        for (const ColumnChoice& choice : choices) {
            const std::size_t column = find_column(choice.column);
            if (equal_ignoring_case(choice.name, kTimeColumn)) {
                layout_.time = column;
            } else {
                layout_.samples.push_back(column);
                layout_.names.push_back(choice.name);
            }
        }
    }

    /// "x=1-8": the whole width, several values a line.
    void take_range(const ColumnChoice& choice) {
        const std::size_t hyphen = choice.column.find('-');
        const std::optional<std::size_t> first = parse_count(choice.column.substr(0, hyphen)),
                                         last = parse_count(choice.column.substr(hyphen + 1));
        if (!first || !last || *first != 1 || *last != table_->columns()) {
            file_->fail(fmt::format("columns '{}' are not those of a series (its lines have {})", choice.column, table_->columns()),
                        {"correct ", Setting::columns});
        }
        require_even_rows(*file_, *table_, true);
        use_series();
        layout_.names = {choice.name};
    }

    std::optional<std::size_t> find_title(std::string_view text) const {
        std::optional<std::size_t> found;
        for (std::size_t column = 0; column < heading_->titles.size(); ++column) {
            const ColumnTitle& candidate = heading_->titles[column];
            if (!equal_ignoring_case(candidate.text, text) && !(equal_ignoring_case(candidate.name, text) && !text.empty())) continue;
            if (found)
                file_->fail(heading_->titles_line, fmt::format("title '{}' occurs twice", text), {"give its number in ", Setting::columns});
            found = column;
        }
        return found;
    }

    std::size_t find_column(const std::string& text) const {
        if (const std::optional<std::size_t> titled = find_title(text)) return *titled;
        const std::optional<std::size_t> number = parse_count(text);
        if (number && *number >= 1 && *number <= table_->columns()) return *number - 1;
        std::string titles;
        for (const ColumnTitle& candidate : heading_->titles) titles += (titles.empty() ? ": " : ", ") + candidate.text;
        file_->fail(fmt::format("no column {} (the table has {}{})", quoted(std::string_view(text)), table_->columns(), titles),
                    {"correct ", Setting::columns});
    }

    /// Groups of values that begin with a time each, under titles that repeat or say nothing, become rows.
    bool join_titled_groups() {
        const std::optional<std::size_t> size = find_timed_groups(*table_);
        if (!size) return false;
        for (std::size_t column = 0; column < table_->columns(); column += *size) {
            if (!title(column)->is_time && title(column)->is_understood()) return false;
        }
        return true;
    }

    void use_titles() {
        find_titled_time();
        for (std::size_t column = 0; column < table_->columns(); ++column) {
            if (is_titled_index(column) && column != layout_.time) layout_.index = column;
            if (column == layout_.time || column == layout_.index || is_dated(column) || is_empty_column(*table_, column)) continue;
            if (is_time_title(column)) continue;
            add(column);
        }
        if (!layout_.time) find_untitled_time();
        if (layout_.samples.empty()) {
            file_->fail(heading_->titles_line, "no column holds samples (titles name times only)", {"give ", Setting::columns});
        }
        refuse_integrals();
    }

    bool is_dated(std::size_t column) const {
        return table_->kind(column) != CellKind::number && table_->kind(column) != CellKind::missing;
    }

    bool is_titled_index(std::size_t column) const {
        const ColumnTitle* head = title(column);
        const bool says_otherwise = head != nullptr && (head->quantity || head->unit.is_known() || head->is_time);
        const bool says_index = head != nullptr && (head->is_index || (head->text.empty() && column == 0));
        return !says_otherwise && says_index && is_index_column(*table_, column);
    }

    bool is_time_title(std::size_t column) const {
        const ColumnTitle* head = title(column);
        return head != nullptr && head->is_time && (head->unit.seconds || is_rising(*table_, column, table_->rows.size()));
    }

    /// The column that a title, or what it holds, says is the time. Of several, those with a unit or instants come first.
    void find_titled_time() {
        std::vector<std::size_t> times;
        for (std::size_t column = 0; column < table_->columns(); ++column) {
            if (table_->kind(column) == CellKind::instant || is_time_title(column)) times.push_back(column);
        }
        if (times.empty()) return;
        const auto is_clear = [&](std::size_t column) { return title(column)->unit.seconds || table_->kind(column) == CellKind::instant; };
        const auto numbers =
            std::find_if(times.begin(), times.end(), [&](std::size_t column) { return title(column)->unit.seconds.has_value(); });
        const auto best = numbers != times.end() ? numbers : std::find_if(times.begin(), times.end(), is_clear);
        layout_.time = best != times.end() ? *best : times.front();
        for (const std::size_t other : times) {
            // each component may have a clock of its own; that of the first holds for all only when they are the same
            const bool is_same_kind =
                title(other)->unit.seconds == title(*layout_.time)->unit.seconds && title(other)->text == title(*layout_.time)->text;
            if (other != *layout_.time && is_same_kind && !are_equal_columns(*table_, other, *layout_.time)) {
                file_->fail(
                    heading_->titles_line,
                    fmt::format("columns {} and {} are both times, and differ (each component has its own)", *layout_.time + 1, other + 1),
                    {"give the columns of one component with ", Setting::columns});
            }
        }
    }

    /// A first column that rises is the time, whatever its title, unless that names a unit of something else or counts rows.
    void find_untitled_time() {
        const std::size_t first = layout_.samples.empty() ? 0 : layout_.samples.front();
        const ColumnTitle* head = title(first);
        if (layout_.samples.size() < 2 || head->unit.is_known() || !head->unknown_unit.empty() || head->quantity) return;
        const bool is_beside_index = first == 1 && is_index_column(*table_, 0);
        if (first != 0 && !is_beside_index) return;
        if (!is_rising(*table_, first, table_->rows.size())) return;
        layout_.samples.erase(layout_.samples.begin());
        layout_.names.erase(layout_.names.begin());
        if (is_index_column(*table_, first)) {
            layout_.index = first;
        } else {
            layout_.time = first;
        }
    }

    void use_values() {
        if (has_counts_row(*table_)) return use_counts_row();
        if (table_->columns() > 1) {
            if (const std::optional<std::size_t> size = find_timed_groups(*table_)) reshape(*file_, *table_, *size);
        }
        const std::size_t width = table_->columns();
        if (find_time_by_values()) {
            require_even_rows(*file_, *table_, false);
            for (std::size_t column = 0; column < width; ++column) {
                const bool is_copy = layout_.time && column != *layout_.time && are_equal_columns(*table_, column, *layout_.time);
                if (column != layout_.time && column != layout_.index && !is_copy && !is_dated(column) && !is_empty_column(*table_, column))
                    add(column);
            }
            refuse_integrals();
            return;
        }
        const bool ends_short = table_->rows.back().size < width && table_->rows.size() > 1;
        require_even_rows(*file_, *table_, width > kMostUntimedComponents);
        const TableShape shape = ends_short ? TableShape::series : width == 1 ? TableShape::components : compare_neighbors(*table_);
        if (shape == TableShape::series && width <= kMostUntimedComponents) refuse_unclear_shape();
        if (shape == TableShape::series) return use_series();
        if (shape == TableShape::unclear) refuse_unclear_shape();
        for (std::size_t column = 0; column < width; ++column) {
            if (!is_empty_column(*table_, column)) add(column);
        }
        refuse_integrals();
    }

    /// Accelerations, velocities and displacements whose titles do not say so would be taken for components.
    void refuse_integrals() const {
        for (std::size_t i = 1; i < layout_.samples.size(); ++i) {
            std::size_t column = layout_.samples[i - 1], next = layout_.samples[i];
            if (says_quantity(column) || says_quantity(next)) continue;
            if (!is_integral(*table_, next, column)) std::swap(column, next);
            if (!is_integral(*table_, next, column)) continue;
            file_->fail(table_->rows.front().line,
                        fmt::format("{} is the integral of {} (a velocity beside an acceleration, or the like)", place_of(next, *heading_),
                                    place_of(column, *heading_)),
                        {"name what to read with ", Setting::columns});
        }
    }

    bool says_quantity(std::size_t column) const {
        return title(column) != nullptr && (title(column)->quantity || title(column)->unit.is_known() || title(column)->is_remark);
    }

    [[noreturn]] void refuse_unclear_shape() const {
        const std::size_t width = table_->columns();
        std::string components = "x=1,y=2";
        if (width > 2) components += ",z=3";
        file_->fail(
            table_->rows.front().line,
            fmt::format("{} values a line without titles or times (components side by side, or several values a line of one)", width),
            {"give ", Setting::columns, fmt::format(": {} for components, x=1-{} for one series", components, width)});
    }

    void use_series() {
        layout_.is_series = table_->columns() > 1;
        reshape(*file_, *table_, 1);
        layout_.samples = {0};
        layout_.names = {""};
    }

    void use_counts_row() {
        const double count = table_->values[0];
        layout_.dt = table_->values[1];
        const std::size_t line = table_->rows.front().line;
        table_->rows.erase(table_->rows.begin());
        use_series();
        if (count != static_cast<double>(table_->rows.size())) {
            file_->fail(line, fmt::format("{} points announced ({} follow)", count, table_->rows.size()),
                        "correct the number or fetch the record again");
        }
    }

    /// True when a column without title is the time or an index.
    bool find_time_by_values() {
        const std::size_t width = table_->columns();
        for (std::size_t column = 0; column < table_->kinds.size() && column < width; ++column) {
            if (table_->kinds[column] == CellKind::instant) {
                layout_.time = column;
                return true;
            }
        }
        const bool is_even =
            std::all_of(table_->rows.begin(), table_->rows.end() - 1, [&](const TextRow& row) { return row.size == width; });
        if (width < 2 || !is_even || table_->rows.size() < 2) return false;
        if (table_->rows.back().size != width && !is_rising_but_last(0)) return false;
        if (table_->rows.back().size != width) require_even_rows(*file_, *table_, false);
        if (is_rising(*table_, 0, table_->rows.size())) {
            if (!is_index_column(*table_, 0) || heading_->stated.seconds) {
                layout_.time = 0;
                return true;
            }
            layout_.index = 0;
        }
        std::vector<std::size_t> others;
        for (std::size_t column = 1; column < width; ++column)
            if (looks_like_seconds(*table_, column)) others.push_back(column);
        const std::size_t columns_of_samples = width - (layout_.index ? 1 : 0) - others.size();
        if (others.empty() || columns_of_samples == 0) return layout_.index.has_value();
        if (others.size() > 1) {
            file_->fail(table_->rows.front().line,
                        fmt::format("columns {} and {} both rise evenly (which is the time?)", others[0] + 1, others[1] + 1),
                        {"give ", Setting::columns});
        }
        layout_.time = others.front();
        return true;
    }

    // a last row that lacks values is damage beside times, and the end of a series otherwise
    bool is_rising_but_last(std::size_t column) const {
        return table_->rows.size() > 2 && is_rising(*table_, column, table_->rows.size() - 1);
    }

    const TextFile* file_;
    TextTable* table_;
    const TextHeading* heading_;
    const ReadOptions* options_;
    TextLayout layout_;
};

}  // namespace

std::string place_of(std::size_t column, const TextHeading& heading) {
    const std::string title = column < heading.titles.size() ? heading.titles[column].text : "";
    return title.empty() ? fmt::format("column {}", column + 1) : fmt::format("column {} {}", column + 1, quoted(std::string_view(title)));
}

TextLayout find_text_layout(const TextFile& file, TextTable& table, const TextHeading& heading, const ReadOptions& options) {
    return LayoutFinder(file, table, heading, options).find();
}

}  // namespace musim::records::detail
