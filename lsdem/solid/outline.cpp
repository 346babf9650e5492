#include "lsdem/solid/outline.hpp"

#include <algorithm>

#include "lsdem/solid/box_gap.hpp"
#include "lsdem/solid/solid_gap.hpp"

namespace musim::lsdem {
namespace {

/// The solid of a body, of a box made here.
class SolidOf {
  public:
    explicit SolidOf(const Outline& outline) : solid_(outline.solid) {
        if (solid_ == nullptr) box_ = make_box_solid(2.0 * outline.half), solid_ = &box_;
    }
    const Solid& operator*() const { return *solid_; }

  private:
    Solid box_;
    const Solid* solid_;
};

}  // namespace

double find_reach(const Outline& outline, const Vector3& direction) {
    return outline.solid == nullptr ? direction.cwiseAbs().dot(outline.half) : find_reach(*outline.solid, direction);
}

double find_gap(const Outline& a, const Outline& b, const Placing& place) {
    if (a.solid == nullptr && b.solid == nullptr) return find_gap(a.half, b.half, place);
    return find_gap(*SolidOf(a), *SolidOf(b), place);
}

double find_gap(const Outline& outline, const Vector3& x) { return find_gap(*SolidOf(outline), x); }

double find_clearance(const Outline& a, const Outline& b, const Placing& place, double enough) {
    const double of_faces = find_gap_of_faces(a.half, b.half, place);
    if (of_faces > enough) return of_faces;
    const double of_boxes = std::max(of_faces, find_gap_of_edges(a.half, b.half, place));
    if (of_boxes > enough || (a.solid == nullptr && b.solid == nullptr)) return of_boxes;
    return find_gap_of_faces(*SolidOf(a), *SolidOf(b), place);
}

}  // namespace musim::lsdem
