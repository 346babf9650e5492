#include "lsdem/study/camera_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "lsdem/study/detail/svg.hpp"

namespace musim::lsdem::study {
namespace {

constexpr double kMargin = 0.05;  ///< around the structure, of its larger side

/// Directions of an image: to the right, and from the structure to the camera.
struct CameraAxes {
    Vector3 right, toward;
};

CameraAxes find_axes(CameraSide side) {
    Vector3 toward = Vector3::Zero();
    toward[side == CameraSide::plus_x || side == CameraSide::minus_x ? 0 : 1] =
        side == CameraSide::plus_x || side == CameraSide::plus_y ? 1.0 : -1.0;
    return {Vector3::UnitZ().cross(toward), toward};
}

/// A block as the camera sees it: places in the image plane and depth toward the camera.
struct Seen {
    Vector3 center, half;
    Matrix3 turn;  ///< body to image axes (right, z, toward)
};

Seen look_at(const StoredRun& run, std::size_t frame, std::size_t block, const CameraAxes& axes) {
    const std::size_t at = frame * run.blocks.size.size() + block;
    const Eigen::Vector4d q = run.frames.quaternion[at].cast<double>();
    Matrix3 image;
    image << axes.right.transpose(), Vector3::UnitZ().transpose(), axes.toward.transpose();
    return {image * run.frames.position[at].cast<double>(), 0.5 * run.blocks.size[block],
            image * Quaternion(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix()};
}

/// Depth at which a ray along the third axis through (u, z) leaves a block toward the camera; nothing (−∞) when it misses.
double find_depth(const Seen& seen, double u, double z) {
    const Vector3 origin = seen.turn.transpose() * Vector3(u - seen.center.x(), z - seen.center.y(), -seen.center.z());
    const Vector3 direction = seen.turn.transpose() * Vector3::UnitZ();
    double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0) {
            if (std::abs(origin[axis]) > seen.half[axis]) return -std::numeric_limits<double>::infinity();
            continue;
        }
        double first = (-seen.half[axis] - origin[axis]) / direction[axis], second = (seen.half[axis] - origin[axis]) / direction[axis];
        if (first > second) std::swap(first, second);
        enter = std::max(enter, first);
        leave = std::min(leave, second);
    }
    return enter <= leave ? leave : -std::numeric_limits<double>::infinity();
}

/// Half extents in the image plane.
Vector3 find_extent(const Seen& seen) { return seen.turn.cwiseAbs() * seen.half; }

/// Outline of a block in the image plane: the convex hull of its corners, counterclockwise [monotone chain].
std::vector<Eigen::Vector2d> find_outline(const Seen& seen) {
    std::vector<std::array<double, 2>> corners;
    for (int corner = 0; corner < 8; ++corner) {
        const Vector3 sign((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0, (corner & 4) != 0 ? 1.0 : -1.0);
        const Vector3 place = seen.center + seen.turn * seen.half.cwiseProduct(sign);
        corners.push_back({place.x(), place.y()});
    }
    std::sort(corners.begin(), corners.end());
    std::vector<Eigen::Vector2d> hull;
    const auto add = [&](const std::array<double, 2>& corner, std::size_t least) {
        const Eigen::Vector2d next(corner[0], corner[1]);
        while (hull.size() > least) {
            const Eigen::Vector2d a = hull.back() - hull[hull.size() - 2], b = next - hull.back();
            if (a.x() * b.y() - a.y() * b.x() > 0.0) break;
            hull.pop_back();
        }
        hull.push_back(next);
    };
    for (const auto& corner : corners) add(corner, 1);
    const std::size_t lower = hull.size();
    for (auto corner = std::next(corners.rbegin()); corner != corners.rend(); ++corner) add(*corner, lower);
    hull.pop_back();
    return hull;
}

using Color = std::array<double, 3>;

/// Colours at even places of a map; linear in between.
constexpr std::array<Color, 11> kDiverging{{{5, 48, 97},
                                            {33, 102, 172},
                                            {67, 147, 195},
                                            {146, 197, 222},
                                            {209, 229, 240},
                                            {247, 247, 247},
                                            {253, 219, 199},
                                            {244, 165, 130},
                                            {214, 96, 77},
                                            {178, 24, 43},
                                            {103, 0, 31}}};  // ColorBrewer's RdBu, blue first
constexpr std::array<Color, 11> kSequential{{{68, 1, 84},
                                             {72, 36, 117},
                                             {65, 68, 135},
                                             {53, 95, 141},
                                             {42, 120, 142},
                                             {33, 145, 140},
                                             {34, 168, 132},
                                             {68, 191, 112},
                                             {122, 209, 81},
                                             {189, 223, 38},
                                             {253, 231, 37}}};  // matplotlib's viridis

/// Colour of a place in a map, 0 to 1.
std::string find_color(const std::array<Color, 11>& map, double place) {
    const double scaled = std::clamp(place, 0.0, 1.0) * static_cast<double>(map.size() - 1);
    const auto index = std::min(static_cast<std::size_t>(scaled), map.size() - 2);
    const double f = scaled - static_cast<double>(index);
    std::array<int, 3> rgb{};
    for (std::size_t c = 0; c < 3; ++c) rgb[c] = static_cast<int>(std::lround((1.0 - f) * map[index][c] + f * map[index + 1][c]));
    return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

/// Sizes of the picture [px].
constexpr double kLeft = 74.0, kTop = 62.0, kBottom = 54.0, kBarGap = 26.0, kBarWidth = 18.0, kBarLabels = 92.0;
constexpr double kLongSide = 640.0, kLeastWidth = 240.0;

/// Ticks at round values from `low` to `high`.
template <class Draw>
void for_ticks(double low, double high, const Draw& draw) {
    const double spacing = detail::round_down((high - low) / 3.0);
    for (double i = std::ceil(low / spacing - 1e-9); i * spacing <= high * (1.0 + 1e-9); ++i) draw(i * spacing + 0.0);
}

void draw_color_bar(std::string& svg, double x, double top, double height, const std::array<Color, 11>& map, double low, double high,
                    const std::string& label) {
    constexpr int kBands = 100;
    for (int band = 0; band < kBands; ++band) {
        const double y = top + height * (1.0 - (band + 1.0) / kBands);
        svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.2f}\" width=\"{}\" height=\"{:.2f}\" fill=\"{}\"/>\n", x, y, kBarWidth,
                           height / kBands + 0.6, find_color(map, (band + 0.5) / kBands));
    }
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#333\"/>\n", x, top,
                       kBarWidth, height);
    for_ticks(low, high, [&](double value) {
        const double y = top + height * (high - value) / (high - low);
        detail::draw_line(svg, x + kBarWidth, y, x + kBarWidth + 4.0, y, "stroke=\"#333\"");
        detail::draw_text(svg, x + kBarWidth + 8.0, y + 4.0, "start", "class=\"small\"", fmt::format("{:.4g}", value));
    });
    detail::draw_upward_text(svg, x + kBarWidth + 70.0, top + 0.5 * height, label);
}

}  // namespace

