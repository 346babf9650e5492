#pragma once

#include <cstdint>

namespace musim::lsdem::detail {

/// Two boxes and the faces by which they meet. The half space z ≤ h is box b without rotation, axis 2, sign 1, place (x, y, h) below the
/// middle of a, half extents (r, r, 0), r four times the diagonal of a: a sheet, whose sides a does not reach.
struct BoxMeeting {
    struct Box {
        const double* rotation;  ///< body to world, column by column
        const double* position;  ///< of the middle [m]
        const double* half;      ///< half extents [m]
        std::uint8_t axis;       ///< of the face's normal
        double sign;             ///< 1 or -1: outward is sign · axis
    };
    Box a, b;
};

/// Names the faces by which two boxes meet: of the pairs of faces that look at each other, the one along which they overlap least. False if
/// no pair of faces is within 15°: take the exact function.
bool choose_faces(BoxMeeting& pair);

}  // namespace musim::lsdem::detail
