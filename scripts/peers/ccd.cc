// libccd's defaults, cube on cube: a thousand ways to stand askew and tilted by about 1e-3, each as deep as said along the axis of least
// overlap, which is known in closed form.
#include <ccd/ccd.h>
#include <ccd/vec3.h>

#include <Eigen/Geometry>
#include <random>

#include "measure.hh"

namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

struct Cube {
    double half;
    Vector3d middle;
    Matrix3d axes;
};

Vector3d farthest(const Cube& cube, const Vector3d& direction) {
    const Vector3d own = cube.axes.transpose() * direction;
    return cube.middle + cube.axes * (cube.half * own.array().sign() + (own.array() == 0.0).cast<double>() * cube.half).matrix();
}

void support(const void* cube, const ccd_vec3_t* direction, ccd_vec3_t* at) {
    const Vector3d point = farthest(*static_cast<const Cube*>(cube), Vector3d(direction->v[0], direction->v[1], direction->v[2]));
    ccdVec3Set(at, point.x(), point.y(), point.z());
}

void center(const void* cube, ccd_vec3_t* at) {
    const Vector3d& middle = static_cast<const Cube*>(cube)->middle;
    ccdVec3Set(at, middle.x(), middle.y(), middle.z());
}

/// Overlap and its direction by the fifteen axes on which cubes can be apart.
std::pair<double, Vector3d> find_overlap(const Cube& below, const Cube& above) {
    std::vector<Vector3d> axes;
    for (int i = 0; i < 3; ++i) {
        axes.emplace_back(below.axes.col(i));
        axes.emplace_back(above.axes.col(i));
        for (int j = 0; j < 3; ++j) {
            const Vector3d both = below.axes.col(i).cross(above.axes.col(j));
            if (both.norm() > 1e-9) axes.emplace_back(both.normalized());
        }
    }
    std::pair<double, Vector3d> least(1e300, Vector3d::UnitZ());
    for (const Vector3d& axis : axes) {
        for (const Vector3d& n : {axis, Vector3d(-axis)}) {
            const double overlap = farthest(below, n).dot(n) - farthest(above, -n).dot(n);
            if (overlap < least.first) least = {overlap, n};
        }
    }
    return least;
}

}  // namespace

int main() {
    constexpr int kWays = 1000;
    constexpr double kTilt = 1e-3, kOff = 5.0;  // standard deviation [rad], degrees
    peers::Report report("libccd", "2.1");
    for (const double edge : {1.0, 0.1, 0.01}) {
        for (const double part : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
            std::mt19937 engine(1);
            std::normal_distribution<double> normal;
            std::array<int, 2> missed{}, off{};
            for (int k = 0; k < kWays; ++k) {
                const Cube below{0.5 * edge, Vector3d::Zero(), Matrix3d::Identity()};
                Cube above = below;
                const double tilt = kTilt * normal(engine), towards = normal(engine), turn = normal(engine);
                above.axes = (Eigen::AngleAxisd(tilt, Vector3d(std::cos(towards), std::sin(towards), 0.0)) *
                              Eigen::AngleAxisd(turn, Vector3d::UnitZ())).toRotationMatrix();
                const Vector3d aside(0.3 * std::sin(k), 0.3 * std::cos(2 * k), 1.0);
                double near = 0.0, far = 3 * edge;
                for (int i = 0; i < 100; ++i) {
                    above.middle = 0.5 * (near + far) * aside;
                    (find_overlap(below, above).first > part * edge ? near : far) = 0.5 * (near + far);
                }
                above.middle = near * aside;
                const Vector3d true_normal = find_overlap(below, above).second;
                ccd_t ccd;
                CCD_INIT(&ccd);
                ccd.support1 = ccd.support2 = support;
                ccd.center1 = ccd.center2 = center;
                ccd.max_iterations = 100;
                for (const int mpr : {0, 1}) {
                    ccd_real_t depth = 0.0;
                    ccd_vec3_t n, at;
                    const int failed = mpr ? ccdMPRPenetration(&below, &above, &ccd, &depth, &n, &at)
                                           : ccdGJKPenetration(&below, &above, &ccd, &depth, &n, &at);
                    missed[mpr] += failed != 0;
                    const double cosine = failed ? 1.0 : Vector3d(n.v[0], n.v[1], n.v[2]).normalized().dot(true_normal);
                    off[mpr] += std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / M_PI > kOff;
                }
            }
            for (const int mpr : {0, 1}) {
                const std::string name = mpr ? "MPR" : "EPA";
                report.say("missed " + name, edge, part, static_cast<double>(missed[mpr]) / kWays);
                report.say("normal off " + name, edge, part, static_cast<double>(off[mpr]) / kWays);
            }
        }
    }
}
