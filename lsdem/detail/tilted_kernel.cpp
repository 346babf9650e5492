#include "lsdem/detail/tilted_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace musim::lsdem::detail {
namespace {

/// Faces that meet under a smaller cosine than this are no pair [-]: the polygon's edges would move by 1/cosine of what the boxes do. Of
/// the three faces of a box that look at a given direction, the best has at least 1/√3.
constexpr double kLeastCosine = 0.1;

/// Other faces take over when they overlap by less than this part of those that met first [-]: far enough below 1 that they cannot swap
/// back, and high enough that the boxes are pushed apart the short way.
constexpr double kTakeOver = 0.5;

/// The mean distance of a contact's pressure from its middle as a part of the root of the mean square: that of an evenly loaded strip. Of a
/// square it is 0.937, of a strip loaded like a wedge 0.838.
const double kMeanDistance = std::sqrt(0.75);

/// Halvings in the search for the overlap that stores a given energy: to the last bit of a double.
constexpr int kHalvings = 52;

/// An affine function on the leader's face.
struct FaceAffine {
    double at = 0.0, by_a = 0.0, by_b = 0.0;
    double operator()(double a, double b) const { return (at + by_a * a) + by_b * b; }
};

/// Which line an edge of the polygon lies on: the side plane ±y = h of the follower, along its u or v, or any other.
enum class Edge : std::int8_t { other, plus_u, minus_u, plus_v, minus_v };

struct Vertex {
    double a, b;
    Edge edge;  ///< from here to the next
};

/// Convex polygon on the leader's face, counter-clockwise in (a, b).
class FacePolygon {
  public:
    FacePolygon() {}
    FacePolygon(double half_a, double half_b) : count_(4) {
        vertices_[0] = {-half_a, -half_b, Edge::other}, vertices_[1] = {half_a, -half_b, Edge::other};
        vertices_[2] = {half_a, half_b, Edge::other}, vertices_[3] = {-half_a, half_b, Edge::other};
    }
    /// Room for vertices that are not there is neither cleared nor copied: polygons are made several times a contact and step.
    FacePolygon(const FacePolygon& other) : count_(other.count_) { std::copy_n(other.vertices_.begin(), count_, vertices_.begin()); }
    FacePolygon& operator=(const FacePolygon& other) {
        count_ = other.count_;
        std::copy_n(other.vertices_.begin(), count_, vertices_.begin());
        return *this;
    }
    ~FacePolygon() = default;

    std::size_t size() const { return count_; }
    const Vertex& operator[](std::size_t i) const { return vertices_[i]; }
    const Vertex& next(std::size_t i) const { return vertices_[i + 1 == count_ ? 0 : i + 1]; }

    /// Keeps what lies where `inside` is positive [SutherlandHodgman74].
    void clip(const FaceAffine& inside, Edge edge = Edge::other) {
        std::array<double, kMost> at;
        std::size_t within = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            at[i] = inside(vertices_[i].a, vertices_[i].b);
            within += at[i] > 0.0 ? 1 : 0;
        }
        if (within == count_) return;
        if (within == 0) {
            count_ = 0;
            return;
        }
        std::array<Vertex, kMost> kept;
        std::size_t count = 0;
        for (std::size_t i = 0; i < count_ && count + 2 <= kMost; ++i) {
            const Vertex &from = vertices_[i], &to = next(i);
            const double here = at[i], there = at[i + 1 == count_ ? 0 : i + 1];
            if (here > 0.0) kept[count++] = from;
            if ((here > 0.0) == (there > 0.0)) continue;
            const double part = here / (here - there);
            kept[count++] = {from.a + part * (to.a - from.a), from.b + part * (to.b - from.b), here > 0.0 ? edge : from.edge};
        }
        std::copy_n(kept.begin(), count, vertices_.begin());
        count_ = count;
    }

    double largest(const FaceAffine& f) const {
        double most = 0.0;
        for (std::size_t i = 0; i < count_; ++i) most = std::max(most, f(vertices_[i].a, vertices_[i].b));
        return most;
    }

