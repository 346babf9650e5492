#include "lsdem/response/camera_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace musim::lsdem {
namespace {

constexpr double kViewMargin = 0.05;  ///< around the structure, of its larger side

/// Depth at which a ray along the third axis through (u, z) leaves a block toward the camera; nothing (−∞) when it misses.
double find_depth(const SeenBlock& seen, double u, double z) {
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
Vector3 find_extent(const SeenBlock& seen) { return seen.turn.cwiseAbs() * seen.half; }

}  // namespace

CameraAxes find_camera_axes(CameraSide side) {
    Vector3 toward = Vector3::Zero();
    toward[side == CameraSide::plus_x || side == CameraSide::minus_x ? 0 : 1] =
        side == CameraSide::plus_x || side == CameraSide::plus_y ? 1.0 : -1.0;
    return {Vector3::UnitZ().cross(toward), toward};
}

SeenBlock look_at_block(const StoredRun& run, std::size_t frame, std::size_t block, const CameraAxes& axes) {
    const std::size_t at = frame * run.blocks.size.size() + block;
    const Eigen::Vector4d q = run.frames.quaternion[at].cast<double>();
    Matrix3 image;
    image << axes.right.transpose(), Vector3::UnitZ().transpose(), axes.toward.transpose();
    return {image * run.frames.position[at].cast<double>(), 0.5 * run.blocks.size[block],
            image * Quaternion(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix()};
}

std::vector<Eigen::Vector2d> find_outline(const SeenBlock& seen) {
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

CameraSide find_side_facing(int axis) { return axis == 1 ? CameraSide::plus_x : CameraSide::minus_y; }

void require_frames(const StoredRun& run) {
    if (!run.frames.time.empty()) return;
    throw ResultError(
        fmt::format("{}: the run has kept no frames (its scene has no output.frame_rate); give one, e.g. \"frame_rate\": "
                    "\"100 Hz\", and run it again",
                    (run.directory / "result.h5").string()));
}

std::size_t find_frame(const StoredRun& run, double time) {
    require_frames(run);
    const double first = run.frames.time.front(), last = run.frames.time.back();
    // half an interval beyond the ends is still nearest to a frame
    const double reach = run.frames.time.size() > 1 ? 0.5 * (run.frames.time[1] - first) : 0.0;
    if (!(first - reach <= time && time <= last + reach)) {
        throw ResultError(fmt::format("{}: there is no frame at {:.6g} s (frames are from {:.6g} to {:.6g} s); name a time between them",
                                      run.directory.string(), time, first, last));
    }
    const auto nearest = std::min_element(run.frames.time.begin(), run.frames.time.end(),
                                          [&](double a, double b) { return std::abs(a - time) < std::abs(b - time); });
    return static_cast<std::size_t>(nearest - run.frames.time.begin());
}

CameraImage take_picture(const StoredRun& run, std::size_t frame, const CameraSettings& settings) {
    const CameraAxes axes = find_camera_axes(settings.side);
    const std::size_t blocks = run.blocks.size.size();

    // the image holds the structure as it was in the first frame
    Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (std::size_t b = 0; b < blocks; ++b) {
        const SeenBlock seen = look_at_block(run, 0, b, axes);
        const Vector3 extent = find_extent(seen);
        low = low.cwiseMin((seen.center - extent).head<2>());
        high = high.cwiseMax((seen.center + extent).head<2>());
    }
    const double margin = kViewMargin * (high - low).maxCoeff();
    CameraImage image{.time = run.frames.time[frame],
                      .left = low.x() - margin,
                      .bottom = low.y() - margin,
                      .pixel = (high.x() - low.x() + 2.0 * margin) / static_cast<double>(settings.columns),
                      .columns = settings.columns,
                      .rows = 0};
    image.rows = static_cast<std::size_t>(std::ceil((high.y() - low.y() + 2.0 * margin) / image.pixel));
    image.block.assign(image.columns * image.rows, -1);
    std::vector<double> depth(image.block.size(), -std::numeric_limits<double>::infinity());

    // every block on the pixels of its bounding rectangle
    const auto clamp_to = [](double place, std::size_t count) {
        return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count)));
    };
    for (std::size_t b = 0; b < blocks; ++b) {
        const SeenBlock seen = look_at_block(run, frame, b, axes);
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
    const double right = v.dot(find_camera_axes(side).right);
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

}  // namespace musim::lsdem
