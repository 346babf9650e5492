#include "lsdem/contact/overlap_contact.hpp"

#include "lsdem/contact/lane_pairs.hpp"

namespace musim::lsdem {

OverlapGeometry find_overlap_geometry(const OverlapPieces& pieces) {
    OverlapGeometry geometry{sum_load(pieces), {}};
    if (geometry.touches()) geometry.area = find_contact_area(pieces, geometry.pressed());
    return geometry;
}

namespace detail {
namespace {

using One = Lane<Wide<1>>;
using Vector = One::Vector;

Vector to_lane(const Vector3& v) { return {v.x(), v.y(), v.z()}; }
Vector3 from_lane(const Vector& v) { return One::pick(v, 0); }

One::Step::Geometry to_lane(const OverlapGeometry& geometry) {
    const Matrix3& second = geometry.area.second;
    return {to_lane(geometry.load.force),
            to_lane(geometry.load.moment),
            geometry.load.deepest,
            geometry.load.energy,
            geometry.area.area,
            to_lane(geometry.area.arm),
            {second(0, 0), second(1, 1), second(2, 2)},
            {second(1, 2), second(2, 0), second(0, 1)}};
}

/// The area of a contact as pieces of both bodies.
struct PieceCells {
    const OverlapPieces& pieces;

    static bool may_pull(const One::Step::Geometry& /*geometry*/, const One::Step::Pressure& /*dashpot*/, double /*stiffness*/) {
        return true;
    }
    One::Step::PressureSum find_pull(const One::Step::Pressure& dashpot, double stiffness) const {
        const PressureMoments pull =
            musim::lsdem::find_pull(pieces, {dashpot.at, from_lane(dashpot.slope), from_lane(dashpot.about)}, stiffness);
        return {pull.sum, to_lane(pull.at)};
    }
    double least_reach(const Vector& normal, const One::Step::Geometry& geometry) const {
        return find_least_reach(pieces, from_lane(normal), geometry.deepest);
    }
    double find_reach(const Vector& normal, const Vector& about) const {
        return musim::lsdem::find_reach(pieces, from_lane(normal), from_lane(about));
    }
};

}  // namespace

void compute_exact_pair(LanePair& pair, const MeetingSolids& solids, double dt, bool first_step, ExactRoom& room) {
    room.placed.place(pair.meeting, solids);
    room.pieces.cut(room.placed.a, room.placed.b);
    const OverlapGeometry geometry = find_overlap_geometry(room.pieces);
    Vector shift;
    const One::Step::Motion motion = One::gather_motion(&pair, to_lane(room.placed.apart), shift);
    const PieceCells cells{room.pieces};
    One::compute(&pair, to_lane(geometry), motion, dt, first_step, geometry.load.area, true, cells);
    pair.contact->company = 0;
}

}  // namespace detail
}  // namespace musim::lsdem