    /// Calls visit(a, b, weight) at points whose weighted sum is the integral over the polygon, exact to second order: the middles of the
    /// sides of the triangles of a fan.
    template <class Visit>
    void integrate(const Visit& visit) const {
        for (std::size_t i = 1; i + 1 < count_; ++i) {
            const std::array corner{&vertices_[0], &vertices_[i], &vertices_[i + 1]};
            const double twice = (corner[1]->a - corner[0]->a) * (corner[2]->b - corner[0]->b) -
                                 (corner[2]->a - corner[0]->a) * (corner[1]->b - corner[0]->b);
            const double weight = std::max(0.0, twice) / 6.0;
            for (std::size_t j = 0; j < 3; ++j) {
                const Vertex &one = *corner[j], &two = *corner[(j + 1) % 3];
                visit(0.5 * (one.a + two.a), 0.5 * (one.b + two.b), weight);
            }
        }
    }

  private:
    // four sides, four planes of the follower, depth, `late` and pressure: one more vertex each, and room for what rounding may add
    static constexpr std::size_t kMost = 16;
    std::size_t count_ = 0;
    std::array<Vertex, kMost> vertices_;
};

/// The leader's face as the follower sees it: a point of it is (n, p, q) = (face_n, a, b) in the leader's axes.
struct FaceView {
    std::size_t k, u, v, n, p, q;
    double side, cosine, face_n;
    std::array<FaceAffine, 3> y;  ///< follower's frame [m]
    FaceAffine depth;             ///< below the follower's face [m]

    FaceView(const BoxPair& boxes, const std::array<Row, 3>& rotation, const Row& position, const TiltedFaces& faces)
        : k(faces.k),
          u((k + 1U) % 3U),
          v((k + 2U) % 3U),
          n(faces.n),
          p((n + 1U) % 3U),
          q((n + 2U) % 3U),
          side(faces.side),
          cosine(std::abs(rotation[k][n])),
          face_n(side * rotation[k][n] < 0.0 ? boxes.leader[n] : -boxes.leader[n]) {
        for (std::size_t r = 0; r < 3; ++r) y[r] = {position[r] + rotation[r][n] * face_n, rotation[r][p], rotation[r][q]};
        depth = {boxes.follower[k] - side * y[k].at, -side * y[k].by_a, -side * y[k].by_b};
    }

    Row point(double a, double b) const {
        Row place{};
        place[n] = face_n, place[p] = a, place[q] = b;
        return place;
    }

    /// The part of the leader's face that lies in the follower.
    FacePolygon find_overlap(const BoxPair& boxes) const {
        FacePolygon polygon(boxes.leader[p], boxes.leader[q]);
        // boxes overlap by a small part of a face: what is left of it then lies within most other planes
        polygon.clip(depth);
        const auto clip = [&](std::size_t axis, double sign, Edge edge) {
            if (polygon.size() == 0) return;
            polygon.clip({boxes.follower[axis] - sign * y[axis].at, -sign * y[axis].by_a, -sign * y[axis].by_b}, edge);
        };
        clip(u, 1.0, Edge::plus_u);
        clip(u, -1.0, Edge::minus_u);
        clip(v, 1.0, Edge::plus_v);
        clip(v, -1.0, Edge::minus_v);
        return polygon;
    }
};

FaceAffine less(const FaceAffine& f, double constant) { return {f.at - constant, f.by_a, f.by_b}; }

/// Displacement of the leader's face along the follower's normal over the last step [m].
FaceAffine find_opening(const RelativePose& pose, const FaceView& view) {
    const Row& change = pose.rotation_change[view.k];
    return {view.side * (pose.position_change[view.k] + change[view.n] * view.face_n), view.side * change[view.p],
            view.side * change[view.q]};
}

