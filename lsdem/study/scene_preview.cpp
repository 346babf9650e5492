#include "lsdem/study/scene_preview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "lsdem/base_motion.hpp"
#include "lsdem/plot/body_view.hpp"
#include "lsdem/plot/plot_panel.hpp"
#include "lsdem/plot/svg.hpp"
#include "lsdem/run/simulate.hpp"
#include "scaling/angle.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/units.hpp"

namespace musim::lsdem {
namespace {

/// Layout [px]: the structure on the left, what there is to say of it on the right, the motion below.
constexpr double kWidth = 920.0, kMargin = 28.0, kTop = 64.0, kPicture = 470.0, kPanelTop = 600.0, kPanel = 150.0, kHeight = 806.0;
constexpr double kLegendBase = 550.0, kLegendRow = 18.0, kSwatch = 12.0, kLegendGap = 24.0;
constexpr double kPictureWidth = 560.0, kTextLeft = 640.0, kPanelLeft = 92.0;

/// Room around the structure for the ruler and the widths [px].
constexpr double kRulerRoom = 96.0, kLabelRoom = 52.0;

constexpr const char* kGrey = R"(class="small" fill="#555")";

std::string write_length(double length) { return scaling::format_quantity(scaling::Length::from_value(length), 4); }

std::vector<DrawnBody> find_bodies(const SceneSummary& summary) {
    const Model& model = summary.specimen.model;
    std::map<std::size_t, int> colors;  // of the model's materials, in the order of the blocks
    std::vector<DrawnBody> bodies;
    const BlockTable table = make_block_table(summary.specimen);
    const auto shapes = list_drawn_shapes(table.shapes, table.size);
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        const Block& block = model.blocks[b];
        const int color = colors.try_emplace(block.material, static_cast<int>(colors.size())).first->second;
        bodies.push_back({.solid = {shapes[b], &shapes[b]->solid},
                          .place = {block.orientation.toRotationMatrix(), block.position},
                          .radius = shapes[b]->radius,
                          .color = color,
                          .is_marked = false});
    }
    // where all blocks are sampled there is nothing to stand out
    if (summary.specimen.spine.size() == bodies.size()) return bodies;
    for (const std::size_t b : summary.specimen.spine.block) bodies[b].is_marked = true;
    return bodies;
}

/// Names of the blocks' materials in the order of their colours, as find_bodies() counts them; empty: the scene's own.
std::vector<std::string> find_material_names(const SceneSummary& summary) {
    std::vector<std::string> names;
    for (const BlockKind& kind : summary.kinds) {
        if (std::find(names.begin(), names.end(), kind.material) == names.end()) names.push_back(kind.material);
    }
    return names;
}

constexpr const char* kGroundColor = "#f0f0ee";

/// The ground around a structure, by its corners.
std::array<Vector3, 4> find_ground(const SceneSummary& summary) {
    const Vector3 size = summary.high - summary.low;
    const double room = 0.3 * std::max(std::min(size.x(), size.y()), 0.25 * std::max(size.x(), size.y()));
    const double x0 = summary.low.x() - room, x1 = summary.high.x() + room, y0 = summary.low.y() - room, y1 = summary.high.y() + room;
    return {Vector3(x0, y0, 0.0), Vector3(x1, y0, 0.0), Vector3(x1, y1, 0.0), Vector3(x0, y1, 0.0)};
}

class Preview {
  public:
    explicit Preview(const SceneSummary& summary) : summary_(summary), bodies_(find_bodies(summary)), ground_(find_ground(summary)) {
        place();
    }

    std::string draw() {
        svg_ = detail::open_svg(kWidth, moves() ? kHeight : kPanelTop + kMargin, summary_.name + " as drawn, before it is run");
        const std::string title = detail::shorten(summary_.name, detail::kTitleFont, kWidth - 2.0 * kMargin);
        detail::draw_text(svg_, kMargin, 32.0, "start", "class=\"title\"", title);
        detail::draw_text(svg_, kMargin, 50.0, "start", kGrey, "as drawn, before it is run");
        if (summary_.specimen.model.ground.present) draw_ground();
        draw_bodies(svg_, bodies_, view_, place_);
        draw_ruler();
        if (summary_.specimen.model.ground.present) draw_widths();
        draw_properties();
        draw_legend();
        draw_motion();
        return svg_ + "</svg>\n";
    }

