#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"
#include "records/headers/header_fields.hpp"

namespace musim::records::detail {
namespace {

struct CsvHeader {
    GroundMotion motion;
    std::vector<SampleUnit> units;  ///< one for all columns, or one each
    std::optional<scaling::Time> start;
    std::optional<scaling::Time> dt;
    std::vector<std::string_view> directions;  ///< azimuths [deg], or up
};

std::vector<std::string_view> split_cells(std::string_view line) {
    std::vector<std::string_view> cells;
    for (std::size_t comma = line.find(','); comma != std::string_view::npos; comma = line.find(',')) {
        cells.push_back(trim(line.substr(0, comma)));
        line.remove_prefix(comma + 1);
    }
    cells.push_back(trim(line));
    return cells;
}

double header_number(const TextFile& file, std::size_t index, std::string_view key, std::string_view text) {
    const std::optional<double> value = parse_real(text);
    if (!value) file.fail(index, fmt::format("{} is {} (no finite number)", key, quoted(text)), "repair the line or write the file again");
    return *value;
}

// "# dt_s: 0.005"
void read_header_line(const TextFile& file, std::size_t index, CsvHeader& header) {
    const std::string_view line = trim(file.line(index).substr(1));
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) return;
    const std::string_view key = line.substr(0, colon);
    const std::string_view value = trim(line.substr(colon + 1));
    if (key == "event") header.motion.event = value;
    if (key == "station") header.motion.station = value;
    if (key == "history") header.motion.history.emplace_back(value);
    if (key == "start_s") header.start = header_number(file, index, key, value) * scaling::si::seconds;
    if (key == "dt_s") header.dt = checked_dt(file, index, header_number(file, index, key, value));
    if (key == "time_zero_utc") {
        header.motion.time_zero = parse_date_time(value);
        if (!header.motion.time_zero) {
            file.fail(index, fmt::format("time_zero_utc is {} (no date and time)", quoted(value)),
                      "write it as 2019/07/06 03:19:23.038300");
        }
    }
    if (key == "integration_corner_hz") {
        header.motion.integration_corner = header_number(file, index, key, value) * scaling::si::hertz;
    }
    if (key == "azimuths_deg") {
        header.directions = split_cells(value);
    }
    if (key == "unit") {
        for (const std::string_view name : split_cells(value)) {
            const std::optional<SampleUnit> unit = find_sample_unit(name);
            if (!unit)
                file.fail(index, fmt::format("unit {} is unknown (known: {})", quoted(name), all_sample_unit_names()), "correct the line");
            header.units.push_back(*unit);
        }
    }
}

// cells of one row; a component that has ended leaves its cell empty from then on
void read_row(const TextFile& file, std::size_t index, std::size_t row, const CsvHeader& header,
              std::vector<std::vector<double>>& columns) {
    const std::vector<std::string_view> cells = split_cells(file.line(index));
    if (cells.size() != columns.size() + 1) {
        file.fail(index, fmt::format("{} cells (the title line has {})", cells.size(), columns.size() + 1), "write the file again");
    }
    const double expected = header.start->value() + static_cast<double>(row) * header.dt->value();
    if (!(std::abs(header_number(file, index, "time", cells[0]) - expected) < 0.5 * header.dt->value())) {
        file.fail(index, fmt::format("time is {} s (start_s and dt_s give {} s)", cells[0], expected), "write the file again");
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (cells[i + 1].empty()) continue;
        if (columns[i].size() != row) file.fail(index, "value after an empty cell (component has ended)", "write the file again");
        columns[i].push_back(checked_sample(file, index, cells[i + 1], row + 1, header.units[i].si));
    }
}

}  // namespace

GroundMotion parse_musim_csv(const TextFile& file, const ReadOptions& options) {
    CsvHeader header;
    std::size_t index = 1;
    for (; file.line(index).starts_with('#'); ++index) read_header_line(file, index, header);
    if (header.units.empty() || !header.start || !header.dt) {
        file.fail("header lacks unit, start_s or dt_s (all are needed)", "write the file again");
    }
    // what is asked for may be any of the columns' quantities
    const auto is_asked = [&](const SampleUnit& unit) { return unit.quantity == options.quantity; };
    const auto asked = std::find_if(header.units.begin(), header.units.end(), is_asked);
    refuse_contradictions(file, options, asked == header.units.end() ? header.units.front() : *asked, *header.dt);

    const std::vector<std::string_view> titles = split_cells(file.line(index));
    if (titles.size() < 2 || titles[0] != "time_s") file.fail(index, "title line is missing (time_s,NAME,...)", "write the file again");
    std::vector<std::vector<double>> columns(titles.size() - 1);
    if (header.units.size() == 1) header.units.resize(columns.size(), header.units.front());
    if (header.units.size() != columns.size()) {
        file.fail(index, fmt::format("{} components (the header names {} units)", columns.size(), header.units.size()),
                  "write the file again");
    }
    header.directions.resize(columns.size());
    ++index;
    for (std::size_t row = 0; index < file.size() && !file.line(index).empty(); ++row, ++index) {
        read_row(file, index, row, header, columns);
    }

    GroundMotion motion = std::move(header.motion);
    motion.source = file.path().string();
    motion.format = "musim CSV";
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (columns[i].empty()) {
            file.fail(fmt::format("component {} has no samples (file is truncated)", titles[i + 1]), "write the file again");
        }
        motion.components.push_back({std::string(titles[i + 1]),
                                     parse_real(header.directions[i]),
                                     {header.units[i].quantity, *header.start, *header.dt, std::move(columns[i])},
                                     header.directions[i] == kUp});
    }
    return motion;
}

}  // namespace musim::records::detail
