#include "lsdem/contact/overlap_pairs.hpp"

#include <algorithm>

#include "lsdem/contact/box_gap.hpp"
#include "lsdem/contact/overlap_contact.hpp"
#include "lsdem/contact/overlap_lanes.hpp"

namespace musim::lsdem {
namespace {

/// The ground reaches so many radii of a block beyond the block, to all sides: it has no edges where it is met [-].
constexpr double kGroundReach = 4.0;
constexpr double kUpright[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};

/// Both bodies of a pair about its origin: half way between two blocks, the centre of a block on the ground. The leader comes first.
OverlapBodies find_bodies(const Bodies& bodies, const BasePose& base, const ContactPair& pair, OverlapPieces& room) {
    const std::size_t l = pair.leader, f = pair.follower;
    if (pair.follower == kGround)
        return {{bodies.half[l], bodies.rotation[l], Vector3::Zero()}, base.displacement.z() - bodies.position[l].z(), room};
    const Vector3 half_way = 0.5 * (bodies.position[f] - bodies.position[l]);
    return {{bodies.half[l], bodies.rotation[l], -half_way}, {bodies.half[f], bodies.rotation[f], half_way}, room};
}

PairMotion find_motion(const Bodies& bodies, const BasePose& base, const ContactPair& pair) {
    const std::size_t l = pair.leader, f = pair.follower;
    PairMotion motion;
    motion.turn[0] = bodies.rotation[l] * bodies.previous_rotation[l].transpose();
    if (pair.follower == kGround) {
        motion.center = motion.previous_center = {Vector3::Zero(), Vector3::Zero()};
        motion.turn[1] = Matrix3::Identity();
        motion.shift = (base.displacement - bodies.position[l]) - (base.previous - bodies.previous_position[l]);
        return motion;
    }
    motion.turn[1] = bodies.rotation[f] * bodies.previous_rotation[f].transpose();
    const Vector3 apart = bodies.position[f] - bodies.position[l], previous = bodies.previous_position[f] - bodies.previous_position[l];
    motion.center = {Vector3(-0.5 * apart), Vector3(0.5 * apart)};
    motion.previous_center = {Vector3(-0.5 * previous), Vector3(0.5 * previous)};
    motion.shift = apart - previous;
    return motion;
}

/// How far the bodies of a pair are apart at least; zero or less where they may overlap [m].
double find_gap(const Bodies& bodies, const BasePose& base, const ContactPair& pair) {
    const std::size_t l = pair.leader, f = pair.follower;
    if (pair.follower == kGround) {
        const double reach = bodies.rotation[l].row(2).cwiseAbs().dot(bodies.half[l]);
        return (bodies.position[l].z() - base.displacement.z()) - reach;
    }
    const Matrix3 to_follower = bodies.rotation[f].transpose();
    const Vector3 position = to_follower * (bodies.position[l] - bodies.position[f]);
    return detail::find_gap(bodies.half[l], bodies.half[f], to_follower * bodies.rotation[l], position);
}

Vector3 pick(const detail::Lanes3& v, std::size_t lane) { return {v.x[lane], v.y[lane], v.z[lane]}; }

Vector3 outward(const detail::BoxMeeting::Box& box) { return box.sign * Eigen::Map<const Matrix3>(box.rotation).col(box.axis); }

/// What one lane found, about the origin of the pair, which lies at `shift` from the point half way between the bodies.
OverlapGeometry geometry_of_lane(const detail::LaneOverlap& found, std::size_t lane, const detail::BoxMeeting& meeting,
                                 const Vector3& shift) {
    OverlapGeometry geometry;
    geometry.load.force = pick(found.force, lane);
    geometry.load.moment = pick(found.moment, lane) - shift.cross(geometry.load.force);
    geometry.load.deepest = found.deepest[lane];
    geometry.load.area = found.area[lane];
    if (!geometry.touches() || !(found.area[lane] > 0.0)) return geometry;
    const Vector3 a = outward(meeting.a), b = outward(meeting.b);
    const double share = share_of_facing(-a.dot(b));
    ContactArea& area = geometry.area;
    area.area = share * found.area[lane];
    area.arm = pick(found.area_place, lane) / found.area[lane] - shift - geometry.pressed();
    const Vector3 square = pick(found.area_square, lane), cross = pick(found.area_cross, lane);
    area.second << square.x(), cross.z(), cross.y(), cross.z(), square.y(), cross.x(), cross.y(), cross.x(), square.z();
    const Vector3 slope = -(a + b);
    const double depth = found.area_depth[lane] / found.area[lane];
    geometry.load.energy = 0.5 * (found.area[lane] * depth * depth + slope.dot(area.second * slope));
    area.second *= share;
    area.depth = {depth, slope};
    return geometry;
}

}  // namespace

OverlapBatch::OverlapBatch(const Bodies& bodies, const BasePose& base, double dt, ContactList& list)
    : bodies_(bodies), base_(base), dt_(dt), list_(list) {}

void OverlapBatch::add(std::size_t index) {
    const ContactPair& pair = list_.pairs[index];
    if (!list_.overlaps[pair.overlap].touches) {
        const double gap = find_gap(bodies_, base_, pair);
        const double trusted = list_.first_step ? 0.0 : list_.trusted_gap * gap;
        list_.next_look[index] = trusted > 0.0 ? bodies_.travel_of(pair.leader, pair.follower) + trusted : 0.0;
        if (gap > 0.0) {
            list_.forces[index] = PairForce{};
            list_.tallies[index] = PairTally{};
            return;
        }
    }
    const std::size_t l = pair.leader, f = pair.follower;
    detail::BoxMeeting& meeting = meetings_[count_];
    meeting.a = {bodies_.rotation[l].data(), bodies_.position[l].data(), bodies_.half[l].data(), 0, 1.0};
    if (pair.follower == kGround) {
        const double reach = kGroundReach * bodies_.half[l].norm();
        ground_half_[count_] = {reach, reach, 0.0};
        ground_place_[count_] = {bodies_.position[l].x(), bodies_.position[l].y(), base_.displacement.z()};
        meeting.b = {kUpright, ground_place_[count_].data(), ground_half_[count_].data(), 2, 1.0};
    } else {
        meeting.b = {bodies_.rotation[f].data(), bodies_.position[f].data(), bodies_.half[f].data(), 0, 1.0};
    }
    if (!detail::choose_faces(meeting)) {
        OverlapBodies both = find_bodies(bodies_, base_, pair, room_);
        finish(index, find_overlap_geometry(both.pieces()), both);
        return;
    }
    index_[count_++] = index;
    if (count_ == kSize) compute();
}

void OverlapBatch::compute() {
    static_assert(kSize == detail::kLanes);
    if (count_ == 0) return;
    // a lane that is left over repeats the first
    for (std::size_t lane = count_; lane < kSize; ++lane) meetings_[lane] = meetings_[0];
    detail::LaneOverlap found;
    detail::compute_overlaps(meetings_.data(), found);
    const std::size_t count = count_;
    count_ = 0;
    for (std::size_t lane = 0; lane < count; ++lane) {
        const ContactPair& pair = list_.pairs[index_[lane]];
        OverlapBodies both = find_bodies(bodies_, base_, pair, room_);
        if (found.irregular[lane] != 0) {
            finish(index_[lane], find_overlap_geometry(both.pieces()), both);
            continue;
        }
        const Vector3 shift =
            pair.follower == kGround ? Vector3(0.5 * (bodies_.position[pair.leader] - ground_place_[lane])) : Vector3(Vector3::Zero());
        finish(index_[lane], geometry_of_lane(found, lane, meetings_[lane], shift), both);
    }
}

void OverlapBatch::finish(std::size_t index, const OverlapGeometry& geometry, OverlapBodies& both) {
    const ContactPair& pair = list_.pairs[index];
    OverlapContact& contact = list_.overlaps[pair.overlap];
    PairForce& force = list_.forces[index];
    PairTally& tally = list_.tallies[index];
    const PairMotion motion = find_motion(bodies_, base_, pair);
    const OverlapForces found =
        compute_overlap_contact(geometry, motion, pair.law, dt_, list_.first_step, tally.elastic_shear, both, contact);
    force.force = -found.force;
    force.leader_torque = motion.center[0].cross(found.force) - found.moment;
    force.follower_torque = found.moment - motion.center[1].cross(found.force);
    tally.elastic_normal = found.elastic_normal;
    tally.elastic_shear = found.elastic_shear;
    tally.overlap = found.overlap;
    tally.touching = contact.touches ? 1 : 0;
    list_.work[index] += found.work;
    if (list_.demand.wanted) list_.demand.ask(index, found.area);
    if (!(found.overlap > 0.0)) return;
    deepest_ = std::max(deepest_, found.overlap / (2.0 * bodies_.half[pair.leader].z()));
}

void refine_overlap_energies(const Bodies& bodies, const BasePose& base, ContactList& list) {
    OverlapPieces room;
    for (std::size_t p = 0; p < list.pairs.size(); ++p) {
        const ContactPair& pair = list.pairs[p];
        if (!pair.is_overlap() || !list.overlaps[pair.overlap].touches) continue;
        list.tallies[p].elastic_normal = pair.law.normal_stiffness * find_bodies(bodies, base, pair, room).energy();
    }
}

}  // namespace musim::lsdem
