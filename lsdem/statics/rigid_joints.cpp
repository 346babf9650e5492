#include "lsdem/statics/rigid_joints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "lsdem/block_height.hpp"
#include "lsdem/contact/box_meeting.hpp"
#include "lsdem/contact/placed_solid.hpp"
#include "lsdem/contact_law.hpp"

namespace musim::lsdem {
namespace {

using Polygon = std::vector<Vector3>;

/// A plane and what meets in it, about the origin of a pair.
struct Meeting {
    Vector3 normal;  ///< from the first body into the second
    Polygon corners;
};

/// Room between a face of one solid and all of another along its normal [m].
double find_room(const PlacedPiece& of, std::size_t face, const PlacedPiece& other) {
    double room = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < other.corner_count; ++c) room = std::min(room, -of.depth(face, other.corner[c]));
    return room;
}

/// The part of a polygon where n·x ≤ limit.
Polygon cut_off(const Polygon& polygon, const Vector3& n, double limit) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
        const double start = n.dot(from) - limit, end = n.dot(to) - limit;
        if (start <= 0.0) kept.push_back(from);
        if ((start < 0.0 && end > 0.0) || (start > 0.0 && end < 0.0)) kept.push_back(from + start / (start - end) * (to - from));
    }
    return kept;
}

/// Twice the area of a polygon over its circumference [m]: about the width of a narrow one.
double find_width(const Polygon& polygon) {
    Vector3 area = Vector3::Zero();
    double around = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
        area += 0.5 * (from - polygon[0]).cross(to - polygon[0]);
        around += (to - from).norm();
    }
    return around > 0.0 ? 2.0 * area.norm() / around : 0.0;
}

/// The face of a solid that looks at a plane of this normal the most.
std::size_t find_facing(const PlacedPiece& solid, const Vector3& normal) {
    std::size_t facing = 0;
    for (std::size_t k = 1; k < solid.face_count; ++k) {
        if (solid.normal[k].dot(normal) < solid.normal[facing].dot(normal)) facing = k;
    }
    return facing;
}

/// Where a face of the other solid lies over a face no farther than `gap`.
Polygon find_covered(const PlacedPiece& of, std::size_t face, const PlacedPiece& other, std::size_t facing, double gap) {
    const Vector3& normal = of.normal[face];
    Polygon polygon;
    for (const std::uint32_t c : other.loop(facing)) polygon.push_back(other.corner[c]);
    const auto around = of.loop(face);
    for (std::size_t i = 0; i < around.size(); ++i) {
        const Vector3 &from = of.corner[around[i]], &to = of.corner[around[(i + 1) % around.size()]];
        const Vector3 outward = (to - from).cross(normal);
        polygon = cut_off(polygon, outward, outward.dot(from));
    }
    if (!(find_width(polygon) > gap)) return {};
    return cut_off(polygon, normal, of.offset[face] + gap);
}

/// Corners of the convex hull of points as they are seen along a normal, counter-clockwise [Andrew79].
Polygon find_outline(Polygon points, const Vector3& normal) {
    const Vector3 u = normal.unitOrthogonal(), v = normal.cross(u);
    std::sort(points.begin(), points.end(),
              [&](const Vector3& l, const Vector3& r) { return std::pair(u.dot(l), v.dot(l)) < std::pair(u.dot(r), v.dot(r)); });
    Polygon outline;
    for (const bool lower : {true, false}) {
        const std::size_t kept = outline.size();
        for (const Vector3& point : points) {
            while (outline.size() >= kept + 2) {
                const Vector3 &before = outline[outline.size() - 2], &last = outline.back();
                if ((last - before).cross(point - before).dot(normal) > 0.0) break;
                outline.pop_back();
            }
            outline.push_back(point);
        }
        outline.pop_back();  // the next half begins with it
        if (lower) std::reverse(points.begin(), points.end());
    }
    return outline;
}

/// Where another solid lies over a face no farther than `gap`: with the face that looks at it the most, or with several of a hull.
Polygon find_covered(const PlacedPiece& of, std::size_t face, const PlacedPiece& other, bool is_box, double gap) {
    const Vector3& normal = of.normal[face];
    if (is_box || other.face_count == 1) return find_covered(of, face, other, find_facing(other, normal), gap);
    Polygon all;
    for (std::size_t k = 0; k < other.face_count; ++k) {
        if (!other.is_outer(k) || !(other.normal[k].dot(normal) < 0.0)) continue;
        const Polygon covered = find_covered(of, face, other, k, gap);
        all.insert(all.end(), covered.begin(), covered.end());
    }
    return all.size() < 3 ? all : find_outline(std::move(all), normal);
}

