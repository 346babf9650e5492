#include "lsdem/plot/body_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "lsdem/plot/solid_edges.hpp"

namespace musim::lsdem {
namespace {

using Tone = std::array<int, 3>;

/// Top, left and right side of a body by its colour; the last are those of marked ones.
struct Shades {
    const char *top, *left, *right;
};
constexpr std::array<Shades, 4> kShades{{{"#f3e3c3", "#d9bd8b", "#b99763"},
                                         {"#e4e7ea", "#b9c0c7", "#8f99a3"},
                                         {"#d7e8d4", "#a5c7a0", "#7aa474"},
                                         {"#e6dcf0", "#bfa9d6", "#9579b4"}}};
constexpr Shades kMarked{"#8fc3ea", "#3f8fca", "#1f6da8"};
constexpr const char* kEdge = R"(stroke="#4a4036" stroke-width="0.5" stroke-linejoin="round")";

const Shades& shades_of(const DrawnBody& body) {
    return body.is_marked ? kMarked : kShades[static_cast<std::size_t>(body.color) % kShades.size()];
}

Tone read_tone(const char* color) {
    const auto number = [&](int at) { return std::stoi(std::string(color + at, 2), nullptr, 16); };
    return {number(1), number(3), number(5)};
}

Tone mix(const Tone& a, const Tone& b, double share) {
    Tone mixed{};
    for (std::size_t i = 0; i < mixed.size(); ++i) mixed[i] = static_cast<int>(std::lround(a[i] + share * (b[i] - a[i])));
    return mixed;
}

/// 0 below `low`, 1 above `high`, even in between.
double rise(double value, double low, double high) { return std::clamp((value - low) / (high - low), 0.0, 1.0); }

/// Colour of a face: three tones of a box, which has no faces in between; of other solids they blend.
std::string find_shade(const Vector3& normal, const DrawnBody& body, bool is_box, const SpaceView& view) {
    const Shades& shades = shades_of(body);
    constexpr double kSlope = 0.7;  // of a face that counts as level
    const double rightward = normal.dot(view.right);
    if (is_box) return normal.z() > kSlope ? shades.top : rightward < 0.0 ? shades.left : shades.right;
    const Tone side = mix(read_tone(shades.left), read_tone(shades.right), rise(rightward, -0.6, 0.6));
    const Tone tone = mix(side, read_tone(shades.top), rise(normal.z(), 0.3, 0.9));
    return fmt::format("#{:02x}{:02x}{:02x}", tone[0], tone[1], tone[2]);
}

/// Six faces along three directions at right angles.
bool is_box(const Solid& solid) {
    if (!solid.is_convex() || solid.pieces.front().faces.size() != 6) return false;
    const auto& faces = solid.pieces.front().faces;
    constexpr double kSame = 1e-9;
    return std::all_of(faces.begin(), faces.end(), [&](const Polyhedron::Face& a) {
        return std::all_of(faces.begin(), faces.end(), [&](const Polyhedron::Face& b) {
            const double along = std::abs(a.plane.normal.dot(b.plane.normal));
            return along < kSame || along > 1.0 - kSame;
        });
    });
}

/// Properties of a solid that its faces are drawn by, found once for all bodies that share it.
struct SolidLook {
    bool is_box = false;
    SolidEdges edges;
};

class Drawing {
  public:
    Drawing(std::string& svg, const std::vector<DrawnBody>& bodies, const SpaceView& view, const ViewPlace& place)
        : svg_(svg), bodies_(bodies), view_(view), place_(place) {
        for (const DrawnBody& body : bodies) {
            solids_.push_back({body.solid.get(), body.place});
            if (looks_.find(body.solid.get()) == looks_.end()) looks_[body.solid.get()] = {is_box(*body.solid), find_edges(*body.solid)};
        }
        pieces_ = list_pieces(solids_, view);
        faces_ = list_faces(solids_, view);
    }

    void draw() {
        find_shown();
        svg_ += fmt::format("<g {}>\n", kEdge);
        for (const DrawnPart& part : sort_by_depth(pieces_, list_shown_pieces())) {
            if (!part.within.empty()) open_clip(part.within);
            draw_piece(part.piece);
            if (!part.within.empty()) svg_ += "</g>\n";
        }
        svg_ += "</g>\n";
    }

