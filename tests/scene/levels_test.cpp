#include "lsdem/scene/detail/placement.hpp"

#include <doctest/doctest.h>

using namespace musim::lsdem;

TEST_CASE("blocks of one course share a level whatever their order and size and the scale") {
    // two courses of two blocks of slightly different height, a lintel across, a small block on it
    for (const double scale : {1.0, 1.0 / 1024.0, 4096.0}) {
        CAPTURE(scale);
        std::vector<Vector3> position{{0, 0, 1.5}, {0, 0, 0.5}, {3, 0, 0.51}, {3, 0, 1.53}, {1.5, 0, 2.25}, {1.5, 0, 2.6}};
        std::vector<Vector3> extent{{1, 1, 1}, {1, 1, 1}, {1, 1, 1.02}, {1, 1, 1.02}, {4, 1, 0.5}, {0.2, 0.2, 0.2}};
        for (Vector3& each : position) each *= scale;
        for (Vector3& each : extent) each *= scale;
        CHECK(detail::find_levels(position, extent) == std::vector<int>{2, 1, 1, 2, 3, 4});
    }
    CHECK(detail::find_levels({}, {}).empty());
}
