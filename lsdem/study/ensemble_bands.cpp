#include "lsdem/study/ensemble_bands.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace musim::lsdem {
namespace {

/// Sampling times agree within this part of the interval. They are counts times a step that was fitted to the interval: rounding only.
constexpr double kSameTime = 1e-9;

}  // namespace

void BandSum::take_times(const History& history) {
    const std::size_t common = std::min(time_.size(), history.samples());
    const double interval =
        history.samples() > 1 ? (history.time.back() - history.time.front()) / static_cast<double>(history.samples() - 1) : 0.0;
    for (std::size_t k = 0; k < common; ++k) {
        if (!(std::abs(history.time[k] - time_[k]) <= kSameTime * interval))
            throw std::invalid_argument("its samples were taken at other times than those of the members before");
    }
    for (std::size_t k = common; k < history.samples(); ++k) {
        time_.push_back(history.time[k]);
        base_.push_back(history.base[k]);
        velocity_.emplace_back(static_cast<Eigen::Index>(3 * level_.size()));
    }
}

void BandSum::add(const History& history, const Spine& spine, std::optional<double> collapse_time) {
    if (time_.empty()) level_ = spine.level;
    if (spine.level != level_) throw std::invalid_argument("its spine has other levels than that of the members before");
    take_times(history);
    const std::size_t values = 3 * level_.size();
    for (std::size_t k = 0; k < history.samples() && !(collapse_time && history.time[k] >= *collapse_time); ++k) {
        Eigen::ArrayXd velocity(static_cast<Eigen::Index>(values));
        for (std::size_t s = 0; s < level_.size(); ++s)
            velocity.segment<3>(static_cast<Eigen::Index>(3 * s)) = history.spine_velocity[k * level_.size() + s].array();
        velocity_[k].add(velocity);
    }
}

Bands BandSum::bands() const {
    Bands bands{.time = time_, .base = base_, .level = level_, .count = {}, .mean = {}, .sd = {}};
    for (const SampleMoments& moments : velocity_) {
        const Eigen::ArrayXd mean = moments.mean(), sd = moments.sd();
        bands.count.push_back(moments.count());
        for (Eigen::Index i = 0; i < mean.size(); i += 3) {
            bands.mean.emplace_back(mean.segment<3>(i).matrix());
            bands.sd.emplace_back(sd.segment<3>(i).matrix());
        }
    }
    return bands;
}

}  // namespace musim::lsdem
