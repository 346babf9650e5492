#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace musim::lsdem {

/// A linear program: the least cost·x with A x = right and 0 ≤ x ≤ most. Whoever writes one scales it: the solver takes 1e-7 for zero.
struct LinearProgram {
    std::vector<double> right;       ///< of every row
    std::vector<double> cost, most;  ///< of every column
    std::vector<int> begin{0};       ///< where a column begins in the two below, and where the last one ends
    std::vector<int> row;            ///< of every entry of A
    std::vector<double> entry;       ///< likewise

    explicit LinearProgram(std::size_t rows) : right(rows, 0.0) {}
    std::size_t columns() const { return cost.size(); }
    /// Adds an entry to the column that is being written.
    void put(std::size_t in_row, double value) {
        row.push_back(static_cast<int>(in_row));
        entry.push_back(value);
    }
    /// Ends the column that is being written.
    void end_column(double of_cost, double at_most = std::numeric_limits<double>::infinity()) {
        cost.push_back(of_cost);
        most.push_back(at_most);
        begin.push_back(static_cast<int>(row.size()));
    }
};

/// Was musim built with the solver, CLP of COIN-OR [Forrest04]?
bool has_linear_programs();

/// x of least cost. Nothing where the solver finds none, or not within `most_iterations`, or where there is no solver. The same program
/// gives the same bits. Rows hold to about 1e-7 in the units of the program: check what matters.
std::optional<std::vector<double>> find_least_cost(const LinearProgram& program, int most_iterations);

}  // namespace musim::lsdem