  private:
    /// As large as the picture allows, in its middle.
    void place() {
        ViewBounds bounds = find_bounds(bodies_, view_);
        for (const Vector3& corner : ground_) {
            const double x = corner.dot(view_.right), y = corner.dot(view_.up);
            bounds = {std::min(bounds.left, x), std::max(bounds.right, x), std::min(bounds.bottom, y), std::max(bounds.top, y)};
        }
        // the ruler stands on the level of the leftmost corner
        bounds.top = std::max(bounds.top, ground_[0].dot(view_.up) + summary_.high.z() * view_.up.z());
        place_.scale = std::min((kPictureWidth - kRulerRoom) / bounds.width(), (kPicture - kLabelRoom) / bounds.height());
        place_.x = kMargin + kRulerRoom + 0.5 * (kPictureWidth - kRulerRoom - place_.scale * (bounds.left + bounds.right));
        place_.y = kTop + 0.5 * (kPicture - kLabelRoom + place_.scale * (bounds.bottom + bounds.top));
        left_ = place_.x + place_.scale * bounds.left;
    }

    double x_of(const Vector3& world) const { return place_.x + place_.scale * world.dot(view_.right); }
    double y_of(const Vector3& world) const { return place_.y - place_.scale * world.dot(view_.up); }

    bool moves() const {
        return std::any_of(summary_.motions.begin(), summary_.motions.end(),
                           [](const MotionSummary& motion) { return !motion.axes.empty() || motion.base.turns(); });
    }

    void draw_ground() {
        std::string points;
        for (const Vector3& corner : ground_) points += (points.empty() ? "" : " ") + write_point(corner, view_, place_);
        svg_ += fmt::format("<polygon points=\"{}\" fill=\"{}\" stroke=\"#999\" stroke-width=\"0.8\"/>\n", points, kGroundColor);
    }

    /// Ruler of the height: bars of a round length, black and white in turn, and the height itself.
    void draw_ruler() {
        // a solid that stands on the ground may be below it by rounding
        constexpr double kRounding = 1e-9;
        const double height = summary_.high.z(), lowest = summary_.low.z();
        const double low = lowest < -kRounding * (height - lowest) ? lowest : 0.0;
        const double bar = detail::round_down(std::max(height - low, 1e-300) / 3.0);
        const double x = left_ - 26.0, px = place_.scale * view_.up.z();
        const auto y_at = [&](double z) { return y_of(ground_[0]) - px * z; };
        int k = 0;
        for (double from = low; from < height; from = low + ++k * bar) {
            const double to = std::min(height, from + bar);
            svg_ += fmt::format(
                "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"6\" height=\"{:.1f}\" fill=\"{}\" stroke=\"#333\" stroke-width=\"0.8\"/>\n",
                x - 3.0, y_at(to), px * (to - from), k % 2 == 0 ? "#333" : "#fff");
            if (from + bar <= height) detail::draw_text(svg_, x - 8.0, y_at(to) + 4.0, "end", kGrey, write_length(low + (k + 1) * bar));
        }
        detail::draw_text(svg_, x - 8.0, y_at(low) + 4.0, "end", kGrey, low < 0.0 ? write_length(low) : "0");
        detail::draw_text(svg_, x, y_at(height) - 8.0, "middle", kGrey, "z = " + write_length(height));
    }

    /// Along x and y, beside the near edges of the ground, with an arrow where the base moves, and a word where it turns.
    void draw_widths() {
        const Vector3 size = summary_.high - summary_.low;
        const std::array<Vector3, 2> from{ground_[0], ground_[1]}, to{ground_[1], ground_[2]};
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const Vector3 middle = 0.5 * (from[axis] + to[axis]);
            const bool moves = std::any_of(summary_.motions.begin(), summary_.motions.end(), [&](const MotionSummary& motion) {
                return std::any_of(motion.axes.begin(), motion.axes.end(), [&](const AxisMotion& a) { return a.axis == "xy"[axis]; });
            });
            const double x = x_of(middle) + (axis == 0 ? -10.0 : 10.0), y = y_of(middle) + 18.0;
            const char* anchor = axis == 0 ? "end" : "start";
            detail::draw_text(svg_, x, y, anchor, kGrey, fmt::format("{} = {}", "xy"[axis], write_length(size[static_cast<int>(axis)])));
            const bool turns = std::any_of(summary_.motions.begin(), summary_.motions.end(),
                                           [&](const MotionSummary& motion) { return !motion.base.turn[axis].velocity.empty(); });
            if (turns) {
                detail::draw_text(svg_, x, y + (moves ? 32.0 : 16.0), anchor, R"(class="small" fill="#D55E00")",
                                  fmt::format("base turns about {}", "xy"[axis]));
            }
            if (!moves) continue;
            detail::draw_text(svg_, x, y + 16.0, anchor, R"(class="small" fill="#D55E00")", "base moves");
            draw_arrow(0.7 * from[axis] + 0.3 * to[axis], 0.3 * from[axis] + 0.7 * to[axis]);
        }
    }

