#include "lsdem/results/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace musim::lsdem {
namespace {

/// Blocks surround the axis when no gap between their directions, seen from it, is as wide as this [rad].
constexpr double kWidestGap = 0.5 * std::numbers::pi;

/// Outward of every block: a horizontal unit vector; zero for those without.
std::vector<Vector3> find_outward(const FailureData& data) {
    double mass = 0.0;
    Vector3 center = Vector3::Zero();
    for (std::size_t b = 0; b < data.start.size(); ++b) {
        mass += data.blocks.mass[b];
        center += data.blocks.mass[b] * data.start[b];
    }
    center /= mass;
    std::vector<Vector3> outward;
    for (std::size_t b = 0; b < data.start.size(); ++b) {
        const Vector3 from_axis(data.start[b].x() - center.x(), data.start[b].y() - center.y(), 0.0);
        const double radius = from_axis.norm();
        outward.push_back(radius >= data.blocks.thin_side(b) ? Vector3(from_axis / radius) : Vector3(Vector3::Zero()));
    }
    return outward;
}

bool surround_axis(const std::vector<Vector3>& outward) {
    std::vector<double> direction;
    for (const Vector3& e : outward) {
        if (!e.isZero(0.0)) direction.push_back(std::atan2(e.y(), e.x()));
    }
    if (direction.empty()) return false;
    std::sort(direction.begin(), direction.end());
    double gap = direction.front() + 2.0 * std::numbers::pi - direction.back();
    for (std::size_t i = 1; i < direction.size(); ++i) gap = std::max(gap, direction[i] - direction[i - 1]);
    return gap < kWidestGap;
}

/// Mass that went one way, of all.
struct Share {
    double part = 0.0, whole = 0.0;

    void add(double mass, bool counts) {
        whole += mass;
        if (counts) part += mass;
    }
    double value() const { return whole > 0.0 ? part / whole : 0.0; }
};

/// A level's mean widening and height.
struct LevelBulge {
    double mass = 0.0, widening = 0.0, height = 0.0;
};

/// The level that has widened most; nothing without levels.
std::optional<LevelBulge> find_bulge(const FailureData& data, const std::vector<Vector3>& outward) {
    std::map<int, LevelBulge> levels;
    for (std::size_t b = 0; b < outward.size(); ++b) {
        if (data.blocks.layer[b] == 0 || outward[b].isZero(0.0)) continue;
        const double mass = data.blocks.mass[b];
        LevelBulge& level = levels[data.blocks.layer[b]];
        level.mass += mass;
        level.widening += mass * (outward[b].dot(data.falls.at_collapse[b]) / data.blocks.thin_side(b));
        level.height += mass * data.start[b].z();
    }
    std::optional<LevelBulge> widest;
    for (auto& [number, level] : levels) {
        level.widening /= level.mass;
        level.height /= level.mass;
        if (!widest || level.widening > widest->widening) widest = level;
    }
    return widest;
}

FailureMeasures measure(const FailureData& data, const std::vector<Vector3>& outward) {
    FailureMeasures measures;
    const std::optional<LevelBulge> bulge = find_bulge(data, outward);
    if (bulge) {
        const auto [low, high] =
            std::minmax_element(data.start.begin(), data.start.end(), [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); });
        measures.bulge = bulge->widening;
        if (high->z() > low->z()) measures.bulge_height = (bulge->height - low->z()) / (high->z() - low->z());
    }
    Share went_outward, came_down;
    for (std::size_t b = 0; b < outward.size(); ++b) {
        if (std::isnan(data.falls.time[b])) continue;
        ++measures.fallen;
        if (outward[b].isZero(0.0)) continue;
        const Vector3& moved = data.falls.displacement[b];
        const double out = outward[b].dot(moved), down = -moved.z();
        went_outward.add(data.blocks.mass[b], out > down && out > 0.5 * data.blocks.thin_side(b));
        // half a block: levels of unequal blocks differ in height by less
        if (bulge && data.start[b].z() > bulge->height + 0.5 * data.blocks.size[b].minCoeff()) {
            came_down.add(data.blocks.mass[b], out <= down);
        }
    }
    measures.outward_share = went_outward.value();
    measures.inward_share_above = came_down.value();
    return measures;
}

}  // namespace

std::string to_string(FailureMode mode) {
    constexpr std::array kNames{"peeling", "buckling", "undecided"};
    return kNames.at(static_cast<std::size_t>(mode));
}

std::string describe(const Failure& failure) {
    const FailureMeasures& m = failure.measures;
    if (!failure.surrounds_axis) {
        return fmt::format(
            "collapse of {} block{}: no failure mode is given, since peeling and buckling are those of structures around an axis", m.fallen,
            m.fallen == 1 ? "" : "s");
    }
    const std::string why = failure.why.empty() ? std::string() : fmt::format(" ({})", failure.why);
    return fmt::format(
        "failure mode {}{}: {:.3g} % by mass of {} fallen blocks went outward; the level at {:.2g} of the height bulged by {:.3g} thin "
        "sides, and {:.3g} % of what fell from above it came down or inward",
        to_string(failure.mode), why, 100.0 * m.outward_share, m.fallen, m.bulge_height, m.bulge, 100.0 * m.inward_share_above);
}

Failure find_failure(const FailureData& data) {
    Failure failure;
    failure.time = data.collapse_time;
    const std::vector<Vector3> outward = find_outward(data);
    if (!surround_axis(outward)) {
        failure.why = "the structure does not surround an axis, so that nothing is outward";
        failure.surrounds_axis = false;
        failure.measures.fallen = static_cast<std::size_t>(
            std::count_if(data.falls.time.begin(), data.falls.time.end(), [](double time) { return !std::isnan(time); }));
        return failure;
    }
    failure.measures = measure(data, outward);
    const FailureMeasures& m = failure.measures;
    const bool at_mid_height = m.bulge_height >= kEndOfTower && m.bulge_height <= 1.0 - kEndOfTower;
    const bool peels = m.outward_share >= kFailureMajority;
    const bool buckles = m.inward_share_above >= kFailureMajority && m.bulge >= kLeastBulge && at_mid_height;
    if (peels == buckles) {
        failure.why = peels ? "the measures of both modes hold" : "the measures of neither mode hold";
    } else {
        failure.mode = peels ? FailureMode::peeling : FailureMode::buckling;
    }
    return failure;
}

}  // namespace musim::lsdem
