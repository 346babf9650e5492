#include "lsdem/contact/overlap_pairs.hpp"

#include <algorithm>
#include <utility>

#include "lsdem/contact/overlap_contact.hpp"
#include "lsdem/contact/overlap_lanes.hpp"
#include "lsdem/solid/outline.hpp"

namespace musim::lsdem {
namespace {

/// The ground reaches so many radii of a block from its middle, to all sides: it has no edges where it is met [-].
constexpr double kGroundReach = 4.0;

/// Least distance between the bodies of a pair; zero or less where they may overlap [m].
double find_gap(const Bodies& bodies, const ContactPair& pair) {
    const std::size_t l = pair.leader, f = pair.follower;
    if (bodies.is_ground(f)) return bodies.find_height(l);
    const Matrix3 to_follower = bodies.pose[f].rotation.transpose();
    const Vector3 position = to_follower * (bodies.pose[l].position - bodies.pose[f].position);
    const Placing place{to_follower * bodies.pose[l].rotation, position};
    return find_clearance({bodies.pose[f].half, bodies.solid[f]}, {bodies.pose[l].half, bodies.solid[l]}, place, 0.0);
}

/// Memory for the pair that a thread is cutting.
detail::ExactRoom& room_of_thread() {
    thread_local detail::ExactRoom room;
    return room;
}

/// Solids of the bodies of a pair, the leader first.
MeetingSolids solids_of(const Bodies& bodies, const ContactPair& pair) { return {bodies.solid[pair.leader], bodies.solid[pair.follower]}; }

/// Both boxes of a pair, the leader first; the ground as a sheet right below its block.
detail::BoxMeeting make_meeting(const Bodies& bodies, const ContactPair& pair, BodyPose& sheet) {
    const BodyPose &leader = bodies.pose[pair.leader], &follower = bodies.pose[pair.follower];
    if (!bodies.is_ground(pair.follower)) return {&leader, &follower};
    const double reach = kGroundReach * leader.half.norm();
    const Vector3 normal = bodies.up();
    sheet.half = {reach, reach, 0.0};
    sheet.rotation = follower.rotation;
    sheet.position = (leader.position - leader.position.dot(normal) * normal) + follower.position.dot(normal) * normal;
    sheet.step.turn = follower.step.turn;
    sheet.step.shift = follower.shift_of(sheet.position);
    return {&leader, &sheet, 0.0};
}

}  // namespace

OverlapBatch::OverlapBatch(const Bodies& bodies, ContactList& list) : bodies_(bodies), list_(list) {}

void OverlapBatch::add(std::size_t index) {
    const ContactPair& pair = list_.pairs[index];
    if (!list_.overlaps[pair.overlap].touches) {
        const double gap = find_gap(bodies_, pair);
        const double trusted = list_.first_step ? 0.0 : list_.trusted_gap * gap;
        list_.next_check[index] = trusted > 0.0 ? bodies_.travel_of(pair.leader, pair.follower) + trusted : 0.0;
        if (gap > 0.0) {
            list_.forces[index] = PairForce{};
            list_.tallies[index] = PairTally{};
            return;
        }
    }
    if (pair.is_exact) {
        detail::LanePair& lane = exact_.lanes[0];
        place(index, exact_, 0);
        compute_exactly(index, lane);
        return note(index, lane.area);
    }
    waiting_[waiting_count_++] = std::uint64_t{list_.overlaps[pair.overlap].company} << 32U | index;
    if (waiting_count_ == kRoom) compute_waiting();
}

double OverlapBatch::compute() {
    compute_waiting();
    return std::exchange(deepest_, 0.0);
}

void OverlapBatch::compute_waiting() {
    const std::uint64_t* const sorted = sort();
    Group *now = &groups_[0], *next = &groups_[1];
    place(sorted, std::min(kSize, waiting_count_), *now);
    for (std::size_t done = 0; done < waiting_count_; done += kSize) {
        const std::size_t end = std::min(done + kSize, waiting_count_);
        place(&sorted[end], std::min(kSize, waiting_count_ - end), *next);
        compute(*now, *next);
        std::swap(now, next);
    }
    waiting_count_ = 0;
}

/// By company, and pairs of the same in the order in which they came: digit by digit, the lowest first.
const std::uint64_t* OverlapBatch::sort() {
    constexpr std::size_t kDigitBits = 8, kDigits = OverlapContact::kCompanyBits / kDigitBits;
    static_assert(kDigits * kDigitBits == OverlapContact::kCompanyBits);
    using Counts = std::array<std::uint32_t, 1U << kDigitBits>;
    const auto digit_of = [](std::uint64_t waiting, std::size_t digit) {
        return waiting >> (32U + digit * kDigitBits) & ((1U << kDigitBits) - 1U);
    };
    std::array<Counts, kDigits> counts{};
    std::uint64_t *from = waiting_.data(), *to = room_for_sort_.data();
    for (std::size_t i = 0; i < waiting_count_; ++i) {
        for (std::size_t digit = 0; digit < kDigits; ++digit) ++counts[digit][digit_of(waiting_[i], digit)];
    }
    for (std::size_t digit = 0; digit < kDigits; ++digit) {
        if (waiting_count_ == 0 || counts[digit][digit_of(from[0], digit)] == waiting_count_) continue;
        std::uint32_t place = 0;
        for (std::uint32_t& count : counts[digit]) count = std::exchange(place, place + count);
        for (std::size_t i = 0; i < waiting_count_; ++i) to[counts[digit][digit_of(from[i], digit)]++] = from[i];
        std::swap(from, to);
    }
    return from;
}

void OverlapBatch::place(const std::uint64_t* waiting, std::size_t count, Group& group) {
    group.count = count;
    for (std::size_t i = 0; i < count; ++i) place(waiting[i] & 0xffff'ffffU, group, i);
}

void OverlapBatch::place(std::size_t index, Group& group, std::size_t at) {
    detail::LanePair& lane = group.lanes[at];
    const ContactPair& pair = list_.pairs[index];
    group.index[at] = static_cast<std::uint32_t>(index);
    lane.meeting = make_meeting(bodies_, pair, group.sheets[at]);
    lane.law = &pair.law;
    lane.contact = &list_.overlaps[pair.overlap];
    lane.force = &list_.forces[index];
    lane.tally = &list_.tallies[index];
    lane.work = &list_.work[index];
    lane.irregular = false;
}

void OverlapBatch::compute(Group& group, const Group& next) {
    // lanes that are left over repeat the first
    const std::size_t lanes = detail::round_up_to_lanes(group.count);
    for (std::size_t i = group.count; i < lanes; ++i) (group.lanes[i] = group.lanes[0]).put_into(nowhere_);
    detail::compute_lane_pairs(group.lanes.data(), lanes, bodies_.elapsed, list_.first_step, nowhere_, {next.lanes.data(), next.count});
    for (std::size_t i = 0; i < group.count; ++i) {
        const std::size_t index = group.index[i];
        if (group.lanes[i].irregular) {
            place(index, group, i);  // its results went nowhere
            compute_exactly(index, group.lanes[i]);
        }
        note(index, group.lanes[i].area);
    }
}

void OverlapBatch::compute_exactly(std::size_t index, detail::LanePair& lane) {
    detail::compute_exact_pair(lane, solids_of(bodies_, list_.pairs[index]), bodies_.elapsed, list_.first_step, room_of_thread());
}

/// Books what a pair asks for and how deep it is; the torque on the ground is about its own origin, not that of its sheet.
void OverlapBatch::note(std::size_t index, double area) {
    const ContactPair& pair = list_.pairs[index];
    if (bodies_.is_ground(pair.follower)) {
        PairForce& forces = list_.forces[index];
        const Vector3 arm = bodies_.pose[pair.leader].position - bodies_.pose[pair.follower].position;
        forces.follower_torque = -(forces.leader_torque + arm.cross(forces.force));
    }
    if (list_.demand.wanted) list_.demand.ask(index, area);
    deepest_ = std::max(deepest_, list_.tallies[index].overlap / (2.0 * bodies_.pose[pair.leader].half.z()));
}

void visit_meeting_areas(const Bodies& bodies, const ContactList& list, const std::function<void(std::size_t, const MeetingArea&)>& visit) {
    constexpr std::size_t kSize = detail::kLanePairs;
    detail::ExactRoom& room = room_of_thread();
    std::array<std::size_t, kSize> index{};
    std::array<detail::BoxMeeting, kSize> meetings{};
    std::array<BodyPose, kSize> sheets;
    std::array<detail::LaneFinding, kSize> found;
    std::size_t count = 0;
    const auto visit_exactly = [&](std::size_t p, const detail::BoxMeeting& meeting) {
        const ContactPair& pair = list.pairs[p];
        room.placed.place(meeting, solids_of(bodies, pair));
        room.pieces.cut(room.placed.a, room.placed.b);
        const OverlapGeometry geometry = find_overlap_geometry(room.pieces);
        if (!geometry.touches()) return;
        const Vector3& leader = bodies.pose[pair.leader].position;
        const Vector3 origin = bodies.is_ground(pair.follower) ? leader : Vector3(0.5 * (leader + bodies.pose[pair.follower].position));
        visit(p, {geometry.area.area, geometry.load.force.normalized(), origin + geometry.pressed() + geometry.area.arm,
                  geometry.area.second});
    };
    const auto visit_waiting = [&] {
        const std::size_t lanes = detail::round_up_to_lanes(count);
        for (std::size_t i = count; i < lanes; ++i) meetings[i] = meetings[0];
        detail::compute_overlaps(meetings.data(), lanes, found.data());
        for (std::size_t i = 0; i < count; ++i) {
            const detail::LaneFinding& f = found[i];
            if (f.irregular) {
                visit_exactly(index[i], meetings[i]);
            } else if (f.area > 0.0) {
                const Vector3 between = 0.5 * (meetings[i].a->position + meetings[i].b->position);
                MeetingArea area{f.area, f.force.normalized(), between + f.area_place / f.area, {}};
                area.second << f.area_square.x(), f.area_cross.z(), f.area_cross.y(), f.area_cross.z(), f.area_square.y(), f.area_cross.x(),
                    f.area_cross.y(), f.area_cross.x(), f.area_square.z();
                visit(index[i], area);
            }
        }
        count = 0;
    };
    for (std::size_t p = 0; p < list.pairs.size(); ++p) {
        const ContactPair& pair = list.pairs[p];
        if (!pair.is_overlap() || !list.overlaps[pair.overlap].touches) continue;
        if (pair.is_exact) {
            BodyPose sheet;
            visit_exactly(p, make_meeting(bodies, pair, sheet));
            continue;
        }
        meetings[count] = make_meeting(bodies, pair, sheets[count]);
        index[count++] = p;
        if (count == kSize) visit_waiting();
    }
    visit_waiting();
}

double find_overlap_energy(const Bodies& bodies, const ContactList& list, std::size_t pair) {
    const PairTally& tally = list.tallies[pair];
    if (!tally.rough) return tally.elastic_normal;
    detail::ExactRoom& room = room_of_thread();
    BodyPose sheet;
    room.placed.place(make_meeting(bodies, list.pairs[pair], sheet), solids_of(bodies, list.pairs[pair]));
    room.pieces.cut(room.placed.a, room.placed.b);
    return list.pairs[pair].law.normal_stiffness * compute_overlap_energy(room.placed.a, room.placed.b, room.pieces);
}

void refine_overlap_energies(const Bodies& bodies, ContactList& list) {
    for (std::size_t p = 0; p < list.pairs.size(); ++p) {
        list.tallies[p].elastic_normal = find_overlap_energy(bodies, list, p);
        list.tallies[p].rough = false;
    }
}

}  // namespace musim::lsdem
