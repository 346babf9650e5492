#include "lsdem/scene/resting_pose.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace musim::lsdem;

namespace {

constexpr double kWide = 0.5, kLong = 1.0, kHigh = 1.5;  // [m]

BoxPose box_at(double x, double y, double height = kHigh) { return {{kWide, kLong, height}, {x, y, 0.5 * height}, Quaternion::Identity()}; }

/// Height of the lowest point of the lower face above the plane through the highest top corners, at a place in plan, body frame.
Vector3 foot_corner(const BoxPose& box, double u, double v) {
    return box.position + box.orientation * Vector3(0.5 * u * box.size.x(), 0.5 * v * box.size.y(), -0.5 * box.size.z());
}

}  // namespace

TEST_CASE("a box on equal boxes stands upright on them, to the last bit") {
    const std::vector<BoxPose> below{box_at(0.0, -0.5), box_at(0.0, 0.5)};
    std::vector<BoxPose> box{box_at(0.0, 0.0)};
    put_to_rest(below, box);
    CHECK(box[0].position == Vector3(0.0, 0.0, 1.5 * kHigh));
    CHECK(box[0].orientation.coeffs() == Quaternion::Identity().coeffs());
    put_to_rest({}, box);
    CHECK(box[0].position == Vector3(0.0, 0.0, 0.5 * kHigh));
}

TEST_CASE("a box on two boxes of unequal height leans on the edges that carry it") {
    // two tops of height difference d: the box turns about x until its face meets the inner edge of the high one and the far end on the low
    // one
    const double d = 0.01;
    std::vector<BoxPose> box{box_at(0.0, 0.0)};
    put_to_rest(std::vector{box_at(0.0, -0.6), box_at(0.0, 0.6, kHigh + d)}, box);
    // inner edges at ∓0.1: the box reaches to −0.5, where the low top ends it
    const double slope = d / 0.6;
    const Vector3 normal = box[0].orientation * Vector3::UnitZ();
    CHECK(-normal.y() / normal.z() == doctest::Approx(slope).epsilon(1e-12));
    CHECK(std::abs(normal.x()) < 1e-15);
    const Vector3 foot = box[0].position - 0.5 * kHigh * normal;
    CHECK(foot.x() == 0.0);
    CHECK(std::abs(foot.y()) < 1e-15);
    CHECK(foot.z() == doctest::Approx(kHigh + 0.5 * slope).epsilon(1e-12));
}

TEST_CASE("resting boxes touch what carries them in three places, never pass through it, and bear their centre of mass") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> rise(0.0, 0.02);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<BoxPose> below{box_at(0.0, -0.52, kHigh + rise(random)), box_at(0.0, 0.52, kHigh + rise(random))};
        // tops that are not level either
        for (BoxPose& box : below)
            box.orientation = Eigen::AngleAxisd(rise(random), Vector3(rise(random) - 0.01, rise(random) - 0.01, 0.0).normalized());
        const BoxPose upright = box_at(0.01, 0.02);
        const std::vector<Vector3> points = find_support_points(upright, below);
        const RestingPlane plane = find_resting_plane(points, kHigh, std::hypot(kWide, kLong));
        int touching = 0;
        for (const Vector3& p : points) {
            const double gap = plane.height + plane.slope_u * p.x() + plane.slope_v * p.y() - p.z();
            CHECK(gap > -1e-14);
            if (gap < 1e-12) ++touching;
        }
        CHECK(touching >= 3);
        // statics: with the plane as floor, the centre of mass lies within the points that carry
        const double lean = -0.5 * kHigh / std::sqrt(1.0 + plane.slope_u * plane.slope_u + plane.slope_v * plane.slope_v);
        const double u = lean * plane.slope_u, v = lean * plane.slope_v;
        double most_u = -1.0, least_u = 1.0, most_v = -1.0, least_v = 1.0;
        for (const Vector3& p : points) {
            if (plane.height + plane.slope_u * p.x() + plane.slope_v * p.y() - p.z() > 1e-12) continue;
            most_u = std::max(most_u, p.x()), least_u = std::min(least_u, p.x());
            most_v = std::max(most_v, p.y()), least_v = std::min(least_v, p.y());
        }
        CHECK((u >= least_u && u <= most_u && v >= least_v && v <= most_v));
        // and the face of the box lies on the plane
        const BoxPose rested = tilt_onto(upright, plane, points, 1.0);
        const Vector3 corner = foot_corner(rested, 1.0, 1.0);
        const double cu = corner.x() - upright.position.x(), cv = corner.y() - upright.position.y();
        CHECK(corner.z() == doctest::Approx(plane.height + plane.slope_u * cu + plane.slope_v * cv).epsilon(1e-12));
    }
}

