#pragma once

#include <vector>

#include "lsdem/solid/solid.hpp"

namespace musim::lsdem {

/// Edges of a solid that are seen as lines, beside its faces.
struct SolidEdges {
    /// For each piece, each of its faces, each corner: is the edge from it to the next one a line? False where an outer face of another
    /// piece goes on in the same plane.
    std::vector<std::vector<std::vector<bool>>> drawn;
};

/// Compares outer faces along their edges on inner ones; directions and places that differ by less than 1e-6, of the size, are the same.
SolidEdges find_edges(const Solid& solid);

}  // namespace musim::lsdem
