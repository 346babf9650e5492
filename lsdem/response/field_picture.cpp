#include "lsdem/response/field_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>

#include "lsdem/plot/solid_edges.hpp"
#include "lsdem/plot/svg.hpp"
#include "lsdem/response/color_map.hpp"
#include "scaling/interruption.hpp"

namespace musim::lsdem {
namespace {

/// Sizes of the picture [px].
constexpr double kFieldLeft = 74.0, kFieldTop = 79.0, kFieldBottom = 54.0, kBarGap = 26.0, kBarWidth = 18.0, kBarLabels = 92.0;
/// The longer side of a panel, alone and beside others; a panel alone is not narrower than its title, others than the labels of their axis.
constexpr double kLongSide = 640.0, kLongSideOfMany = 420.0, kLeastWidth = 240.0, kLeastWidthOfMany = 100.0;
/// Between panels, for their times and scales; and how wide a row may be.
constexpr double kFieldGap = 38.0, kRowGap = 48.0, kWidestRow = 1100.0;
/// Room for the times above the first row.
constexpr double kTimeRoom = 16.0;
/// Ticks of an axis, and of one that is narrower than so many pixels.
constexpr double kTicks = 3.0, kFewTicks = 1.5, kNarrow = 180.0;

/// Ticks at round values from `low` to `high`, `least` of them at least where the range begins at one.
template <class Draw>
void for_ticks(double low, double high, double least, const Draw& draw) {
    const double spacing = detail::round_down((high - low) / least);
    for (double i = std::ceil(low / spacing - 1e-9); i * spacing <= high * (1.0 + 1e-9); ++i) draw(i * spacing + 0.0);
}

/// Range of colours.
struct ColorRange {
    const detail::ColorMap& map;
    double low, high;

    std::string operator()(double value) const { return detail::find_color(map, (value - low) / (high - low)); }
};

ColorRange find_colors(const FieldPicture& picture) {
    const bool is_signed = picture.component != FieldComponent::speed;
    const double high = picture.limit > 0.0 ? picture.limit : 1.0;
    return {is_signed ? detail::kDivergingMap : detail::kSequentialMap, is_signed ? -high : 0.0, high};
}

void draw_color_bar(std::string& svg, double x, double top, double height, const ColorRange& colors, const std::string& label) {
    constexpr int kBands = 100;
    for (int band = 0; band < kBands; ++band) {
        const double y = top + height * (1.0 - (band + 1.0) / kBands);
        svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.2f}\" width=\"{}\" height=\"{:.2f}\" fill=\"{}\"/>\n", x, y, kBarWidth,
                           height / kBands + 0.6, detail::find_color(colors.map, (band + 0.5) / kBands));
    }
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#333\"/>\n", x, top,
                       kBarWidth, height);
    for_ticks(colors.low, colors.high, kTicks, [&](double value) {
        const double y = top + height * (colors.high - value) / (colors.high - colors.low);
        detail::draw_line(svg, x + kBarWidth, y, x + kBarWidth + 4.0, y, "stroke=\"#333\"");
        detail::draw_text(svg, x + kBarWidth + 8.0, y + 4.0, "start", "class=\"small\"", fmt::format("{:.4g}", value));
    });
    detail::draw_upward_text(svg, x + kBarWidth + 70.0, top + 0.5 * height, label);
}

/// Where panels lie, all of one size.
struct PanelGrid {
    std::size_t count, columns;
    double width, height;  ///< of a panel [px]
    double scale;          ///< [px/m]
    double offset;         ///< of the image in its panel [px]

    std::size_t rows() const { return (count + columns - 1) / columns; }
    double left(std::size_t panel) const { return kFieldLeft + static_cast<double>(panel % columns) * (width + kFieldGap); }
    double top(std::size_t panel) const {
        const std::size_t row = panel / columns;
        return kFieldTop + (count > 1 ? kTimeRoom : 0.0) + static_cast<double>(row) * (height + kRowGap);
    }
    double right() const { return left(columns - 1) + width; }
    double bottom() const { return top(count - 1) + height; }
    bool is_leftmost(std::size_t panel) const { return panel % columns == 0; }
};

PanelGrid lay_out(const CameraImage& image, std::size_t count) {
    const double width = image.pixel * static_cast<double>(image.columns), height = image.pixel * static_cast<double>(image.rows);
    PanelGrid grid{.count = count, .columns = 1, .width = 0.0, .height = 0.0, .scale = 0.0, .offset = 0.0};
    grid.scale = (count == 1 ? kLongSide : kLongSideOfMany) / std::max(width, height);
    grid.width = std::max(count == 1 ? kLeastWidth : kLeastWidthOfMany, width * grid.scale);
    grid.height = height * grid.scale;
    grid.offset = 0.5 * (grid.width - width * grid.scale);
    const auto fitting = static_cast<std::size_t>((kWidestRow + kFieldGap) / (grid.width + kFieldGap));
    grid.columns = std::clamp<std::size_t>(fitting, 1, count);
    return grid;
}

