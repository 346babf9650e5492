#include "lsdem/scene/detail/block_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "lsdem/scene/detail/turn_about.hpp"
#include "lsdem/scene/scene_error.hpp"
#include "scaling/nearest_name.hpp"
#include "scaling/number.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::lsdem::detail {
namespace {

/// Contents of cells: lengths, an angle, a density, plain numbers, texts, truths.
enum class CellKind { length, angle, density, number, text, truth };

struct TableColumn {
    const char* name;
    CellKind cell;
    const char* key;  ///< of an entry
    int index;        ///< in the list there; -1: it is no list
};

constexpr std::array kTableColumns{TableColumn{"shape", CellKind::text, "shape", -1},
                                   TableColumn{"size_x", CellKind::length, "size", 0},
                                   TableColumn{"size_y", CellKind::length, "size", 1},
                                   TableColumn{"size_z", CellKind::length, "size", 2},
                                   TableColumn{"x", CellKind::length, "position", 0},
                                   TableColumn{"y", CellKind::length, "position", 1},
                                   TableColumn{"z", CellKind::length, "position", 2},
                                   TableColumn{"qw", CellKind::number, "quaternion", 0},
                                   TableColumn{"qx", CellKind::number, "quaternion", 1},
                                   TableColumn{"qy", CellKind::number, "quaternion", 2},
                                   TableColumn{"qz", CellKind::number, "quaternion", 3},
                                   TableColumn{"turn", CellKind::angle, "quaternion", -1},
                                   TableColumn{"material", CellKind::text, "material", -1},
                                   TableColumn{"density", CellKind::density, "density", -1},
                                   TableColumn{"fixed", CellKind::truth, "fixed", -1},
                                   TableColumn{"with_base", CellKind::truth, "with_base", -1},
                                   TableColumn{"rotation_locked", CellKind::truth, "rotation_locked", -1},
                                   TableColumn{"name", CellKind::text, "name", -1}};

/// A column of a file: what it is, and its unit.
struct Heading {
    const TableColumn* column = nullptr;
    std::string unit;
};

std::string trim(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r";
    const std::size_t first = text.find_first_not_of(kBlank);
    return first == std::string_view::npos ? "" : std::string(text.substr(first, text.find_last_not_of(kBlank) - first + 1));
}

class TableReader {
  public:
    TableReader(const std::filesystem::path& file, const std::optional<std::string>& unit) : file_(file.string()), unit_(unit) {}

    std::vector<BlockRow> read(std::string_view text) {
        if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
        std::vector<BlockRow> rows;
        while (!text.empty()) {
            ++line_;
            const std::size_t end = text.find('\n');
            const std::string line = trim(text.substr(0, end));
            text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
            if (line.empty() || line.front() == '#') continue;
            if (headings_.empty()) {
                read_headings(line);
            } else {
                rows.push_back({line_, read_row(split(line))});
            }
        }
        if (rows.empty())
            throw SceneError(fmt::format("{}: no block (a line of names of columns and one for each block are wanted)", file_));
        return rows;
    }

  private:
    [[noreturn]] void fail(const std::string& what) const { throw SceneError(fmt::format("{}:{}: {}", file_, line_, what)); }
    [[noreturn]] void fail(std::size_t column, const std::string& what) const {
        fail(fmt::format("column {} (\"{}\"): {}", column + 1, headings_[column].column->name, what));
    }

    std::vector<std::string> split(const std::string& line) const {
        std::vector<std::string> cells(1);
        bool quoted = false;
        for (std::size_t k = 0; k < line.size(); ++k) {
            const char c = line[k];
            if (c == '"' && quoted && k + 1 < line.size() && line[k + 1] == '"') {
                cells.back() += line[++k];
            } else if (c == '"') {
                quoted = !quoted;
            } else if (c == separator_ && !quoted) {
                cells.emplace_back();
            } else {
                cells.back() += c;
            }
        }
        if (quoted) fail("a quote is not closed; close it in the same line");
        for (std::string& cell : cells) cell = trim(cell);
        return cells;
    }

    void read_headings(const std::string& line) {
        for (const char c : {'\t', ';'}) {
            if (line.find(c) != std::string::npos) separator_ = c;
        }
        std::vector<std::string> names;
        for (const TableColumn& column : kTableColumns) names.emplace_back(column.name);
        const std::vector<std::string> cells = split(line);
        for (const std::string& cell : cells) {
            const std::size_t bracket = cell.find('[');
            const std::string name = trim(std::string_view(cell).substr(0, bracket));
            const auto found =
                std::find_if(kTableColumns.begin(), kTableColumns.end(), [&](const TableColumn& column) { return column.name == name; });
            if (found == kTableColumns.end()) fail(fmt::format("column \"{}\" is not known; {}", name, scaling::suggest_name(name, names)));
            const auto is_it = [&](const Heading& heading) { return heading.column == &*found; };
            if (std::any_of(headings_.begin(), headings_.end(), is_it)) fail(fmt::format("column \"{}\" is there twice; keep one", name));
            Heading& heading = headings_.emplace_back();
            heading.column = &*found;
            if (bracket != std::string::npos) heading.unit = trim(std::string_view(cell).substr(bracket + 1, cell.find(']') - bracket - 1));
            find_unit(heading);
        }
        require_together({"x", "y", "z"}, true);
        require_together({"size_x", "size_y", "size_z"}, false);
        require_together({"qw", "qx", "qy", "qz"}, false);
        if (has("turn") && has("qw")) fail("columns \"turn\" and \"qw\" (each is the orientation); keep one of the two");
    }

