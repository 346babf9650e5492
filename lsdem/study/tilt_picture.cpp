#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "lsdem/finite_turn.hpp"
#include "lsdem/plot/body_view.hpp"
#include "lsdem/plot/svg.hpp"
#include "lsdem/results/block_shapes.hpp"
#include "lsdem/study/tilt.hpp"

/// Picture of a structure on a tilted ground, as it falls.
namespace musim::lsdem {
namespace {

/// Layout [px].
constexpr double kFallWidth = 720.0, kFallMargin = 28.0, kFallTop = 84.0, kFallPicture = 460.0, kFallRow = 18.0, kSwatchSide = 12.0;

constexpr const char* kFallGrey = R"(class="small" fill="#555")";
constexpr const char *kOpens = "#D55E00", *kSlides = "#0072B2", *kParts = "#CC79A7", *kSoil = "#e4e2dc";

const char* color_of(JointEvent event) { return event == JointEvent::opens ? kOpens : event == JointEvent::slides ? kSlides : kParts; }

class FallPicture {
  public:
    FallPicture(const TiltCollapse& result, std::string title) : result_(result), title_(std::move(title)) {
        // seen along the axis, the true vertical upward, in the frame of the ground
        const double tilt = result.high.value_or(result.low);
        const Quaternion back = turn_by(-tilt * result.axis);
        // from a little aside, so that faces that look along the axis are of one shade, whatever their rounding
        constexpr double kAside = 1e-4;
        const Vector3 right = back * result.downhill();
        view_ = {.right = (right + kAside * result.axis).normalized(),
                 .up = back * Vector3::UnitZ(),
                 .toward = (kAside * right - result.axis).normalized()};
        find_fallen_bodies();
        bounds_ = find_bounds(bodies_, view_);
        ground_ = find_ground(0.15 * std::max(bounds_.width(), bounds_.height()));
        for (const Vector3& end : ground_) {
            const double x = end.dot(view_.right), y = end.dot(view_.up);
            bounds_ = unite(bounds_, {x, x, y, y});
        }
        place_.scale = std::min((kFallWidth - 2.0 * kFallMargin) / bounds_.width(), kFallPicture / bounds_.height());
        place_.x = 0.5 * (kFallWidth - place_.scale * (bounds_.left + bounds_.right));
        place_.y = kFallTop + 0.5 * (kFallPicture + place_.scale * (bounds_.bottom + bounds_.top));
    }

    std::string draw() {
        const std::vector<std::string> lines =
            detail::wrap(result_.fall->sentence.empty() ? "the mechanism is not named: some blocks are round" : result_.fall->sentence,
                         detail::kSmallFont, kFallWidth - 2.0 * kFallMargin);
        const double below = kFallTop + kFallPicture + 30.0;
        svg_ =
            detail::open_svg(kFallWidth, below + kFallRow * static_cast<double>(lines.size() + 1) + kFallMargin, title_ + " as it falls");
        detail::draw_text(svg_, kFallMargin, 32.0, "start", "class=\"title\"",
                          detail::shorten(title_, detail::kTitleFont, kFallWidth - 2.0 * kFallMargin));
        detail::draw_text(
            svg_, kFallMargin, 52.0, "start", kFallGrey,
            fmt::format("on ground tilted by {:.4g} degrees, {:.3g} s after it began to turn by the last step; seen along the axis",
                        result_.high.value_or(result_.low) * scaling::kDegrees, result_.fall->time));
        draw_ground_line();
        draw_bodies(svg_, bodies_, view_, place_);
        draw_joints();
        double y = below;
        for (const std::string& line : lines) detail::draw_text(svg_, kFallMargin, y, "start", kFallGrey, line), y += kFallRow;
        draw_key(y);
        return svg_ + "</svg>\n";
    }

  private:
    void find_fallen_bodies() {
        const auto shapes = list_drawn_shapes(result_.blocks.shapes, result_.blocks.size);
        for (std::size_t b = 0; b < shapes.size(); ++b) {
            const BodyPlace& at = result_.fall->place[b];
            const bool moves = result_.fall->mechanism && result_.fall->mechanism->body[b] != 0;
            bodies_.push_back({.solid = {shapes[b], &shapes[b]->solid},
                               .place = {at.orientation.toRotationMatrix(), at.position},
                               .radius = shapes[b]->radius,
                               .color = moves ? 0 : 1,
                               .is_marked = false});
        }
    }