/// One frame in its panel.
class FieldPanel {
  public:
    FieldPanel(const StoredRun& run, const FieldView& view, const FieldPicture& picture, const PanelGrid& grid, std::size_t panel)
        : run_(run), view_(view), picture_(picture), grid_(grid), left_(grid.left(panel)), top_(grid.top(panel)) {}

    void draw_blocks(std::string& svg, std::size_t panel) const {
        svg +=
            fmt::format("<clipPath id=\"panel{4}\"><rect x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"{3:.1f}\"/></clipPath>\n",
                        left_, top_, grid_.width, grid_.height, panel);
        svg += fmt::format("<g clip-path=\"url(#panel{})\" stroke=\"#444\" stroke-width=\"0.35\" stroke-linejoin=\"round\">\n", panel);
        const FrameBlocks blocks(run_);
        const std::vector<PlacedSolid> solids = blocks.place(view_.frame);
        const std::vector<SeenPiece> pieces = list_pieces(solids, look_from(picture_.side));
        std::size_t clips = 0;
        for (const DrawnPart& part : sort_by_depth(pieces, list_seen(pieces))) {
            if (!part.within.empty()) {
                svg += fmt::format(
                    "<clipPath id=\"panel{0}-{1}\"><polygon points=\"{2}\"/></clipPath>\n<g clip-path=\"url(#panel{0}-{1})\">\n", panel,
                    clips++, write_points(part.within));
            }
            draw_piece(svg, pieces[part.piece], *solids[pieces[part.piece].body].solid);
            if (!part.within.empty()) svg += "</g>\n";
        }
        svg += "</g>\n";
    }

    /// Ground line, frame, scales; heights only at the left end of a row.
    void draw_frame(std::string& svg, bool leftmost) const {
        const CameraImage& image = view_.image;
        const double bottom = top_ + grid_.height;
        if (to_y(0.0) <= bottom && to_y(0.0) >= top_) {
            detail::draw_line(svg, left_, to_y(0.0), left_ + grid_.width, to_y(0.0), "stroke=\"#333\" stroke-width=\"1.5\"");
        }
        svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#333\"/>\n", left_,
                           top_, grid_.width, grid_.height);
        const double first = image.left - grid_.offset / grid_.scale;
        for_ticks(first, first + grid_.width / grid_.scale, grid_.width < kNarrow ? kFewTicks : kTicks, [&](double value) {
            detail::draw_line(svg, to_x(value), bottom, to_x(value), bottom + 4.0, "stroke=\"#333\"");
            detail::draw_text(svg, to_x(value), bottom + 17.0, "middle", "class=\"small\"", fmt::format("{:.4g}", value));
        });
        for_ticks(image.bottom, image.bottom + image.pixel * static_cast<double>(image.rows), kTicks, [&](double value) {
            detail::draw_line(svg, left_ - 4.0, to_y(value), left_, to_y(value), "stroke=\"#333\"");
            if (leftmost) detail::draw_text(svg, left_ - 7.0, to_y(value) + 4.0, "end", "class=\"small\"", fmt::format("{:.4g}", value));
        });
        if (leftmost) detail::draw_upward_text(svg, 20.0, top_ + 0.5 * grid_.height, "z [m]");
    }

    void draw_time(std::string& svg) const {
        detail::draw_text(svg, left_ + 0.5 * grid_.width, top_ - 6.0, "middle", "class=\"small\"",
                          fmt::format("{:.4g} s", view_.image.time));
    }

  private:
    double to_x(double right) const { return left_ + grid_.offset + (right - view_.image.left) * grid_.scale; }
    double to_y(double z) const { return top_ + grid_.height - (z - view_.image.bottom) * grid_.scale; }

    /// Pieces of the blocks that some pixel sees.
    std::vector<std::size_t> list_seen(const std::vector<SeenPiece>& pieces) const {
        std::vector<bool> seen(run_.blocks.size.size(), false);
        for (const int block : view_.image.block) {
            if (block >= 0) seen[static_cast<std::size_t>(block)] = true;
        }
        std::vector<std::size_t> list;
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            if (seen[pieces[p].body]) list.push_back(p);
        }
        return list;
    }

    /// In the colour of its block's velocity; of a compound with lines only where its surface ends.
    void draw_piece(std::string& svg, const SeenPiece& piece, const Solid& solid) const {
        const double value = find_velocity(run_, view_.frame, piece.body, picture_.side, picture_.component);
        const std::string points = write_points(piece.outline), color = find_colors(picture_)(value);
        if (solid.is_convex()) {
            svg += fmt::format("<polygon points=\"{}\" fill=\"{}\"/>\n", points, color);
            return;
        }
        svg += fmt::format("<polygon points=\"{0}\" fill=\"{1}\" stroke=\"{1}\"/>\n<path d=\"", points, color);
        const auto number = static_cast<std::size_t>(piece.piece - solid.pieces.data());
        for (const auto& line : find_silhouette(piece, find_edges(solid).drawn[number])) {
            fmt::format_to(std::back_inserter(svg), "M{:.2f},{:.2f} L{:.2f},{:.2f} ", to_x(line[0].x()), to_y(line[0].y()),
                           to_x(line[1].x()), to_y(line[1].y()));
        }
        svg += "\"/>\n";
    }

    std::string write_points(const std::vector<Eigen::Vector2d>& corners) const {
        std::string points;
        for (const Eigen::Vector2d& corner : corners) {
            fmt::format_to(std::back_inserter(points), "{:.2f},{:.2f} ", to_x(corner.x()), to_y(corner.y()));
        }
        return points;
    }

    const StoredRun& run_;
    const FieldView& view_;
    const FieldPicture& picture_;
    const PanelGrid& grid_;
    double left_, top_;
};

