#include "cli/records/target_spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "cli/input_file.hpp"
#include "records/error.hpp"
#include "scaling/number.hpp"

namespace musim::cli {
namespace {

/// Cells of a CSV line; a cell in quotes may hold commas.
std::vector<std::string> split_cells(const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char letter : line) {
        if (letter == '"') quoted = !quoted;
        if (letter == ',' && !quoted) {
            cells.emplace_back();
        } else if (letter != '"' && letter != '\r') {
            cells.back() += letter;
        }
    }
    return cells;
}

bool is_number(const std::string& text) {
    try {
        scaling::parse_number(text);
        return true;
    } catch (const scaling::ParseError&) {
        return false;
    }
}

/// A line of the file, for messages.
struct Place {
    const std::string& file;
    std::size_t line;

    [[noreturn]] void fail(const std::string& message) const { throw records::ReadError(fmt::format("{}:{}: {}", file, line, message)); }
};

std::size_t find_column(const std::vector<std::string>& titles, const std::string& title, const Place& place) {
    const auto found = std::find(titles.begin(), titles.end(), title);
    if (found == titles.end())
        place.fail(fmt::format("there is no column {} (columns: {}); name it so, or the PSA in g by --target-column", title,
                               fmt::join(titles, ", ")));
    return static_cast<std::size_t>(found - titles.begin());
}

double read_cell(const std::vector<std::string>& cells, std::size_t column, const Place& place) {
    if (column >= cells.size() || !is_number(cells[column]))
        place.fail(fmt::format("column {} holds no number; correct or remove the line", column + 1));
    return scaling::parse_number(cells[column]);
}

}  // namespace

records::TargetSpectrum read_target_spectrum(const std::string& file, const std::string& column, const PeriodBand& band, double damping) {
    std::istringstream text(read_input_file(file, "a spectrum as CSV"));
    records::TargetSpectrum target{.damping = damping, .period = {}, .psa = {}};
    std::size_t period_column = 0, psa_column = 1;
    bool first = true;
    double before = 0.0;
    Place place{file, 0};
    for (std::string line; std::getline(text, line);) {
        ++place.line;
        if (line.empty() || line == "\r" || line.starts_with('#')) continue;
        const std::vector<std::string> cells = split_cells(line);
        const bool titles = first && !is_number(cells.front());
        first = false;
        if (titles) {
            period_column = find_column(cells, "period_s", place);
            psa_column = find_column(cells, column, place);
            continue;
        }
        const double period = read_cell(cells, period_column, place), psa = read_cell(cells, psa_column, place);
        if (!(period > before))
            place.fail(
                fmt::format("period {} s follows {} s (must rise); give one spectrum, such as one of a single component", period, before));
        before = period;
        if (period < band.first || period > band.last) continue;
        target.period.push_back(period * scaling::si::seconds);
        target.psa.push_back(psa * scaling::kStandardGravity);
    }
    if (target.period.empty())
        throw records::ReadError(
            fmt::format("{}: no period lies from {:g} to {:g} s; widen the band or give another spectrum", file, band.first, band.last));
    return target;
}

}  // namespace musim::cli