using Edge = std::array<Vector3, 2>;

std::vector<Edge> find_edges(const PlacedPiece& solid) {
    std::vector<Edge> edges;
    for (std::size_t k = 0; k < solid.face_count; ++k) {
        const auto loop = solid.loop(k);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::uint32_t from = loop[i], to = loop[(i + 1) % loop.size()];
            // every edge is in two faces, once in either direction
            if (from < to) edges.push_back({solid.corner[from], solid.corner[to]});
        }
    }
    return edges;
}

/// Least sine of the angle between two edges that cross; those that are nearer to parallel do not [-].
constexpr double kParallel = 1e-3;

/// Does an edge of one lie along one of the other, no farther apart than `gap`, over more than that?
bool have_common_edge(const PlacedPiece& a, const PlacedPiece& b, double gap) {
    const std::vector<Edge> edges_of_b = find_edges(b);
    for (const Edge& of_a : find_edges(a)) {
        const Vector3 u = of_a[1] - of_a[0];
        const double length = u.norm();
        for (const Edge& of_b : edges_of_b) {
            const Vector3 v = of_b[1] - of_b[0];
            if (u.cross(v).squaredNorm() > kParallel * kParallel * u.squaredNorm() * v.squaredNorm()) continue;
            const std::array<Vector3, 2> from{of_b[0] - of_a[0], of_b[1] - of_a[0]};
            const double first = from[0].dot(u) / length, second = from[1].dot(u) / length;
            const double common = std::min(length, std::max(first, second)) - std::max(0.0, std::min(first, second));
            const bool near = from[0].cross(u).norm() <= gap * length && from[1].cross(u).norm() <= gap * length;
            if (near && common > gap) return true;
        }
    }
    return false;
}

/// Where an edge of each cross, seen along the normal on both, no farther apart than `gap`, with all else of the solids on either side.
std::optional<Meeting> find_crossing(const PlacedPiece& a, const PlacedPiece& b, const Vector3& apart, double gap) {
    for (const Edge& of_a : find_edges(a)) {
        for (const Edge& of_b : find_edges(b)) {
            const Vector3 u = of_a[1] - of_a[0], v = of_b[1] - of_b[0], w = of_b[0] - of_a[0];
            Vector3 normal = u.cross(v);
            const double square = normal.squaredNorm();
            if (!(square > kParallel * kParallel * u.squaredNorm() * v.squaredNorm())) continue;
            const double along_a = w.cross(v).dot(normal) / square, along_b = w.cross(u).dot(normal) / square;
            // at an end of an edge the bodies do not reach over each other
            const bool inside =
                std::abs(along_a - 0.5) * u.norm() < 0.5 * u.norm() - gap && std::abs(along_b - 0.5) * v.norm() < 0.5 * v.norm() - gap;
            if (!inside) continue;
            normal *= (normal.dot(apart) < 0.0 ? -1.0 : 1.0) / std::sqrt(square);
            const Vector3 on_a = of_a[0] + along_a * u, on_b = of_b[0] + along_b * v;
            double reach_a = -std::numeric_limits<double>::infinity(), reach_b = -reach_a;
            for (std::size_t c = 0; c < a.corner_count; ++c) reach_a = std::max(reach_a, normal.dot(a.corner[c] - on_a));
            for (std::size_t c = 0; c < b.corner_count; ++c) reach_b = std::min(reach_b, normal.dot(b.corner[c] - on_b));
            const bool is_between = reach_a <= gap && reach_b >= -gap && (on_b - on_a).norm() <= gap;
            if (is_between) return Meeting{normal, {0.5 * (on_a + on_b)}};
        }
    }
    return std::nullopt;
}

std::optional<Meeting> find_meeting(const PlacedPiece& a, const PlacedPiece& b, const std::array<bool, 2>& is_box, const Vector3& apart,
                                    double gap) {
    const std::array<const PlacedPiece*, 2> solid{&a, &b};
    // the plane with the most room between the solids, along a face of one
    double most = -std::numeric_limits<double>::infinity();
    std::size_t of = 0, face = 0;
    for (std::size_t s = 0; s < 2; ++s) {
        for (std::size_t k = 0; k < solid[s]->face_count; ++k) {
            if (!solid[s]->is_outer(k)) continue;
            const double room = find_room(*solid[s], k, *solid[1 - s]);
            if (room > gap) return std::nullopt;
            if (room > most) most = room, of = s, face = k;
        }
    }
    const Polygon covered = find_covered(*solid[of], face, *solid[1 - of], is_box[1 - of], gap);
    const Vector3& outward = solid[of]->normal[face];
    if (!covered.empty()) return Meeting{of == 0 ? outward : Vector3(-outward), covered};
    return b.face_count > 1 ? find_crossing(a, b, apart, gap) : std::nullopt;
}

