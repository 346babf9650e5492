#include "lsdem/level_set.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace musim::lsdem {

double BoxLevelSet::value(const Vector3& x) const {
    const Vector3 beyond = x.cwiseAbs() - half;
    const double largest = beyond.maxCoeff();
    return largest <= 0.0 ? largest : beyond.cwiseMax(0.0).norm();
}

Vector3 BoxLevelSet::gradient(const Vector3& x) const {
    const Vector3 beyond = x.cwiseAbs() - half;
    Eigen::Index axis = 0;
    Vector3 outward = Vector3::Zero();
    if (beyond.maxCoeff(&axis) <= 0.0) {
        outward[axis] = x[axis] < 0.0 ? -1.0 : 1.0;
        return outward;
    }
    for (int i = 0; i < 3; ++i) outward[i] = beyond[i] > 0.0 ? std::copysign(beyond[i], x[i]) : 0.0;
    return outward / outward.norm();
}

GridLevelSet::GridLevelSet(const Vector3& origin, double spacing, std::array<std::size_t, 3> counts,
                           const std::function<double(const Vector3&)>& distance)
    : origin_(origin), spacing_(spacing), counts_(counts) {
    if (!(spacing > 0.0)) throw std::invalid_argument("GridLevelSet: the spacing must be positive");
    if (*std::min_element(counts.begin(), counts.end()) < 2) throw std::invalid_argument("GridLevelSet: two nodes a side at least");
    values_.reserve(counts[0] * counts[1] * counts[2]);
    for (std::size_t k = 0; k < counts[2]; ++k) {
        for (std::size_t j = 0; j < counts[1]; ++j) {
            for (std::size_t i = 0; i < counts[0]; ++i) {
                const Vector3 step{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
                values_.push_back(distance(origin + spacing * step));
            }
        }
    }
}

GridLevelSet::Cell GridLevelSet::find_cell(const Vector3& x) const {
    Cell cell{};
    for (int a = 0; a < 3; ++a) {
        const std::size_t last = counts_[static_cast<std::size_t>(a)] - 1;
        const double place = std::clamp((x[a] - origin_[a]) / spacing_, 0.0, static_cast<double>(last));
        const std::size_t lower = std::min(static_cast<std::size_t>(place), last - 1);
        cell.index[static_cast<std::size_t>(a)] = lower;
        cell.fraction[a] = place - static_cast<double>(lower);
        cell.clamped[a] = origin_[a] + spacing_ * place;
    }
    return cell;
}

double GridLevelSet::value(const Vector3& x) const {
    const Cell cell = find_cell(x);
    const auto [i, j, k] = cell.index;
    const auto mix = [](double low, double high, double f) { return low + f * (high - low); };
    const double fx = cell.fraction.x();
    const double low = mix(mix(at(i, j, k), at(i + 1, j, k), fx), mix(at(i, j + 1, k), at(i + 1, j + 1, k), fx), cell.fraction.y());
    const double high =
        mix(mix(at(i, j, k + 1), at(i + 1, j, k + 1), fx), mix(at(i, j + 1, k + 1), at(i + 1, j + 1, k + 1), fx), cell.fraction.y());
    return mix(low, high, cell.fraction.z()) + (x - cell.clamped).norm();
}

Vector3 GridLevelSet::gradient(const Vector3& x) const {
    const Cell cell = find_cell(x);
    const auto [i, j, k] = cell.index;
    Vector3 sum = Vector3::Zero();
    for (std::size_t c = 0; c < 8; ++c) {
        const std::size_t dx = c & 1U, dy = (c >> 1U) & 1U, dz = c >> 2U;
        const double phi = at(i + dx, j + dy, k + dz);
        const double wx = dx != 0 ? cell.fraction.x() : 1.0 - cell.fraction.x();
        const double wy = dy != 0 ? cell.fraction.y() : 1.0 - cell.fraction.y();
        const double wz = dz != 0 ? cell.fraction.z() : 1.0 - cell.fraction.z();
        sum.x() += (dx != 0 ? phi : -phi) * wy * wz;
        sum.y() += (dy != 0 ? phi : -phi) * wx * wz;
        sum.z() += (dz != 0 ? phi : -phi) * wx * wy;
    }
    return sum / spacing_;
}

}  // namespace musim::lsdem