  private:
    /// Faces that show in at least one point of a grid, piece by piece.
    void find_shown() {
        const double spacing = 0.7 / place_.scale;
        const ViewBounds bounds = find_bounds(bodies_, view_);
        const std::vector<std::size_t> nearest =
            find_nearest_faces(faces_, {.left = bounds.left,
                                        .bottom = bounds.bottom,
                                        .spacing = spacing,
                                        .columns = static_cast<std::size_t>(bounds.width() / spacing) + 1,
                                        .rows = static_cast<std::size_t>(bounds.height() / spacing) + 1});
        std::vector<bool> shown(faces_.size(), false);
        for (const std::size_t f : nearest) {
            if (f != kNoFace) shown[f] = true;
        }
        faces_of_.resize(pieces_.size());
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            if (shown[f]) faces_of_[faces_[f].piece].push_back(f);
        }
    }

    std::vector<std::size_t> list_shown_pieces() const {
        std::vector<std::size_t> list;
        for (std::size_t p = 0; p < pieces_.size(); ++p) {
            if (!faces_of_[p].empty()) list.push_back(p);
        }
        return list;
    }

    /// A group of which only the part in a polygon is drawn.
    void open_clip(const std::vector<Eigen::Vector2d>& within) {
        std::string points;
        for (const Eigen::Vector2d& corner : within) points += (points.empty() ? "" : " ") + write_seen({corner.x(), corner.y(), 0.0});
        svg_ += fmt::format("<clipPath id=\"within{0}\"><polygon points=\"{1}\"/></clipPath>\n<g clip-path=\"url(#within{0})\">\n",
                            clips_++, points);
    }

    void draw_piece(std::size_t p) {
        const DrawnBody& body = bodies_[pieces_[p].body];
        if (body.radius > 0.0) {
            const Vector3 c = view_ * body.place.position;
            svg_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\"/>\n", place_.x + place_.scale * c.x(),
                                place_.y - place_.scale * c.y(), place_.scale * body.radius, find_swatch(body));
            return;
        }
        const SolidLook& look = looks_.at(body.solid.get());
        const auto number = static_cast<std::size_t>(pieces_[p].piece - body.solid->pieces.data());
        for (const std::size_t f : faces_of_[p]) {
            const std::string shade = find_shade(faces_[f].normal, body, look.is_box, view_);
            std::string points;
            for (const Vector3& corner : faces_[f].corners) points += (points.empty() ? "" : " ") + write_seen(corner);
            const std::vector<bool>& drawn = look.edges.drawn[number][faces_[f].face];
            if (std::all_of(drawn.begin(), drawn.end(), [](bool edge) { return edge; })) {
                svg_ += fmt::format("<polygon points=\"{}\" fill=\"{}\"/>\n", points, shade);
                continue;
            }
            // the colour of the face joins it to the one beside it in its plane
            svg_ += fmt::format("<polygon points=\"{0}\" fill=\"{1}\" stroke=\"{1}\"/>\n", points, shade);
            std::string path;
            const std::vector<Vector3>& corners = faces_[f].corners;
            for (std::size_t i = 0; i < corners.size(); ++i) {
                if (drawn[i]) path += fmt::format("M{} L{} ", write_seen(corners[i]), write_seen(corners[(i + 1) % corners.size()]));
            }
            if (!path.empty()) svg_ += fmt::format("<path d=\"{}\"/>\n", path);
        }
    }

    std::string write_seen(const Vector3& seen) const {
        return fmt::format("{:.1f},{:.1f}", place_.x + place_.scale * seen.x(), place_.y - place_.scale * seen.y());
    }

    std::string& svg_;
    const std::vector<DrawnBody>& bodies_;
    const SpaceView& view_;
    const ViewPlace& place_;
    std::vector<PlacedSolid> solids_;
    std::map<const Solid*, SolidLook> looks_;
    std::vector<SeenPiece> pieces_;
    std::vector<SeenFace> faces_;
    std::vector<std::vector<std::size_t>> faces_of_;  ///< those that show, by piece
    int clips_ = 0;
};

}  // namespace

ViewBounds find_bounds(const std::vector<DrawnBody>& bodies, const SpaceView& view) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    ViewBounds all{kFar, -kFar, kFar, -kFar};
    for (const DrawnBody& body : bodies) {
        ViewBounds own = find_bounds(*body.solid, body.place, view);
        if (body.radius > 0.0) {
            const Vector3 c = view * body.place.position;
            own = {c.x() - body.radius, c.x() + body.radius, c.y() - body.radius, c.y() + body.radius};
        }
        all = unite(all, own);
    }
    return all;
}

const char* find_swatch(const DrawnBody& body) { return shades_of(body).left; }
const char* find_swatch(int color) { return kShades[static_cast<std::size_t>(color) % kShades.size()].left; }

void draw_bodies(std::string& svg, const std::vector<DrawnBody>& bodies, const SpaceView& view, const ViewPlace& place) {
    Drawing(svg, bodies, view, place).draw();
}

}  // namespace musim::lsdem