    void find_unit(Heading& heading) const {
        const CellKind cell = heading.column->cell;
        if (cell == CellKind::length && heading.unit.empty()) heading.unit = unit_.value_or("");
        const bool wants = cell == CellKind::length || cell == CellKind::angle || cell == CellKind::density;
        if (wants && heading.unit.empty()) {
            fail(fmt::format("column \"{}\" has no unit; write it in brackets, \"{} [{}]\"{}", heading.column->name, heading.column->name,
                             cell == CellKind::length  ? "m"
                             : cell == CellKind::angle ? "deg"
                                                       : "kg/m^3",
                             cell == CellKind::length ? ", or give the structure a \"unit\"" : ""));
        }
        if (!wants && !heading.unit.empty()) fail(fmt::format("column \"{}\" has no unit; leave the brackets out", heading.column->name));
    }

    bool has(std::string_view name) const {
        return std::any_of(headings_.begin(), headings_.end(), [&](const Heading& heading) { return heading.column->name == name; });
    }

    void require_together(const std::vector<std::string>& names, bool required) const {
        const bool any = std::any_of(names.begin(), names.end(), [&](const std::string& name) { return has(name); });
        for (const std::string& name : names) {
            if ((any || required) && !has(name)) fail(fmt::format("column \"{}\" is missing; add it", name));
        }
    }

    double read_number(std::size_t column, const std::string& cell) const {
        try {
            return scaling::parse_number(cell);
        } catch (const std::exception&) {
            fail(column, fmt::format("\"{}\" is no number; correct the cell", cell));
        }
    }

    /// Value of a cell in an entry, as its author would write it there.
    Json read_cell(std::size_t column, const std::string& cell) const {
        const Heading& heading = headings_[column];
        switch (heading.column->cell) {
            case CellKind::text:
                return cell;
            case CellKind::number:
                return read_number(column, cell);
            case CellKind::truth:
                if (cell == "true" || cell == "1") return true;
                if (cell == "false" || cell == "0") return false;
                fail(column, fmt::format("\"{}\" is neither true nor false; correct the cell", cell));
            case CellKind::length:
            case CellKind::density:
                read_number(column, cell);
                return cell + " " + heading.unit;
            case CellKind::angle:
                break;
        }
        read_number(column, cell);
        const std::array<double, 4> turn = turn_about(2, read_angle(column, cell + " " + heading.unit));
        return Json::array({turn[0], turn[1], turn[2], turn[3]});
    }

    double read_angle(std::size_t column, const std::string& text) const {
        try {
            return scaling::parse_quantity<scaling::Ratio>(text).value();
        } catch (const std::exception& error) {
            fail(column, error.what());
        }
    }

    Json read_row(const std::vector<std::string>& cells) const {
        if (cells.size() != headings_.size())
            fail(fmt::format("{} cells, but {} columns; correct the line", cells.size(), headings_.size()));
        Json entry = Json::object();
        std::map<std::string, std::size_t> filled;
        for (std::size_t k = 0; k < cells.size(); ++k) {
            if (cells[k].empty()) continue;
            const TableColumn& column = *headings_[k].column;
            const Json value = read_cell(k, cells[k]);
            if (column.index < 0) {
                entry[column.key] = value;
                continue;
            }
            ++filled[column.key];
            entry[column.key][static_cast<std::size_t>(column.index)] = value;
        }
        for (std::size_t k = 0; k < cells.size(); ++k) {
            const TableColumn& column = *headings_[k].column;
            if (column.index < 0 || !cells[k].empty()) continue;
            const auto others = filled.find(column.key);
            if (others != filled.end() || std::string_view(column.key) == "position") fail(k, "the cell is empty; fill it");
        }
        return entry;
    }

    std::string file_;
    std::optional<std::string> unit_;
    std::size_t line_ = 0;
    char separator_ = ',';
    std::vector<Heading> headings_;
};

}  // namespace

std::vector<BlockRow> read_block_table(const std::filesystem::path& file, const std::optional<std::string>& unit) {
    return TableReader(file, unit).read(read_text(file));
}

}  // namespace musim::lsdem::detail