    /// With two heads, between two places on the ground.
    void draw_arrow(const Vector3& from, const Vector3& to) {
        constexpr double kHead = 7.0;
        const double x1 = x_of(from), y1 = y_of(from) + 4.0, x2 = x_of(to), y2 = y_of(to) + 4.0;
        const double length = std::max(std::hypot(x2 - x1, y2 - y1), 1.0), ux = (x2 - x1) / length, uy = (y2 - y1) / length;
        std::string path = fmt::format("M{:.1f},{:.1f} L{:.1f},{:.1f}", x1, y1, x2, y2);
        for (const double end : {1.0, -1.0}) {
            const double x = end > 0.0 ? x2 : x1, y = end > 0.0 ? y2 : y1, bx = x - end * kHead * ux, by = y - end * kHead * uy;
            path += fmt::format(" M{:.1f},{:.1f} L{:.1f},{:.1f} L{:.1f},{:.1f}", bx - 0.5 * kHead * uy, by + 0.5 * kHead * ux, x, y,
                                bx + 0.5 * kHead * uy, by - 0.5 * kHead * ux);
        }
        svg_ += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#D55E00\" stroke-width=\"1.6\" stroke-linejoin=\"round\"/>\n", path);
    }

    void draw_properties() {
        double y = kTop + 20.0;
        for (const auto& [about, texts] : describe_briefly(summary_)) {
            detail::draw_text(svg_, kTextLeft, y, "start", kGrey, about);
            for (const std::string& text : texts) {
                for (const std::string& line : detail::wrap(text, 13.0, kWidth - kMargin - kTextLeft)) {
                    detail::draw_text(svg_, kTextLeft, y += 17.0, "start", "", line);
                }
            }
            y += 25.0;
        }
    }

    /// Colours of blocks by material, of the spine and of the ground.
    void draw_legend() {
        std::vector<std::pair<std::string, std::string>> entries;
        const auto is_marked = [](const DrawnBody& body) { return body.is_marked; };
        const std::vector<std::string> materials = find_material_names(summary_);
        // a material whose blocks are all of the spine has no colour of its own here
        for (std::size_t m = 0; m < materials.size(); ++m) {
            const auto shows = [&](const DrawnBody& body) { return !body.is_marked && body.color == static_cast<int>(m); };
            const auto shown = std::find_if(bodies_.begin(), bodies_.end(), shows);
            if (shown == bodies_.end()) continue;
            const std::string name = materials[m].empty() ? "the scene's material" : materials[m];
            entries.emplace_back(find_swatch(*shown), materials.size() > 1 ? "blocks of " + name : "blocks");
        }
        const auto marked = std::find_if(bodies_.begin(), bodies_.end(), is_marked);
        if (marked != bodies_.end()) entries.emplace_back(find_swatch(*marked), "spine: blocks whose motion is sampled");
        if (summary_.specimen.model.ground.present) entries.emplace_back(kGroundColor, "ground");
        double x = kMargin, y = kLegendBase;
        for (const auto& [color, text] : entries) {
            const double width = kSwatch + 6.0 + detail::find_text_width(text, detail::kSmallFont);
            if (x > kMargin && x + width > kWidth - kMargin) x = kMargin, y += kLegendRow;
            svg_ += fmt::format("<rect x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2}\" height=\"{2}\" fill=\"{3}\" stroke=\"#4a4036\"/>\n", x,
                                y - 10.0, kSwatch, color);
            detail::draw_text(svg_, x + kSwatch + 6.0, y, "start", kGrey, text);
            x += width + kLegendGap;
        }
    }

    /// Curves that one panel below the structure shows.
    struct MotionPanel {
        std::string title;
        LinePlot plot;
    };

