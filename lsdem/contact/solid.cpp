#include "lsdem/contact/solid.hpp"

#include "lsdem/contact/box_meeting.hpp"

namespace musim::lsdem {
namespace {

/// The corners of a box, by the signs of x, y, z in the bits of their number, around the faces -x, +x, -y, +y, -z, +z.
constexpr std::array<std::array<std::uint8_t, 4>, 6> kBoxLoops{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
constexpr std::array<std::uint8_t, 4> kSquareLoop{0, 1, 2, 3};

/// Places a box of half extents `half` [m]; `rotation`: body to world.
void place_box(const Vector3& half, const Matrix3& rotation, const Vector3& center, PlacedSolid& placed) {
    placed.face_count = kBoxLoops.size();
    placed.corner_count = 8;
    const Vector3 ex = half.x() * rotation.col(0), ey = half.y() * rotation.col(1), ez = half.z() * rotation.col(2);
    for (std::size_t c = 0; c < 8; ++c) {
        const Vector3 level = (c & 4U) != 0 ? Vector3(center + ez) : Vector3(center - ez);
        const Vector3 row = (c & 2U) != 0 ? Vector3(level + ey) : Vector3(level - ey);
        placed.corner[c] = (c & 1U) != 0 ? Vector3(row + ex) : Vector3(row - ex);
    }
    for (std::size_t a = 0; a < 3; ++a) {
        const Vector3 axis = rotation.col(static_cast<Eigen::Index>(a));
        const double along = axis.dot(center), reach = half[static_cast<Eigen::Index>(a)];
        placed.normal[2 * a] = -axis, placed.offset[2 * a] = reach - along;
        placed.normal[2 * a + 1] = axis, placed.offset[2 * a + 1] = reach + along;
    }
    for (std::size_t f = 0; f < kBoxLoops.size(); ++f) placed.loop[f] = {kBoxLoops[f].data(), kBoxLoops[f].size()};
}

}  // namespace

void place_half_space(double height, double reach, PlacedSolid& placed) {
    placed.face_count = 1;
    placed.corner_count = 4;
    placed.normal[0] = Vector3::UnitZ();
    placed.offset[0] = height;
    placed.loop[0] = {kSquareLoop.data(), kSquareLoop.size()};
    const double half = 2.0 * reach;
    for (std::size_t c = 0; c < 4; ++c) placed.corner[c] = {c == 0 || c == 3 ? -half : half, c < 2 ? -half : half, height};
}

PlacedPair::PlacedPair(const detail::BoxMeeting& boxes) {
    apart = boxes.b->position - boxes.a->position;
    const Vector3 to_origin = boxes.origin * apart;
    place_box(boxes.a->half, boxes.a->rotation, -to_origin, a);
    if (boxes.origin > 0.0) {
        place_box(boxes.b->half, boxes.b->rotation, to_origin, b);
    } else {
        place_half_space(apart.z(), boxes.a->half.norm(), b);
    }
}

}  // namespace musim::lsdem
