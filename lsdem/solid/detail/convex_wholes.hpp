#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lsdem/solid/detail/cells.hpp"
#include "lsdem/solid/solid.hpp"

namespace musim::lsdem::detail {

/// A convex part of a solid that is made of whole cells.
struct Whole {
    std::vector<bool> cells;    ///< is a cell in it
    std::vector<Plane> planes;  ///< of its faces
};

/// Convex parts of a solid that hold the given sets of cells and that no cell enlarges, each once. Sets that are not convex give none.
std::vector<Whole> find_wholes(std::span<const Cell> cells, std::span<const std::vector<bool>> seeds, double tolerance);

}  // namespace musim::lsdem::detail
