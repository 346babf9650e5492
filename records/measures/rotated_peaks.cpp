#include "records/measures/rotated_peaks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "records/measures/oscillator.hpp"
#include "records/measures/response_spectrum.hpp"
#include "scaling/angle.hpp"
#include "scaling/interruption.hpp"

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

/// The extreme points along eight directions: what lies inside of the octagon that they span is no corner of the hull.
class Octagon {
  public:
    explicit Octagon(const Point& point) { corners_.fill(point); }

    void widen(const Point& point) {
        for (std::size_t way = 0; way < kWays.size(); ++way) {
            if (along(way, point) > along(way, corners_[way])) corners_[way] = point;
        }
        reach_ = std::max({reach_, std::abs(point.first), std::abs(point.second)});
    }

    /// True for points that lie inside, or beyond a side by `slack` of the octagon's reach.
    bool holds(const Point& point, double slack = 0.0) const {
        for (std::size_t side = 0; side < corners_.size(); ++side) {
            const Point &from = corners_[side], &to = corners_[(side + 1) % corners_.size()];
            if (along(side, point) > along(side, from)) return false;
            if (from == to) continue;
            const double margin =
                slack > 0.0 ? slack * reach_ * (std::abs(to.first - from.first) + std::abs(to.second - from.second)) : 0.0;
            if (!(cross(from, to, point) > -margin)) return false;
        }
        return true;
    }

    std::vector<Point> corners() const { return {corners_.begin(), corners_.end()}; }

  private:
    static constexpr std::array<Point, 8> kWays{{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

    static double along(std::size_t way, const Point& point) { return kWays[way].first * point.first + kWays[way].second * point.second; }

    std::array<Point, 8> corners_;
    double reach_ = 0.0;
};

/// The points that lie outside the octagon, and its corners: a few of thousands.
std::vector<Point> find_outer(std::span<const double> x, std::span<const double> y) {
    Octagon octagon({x[0], y[0]});
    for (std::size_t i = 0; i < x.size(); ++i) octagon.widen({x[i], y[i]});
    std::vector<Point> outer = octagon.corners();
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!octagon.holds({x[i], y[i]})) outer.emplace_back(x[i], y[i]);
    }
    return outer;
}

/// Likewise of the path that two oscillators describe, between the samples too.
std::vector<Point> find_outer_path(std::span<const double> x, std::span<const double> y, double theta, double damping) {
    const auto along_path = [&](auto&& visit) {
        detail::OscillatorWalk x_walk(x, theta, damping), y_walk(y, theta, damping);
        while (x_walk.next() && y_walk.next()) visit(x_walk.displacement(), y_walk.displacement());
        return x_walk.substeps().fine;
    };
    Octagon octagon({0.0, 0.0});
    const bool fine = along_path([&](const auto& u, const auto& v) { octagon.widen({u.value1, v.value1}); });

    // 1/4 rad in so many parts: chords are within (1/64)²/8 = 3e-5 of the path
    constexpr int kParts = 16;
    // motions along one line span no octagon: what is off it by rounding is no corner
    constexpr double kSlack = 1e-9;
    std::vector<Point> outer = octagon.corners();
    const auto holds = [&](double first, double second) { return octagon.holds({first, second}, kSlack); };
    along_path([&](const detail::Cubic& u, const detail::Cubic& v) {
        if (!holds(u.value1, v.value1)) outer.emplace_back(u.value1, v.value1);
        // cubics stay within the hull of their ends and of the points that their slopes reach after a third
        const bool inside =
            holds(u.value0 + u.slope0 / 3.0, v.value0 + v.slope0 / 3.0) && holds(u.value1 - u.slope1 / 3.0, v.value1 - v.slope1 / 3.0);
        if (inside || !fine) return;
        for (int part = 1; part < kParts; ++part) {
            const double share = static_cast<double>(part) / kParts, first = u.at(share), second = v.at(share);
            if (!holds(first, second)) outer.emplace_back(first, second);
        }
    });
    return outer;
}

/// Peaks of the points along each direction.
RotatedPeaks rotate(std::vector<Point> outer) {
    const std::vector<Point> hull = find_hull(std::move(outer));
    std::array<double, kDirections> peaks{};
    for (std::size_t degree = 0; degree < kDirections; ++degree) {
        const double angle = static_cast<double>(degree) * scaling::kDegree, c = std::cos(angle), s = std::sin(angle);
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

}  // namespace

RotatedPeaks find_rotated_peaks(std::span<const double> x, std::span<const double> y) {
    if (x.size() != y.size() || x.empty()) {
        throw ProcessingError(
            fmt::format("components have {} and {} samples (must be as many); cut them to one stretch", x.size(), y.size()));
    }
    return rotate(find_outer(x, y));
}

std::vector<RotatedPeaks> compute_rotated_spectrum(const TimeSeries& first, const TimeSeries& second,
                                                   std::span<const scaling::Time> periods, double damping) {
    const bool one_clock = first.size() == second.size() && first.dt() == second.dt() && first.start() == second.start();
    if (!one_clock) throw ProcessingError("components are not on one clock (start, dt or length differ); align them first");
    for (const TimeSeries* series : {&first, &second}) require_quantity(*series, SampleQuantity::acceleration, "the response spectrum");
    require_damping(damping);
    require_periods(periods);
    std::vector<RotatedPeaks> spectrum;
    for (const scaling::Time& period : periods) {
        scaling::stop_if_interrupted();
        if (period.value() == 0.0) {
            spectrum.push_back(find_rotated_peaks(first.samples(), second.samples()));
            continue;
        }
        const double theta = detail::find_theta(period, first.dt());
        RotatedPeaks peaks = rotate(find_outer_path(first.samples(), second.samples(), theta, damping));
        for (double* value : {&peaks.least, &peaks.median, &peaks.largest}) *value *= theta * theta;
        spectrum.push_back(peaks);
    }
    return spectrum;
}

}  // namespace musim::records