/// Adds the push of the polygon's edges that lie on the follower's side planes: its area shrinks as the leader moves off the follower.
void add_edges(const FaceView& view, const FacePolygon& polygon, const FaceAffine& depth, double stiffness, PlacedForce& sum) {
    const double gauss = 0.5 / std::sqrt(3.0);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vertex &from = polygon[i], &to = polygon.next(i);
        if (from.edge == Edge::other) continue;
        const bool along_u = from.edge == Edge::plus_u || from.edge == Edge::minus_u;
        const bool positive = from.edge == Edge::plus_u || from.edge == Edge::plus_v;
        const std::size_t axis = along_u ? view.u : view.v;
        const double slope = std::sqrt(view.y[axis].by_a * view.y[axis].by_a + view.y[axis].by_b * view.y[axis].by_b);
        const double da = to.a - from.a, db = to.b - from.b, length = std::sqrt(da * da + db * db);
        // depth squared times place is a cubic along the edge: two points of Gauss are exact
        for (const double part : {0.5 - gauss, 0.5 + gauss}) {
            const double a = from.a + part * da, b = from.b + part * db, d = depth(a, b);
            Row force{};
            force[axis] = (positive ? 0.5 : -0.5) * length * (0.5 * stiffness * d * d) / slope;
            sum.add(force, view.point(a, b));
        }
    }
}

/// Load of a polygon of the leader's face on which `depth` is positive.
TiltedLoad compute_load(const FaceView& view, const FacePolygon& polygon, const FaceAffine& depth, double stiffness) {
    TiltedLoad load;
    double force = 0.0, force_a = 0.0, force_b = 0.0;
    polygon.integrate([&](double a, double b, double weight) {
        const double d = std::max(0.0, depth(a, b)), share = stiffness * weight * d;
        load.area += weight;
        load.energy += 0.5 * share * d;
        force += share, force_a += share * a, force_b += share * b;
    });
    load.force.force[view.k] = view.side * force;
    load.force.by_place[view.k][view.n] = view.side * force * view.face_n;
    load.force.by_place[view.k][view.p] = view.side * force_a;
    load.force.by_place[view.k][view.q] = view.side * force_b;
    add_edges(view, polygon, depth, stiffness, load.force);
    return load;
}

/// A choice of faces, with the part of the leader's one that lies in the follower.
struct Meeting {
    bool exists = false;
    TiltedFaces faces;
    FacePolygon polygon;
    double deepest = 0.0;
};

Meeting find_meeting(const BoxPair& boxes, const FaceView& view, const TiltedFaces& faces) {
    Meeting meeting;
    if (view.cosine < kLeastCosine) return meeting;
    meeting.faces = faces;
    meeting.polygon = view.find_overlap(boxes);
    meeting.deepest = meeting.polygon.largest(view.depth);
    meeting.exists = meeting.polygon.size() >= 3 && meeting.deepest > 0.0;
    return meeting;
}

/// How far the boxes are apart across an edge of one and an edge of the other, times the sine of the angle between these edges [m]. Edges
/// nearly parallel to each other are left to the faces.
double find_gap_of_edges(const BoxPair& boxes, const std::array<Row, 3>& q, const Row& position) {
    constexpr double kParallel = 1e-6;
    double widest = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t a1 = (a + 1) % 3, a2 = (a + 2) % 3;
        for (std::size_t b = 0; b < 3; ++b) {
            const std::size_t b1 = (b + 1) % 3, b2 = (b + 2) % 3;
            if (1.0 - q[a][b] * q[a][b] < kParallel) continue;
            const double of_follower = boxes.follower[a1] * std::abs(q[a2][b]) + boxes.follower[a2] * std::abs(q[a1][b]);
            const double of_leader = boxes.leader[b1] * std::abs(q[a][b2]) + boxes.leader[b2] * std::abs(q[a][b1]);
            const double offset = std::abs(position[a2] * q[a1][b] - position[a1] * q[a2][b]);
            widest = std::max(widest, offset - (of_follower + of_leader));
        }
    }
    return widest;
}

/// The faces that meet: of all that look at each other those with the smallest depth, measured along the leader's normal. When two boxes
/// overlap, a face of the leader lies partly in the follower, so that no overlap goes unseen.
Meeting choose_faces(const BoxPair& boxes, const RelativePose& pose) {
    Meeting best;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint8_t k = 0; k < 3; ++k) {
        for (const double side : {1.0, -1.0}) {
            for (std::uint8_t n = 0; n < 3; ++n) {
                const TiltedFaces faces{k, n, side};
                const FaceView view(boxes, pose.rotation, pose.position, faces);
                const Meeting meeting = find_meeting(boxes, view, faces);
                // beyond the follower's middle its opposite face is nearer
                if (!meeting.exists || meeting.deepest > boxes.follower[k]) continue;
                if (meeting.deepest >= least * view.cosine) continue;
                least = meeting.deepest / view.cosine;
                best = meeting;
            }
        }
    }
    return best;
}