TEST_CASE("a box whose centre of mass nothing carries stays upright on the highest point") {
    const std::vector<BoxPose> below{box_at(0.4, 0.0)};
    const BoxPose upright = box_at(0.0, 0.0);
    const auto points = find_support_points(upright, below);
    const RestingPlane plane = find_resting_plane(points, kHigh, 1.0);
    CHECK(plane.height == kHigh);
    CHECK(plane.slope_u == 0.0);
    CHECK(plane.slope_v == 0.0);
}

TEST_CASE("boxes side by side lean only as far as their neighbors leave room") {
    // the right one of the upper boxes reaches from the low top in the middle to the inner edge of the high one: it leans to the left,
    // where the other stands upright on level tops, a hair's breadth away
    const double gap = 0.001, d = 0.03;
    const BoxPose low = box_at(0.0, 0.0), high = box_at(0.6, 0.0, kHigh + d), level = box_at(-0.6, 0.0);
    const BoxPose leaning = box_at(0.25, 0.0), neighbor = box_at(0.25 - kWide - gap, 0.0);
    const auto tilt = [](const BoxPose& box) { return std::acos((box.orientation * Vector3::UnitZ()).z()); };

    const std::vector<BoxPose> below{low, high, level};
    std::vector<BoxPose> alone{leaning};
    put_to_rest(below, alone);
    const double free_tilt = std::atan(d / 0.35);
    CHECK(tilt(alone[0]) == doctest::Approx(free_tilt).epsilon(1e-12));

    std::vector<BoxPose> beside{neighbor, leaning};
    put_to_rest(below, beside);
    CHECK(tilt(beside[0]) == 0.0);
    // its upper corner moves by the height times the tilt; bisection finds the tilt to a thousandth of the free one, twice
    CHECK(tilt(beside[1]) <= gap / kHigh * (1.0 + 1e-2));
    CHECK(tilt(beside[1]) >= gap / kHigh - free_tilt / 1000.0);

    // and less where they are to keep clear of each other
    std::vector<BoxPose> clear{neighbor, leaning};
    put_to_rest(below, clear, 0.25 * gap);
    CHECK(tilt(clear[1]) <= 0.75 * gap / kHigh * (1.0 + 1e-2));
    CHECK(tilt(clear[1]) >= 0.75 * gap / kHigh - free_tilt / 1000.0);
}

TEST_CASE("boxes that lean toward each other do not overlap") {
    // alone, each would lean into the other by far more than the gap between them, and the first is placed before the second has leaned
    const double gap = 0.002, d = 0.03;
    const std::vector<BoxPose> below{box_at(-0.55, 0.0, kHigh + d), box_at(0.0, 0.0), box_at(0.55, 0.0, kHigh + d)};
    const double offset = 0.5 * (kWide + gap);
    std::vector<BoxPose> boxes{box_at(-offset, 0.0), box_at(offset, 0.0)};
    put_to_rest(below, boxes);
    double apart = 1.0;
    for (const double side : {-1.0, 1.0}) {
        const Vector3 left = boxes[0].position + boxes[0].orientation * Vector3(0.5 * kWide, 0.0, side * 0.5 * kHigh);
        const Vector3 right = boxes[1].position + boxes[1].orientation * Vector3(-0.5 * kWide, 0.0, side * 0.5 * kHigh);
        apart = std::min(apart, right.x() - left.x());
    }
    CHECK(apart > -1e-6 * kWide);
    CHECK(apart < gap);
}

TEST_CASE("resting poses scale by powers of four bit for bit") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> rise(0.0, 0.02);
    std::vector<BoxPose> below, boxes;
    for (int i = 0; i < 4; ++i) below.push_back(box_at(0.0, 1.05 * (i - 1.5), kHigh + rise(random)));
    for (int i = 0; i < 3; ++i) boxes.push_back(box_at(0.0, 1.05 * (i - 1.0), kHigh + rise(random)));
    std::vector<BoxPose> small_below = below, small = boxes;
    for (BoxPose& box : small_below) box.size *= 0.0625, box.position *= 0.0625;
    for (BoxPose& box : small) box.size *= 0.0625, box.position *= 0.0625;
    put_to_rest(below, boxes);
    put_to_rest(small_below, small);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        CHECK(small[i].position == 0.0625 * boxes[i].position);
        CHECK(small[i].orientation.coeffs() == boxes[i].orientation.coeffs());
    }
}
