#include "records/rotated_peaks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "records/response_spectrum.hpp"

namespace musim::records {
namespace {

constexpr std::size_t kDirections = 180;

using Point = std::pair<double, double>;

double cross(const Point& origin, const Point& a, const Point& b) {
    return (a.first - origin.first) * (b.second - origin.second) - (a.second - origin.second) * (b.first - origin.first);
}

/// Corners of the convex hull [Andrew79]: the only points that are farthest along any direction.
std::vector<Point> find_hull(std::vector<Point> points) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    std::vector<Point> hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t start = hull.size();
        for (const Point& point : points) {
            while (hull.size() >= start + 2 && cross(hull[hull.size() - 2], hull.back(), point) <= 0.0) hull.pop_back();
            hull.push_back(point);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

/// The points that lie outside the octagon which the extreme points along eight directions span, and those: a few of thousands.
std::vector<Point> find_outer(std::span<const double> x, std::span<const double> y) {
    constexpr std::array<Point, 8> kWays{{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
    std::array<Point, 8> corner;
    for (std::size_t way = 0; way < kWays.size(); ++way) {
        std::size_t farthest = 0;
        const auto along = [&](std::size_t i) { return kWays[way].first * x[i] + kWays[way].second * y[i]; };
        for (std::size_t i = 1; i < x.size(); ++i)
            if (along(i) > along(farthest)) farthest = i;
        corner[way] = {x[farthest], y[farthest]};
    }
    std::vector<Point> outer(corner.begin(), corner.end());
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Point point{x[i], y[i]};
        bool inside = true;
        for (std::size_t side = 0; side < corner.size() && inside; ++side) {
            const Point &from = corner[side], &to = corner[(side + 1) % corner.size()];
            inside = from == to || cross(from, to, point) > 0.0;
        }
        if (!inside) outer.push_back(point);
    }
    return outer;
}

}  // namespace

RotatedPeaks find_rotated_peaks(std::span<const double> x, std::span<const double> y) {
    if (x.size() != y.size() || x.empty())
        throw ProcessingError(
            fmt::format("components have {} and {} samples (must be as many); cut them to one stretch", x.size(), y.size()));
    const std::vector<Point> hull = find_hull(find_outer(x, y));
    std::array<double, kDirections> peaks{};
    for (std::size_t degree = 0; degree < kDirections; ++degree) {
        const double angle = static_cast<double>(degree) * (std::numbers::pi / 180.0), c = std::cos(angle), s = std::sin(angle);
        for (const auto& [px, py] : hull) peaks[degree] = std::max(peaks[degree], std::abs(px * c + py * s));
    }
    RotatedPeaks result;
    result.largest_at = static_cast<double>(std::max_element(peaks.begin(), peaks.end()) - peaks.begin());
    std::sort(peaks.begin(), peaks.end());
    result.least = peaks.front();
    result.median = 0.5 * (peaks[kDirections / 2 - 1] + peaks[kDirections / 2]);
    result.largest = peaks.back();
    return result;
}

std::vector<RotatedPeaks> compute_rotated_spectrum(const TimeSeries& first, const TimeSeries& second,
                                                   std::span<const scaling::Time> periods, double damping) {
    const bool one_clock = first.size() == second.size() && first.dt() == second.dt() && first.start() == second.start();
    if (!one_clock) throw ProcessingError("components are not on one clock (start, dt or length differ); align them first");
    std::vector<RotatedPeaks> spectrum;
    for (const scaling::Time& period : periods) {
        if (period.value() == 0.0) {
            spectrum.push_back(find_rotated_peaks(first.samples(), second.samples()));
            continue;
        }
        const TimeSeries x = compute_oscillator_response(first, period, damping), y = compute_oscillator_response(second, period, damping);
        RotatedPeaks peaks = find_rotated_peaks(x.samples(), y.samples());
        const double omega = 2.0 * std::numbers::pi / period.value(), square = omega * omega;
        for (double* value : {&peaks.least, &peaks.median, &peaks.largest}) *value *= square;
        spectrum.push_back(peaks);
    }
    return spectrum;
}

}  // namespace musim::records
