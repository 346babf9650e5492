#include "lsdem/facing_sides.hpp"

#include <algorithm>
#include <numeric>

#include "lsdem/block_height.hpp"
#include "lsdem/block_reach.hpp"

namespace musim::lsdem {
namespace {

/// Distance from a face up to which bodies count as before it, in largest edges of its block [-]: at no number that ratios of lengths come
/// to.
constexpr double kFacingReach = 0.77;
/// Rim of a face that is not looked before [part of the way to its middle]: neighbours of an arch touch there.
constexpr double kRim = 1.0 / 16.0;
/// Cosine of the largest turn of two blocks against each other that have not left their places.
constexpr double kFacingTurn = 2.0 * kLeavingTurn * kLeavingTurn - 1.0;

/// A convex body by its corners and planes, in the frame of a block.
struct FaceOutline {
    std::vector<Vector3> corners;
    std::vector<Plane> planes;
};

/// Does a plane of one part it from the other?
bool parts(const FaceOutline& one, const FaceOutline& other) {
    return std::any_of(one.planes.begin(), one.planes.end(), [&](const Plane& plane) {
        return std::all_of(other.corners.begin(), other.corners.end(), [&](const Vector3& x) { return plane.depth(x) <= 0.0; });
    });
}

/// The room before a face, without its rim, as far as `reach` [m].
FaceOutline find_room(const Polyhedron& piece, const Polyhedron::Face& face, double reach) {
    const auto loop = piece.loop(face);
    Vector3 middle = Vector3::Zero();
    for (const std::uint32_t c : loop) middle += piece.corners[c];
    middle /= static_cast<double>(loop.size());
    const Vector3 &normal = face.plane.normal, up = reach * normal;
    FaceOutline room{{}, {{-normal, -face.plane.offset}, {normal, face.plane.offset + reach}}};
    std::vector<Vector3> rim;
    for (const std::uint32_t c : loop) rim.emplace_back(piece.corners[c] + kRim * (middle - piece.corners[c]));
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const Vector3& next = rim[i + 1 == rim.size() ? 0 : i + 1];
        const Vector3 outward = Vector3(next - rim[i]).cross(normal).normalized();
        room.planes.push_back({outward, outward.dot(rim[i])});
        room.corners.push_back(rim[i]);
        room.corners.emplace_back(rim[i] + up);
    }
    return room;
}

/// A body of a model as contacts see it; a round one as its box.
class Body {
  public:
    Body(const Model& model, const Block& block)
        : solid_(model.shapes[block.shape].solid.get()),
          box_(solid_ == nullptr ? make_box_solid(2.0 * half_extents(model, block)) : Solid{}),
          placing_{block.orientation.toRotationMatrix(), block.position} {
        bounds_ = find_bounds(solid(), placing_);
    }
    const Solid& solid() const { return solid_ == nullptr ? box_ : *solid_; }
    const Placing& placing() const { return placing_; }
    const Bounds& bounds() const { return bounds_; }  ///< world
    /// Its largest edge [m].
    double size() const { return find_bounds(solid()).size().maxCoeff(); }

    bool is_within(const Body& other, double reach) const {
        return ((bounds_.low - other.bounds_.high).array() < reach).all() && ((other.bounds_.low - bounds_.high).array() < reach).all();
    }
    /// Its pieces, in the frame of another.
    std::vector<FaceOutline> seen_from(const Body& other) const {
        const Placing place = other.placing_.inverse() * placing_;
        std::vector<FaceOutline> pieces;
        for (const Polyhedron& piece : solid().pieces) {
            FaceOutline outline;
            for (const Vector3& corner : piece.corners) outline.corners.push_back(place * corner);
            for (const Polyhedron::Face& face : piece.faces) {
                const Vector3 normal = place.rotation * face.plane.normal;
                outline.planes.push_back({normal, face.plane.offset + normal.dot(place.position)});
            }
            pieces.push_back(std::move(outline));
        }
        return pieces;
    }

  private:
    const Solid* solid_;
    Solid box_;
    Placing placing_;
    Bounds bounds_;
};

/// The faces of one block.
class FacingSides {
  public:
    explicit FacingSides(const Body& body) : body_(body), reach_(kFacingReach * body.size()) {
        for (const Polyhedron& piece : body.solid().pieces) {
            for (const Polyhedron::Face& face : piece.faces) {
                if (!face.outer) continue;
                normals_.push_back(face.plane.normal);
                rooms_.push_back(find_room(piece, face, reach_));
            }
        }
        facing_.assign(normals_.size(), false);
    }
    double reach() const { return reach_; }

    void look_at(const Body& other) {
        if (!body_.is_within(other, reach_)) return;
        for (const FaceOutline& piece : other.seen_from(body_)) {
            for (std::size_t f = 0; f < rooms_.size(); ++f) {
                if (!facing_[f]) facing_[f] = !parts(rooms_[f], piece) && !parts(piece, rooms_[f]);
            }
        }
    }

    /// `on_ground`: there is a ground.
    std::vector<bool> find_bearing(bool on_ground) const {
        std::vector<bool> bearing(facing_.size(), false);
        const auto add_near = [&](const Vector3& direction, double cosine) {
            for (std::size_t f = 0; f < bearing.size(); ++f) bearing[f] = bearing[f] || normals_[f].dot(direction) >= cosine;
        };
        for (std::size_t f = 0; f < facing_.size(); ++f) {
            if (facing_[f]) add_near(normals_[f], kFacingTurn);
        }
        if (on_ground && body_.bounds().low.z() < reach_) {
            add_near(-(body_.placing().rotation.transpose() * Vector3::UnitZ()), kLeavingTurn);
        }
        const bool any = std::find(bearing.begin(), bearing.end(), true) != bearing.end();
        return any ? bearing : std::vector<bool>(bearing.size(), true);
    }

  private:
    const Body& body_;
    double reach_;
    std::vector<Vector3> normals_;
    std::vector<FaceOutline> rooms_;
    std::vector<bool> facing_;
};

}  // namespace

std::vector<std::vector<bool>> find_facing_sides(const Model& model) {
    std::vector<std::vector<bool>> sides(model.blocks.size());
    const auto asks = [&](const Block& block) { return !block.fixed && model.shapes[block.shape].solid != nullptr; };
    if (std::none_of(model.blocks.begin(), model.blocks.end(), asks)) return sides;

    std::vector<Body> bodies;
    bodies.reserve(model.blocks.size());
    for (const Block& block : model.blocks) bodies.emplace_back(model, block);
    // by their lower ends along x
    std::vector<std::size_t> order(bodies.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto low = [&](std::size_t i) { return bodies[i].bounds().low.x(); };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return low(a) < low(b); });
    double longest = 0.0;
    for (const Body& body : bodies) longest = std::max(longest, body.bounds().size().x());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (!asks(model.blocks[i])) continue;
        FacingSides facing(bodies[i]);
        const double from = low(i) - longest - facing.reach(), to = bodies[i].bounds().high.x() + facing.reach();
        auto other = std::lower_bound(order.begin(), order.end(), from, [&](std::size_t k, double x) { return low(k) < x; });
        for (; other != order.end() && low(*other) < to; ++other) {
            if (*other != i) facing.look_at(bodies[*other]);
        }
        sides[i] = facing.find_bearing(model.ground.present);
    }
    return sides;
}

}  // namespace musim::lsdem