/// The overlap without force for which a meeting stores `energy`, found as a part of its depth; zero when it cannot store as much.
double find_late(const FaceView& view, const Meeting& meeting, double stiffness, double energy) {
    if (!(energy > 0.0)) return meeting.deepest;
    const auto stored = [&](double late) {
        FacePolygon polygon = meeting.polygon;
        const FaceAffine depth = less(view.depth, late);
        polygon.clip(depth);
        return compute_load(view, polygon, depth, stiffness).energy;
    };
    if (stored(0.0) <= energy) return 0.0;
    double low = 0.0, high = 1.0;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        (stored(middle * meeting.deepest) > energy ? low : high) = middle;
    }
    return high * meeting.deepest;
}

Row change_at(const RelativePose& pose, const Row& p) {
    Row change;
    for (std::size_t r = 0; r < 3; ++r) change[r] = dot(pose.rotation_change[r], p) + pose.position_change[r];
    return change;
}

/// The part of the step that a contact has lasted: all of it, unless its deepest point came from outside.
double find_part_since_touch(const FacePolygon& polygon, const FaceAffine& depth, const FaceAffine& opening) {
    double deepest = 0.0, sunk = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const double d = depth(polygon[i].a, polygon[i].b);
        if (d <= deepest) continue;
        deepest = d;
        sunk = -opening(polygon[i].a, polygon[i].b);
    }
    return sunk > deepest ? deepest / sunk : 1.0;
}

/// The dashpot as a part of the elastic force, never below −1: together they do not pull. The rate at which the boxes close is what the
/// elastic force works at, so that sliding along a face that is not the follower's closes nothing.
double find_damping(const StepLaw& law, const TiltedLoad& load, std::size_t k, double work) {
    const double pressing = load.force.force[k];
    return std::max(-1.0, -law.cn * load.area * work / (pressing * pressing));
}

/// How far a contact reaches about its middles: what it resists turning with.
struct Reach {
    double polar = 0.0;     ///< second moment of the area about its middle [m⁴]
    double distance = 0.0;  ///< r̄, for the mean distance of the pressure from its own middle [m]
};

/// Sums area and load again, from a corner of the polygon: from the middle of the face those of a thin strip would cancel.
Reach find_reach(const FacePolygon& polygon, const FaceAffine& depth) {
    // exact integrals of products of affine functions over the triangles of a fan
    double area = 0.0, area_a = 0.0, area_b = 0.0, area_squared = 0.0;
    double load = 0.0, load_a = 0.0, load_b = 0.0, load_squared = 0.0;
    const double first = std::max(0.0, depth(polygon[0].a, polygon[0].b));
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const double a1 = polygon[i].a - polygon[0].a, b1 = polygon[i].b - polygon[0].b;
        const double a2 = polygon[i + 1].a - polygon[0].a, b2 = polygon[i + 1].b - polygon[0].b;
        const double d1 = std::max(0.0, depth(polygon[i].a, polygon[i].b)), d2 = std::max(0.0, depth(polygon[i + 1].a, polygon[i + 1].b));
        const double weight = 0.5 * std::max(0.0, a1 * b2 - a2 * b1), sum_d = (first + d1) + d2;
        const double sum_a = a1 + a2, sum_b = b1 + b2, load_sum_a = d1 * a1 + d2 * a2, load_sum_b = d1 * b1 + d2 * b2;
        const double squared_1 = a1 * a1 + b1 * b1, squared_2 = a2 * a2 + b2 * b2, squared = sum_a * sum_a + sum_b * sum_b;
        area += weight, area_a += weight / 3.0 * sum_a, area_b += weight / 3.0 * sum_b;
        area_squared += weight / 12.0 * (squared + (squared_1 + squared_2));
        load += weight / 3.0 * sum_d;
        load_a += weight / 12.0 * (sum_d * sum_a + load_sum_a), load_b += weight / 12.0 * (sum_d * sum_b + load_sum_b);
        load_squared += weight / 60.0 *
                        (sum_d * (squared + (squared_1 + squared_2)) + 2.0 * (load_sum_a * sum_a + load_sum_b * sum_b) +
                         2.0 * (d1 * squared_1 + d2 * squared_2));
    }
    Reach reach;
    if (!(area > 0.0 && load > 0.0)) return reach;
    const double middle_a = load_a / load, middle_b = load_b / load;
    reach.polar = std::max(0.0, area_squared - (area_a * area_a + area_b * area_b) / area);
    reach.distance = kMeanDistance * std::sqrt(std::max(0.0, load_squared / load - (middle_a * middle_a + middle_b * middle_b)));
    if (reach.distance == 0.0) reach.polar = 0.0;
    return reach;
}

