#include "lsdem/response/camera.hpp"

#include <algorithm>
#include <array>
#include <iterator>

namespace musim::lsdem::detail {

CameraAxes find_axes(CameraSide side) {
    Vector3 toward = Vector3::Zero();
    toward[side == CameraSide::plus_x || side == CameraSide::minus_x ? 0 : 1] =
        side == CameraSide::plus_x || side == CameraSide::plus_y ? 1.0 : -1.0;
    return {Vector3::UnitZ().cross(toward), toward};
}

Seen look_at(const StoredRun& run, std::size_t frame, std::size_t block, const CameraAxes& axes) {
    const std::size_t at = frame * run.blocks.size.size() + block;
    const Eigen::Vector4d q = run.frames.quaternion[at].cast<double>();
    Matrix3 image;
    image << axes.right.transpose(), Vector3::UnitZ().transpose(), axes.toward.transpose();
    return {image * run.frames.position[at].cast<double>(), 0.5 * run.blocks.size[block],
            image * Quaternion(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix()};
}

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

}  // namespace musim::lsdem::detail