BodyPose pose_of(const Model& model, const Block& block) {
    BodyPose pose;
    pose.rotation = block.orientation.toRotationMatrix();
    pose.position = block.position;
    pose.half = half_extents(model, block);
    return pose;
}

/// The ground as a sheet below a block, see BoxMeeting.
BodyPose ground_below(const BodyPose& block) {
    BodyPose ground;
    ground.position = {block.position.x(), block.position.y(), 0.0};
    return ground;
}

class JointSearch {
  public:
    JointSearch(const Model& model, double gap) : model_(model), gap_(gap) {
        for (const Block& block : model.blocks) poses_.push_back(pose_of(model, block));
    }

    RigidJoints run() {
        if (model_.ground.present) {
            for (std::size_t i = 0; i < poses_.size(); ++i) meet_ground(i);
        }
        // along x, those that begin before another one ends
        std::vector<std::pair<double, std::size_t>> begins;
        for (std::size_t i = 0; i < poses_.size(); ++i) begins.emplace_back(poses_[i].position.x() - reach_of(i), i);
        std::sort(begins.begin(), begins.end());
        for (std::size_t k = 0; k < begins.size(); ++k) {
            const std::size_t i = begins[k].second;
            const double end = poses_[i].position.x() + reach_of(i);
            for (std::size_t other = k + 1; other < begins.size() && begins[other].first <= end; ++other) {
                meet(std::min(i, begins[other].second), std::max(i, begins[other].second));
            }
        }
        std::stable_sort(joints_.begin(), joints_.end(), [](const RigidJoint& l, const RigidJoint& r) {
            return std::pair(l.block, l.other) < std::pair(r.block, r.other);
        });
        return {std::move(joints_), leaves_out_edges_};
    }

  private:
    double gap_of(std::size_t i) const { return gap_ * 2.0 * poses_[i].half.z(); }
    double reach_of(std::size_t i) const { return poses_[i].half.norm() + gap_of(i); }

    void meet_ground(std::size_t i) {
        if (model_.blocks[i].fixed || poses_[i].position.z() > reach_of(i)) return;
        const BodyPose ground = ground_below(poses_[i]);
        add(i, std::nullopt, {.a = &poses_[i], .b = &ground, .origin = 0.0}, gap_of(i),
            find_joint_of_blocks(model_, i, std::nullopt).friction);
    }
    void meet(std::size_t i, std::size_t j) {
        const Block &a = model_.blocks[i], &b = model_.blocks[j];
        const double reach = reach_of(i) + reach_of(j);
        if ((a.fixed && b.fixed) || (a.position - b.position).squaredNorm() > reach * reach) return;
        add(i, j, {.a = &poses_[i], .b = &poses_[j]}, std::min(gap_of(i), gap_of(j)), find_joint_of_blocks(model_, i, j).friction);
    }
    void add(std::size_t block, std::optional<std::size_t> other, const detail::BoxMeeting& boxes, double gap, double friction) {
        const MeetingSolids solids{solid_of(block), other ? solid_of(*other) : nullptr};
        const PlacedPair pair(boxes, solids);
        const std::array<bool, 2> is_box{solids.a == nullptr, solids.b == nullptr};
        const Vector3 origin = boxes.a->position + boxes.origin * (boxes.b->position - boxes.a->position);
        for (const PlacedPiece& a : pair.a.pieces()) {
            for (const PlacedPiece& b : pair.b.pieces()) {
                std::optional<Meeting> meeting = find_meeting(a, b, is_box, pair.apart, gap);
                if (!meeting) {
                    leaves_out_edges_ = leaves_out_edges_ || (other && have_common_edge(a, b, gap));
                    continue;
                }
                for (Vector3& corner : meeting->corners) corner += origin;
                joints_.push_back({block, other, -meeting->normal, std::move(meeting->corners), friction});
            }
        }
    }
    const Solid* solid_of(std::size_t block) const { return model_.shapes[model_.blocks[block].shape].solid.get(); }

    const Model& model_;
    double gap_;
    std::vector<BodyPose> poses_;
    std::vector<RigidJoint> joints_;
    bool leaves_out_edges_ = false;
};

}  // namespace

bool is_of_flat_sides(const Model& model) {
    return std::all_of(model.blocks.begin(), model.blocks.end(), [&](const Block& block) { return model.shapes[block.shape].faceted; });
}

RigidJoints find_rigid_joints(const Model& model, double gap) { return JointSearch(model, gap).run(); }

}  // namespace musim::lsdem