/// Turn of the leader over the last step as the follower sees it [rad].
Row find_turn(const RelativePose& pose) {
    const auto part = [&](std::size_t r, std::size_t s) { return dot(pose.rotation_change[r], pose.rotation[s]); };
    return {0.5 * (part(2, 1) - part(1, 2)), 0.5 * (part(0, 2) - part(2, 0)), 0.5 * (part(1, 0) - part(0, 1))};
}

/// Friction: one spring at the centre of pressure, across the direction in which the boxes push each other, and one against turning about
/// that direction, with one limit for both. `turned`: over the step, of which the contact has lasted `part`.
void slide(const RelativePose& pose, const Row& turned, const StepLaw& law, const TiltedLoad& load, const Reach& reach, std::size_t k,
           double part, const TiltedContact& before, TiltedContact& now) {
    const double size = std::sqrt(dot(load.force.force, load.force.force));
    Row normal;
    for (std::size_t r = 0; r < 3; ++r) {
        normal[r] = load.force.force[r] / size;
        now.place[r] = load.force.by_place[k][r] / load.force.force[k];
    }
    // a smaller area keeps the slip, a larger one the force: neither adds energy
    const double keep = now.area > before.area ? before.area / now.area : 1.0;
    const double keep_twist = reach.polar > before.polar ? before.polar / reach.polar : 1.0;
    const double turn = part * dot(turned, normal);
    double twist = keep_twist * before.twist + turn, couple_drag = -reach.polar * law.cs * turn;
    double couple = couple_drag - reach.polar * law.ks * twist;
    const Row step = change_at(pose, now.place);
    const double step_off = dot(step, normal), slip_off = dot(before.slip, normal);
    Row slip, drag, shear;
    for (std::size_t r = 0; r < 3; ++r) {
        const double tangential = part * (step[r] - step_off * normal[r]);
        slip[r] = keep * (before.slip[r] - slip_off * normal[r]) + tangential;
        drag[r] = -now.area * law.cs * tangential;
        shear[r] = drag[r] - now.area * law.ks * slip[r];
    }
    const double limit = law.mu * (1.0 + now.damping) * size;
    const double turning = reach.distance > 0.0 ? couple / reach.distance : 0.0, squared = dot(shear, shear) + turning * turning;
    if (squared > limit * limit) {
        const double scale = limit / std::sqrt(squared);
        // springs and dashpots alike: what a dashpot bore is no spring's now, which would store what no work has given it
        couple *= scale;
        couple_drag *= scale;
        twist = reach.polar > 0.0 ? -law.ks_inverse * (couple - couple_drag) / reach.polar : 0.0;
        for (std::size_t r = 0; r < 3; ++r) {
            shear[r] *= scale;
            drag[r] *= scale;
            slip[r] = -law.ks_inverse * (shear[r] - drag[r]) / now.area;
        }
    }
    now.slip = slip, now.drag = drag, now.shear = shear;
    now.polar = reach.polar, now.twist = twist;
    for (std::size_t r = 0; r < 3; ++r) now.couple[r] = couple * normal[r], now.couple_drag[r] = couple_drag * normal[r];
}

}  // namespace

TiltedLoad compute_tilted_load(const BoxPair& boxes, const RelativePose& pose, const TiltedFaces& faces, double late, double stiffness) {
    const FaceView view(boxes, pose.rotation, pose.position, faces);
    Meeting meeting = find_meeting(boxes, view, faces);
    if (!meeting.exists) return {};
    const FaceAffine depth = less(view.depth, late);
    meeting.polygon.clip(depth);
    TiltedLoad load = compute_load(view, meeting.polygon, depth, stiffness);
    load.deepest = meeting.deepest;
    return load;
}

