#include "lsdem/contact/box_meeting.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace musim::lsdem::detail {
namespace {

/// Of the angle between two faces that meet: 15°; the lanes themselves decide at 16°, see kLeastCosine.
constexpr double kFacing = 0.966;

}  // namespace

bool choose_faces(BoxMeeting& pair) {
    const BoxMeeting::Box &a = pair.a, &b = pair.b;
    const std::array<double, 3> c{b.position[0] - a.position[0], b.position[1] - a.position[1], b.position[2] - a.position[2]};
    double best = std::numeric_limits<double>::infinity();
    // without branches on the axes, which differ from pair to pair and would be mispredicted
#pragma GCC unroll 3
    for (std::size_t i = 0; i < 3; ++i) {
        const double* const n = a.rotation + 3 * i;
        const double along = n[0] * c[0] + n[1] * c[1] + n[2] * c[2];
        const auto cosine_of = [&](std::size_t j) {
            const double* const m = b.rotation + 3 * j;
            return n[0] * m[0] + n[1] * m[1] + n[2] * m[2];
        };
        const std::array<double, 3> cosine{cosine_of(0), cosine_of(1), cosine_of(2)};
        const std::array<double, 3> size{std::abs(cosine[0]), std::abs(cosine[1]), std::abs(cosine[2])};
        const double overlap = (((a.half[i] + size[0] * b.half[0]) + size[1] * b.half[1]) + size[2] * b.half[2]) - std::abs(along);
        std::size_t facing = size[1] > size[0] ? 1 : 0;
        facing = size[2] > size[facing] ? 2 : facing;
        if (!(size[facing] > kFacing) || !(overlap < best)) continue;
        best = overlap;
        const double side = along < 0.0 ? -1.0 : 1.0;
        pair.a.axis = static_cast<std::uint8_t>(i), pair.a.sign = side;
        pair.b.axis = static_cast<std::uint8_t>(facing), pair.b.sign = side * cosine[facing] < 0.0 ? 1.0 : -1.0;
    }
    return best < std::numeric_limits<double>::infinity();
}

}  // namespace musim::lsdem::detail
