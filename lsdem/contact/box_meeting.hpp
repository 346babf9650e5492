#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "lsdem/body_pose.hpp"
#include "lsdem/detail/wide.hpp"

namespace musim::lsdem::detail {

/// Two boxes. The ground is box b, turned as the ground is, in the foot of the middle of a on it, half extents (r, r, 0), r twice the
/// diagonal of a: a sheet, whose sides a does not reach.
struct BoxMeeting {
    const BodyPose *a, *b;
    /// From the first centre to the origin of the pair, in parts of the way between the centres: 1/2; 0 where b is the ground.
    double origin = 0.5;
};

/// Axes of a box, or of several side by side.
template <class W>
struct BoxAxes {
    std::array<Triple<typename W::Real>, 3> axis;  ///< world axes
    std::array<typename W::Real, 3> half;          ///< half extents [m]
};

inline BoxAxes<Wide<1>> axes_of(const BodyPose& box) {
    const double* const r = box.rotation.data();
    return {{{{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}}}, {box.half[0], box.half[1], box.half[2]}};
}

/// The faces by which two boxes meet, of the first and the second.
template <class W>
struct MeetingFaces {
    using Real = typename W::Real;
    using Mask = typename W::Mask;
    Mask found{};
    std::array<std::array<Mask, 3>, 2> along{};  ///< the axis of the face's normal
    std::array<Real, 2> sign{};                  ///< 1 or -1: outward is sign · axis
};

/// Names the faces by which two boxes meet: of the pairs of faces that look at each other, the one that overlaps least. A face overlaps
/// another by the largest depth of its points below that, where one lies over the other; seen along the axes of the first box, which is
/// right to the tilt. None is found if no pair of faces is within 15°: take the exact function. `apart`: from the middle of the first to
/// that of the second.
template <class W>
MUSIM_WIDE MeetingFaces<W> choose_faces(const BoxAxes<W>& a, const BoxAxes<W>& b, const Triple<typename W::Real>& apart) {
    using Real = typename W::Real;
    using Mask = typename W::Mask;
    // of the angle between faces: 15°; the lanes themselves decide at 16°, see kLeastCosine
    const Real least_cosine = broadcast<Real>(0.966), one = broadcast<Real>(1.0), zero{};
    // b along the axes of a: its middle, its axes, and how far it reaches from its middle
    std::array<Real, 3> way, reach;
    std::array<std::array<Real, 3>, 3> cosine;
#pragma GCC unroll 3
    for (std::size_t i = 0; i < 3; ++i) {
        way[i] = dot(a.axis[i], apart);
        cosine[i] = {dot(a.axis[i], b.axis[0]), dot(a.axis[i], b.axis[1]), dot(a.axis[i], b.axis[2])};
        reach[i] = (magnitude(cosine[i][0]) * b.half[0] + magnitude(cosine[i][1]) * b.half[1]) + magnitude(cosine[i][2]) * b.half[2];
    }
    MeetingFaces<W> faces;
    Real best = broadcast<Real>(std::numeric_limits<double>::infinity());
#pragma GCC unroll 3
    for (std::size_t i = 0; i < 3; ++i) {
        // no two axes of one box can both be within 15° of a third
        const Mask first = magnitude(cosine[i][0]) > least_cosine, second = magnitude(cosine[i][1]) > least_cosine,
                   third = magnitude(cosine[i][2]) > least_cosine;
        const auto facing = [&](const std::array<Real, 3>& of)
                                MUSIM_WIDE_LAMBDA { return choose(first, of[0], choose(second, of[1], of[2])); };
        const Real side = choose(way[i] < zero, -one, one), half = facing(b.half), facing_cosine = facing(cosine[i]);
        // of b's axis along which it lies beyond that face of a
        const Real beyond = choose(side * facing_cosine < zero, -one, one);
        Real overlap = half + magnitude(facing_cosine) * (a.half[i] - magnitude(way[i]));
#pragma GCC unroll 2
        for (std::size_t step = 1; step < 3; ++step) {
            const std::size_t k = (i + step) % 3;
            const Real lean = beyond * facing(cosine[k]), middle = way[k] - lean * half, of_face = reach[k] - magnitude(lean) * half;
            const Real low = larger_of<Real>(-a.half[k], middle - of_face), high = smaller_of<Real>(a.half[k], middle + of_face);
            overlap += lean * (0.5 * (low + high) - way[k]) + magnitude(lean) * larger_of<Real>(0.5 * (high - low), zero);
        }
        const Mask better = (first | second | third) & (overlap < best);
        best = choose(better, overlap, best);
        faces.found = faces.found | better;
        faces.sign[0] = choose(better, side, faces.sign[0]);
        faces.sign[1] = choose(better, -beyond, faces.sign[1]);
        const auto name = [&better](std::array<Mask, 3>& along, const std::array<Mask, 3>& now) MUSIM_WIDE_LAMBDA {
#pragma GCC unroll 3
            for (std::size_t k = 0; k < 3; ++k) {
                const Mask before = along[k], then = now[k], kept = before & (before ^ better);
                along[k] = kept | (better & then);
            }
        };
        std::array<Mask, 3> own{};
        own[i] = better;
        name(faces.along[0], own), name(faces.along[1], {first, second, third});
    }
    return faces;
}
inline MeetingFaces<Wide<1>> choose_faces(const BoxMeeting& pair) {
    const Vector3 apart = pair.b->position - pair.a->position;
    return choose_faces<Wide<1>>(axes_of(*pair.a), axes_of(*pair.b), {apart.x(), apart.y(), apart.z()});
}

}  // namespace musim::lsdem::detail