CameraSide find_side_facing(int axis) { return axis == 1 ? CameraSide::plus_x : CameraSide::minus_y; }

std::size_t find_frame(const StoredRun& run, double time) {
    if (run.frames.time.empty()) {
        throw ResultError(
            fmt::format("{}: the run has kept no frames (its scene has no output.frame_rate); give one, e.g. \"frame_rate\": "
                        "\"100 Hz\", and run it again",
                        (run.directory / "result.h5").string()));
    }
    const auto nearest = std::min_element(run.frames.time.begin(), run.frames.time.end(),
                                          [&](double a, double b) { return std::abs(a - time) < std::abs(b - time); });
    return static_cast<std::size_t>(nearest - run.frames.time.begin());
}

CameraImage take_picture(const StoredRun& run, std::size_t frame, const CameraSettings& settings) {
    const CameraAxes axes = find_axes(settings.side);
    const std::size_t blocks = run.blocks.size.size();

    // the image holds the structure as it was in the first frame
    Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (std::size_t b = 0; b < blocks; ++b) {
        const Seen seen = look_at(run, 0, b, axes);
        const Vector3 extent = find_extent(seen);
        low = low.cwiseMin((seen.center - extent).head<2>());
        high = high.cwiseMax((seen.center + extent).head<2>());
    }
    const double margin = kMargin * (high - low).maxCoeff();
    CameraImage image{.time = run.frames.time[frame],
                      .left = low.x() - margin,
                      .bottom = low.y() - margin,
                      .pixel = (high.x() - low.x() + 2.0 * margin) / static_cast<double>(settings.columns),
                      .columns = settings.columns,
                      .rows = 0,
                      .block = {}};
    image.rows = static_cast<std::size_t>(std::ceil((high.y() - low.y() + 2.0 * margin) / image.pixel));
    image.block.assign(image.columns * image.rows, -1);
    std::vector<double> depth(image.block.size(), -std::numeric_limits<double>::infinity());

    // every block on the pixels of its bounding rectangle
    const auto clamp_to = [](double place, std::size_t count) {
        return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count)));
    };
    for (std::size_t b = 0; b < blocks; ++b) {
        const Seen seen = look_at(run, frame, b, axes);
        const Vector3 extent = find_extent(seen);
        const std::size_t left = clamp_to((seen.center.x() - extent.x() - image.left) / image.pixel, image.columns);
        const std::size_t right = clamp_to((seen.center.x() + extent.x() - image.left) / image.pixel + 1.0, image.columns);
        const std::size_t bottom = clamp_to((seen.center.y() - extent.y() - image.bottom) / image.pixel, image.rows);
        const std::size_t top = clamp_to((seen.center.y() + extent.y() - image.bottom) / image.pixel + 1.0, image.rows);
        for (std::size_t row = bottom; row < top; ++row) {
            for (std::size_t column = left; column < right; ++column) {
                const double d = find_depth(seen, image.left + (static_cast<double>(column) + 0.5) * image.pixel,
                                            image.bottom + (static_cast<double>(row) + 0.5) * image.pixel);
                const std::size_t at = row * image.columns + column;
                if (d <= depth[at]) continue;
                depth[at] = d;
                image.block[at] = static_cast<int>(b);
            }
        }
    }
    return image;
}

