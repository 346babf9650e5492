#include "lsdem/contact/placed_solid.hpp"

#include <algorithm>

#include "lsdem/contact/box_meeting.hpp"

namespace musim::lsdem {
namespace {

/// Room for one more piece of a placed solid.
PlacedPiece& add_piece(const Polyhedron& form, PlacedSolid& placed) {
    if (placed.piece.size() == placed.piece_count) placed.piece.emplace_back();
    PlacedPiece& piece = placed.piece[placed.piece_count++];
    piece.form = &form;
    piece.face_count = form.faces.size(), piece.corner_count = form.corners.size();
    // rooms grow and never shrink
    if (piece.normal.size() < piece.face_count) piece.normal.resize(piece.face_count), piece.offset.resize(piece.face_count);
    piece.corner.resize(piece.corner_count);
    piece.nearest.clear(), piece.members.clear(), piece.whole_ends.clear();
    return piece;
}

void fill_rows(PlacedPiece& piece) {
    piece.nearest_rows.clear();
    for (std::size_t k = 0; k < piece.nearest_count(); ++k) piece.nearest_rows.push_back(piece.nearest_plane(k));
}

/// Places the planes that decide on the depth in a piece among others.
void add_wholes(const Polyhedron& form, const Matrix3& rotation, const Vector3& position, PlacedPiece& piece) {
    // equal planes have equal images
    for (const std::vector<Plane>& whole : form.wholes) {
        for (const Plane& plane : whole) {
            const Vector3 normal = rotation * plane.normal;
            const Plane placed{normal, plane.offset + normal.dot(position)};
            const auto known = std::find(piece.nearest.begin(), piece.nearest.end(), placed);
            piece.members.push_back(static_cast<std::uint32_t>(known - piece.nearest.begin()));
            if (known == piece.nearest.end()) piece.nearest.push_back(placed);
        }
        piece.whole_ends.push_back(piece.members.size());
    }
}

const Polyhedron& unit_box() {
    static const Solid box = make_box_solid(Vector3::Constant(2.0));
    return box.pieces.front();
}

/// The form of the ground: one face.
const Polyhedron& sheet() {
    static const Polyhedron form{.corners = std::vector<Vector3>(4),
                                 .faces = {{.plane = {}, .first = 0, .count = 4}},
                                 .loops = {0, 1, 2, 3},
                                 .marks = {0b1111},
                                 .neighbours = {0, 0, 0, 0},
                                 .wholes = {}};
    return form;
}

}  // namespace

void place(const Solid& solid, const Matrix3& rotation, const Vector3& position, PlacedSolid& placed) {
    placed.piece_count = 0;
    for (const Polyhedron& form : solid.pieces) {
        PlacedPiece& piece = add_piece(form, placed);
        for (std::size_t c = 0; c < piece.corner_count; ++c) piece.corner.set(c, rotation * form.corners[c] + position);
        for (std::size_t f = 0; f < piece.face_count; ++f) {
            const Plane& plane = form.faces[f].plane;
            piece.normal[f] = rotation * plane.normal;
            piece.offset[f] = plane.offset + piece.normal[f].dot(position);
        }
        if (!solid.is_convex()) add_wholes(form, rotation, position, piece);
        fill_rows(piece);
    }
}

void place_box(const Vector3& half, const Matrix3& rotation, const Vector3& position, PlacedSolid& placed) {
    placed.piece_count = 0;
    PlacedPiece& piece = add_piece(unit_box(), placed);
    const Vector3 ex = half.x() * rotation.col(0), ey = half.y() * rotation.col(1), ez = half.z() * rotation.col(2);
    for (std::size_t c = 0; c < 8; ++c) {
        const Vector3 level = (c & 4U) != 0 ? Vector3(position + ez) : Vector3(position - ez);
        const Vector3 row = (c & 2U) != 0 ? Vector3(level + ey) : Vector3(level - ey);
        piece.corner.set(c, (c & 1U) != 0 ? Vector3(row + ex) : Vector3(row - ex));
    }
    for (std::size_t a = 0; a < 3; ++a) {
        const Vector3 axis = rotation.col(static_cast<Eigen::Index>(a));
        const double along = axis.dot(position), reach = half[static_cast<Eigen::Index>(a)];
        piece.normal[2 * a] = -axis, piece.offset[2 * a] = reach - along;
        piece.normal[2 * a + 1] = axis, piece.offset[2 * a + 1] = reach + along;
    }
    fill_rows(piece);
}

void place_half_space(const Matrix3& rotation, const Vector3& foot, double reach, PlacedSolid& placed) {
    placed.piece_count = 0;
    PlacedPiece& piece = add_piece(sheet(), placed);
    piece.normal[0] = rotation.col(2);
    piece.offset[0] = rotation.col(2).dot(foot);
    const double half = 2.0 * reach;
    for (std::size_t c = 0; c < 4; ++c) {
        piece.corner.set(c, rotation * Vector3(c == 0 || c == 3 ? -half : half, c < 2 ? -half : half, 0.0) + foot);
    }
    fill_rows(piece);
}

void PlacedPair::place(const detail::BoxMeeting& poses, const MeetingSolids& solids) {
    const auto place_one = [](const BodyPose& pose, const Solid* solid, const Vector3& position, PlacedSolid& placed) {
        if (solid == nullptr) return place_box(pose.half, pose.rotation, position, placed);
        lsdem::place(*solid, pose.rotation, position, placed);
    };
    apart = poses.b->position - poses.a->position;
    const Vector3 to_origin = poses.origin * apart;
    place_one(*poses.a, solids.a, -to_origin, a);
    if (poses.origin > 0.0) {
        place_one(*poses.b, solids.b, to_origin, b);
    } else {
        place_half_space(poses.b->rotation, apart, poses.a->half.norm(), b);
    }
}

}  // namespace musim::lsdem
