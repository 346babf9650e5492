#include "lsdem/contact/face_gap.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace musim::lsdem {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Widest gap between the faces of `a` and `corners`, in its frame.
double find_widest(const Polyhedron& a, const std::vector<Vector3>& corners) {
    double widest = -kInfinite;
    for (const Polyhedron::Face& face : a.faces) {
        double least = kInfinite;
        for (const Vector3& x : corners) {
            least = std::min(least, -face.plane.depth(x));
            if (least <= widest) break;
        }
        widest = std::max(widest, least);
    }
    return widest;
}

void place_corners(const Polyhedron& piece, const Placing& place, std::vector<Vector3>& corners) {
    corners.clear();
    for (const Vector3& corner : piece.corners) corners.push_back(place * corner);
}

}  // namespace

double find_gap_of_faces(const Solid& a, const Solid& b, const Placing& place) {
    thread_local std::vector<Vector3> corners;  // room
    const Placing back = place.inverse();
    double nearest = kInfinite;
    for (const Polyhedron& piece_a : a.pieces) {
        for (const Polyhedron& piece_b : b.pieces) {
            place_corners(piece_b, place, corners);
            double widest = find_widest(piece_a, corners);
            place_corners(piece_a, back, corners);
            widest = std::max(widest, find_widest(piece_b, corners));
            nearest = std::min(nearest, widest);
        }
    }
    return nearest;
}

}  // namespace musim::lsdem