/// The world's axis that a side of the camera has at its right, and the one on which the camera stands.
struct SideNames {
    const char *right, *stand;
};

SideNames name_axes(CameraSide side) {
    switch (side) {
        case CameraSide::plus_x:
            return {"y", "+x"};
        case CameraSide::minus_x:
            return {"−y", "−x"};
        case CameraSide::plus_y:
            return {"−x", "+y"};
        case CameraSide::minus_y:
            break;
    }
    return {"x", "−y"};
}

/// "velocity to the right, along x".
std::string name_component(FieldComponent component, CameraSide side) {
    if (component == FieldComponent::up) return "velocity upward, along z";
    if (component == FieldComponent::speed) return "speed in the image plane";
    return fmt::format("velocity to the right, along {}", name_axes(side).right);
}

}  // namespace

std::vector<FieldView> take_views(const StoredRun& run, const std::vector<double>& times, const CameraSettings& settings) {
    std::vector<FieldView> views;
    for (const double time : times) {
        scaling::stop_if_interrupted();
        const std::size_t frame = find_frame(run, time);
        const auto is_same = [&](const FieldView& view) { return view.frame == frame; };
        if (std::none_of(views.begin(), views.end(), is_same)) views.push_back({frame, take_picture(run, frame, settings)});
    }
    return views;
}

double find_field_limit(const StoredRun& run, const std::vector<FieldView>& views, CameraSide side, FieldComponent component) {
    double limit = 0.0;
    for (const FieldView& view : views) {
        for (const int block : view.image.block) {
            if (block < 0) continue;
            limit = std::max(limit, std::abs(find_velocity(run, view.frame, static_cast<std::size_t>(block), side, component)));
        }
    }
    return limit;
}

std::string make_field_svg(const StoredRun& run, const std::vector<FieldView>& views, const FieldPicture& picture) {
    const PanelGrid grid = lay_out(views.front().image, views.size());
    const bool alone = views.size() == 1;
    const SideNames axes = name_axes(picture.side);
    const std::string view = fmt::format("seen from {}; velocities relative to the fixed axes, not to the base", axes.stand);
    const double width =
        std::max(grid.right() + kBarGap + kBarWidth + kBarLabels, 32.0 + detail::find_text_width(view, detail::kSmallFont));
    const std::string component = name_component(picture.component, picture.side);
    std::string title = component;
    title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(title.front())));
    if (alone) title += fmt::format(", at {:.4g} s", views.front().image.time);
    std::string svg = detail::open_svg(width, grid.bottom() + kFieldBottom, fmt::format("{}, {}", title, picture.name));
    detail::draw_text(svg, 16.0, 26.0, "start", "class=\"title\"", title);
    detail::draw_text(svg, 16.0, 45.0, "start", "class=\"small\"", detail::shorten(picture.name, detail::kSmallFont, width - 32.0));
    detail::draw_text(svg, 16.0, 62.0, "start", "class=\"small\"", view);
    for (std::size_t i = 0; i < views.size(); ++i) {
        const FieldPanel panel(run, views[i], picture, grid, i);
        panel.draw_blocks(svg, i);
        panel.draw_frame(svg, grid.is_leftmost(i));
        if (!alone) panel.draw_time(svg);
    }
    detail::draw_text(svg, 0.5 * (kFieldLeft + grid.right()), grid.bottom() + 40.0, "middle", "", fmt::format("{} [m]", axes.right));
    draw_color_bar(svg, grid.right() + kBarGap, grid.top(0), grid.height, find_colors(picture), component + " [m/s]");
    svg += "</svg>\n";
    return svg;
}

}  // namespace musim::lsdem