double find_least_overlap(const BoxPair& boxes, const std::array<Row, 3>& q, const Row& position) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < 3; ++a) {
        double of_leader = 0.0, of_follower = 0.0, offset = 0.0;
        for (std::size_t b = 0; b < 3; ++b) {
            of_leader += std::abs(q[a][b]) * boxes.leader[b];
            of_follower += std::abs(q[b][a]) * boxes.follower[b];
            offset += q[b][a] * position[b];
        }
        least = std::min(least, boxes.follower[a] + of_leader - std::abs(position[a]));
        least = std::min(least, boxes.leader[a] + of_follower - std::abs(offset));
    }
    return least;
}

double find_gap(const BoxPair& boxes, const std::array<Row, 3>& rotation, const Row& position) {
    const double of_faces = -find_least_overlap(boxes, rotation, position);
    return of_faces > 0.0 ? of_faces : find_gap_of_edges(boxes, rotation, position);
}

Row compute_moment(const PlacedForce& forces, const RelativePose& pose) {
    // Σ y_r f_s with y = Q p + t
    const auto lever = [&](std::size_t r, std::size_t s) {
        return dot(pose.rotation[r], forces.by_place[s]) + pose.position[r] * forces.force[s];
    };
    return {lever(1, 2) - lever(2, 1), lever(2, 0) - lever(0, 2), lever(0, 1) - lever(1, 0)};
}

double compute_work(const PlacedForce& forces, const RelativePose& pose) {
    double work = dot(forces.force, pose.position_change);
    for (std::size_t r = 0; r < 3; ++r) work += dot(forces.by_place[r], pose.rotation_change[r]);
    return work;
}

TiltedFriction find_friction(const TiltedContact& contact) {
    const Row& push = contact.elastic.force;
    const double squared = dot(push, push);
    return {contact.shear, squared > 0.0 ? dot(contact.couple, push) / std::sqrt(squared) : 0.0};
}

bool start_tilted_contact(const BoxPair& boxes, const std::array<Row, 3>& rotation, const Row& position, const Interface& law,
                          const TiltedFaces& faces, double energy, const TiltedFriction& friction, TiltedContact& contact,
                          PairTally& tally) {
    const FaceView view(boxes, rotation, position, faces);
    Meeting meeting = find_meeting(boxes, view, faces);
    if (!meeting.exists) return false;
    contact = TiltedContact{};
    contact.touches = true;
    contact.faces = faces;
    contact.late = find_late(view, meeting, law.normal_stiffness, energy);
    const FaceAffine depth = less(view.depth, contact.late);
    meeting.polygon.clip(depth);
    const TiltedLoad load = compute_load(view, meeting.polygon, depth, law.normal_stiffness);
    contact.area = load.area;
    contact.elastic = load.force;
    tally.elastic_normal = load.energy;
    const double stiffness = load.area * law.shear_stiffness;
    if (!(load.energy > 0.0 && stiffness > 0.0)) return true;
    const Reach reach = find_reach(meeting.polygon, depth);
    const double turning_stiffness = reach.polar * law.shear_stiffness;
    if (turning_stiffness > 0.0) {
        contact.polar = reach.polar;
        contact.twist = -friction.couple / turning_stiffness;
    }
    const double size = std::sqrt(dot(load.force.force, load.force.force));
    for (std::size_t r = 0; r < 3; ++r) {
        contact.place[r] = load.force.by_place[view.k][r] / load.force.force[view.k];
        contact.slip[r] = -friction.force[r] / stiffness;
        contact.couple[r] = -turning_stiffness * contact.twist * load.force.force[r] / size;
    }
    contact.shear = friction.force;
    tally.elastic_shear = 0.5 * (stiffness * dot(contact.slip, contact.slip) + turning_stiffness * contact.twist * contact.twist);
    return true;
}

