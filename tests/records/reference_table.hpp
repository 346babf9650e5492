#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/shared_records.hpp"

/// Tables of numbers that other programs made, in the folder reference/ of the shared records, and what their rounding allows.
namespace musim::tests {

/// The rows of two numbers or more of a table, whatever parts its columns; headings and lines with "#" are left out.
inline std::vector<std::vector<double>> read_reference(const std::string& name) {
    std::ifstream file(shared_records() / name);
    std::vector<std::vector<double>> rows;
    for (std::string line; std::getline(file, line);) {
        if (line.find('#') != std::string::npos) continue;
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream stream(line);
        std::vector<double> row;
        for (double value = 0.0; stream >> value;) row.push_back(value);
        if (row.size() > 1) rows.push_back(std::move(row));
    }
    return rows;
}

/// Half a unit of the last of so many significant digits of a printed value; of zero nothing.
inline double half_unit(double value, int digits) {
    return value == 0.0 ? 0.0 : 0.5 * std::pow(10.0, std::floor(std::log10(std::abs(value)) + 1e-9) + 1.0 - digits);
}

struct Range {
    double least = 0.0;
    double largest = 0.0;

    /// Distance of a value outside.
    double distance(double value) const { return std::max({least - value, value - largest, 0.0}); }
};

/// Range that `response` takes within a printed period's rounding: looked at in nine places, the printed period in the middle.
template <class Response>
Range find_range(double period, double half_unit_of_period, Response&& response) {
    constexpr int kPlaces = 4;  // to each side
    Range range{response(period), response(period)};
    for (int place = -kPlaces; place <= kPlaces; ++place) {
        const double value = response(period + half_unit_of_period * place / kPlaces);
        range = {std::min(range.least, value), std::max(range.largest, value)};
    }
    return range;
}

}  // namespace musim::tests
