#pragma once

#include <vector>

namespace musim::lsdem::detail {

/// A place in a picture [px].
struct PicturePoint {
    double x = 0.0;
    double y = 0.0;
    friend bool operator==(const PicturePoint&, const PicturePoint&) = default;
};

/// What can be seen of a path: of more than two points in a row in the same pixel column only the lowest and the highest, in their order.
/// So a column has two points at most each time the path enters it, peaks stay, and a path without such rows stays as it is.
std::vector<PicturePoint> thin_path(const std::vector<PicturePoint>& path);

}  // namespace musim::lsdem::detail
