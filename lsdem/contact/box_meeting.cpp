#include "lsdem/contact/box_meeting.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace musim::lsdem::detail {

bool choose_faces(BoxMeeting& pair) {
    const BoxMeeting::Box &a = pair.a, &b = pair.b;
    const std::array<double, 3> c{b.position[0] - a.position[0], b.position[1] - a.position[1], b.position[2] - a.position[2]};
    double best = std::numeric_limits<double>::infinity();
#pragma GCC unroll 3
    for (std::size_t i = 0; i < 3; ++i) {
        const double* const n = a.rotation + 3 * i;
        const double along = n[0] * c[0] + n[1] * c[1] + n[2] * c[2];
        double reach = a.half[i];
        std::size_t facing = 0;
        double most = 0.0;
#pragma GCC unroll 3
        for (std::size_t j = 0; j < 3; ++j) {
            const double* const m = b.rotation + 3 * j;
            const double cosine = n[0] * m[0] + n[1] * m[1] + n[2] * m[2];
            reach += std::abs(cosine) * b.half[j];
            if (std::abs(cosine) > std::abs(most)) most = cosine, facing = j;
        }
        const double overlap = reach - std::abs(along);
        if (!(std::abs(most) > 0.966) || !(overlap < best)) continue;
        best = overlap;
        const double side = along < 0.0 ? -1.0 : 1.0;
        pair.a.axis = static_cast<std::uint8_t>(i), pair.a.sign = side;
        pair.b.axis = static_cast<std::uint8_t>(facing), pair.b.sign = side * most < 0.0 ? 1.0 : -1.0;
    }
    return best < std::numeric_limits<double>::infinity();
}

}  // namespace musim::lsdem::detail
