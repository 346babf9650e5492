#include "lsdem/contact/solid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lsdem/contact/box_meeting.hpp"

namespace musim::lsdem {
namespace {

/// Corners that lie off a plane by less than this part of the body's size lie in it [-]: far above the rounding of their places.
constexpr double kSamePlane = 1e-12;

/// The corners of a box, by the signs of x, y, z in the bits of their number, around the faces -x, +x, -y, +y, -z, +z.
constexpr std::array<std::array<std::uint8_t, 4>, 6> kBoxLoops{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
constexpr std::array<std::uint8_t, 4> kSquareLoop{0, 1, 2, 3};

/// Sorts corners in a plane counter-clockwise about its normal.
void sort_around(const std::vector<Vector3>& corners, const Vector3& normal, std::vector<std::uint8_t>& loop) {
    Vector3 middle = Vector3::Zero();
    for (const std::uint8_t c : loop) middle += corners[c] / static_cast<double>(loop.size());
    const Vector3 e = (corners[loop.front()] - middle).normalized(), f = normal.cross(e);
    const auto angle = [&](std::uint8_t c) { return std::atan2(f.dot(corners[c] - middle), e.dot(corners[c] - middle)); };
    std::sort(loop.begin(), loop.end(), [&](std::uint8_t a, std::uint8_t b) { return angle(a) < angle(b); });
}

/// The face through three corners, if all others lie on one side of them and it is not there yet.
void add_face(std::size_t i, std::size_t j, std::size_t k, double size, Solid& solid) {
    const std::vector<Vector3>& corners = solid.corners;
    Solid::Face face{.normal = (corners[j] - corners[i]).cross(corners[k] - corners[i]), .corners = {}};
    if (!(face.normal.norm() > kSamePlane * size * size)) return;
    face.normal.normalize();
    face.offset = face.normal.dot(corners[i]);
    if (face.offset < 0.0) face.normal = -face.normal, face.offset = -face.offset;
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const double beyond = face.normal.dot(corners[c]) - face.offset;
        if (beyond > kSamePlane * size) return;
        if (beyond > -kSamePlane * size) face.corners.push_back(static_cast<std::uint8_t>(c));
    }
    for (const Solid::Face& known : solid.faces) {
        if (known.corners == face.corners) return;
    }
    solid.faces.push_back(face);
}

}  // namespace

Solid make_solid(const std::vector<Vector3>& corners) {
    if (corners.size() < 4 || corners.size() > PlacedSolid::kMostCorners)
        throw std::invalid_argument("make_solid: a solid has 4 to " + std::to_string(PlacedSolid::kMostCorners) + " corners");
    Solid solid{.corners = corners, .faces = {}};
    double size = 0.0;
    for (const Vector3& corner : corners) size = std::max(size, corner.norm());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t j = i + 1; j < corners.size(); ++j) {
            for (std::size_t k = j + 1; k < corners.size(); ++k) add_face(i, j, k, size, solid);
        }
    }
    // faces were known by their corners in ascending order
    for (Solid::Face& face : solid.faces) sort_around(corners, face.normal, face.corners);
    const bool encloses = std::all_of(solid.faces.begin(), solid.faces.end(), [](const Solid::Face& f) { return f.offset > 0.0; });
    if (solid.faces.size() < 4 || !encloses) throw std::invalid_argument("make_solid: the corners do not enclose the origin");
    if (solid.faces.size() > PlacedSolid::kMostFaces)
        throw std::invalid_argument("make_solid: a solid has at most " + std::to_string(PlacedSolid::kMostFaces) + " faces");
    return solid;
}

void place(const Solid& solid, const Matrix3& rotation, const Vector3& center, PlacedSolid& placed) {
    placed.face_count = solid.faces.size();
    placed.corner_count = solid.corners.size();
    for (std::size_t c = 0; c < solid.corners.size(); ++c) placed.corner[c] = rotation * solid.corners[c] + center;
    for (std::size_t f = 0; f < solid.faces.size(); ++f) {
        const Solid::Face& face = solid.faces[f];
        placed.normal[f] = rotation * face.normal;
        placed.offset[f] = face.offset + placed.normal[f].dot(center);
        placed.loop[f] = {face.corners.data(), face.corners.size()};
    }
}

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
    using Place = Eigen::Map<const Vector3>;
    using Axes = Eigen::Map<const Matrix3>;
    apart = Place(boxes.b.position) - Place(boxes.a.position);
    const Vector3 half = Place(boxes.a.half), to_origin = boxes.origin * apart;
    place_box(half, Axes(boxes.a.rotation), -to_origin, a);
    if (boxes.origin > 0.0) {
        place_box(Place(boxes.b.half), Axes(boxes.b.rotation), to_origin, b);
    } else {
        place_half_space(apart.z(), half.norm(), b);
    }
}

}  // namespace musim::lsdem
