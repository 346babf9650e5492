#pragma once

#include <cstdint>

namespace musim::lsdem::detail {

/// Two boxes and the faces by which they meet.
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