double find_velocity(const StoredRun& run, std::size_t frame, std::size_t block, CameraSide side, FieldComponent component) {
    const Vector3 v = run.frames.velocity[frame * run.blocks.size.size() + block].cast<double>();
    const double right = v.dot(find_axes(side).right);
    switch (component) {
        case FieldComponent::right:
            return right;
        case FieldComponent::up:
            return v.z();
        case FieldComponent::speed:
            break;
    }
    return std::hypot(right, v.z());
}

std::string make_field_csv(const StoredRun& run, std::size_t frame, const CameraImage& image, CameraSide side) {
    std::string csv = "column,row,right_m,z_m,block,level,v_right_m_s,v_up_m_s\n";
    for (std::size_t at = 0; at < image.block.size(); ++at) {
        if (image.block[at] < 0) continue;
        const auto block = static_cast<std::size_t>(image.block[at]);
        const std::size_t column = at % image.columns, row = at / image.columns;
        fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{},{}\n", column, row,
                       image.left + (static_cast<double>(column) + 0.5) * image.pixel,
                       image.bottom + (static_cast<double>(row) + 0.5) * image.pixel, block, run.blocks.layer[block],
                       find_velocity(run, frame, block, side, FieldComponent::right),
                       find_velocity(run, frame, block, side, FieldComponent::up));
    }
    return csv;
}