void compute_tilted_contact(const BoxPair& boxes, const RelativePose& pose, const StepLaw& law, bool first_step, const PairTally& stored,
                            TiltedContact& contact, PairSums& sums) {
    const double least = find_least_overlap(boxes, pose.rotation, pose.position);
    const TiltedContact before = contact;
    contact = TiltedContact{};

    // the faces that met stay, unless the boxes overlap much less across others
    FaceView view(boxes, pose.rotation, pose.position, before.faces);
    Meeting meeting = before.touches && least > 0.0 ? find_meeting(boxes, view, before.faces) : Meeting{};
    const bool still_meet = meeting.exists;
    if (least > 0.0 && (!still_meet || least < kTakeOver * meeting.deepest)) {
        const Meeting other = choose_faces(boxes, pose);
        if (!still_meet || (other.exists && other.deepest < kTakeOver * meeting.deepest)) {
            meeting = other;
            view = FaceView(boxes, pose.rotation, pose.position, meeting.faces);
        }
    }
    const bool lasts = before.touches && meeting.exists && meeting.faces == before.faces;
    const bool changes = before.touches && meeting.exists && !lasts;
    const bool inherits = !before.touches && before.inherited > 0.0;
    const Row turn = find_turn(pose);

    contact.touches = meeting.exists;
    contact.faces = meeting.faces;
    TiltedLoad load;
    PlacedForce total;
    if (meeting.exists) {
        // overlap that no force has worked against carries none
        if (lasts) {
            contact.late = std::min(before.late, meeting.deepest);
        } else if (changes) {
            contact.late = find_late(view, meeting, law.kn, stored.elastic_normal - compute_work(before.elastic, pose));
        } else if (inherits) {
            contact.late = find_late(view, meeting, law.kn, before.inherited);
        } else if (!first_step) {
            std::array<Row, 3> rotation = pose.rotation;
            Row position = pose.position;
            for (std::size_t r = 0; r < 3; ++r) {
                position[r] -= pose.position_change[r];
                for (std::size_t c = 0; c < 3; ++c) rotation[r][c] -= pose.rotation_change[r][c];
            }
            contact.late =
                std::min(meeting.deepest, find_meeting(boxes, FaceView(boxes, rotation, position, meeting.faces), meeting.faces).deepest);
        }
        const FaceAffine depth = less(view.depth, contact.late);
        if (contact.late > 0.0) meeting.polygon.clip(depth);
        load = compute_load(view, meeting.polygon, depth, law.kn);
        contact.area = load.area;
        contact.elastic = load.force;

        total = contact.elastic;
        if (load.energy > 0.0) {
            contact.damping = find_damping(law, load, view.k, compute_work(load.force, pose));
            total.add(contact.elastic, contact.damping);
            const double part = lasts ? 1.0 : find_part_since_touch(meeting.polygon, depth, find_opening(pose, view));
            slide(pose, turn, law, load, find_reach(meeting.polygon, depth), view.k, part, lasts ? before : TiltedContact{}, contact);
            total.add(contact.shear, contact.place);
        }
    }

    // losses: a force works over a step with the mean of its values at both ends
    const double stored_shear =
        contact.area > 0.0 ? 0.5 * law.ks * (contact.area * dot(contact.slip, contact.slip) + contact.polar * contact.twist * contact.twist)
                           : 0.0;
    const Row step_before = change_at(pose, before.place), step = change_at(pose, contact.place);
    const double dragged =
        -0.5 * (dot(before.drag, step_before) + dot(contact.drag, step) + dot(before.couple_drag, turn) + dot(contact.couple_drag, turn));
    const double sheared =
        -0.5 * (dot(before.shear, step_before) + dot(contact.shear, step) + dot(before.couple, turn) + dot(contact.couple, turn));
    const double worked_before = compute_work(before.elastic, pose), worked = compute_work(contact.elastic, pose);
    sums.damping = dragged - 0.5 * (before.damping * worked_before + contact.damping * worked);
    sums.friction = (sheared - dragged) - (stored_shear - stored.elastic_shear);
    if (changes || inherits) sums.damping += (stored.elastic_normal - load.energy) - 0.5 * (worked_before + worked);

    sums.force = total.force;
    sums.moment = compute_moment(total, pose);
    for (std::size_t r = 0; r < 3; ++r) sums.moment[r] += contact.couple[r];
    sums.elastic_normal = load.energy;
    sums.elastic_shear = stored_shear;
    sums.overlap = std::min(meeting.deepest, std::max(least, 0.0));
    sums.touching = load.area > 0.0 ? 1 : 0;
}

}  // namespace musim::lsdem::detail