    void draw_motion() {
        MotionPanel slides{.title = "Acceleration of the base", .plot = {.x_label = "time [s]", .y_label = "base [g]"}};
        MotionPanel turns{.title = "Turn of the base", .plot = {.x_label = "time [s]", .y_label = "angle [deg]"}};
        std::map<char, PlotSeries> along, about;
        double start = 0.0;
        for (const MotionSummary& motion : summary_.motions) {
            for (const AxisMotion& axis : motion.axes) {
                PlotSeries& curve = along[axis.axis];
                curve.label = fmt::format("along {}", axis.axis);
                add_acceleration(motion.base.shift[static_cast<std::size_t>(axis.axis - 'x')], start, motion.plan.duration(), curve);
            }
            add_angles(motion.base, start, motion.plan.duration(), about);
            start += motion.plan.duration();
        }
        take_series(along, slides);
        take_series(about, turns);
        std::vector<const MotionPanel*> panels;
        for (const MotionPanel* panel : {&slides, &turns}) {
            if (!panel->plot.series.empty()) panels.push_back(panel);
        }
        if (panels.empty()) detail::draw_text(svg_, kPanelLeft, kPanelTop, "start", kGrey, "the base rests");
        const auto count = static_cast<double>(panels.size());
        const double width = (kWidth - kMargin - kPanelLeft - (count - 1.0) * kPanelLeft) / count;
        double left = kPanelLeft;
        for (const MotionPanel* panel : panels) {
            draw_motion_panel(*panel, left, width, start);
            left += width + kPanelLeft;
        }
    }

    static void take_series(std::map<char, PlotSeries>& from, MotionPanel& to) {
        int style = 0;
        for (auto& [axis, curve] : from) {
            curve.style = style++;
            to.plot.series.push_back(std::move(curve));
        }
    }

    void draw_motion_panel(const MotionPanel& panel, double left, double width, double end) {
        const detail::PanelFrame frame{.left = left, .top = kPanelTop, .width = width, .height = kPanel, .y_label_gap = 48.0};
        detail::DataRange range;
        range.add(0.0);
        range.add(end);
        const std::vector<detail::LineStyle> styles = detail::find_styles(panel.plot, [](std::size_t index) {
            constexpr std::array<detail::LineStyle, 3> kLooks{{{"#0072B2", 1.2, ""}, {"#D55E00", 1.2, "6 3"}, {"#000000", 1.1, "1.5 3"}}};
            return kLooks[index % kLooks.size()];
        });
        std::string heading = panel.title;
        for (const PlotSeries& curve : panel.plot.series) heading += (&curve == &panel.plot.series.front() ? " " : ", ") + curve.label;
        if (summary_.motions.size() > 1) heading += fmt::format("; {} motions one after another", summary_.motions.size());
        detail::draw_text(svg_, left, kPanelTop - 10.0, "start", "class=\"title\"", heading);
        detail::draw_panel(svg_, panel.plot, {.frame = frame, .x_range = range}, styles);
    }

    /// Components of the rotation vector at even times, of those axes about which the base turns.
    static void add_angles(const BaseComponents& base, double start, double duration, std::map<char, PlotSeries>& about) {
        constexpr int kPoints = 400;
        const BaseMotion motion(base);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (base.turn[axis].velocity.empty()) continue;
            const char name = "xyz"[axis];
            PlotSeries& curve = about[name];
            curve.label = fmt::format("about {}", name);
            for (int i = 0; i <= kPoints; ++i) {
                const double time = duration * i / kPoints;
                curve.x.push_back(start + time);
                curve.y.push_back(motion.angle(time)[static_cast<Eigen::Index>(axis)] / scaling::kDegree);
            }
        }
    }

    /// Constant between samples of the velocity: at the middles of these stretches, from t = 0 until the run ends.
    static void add_acceleration(const BaseComponent& component, double start, double end, PlotSeries& curve) {
        const double gravity = scaling::kStandardGravity.value();
        const auto add = [&](double time, double acceleration) {
            if (time < 0.0 || time > end) return;
            curve.x.push_back(start + time);
            curve.y.push_back(acceleration / gravity);
        };
        add(0.0, 0.0);
        add(component.start, 0.0);
        for (std::size_t k = 1; k < component.velocity.size(); ++k) {
            const double time = component.start + (static_cast<double>(k) - 0.5) * component.dt;
            add(time, (component.velocity[k] - component.velocity[k - 1]) / component.dt);
        }
        add(component.start + static_cast<double>(component.velocity.size()) * component.dt, 0.0);
        add(end, 0.0);
    }

    const SceneSummary& summary_;
    std::vector<DrawnBody> bodies_;
    std::array<Vector3, 4> ground_;
    SpaceView view_ = look_from_corner();
    ViewPlace place_;
    double left_ = 0.0;  ///< of all that is drawn [px]
    std::string svg_;
};

}  // namespace

std::string make_preview_svg(const SceneSummary& summary) { return Preview(summary).draw(); }

}  // namespace musim::lsdem