std::string make_field_svg(const StoredRun& run, std::size_t frame, const CameraImage& image, CameraSide side, FieldComponent component,
                           double limit, const std::string& name) {
    const bool is_signed = component != FieldComponent::speed;
    const auto& map = is_signed ? kDiverging : kSequential;
    const double high = limit > 0.0 ? limit : 1.0, low = is_signed ? -high : 0.0;
    const double width = image.pixel * static_cast<double>(image.columns), height = image.pixel * static_cast<double>(image.rows);
    const double scale = kLongSide / std::max(width, height);
    const double plot_width = std::max(kLeastWidth, width * scale), plot_height = height * scale;
    const double offset = 0.5 * (plot_width - width * scale), bottom = kTop + plot_height;
    const auto to_x = [&](double right) { return kLeft + offset + (right - image.left) * scale; };
    const auto to_y = [&](double z) { return bottom - (z - image.bottom) * scale; };

    std::string svg = detail::open_svg(kLeft + plot_width + kBarGap + kBarWidth + kBarLabels, bottom + kBottom);
    detail::draw_text(svg, 16.0, 26.0, "start", "class=\"title\"", fmt::format("Velocity at {:.4g} s", image.time));
    detail::draw_text(svg, 16.0, 45.0, "start", "class=\"small\"", name);
    svg += fmt::format("<clipPath id=\"frame\"><rect x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"{3:.1f}\"/></clipPath>\n",
                       kLeft, kTop, plot_width, plot_height);

    // the blocks that some pixel sees, the farthest first
    std::vector<int> visible(image.block);
    std::sort(visible.begin(), visible.end());
    visible.erase(std::unique(visible.begin(), visible.end()), visible.end());
    const CameraAxes axes = find_axes(side);
    std::vector<std::pair<double, std::size_t>> order;
    for (const int block : visible)
        if (block >= 0) order.emplace_back(look_at(run, frame, static_cast<std::size_t>(block), axes).center.z(), block);
    std::sort(order.begin(), order.end());
    svg += "<g clip-path=\"url(#frame)\" stroke=\"#444\" stroke-width=\"0.35\" stroke-linejoin=\"round\">\n";
    for (const auto& [depth, block] : order) {
        std::string points;
        for (const Eigen::Vector2d& corner : find_outline(look_at(run, frame, block, axes)))
            fmt::format_to(std::back_inserter(points), "{:.2f},{:.2f} ", to_x(corner.x()), to_y(corner.y()));
        const double value = find_velocity(run, frame, block, side, component);
        svg += fmt::format("<polygon points=\"{}\" fill=\"{}\"/>\n", points, find_color(map, (value - low) / (high - low)));
    }
    svg += "</g>\n";

    // ground line, frame, scales
    if (to_y(0.0) <= bottom && to_y(0.0) >= kTop)
        detail::draw_line(svg, kLeft, to_y(0.0), kLeft + plot_width, to_y(0.0), "stroke=\"#333\" stroke-width=\"1.5\"");
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#333\"/>\n", kLeft, kTop,
                       plot_width, plot_height);
    const double first = image.left - offset / scale;
    for_ticks(first, first + plot_width / scale, [&](double value) {
        detail::draw_line(svg, to_x(value), bottom, to_x(value), bottom + 4.0, "stroke=\"#333\"");
        detail::draw_text(svg, to_x(value), bottom + 17.0, "middle", "class=\"small\"", fmt::format("{:.4g}", value));
    });
    for_ticks(image.bottom, image.bottom + height, [&](double value) {
        detail::draw_line(svg, kLeft - 4.0, to_y(value), kLeft, to_y(value), "stroke=\"#333\"");
        detail::draw_text(svg, kLeft - 7.0, to_y(value) + 4.0, "end", "class=\"small\"", fmt::format("{:.4g}", value));
    });
    detail::draw_text(svg, kLeft + 0.5 * plot_width, bottom + 40.0, "middle", "", "to the right [m]");
    detail::draw_upward_text(svg, 20.0, kTop + 0.5 * plot_height, "height [m]");
    const char* label = component == FieldComponent::right ? "velocity to the right [m/s]"
                        : component == FieldComponent::up  ? "velocity upward [m/s]"
                                                           : "speed in the image plane [m/s]";
    draw_color_bar(svg, kLeft + plot_width + kBarGap, kTop, plot_height, map, low, high, label);
    svg += "</svg>\n";
    return svg;
}

}  // namespace musim::lsdem::study
