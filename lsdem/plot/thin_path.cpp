#include "lsdem/plot/thin_path.hpp"

#include <algorithm>
#include <cmath>

namespace musim::lsdem::detail {

std::vector<PicturePoint> thin_path(const std::vector<PicturePoint>& path) {
    std::vector<PicturePoint> thinned;
    auto first = path.begin();
    while (first != path.end()) {
        // the points in the column of the first
        const double column = std::floor(first->x);
        const auto last = std::find_if(first, path.end(), [&](const PicturePoint& point) { return std::floor(point.x) != column; });

        if (last - first <= 2) {
            thinned.insert(thinned.end(), first, last);
        } else {
            const auto [low, high] =
                std::minmax_element(first, last, [](const PicturePoint& a, const PicturePoint& b) { return a.y < b.y; });
            thinned.push_back(*std::min(low, high));
            if (low->y != high->y) thinned.push_back(*std::max(low, high));
        }
        first = last;
    }
    return thinned;
}

}  // namespace musim::lsdem::detail