    /// Ends of the surface of the ground.
    std::array<Vector3, 2> find_ground(double room) const {
        const Vector3 downhill = result_.downhill();
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::size_t b = 0; b < result_.model.blocks.size(); ++b) {
            const double at = downhill.dot(result_.model.blocks[b].position), half = 0.5 * result_.blocks.size[b].norm();
            low = std::min(low, at - half);
            high = std::max(high, at + half);
        }
        return {(low - room) * downhill, (high + room) * downhill};
    }

    std::array<double, 2> pixel(const Vector3& x) const {
        return {place_.x + place_.scale * x.dot(view_.right), place_.y - place_.scale * x.dot(view_.up)};
    }

    void draw_ground_line() {
        if (!result_.model.ground.present) return;
        const auto from = pixel(ground_[0]), to = pixel(ground_[1]);
        // the soil below its surface, and a level line
        const Vector3 down = -0.03 * (ground_[1] - ground_[0]).norm() * Vector3::UnitZ();
        const auto below_to = pixel(ground_[1] + down), below_from = pixel(ground_[0] + down);
        svg_ += fmt::format("<polygon points=\"{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}\" fill=\"{}\"/>\n", from[0], from[1],
                            to[0], to[1], below_to[0], below_to[1], below_from[0], below_from[1], kSoil);
        detail::draw_line(svg_, from[0], from[1], to[0], to[1], "stroke=\"#555\" stroke-width=\"1.4\"");
        detail::draw_line(svg_, from[0], to[1], to[0], to[1], "stroke=\"#999\" stroke-width=\"0.8\" stroke-dasharray=\"4 4\"");
    }

    /// Both faces of every joint that moves, and the edge about which it opens.
    void draw_joints() {
        if (!result_.fall->mechanism) return;
        for (const JointMotion& joint : result_.fall->mechanism->joints) {
            if (joint.event == JointEvent::sticks) continue;
            const char* color = color_of(joint.event);
            draw_face(joint.of_other, color);
            draw_face(joint.of_block, color);
            if (joint.event != JointEvent::opens) continue;
            const auto at = pixel(joint.edge);
            svg_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\" fill=\"#fff\" stroke=\"{}\" stroke-width=\"2\"/>\n", at[0],
                                at[1], color);
        }
    }

    /// A face as the line that it is, seen along the axis.
    void draw_face(const std::vector<Vector3>& corners, const char* color) {
        std::array<std::array<double, 2>, 2> ends{};
        double longest = -1.0;
        for (const Vector3& a : corners) {
            for (const Vector3& b : corners) {
                const auto from = pixel(a), to = pixel(b);
                const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
                if (length > longest) longest = length, ends = {from, to};
            }
        }
        if (longest < 0.0) return;
        detail::draw_line(svg_, ends[0][0], ends[0][1], ends[1][0], ends[1][1],
                          fmt::format("stroke=\"{}\" stroke-width=\"2.6\" stroke-linecap=\"round\"", color).c_str());
    }

    void draw_key(double y) {
        std::vector<std::pair<std::string, std::string>> entries;
        if (result_.fall->mechanism) {
            const auto has = [&](JointEvent event) {
                const auto& joints = result_.fall->mechanism->joints;
                return std::any_of(joints.begin(), joints.end(), [&](const JointMotion& joint) { return joint.event == event; });
            };
            if (has(JointEvent::opens)) entries.emplace_back(kOpens, "joint that opens, about the ring");
            if (has(JointEvent::slides)) entries.emplace_back(kSlides, "joint that slides");
            if (has(JointEvent::parts)) entries.emplace_back(kParts, "joint that parts");
            entries.emplace_back(find_swatch(0), "moves");
            if (std::any_of(bodies_.begin(), bodies_.end(), [](const DrawnBody& body) { return body.color == 1; })) {
                entries.emplace_back(find_swatch(1), "stays with the ground");
            }
        }
        double x = kFallMargin;
        for (const auto& [color, text] : entries) {
            svg_ += fmt::format("<rect x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2}\" height=\"{2}\" fill=\"{3}\" stroke=\"#4a4036\"/>\n", x,
                                y - 10.0, kSwatchSide, color);
            detail::draw_text(svg_, x + kSwatchSide + 6.0, y, "start", kFallGrey, text);
            x += kSwatchSide + 24.0 + detail::find_text_width(text, detail::kSmallFont);
        }
    }

    const TiltCollapse& result_;
    std::string title_;
    SpaceView view_;
    std::vector<DrawnBody> bodies_;
    ViewBounds bounds_;
    std::array<Vector3, 2> ground_;
    ViewPlace place_;
    std::string svg_;
};

}  // namespace

std::string make_fall_svg(const TiltCollapse& result, const std::string& title) { return FallPicture(result, title).draw(); }

}  // namespace musim::lsdem
