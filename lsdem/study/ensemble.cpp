#include "lsdem/study/ensemble.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <stdexcept>

#include "lsdem/results/read_results.hpp"

namespace musim::lsdem {
namespace {

/// Sampling times agree within this part of the interval. They are counts times a step that was fitted to the interval: rounding only.
constexpr double kSameTime = 1e-9;

MemberStatus judge(const StoredRun& run) {
    if (run.status == RunStatus::diverged) return MemberStatus::diverged;
    // one that collapsed while it was prepared need not lie at rest
    if (!run.at_rest && !run.collapsed_before()) return MemberStatus::unsettled;
    return run.status == RunStatus::collapsed ? MemberStatus::collapsed : MemberStatus::completed;
}

std::string explain(MemberStatus status, const StoredRun& run) {
    if (status == MemberStatus::diverged) return run.divergence;
    if (status == MemberStatus::unsettled) return "it did not come to rest before t = 0; see summary.json in its folder";
    return {};
}

Eigen::ArrayXd one(double value) { return Eigen::ArrayXd::Constant(1, value); }

/// Response of a member that stands to the end.
void add_response(EnsembleSummary& summary, const Response& response) {
    if (summary.levels.empty()) {
        summary.levels.resize(response.spine.size());
        for (const SpeedEstimate& estimate : response.speeds) summary.speeds.push_back({.method = estimate.method});
    }
    for (std::size_t s = 0; s < response.spine.size(); ++s) {
        const SpineLevel& of_member = response.spine[s];
        LevelMoments& level = summary.levels[s];
        level.level = of_member.level;
        level.height.add(one(of_member.height));
        level.peak_velocity.add(of_member.peak_velocity.array());
        level.peak_displacement.add(of_member.peak_displacement.array());
        level.residual_displacement.add(of_member.residual_displacement.array());
        level.rotation.add(
            Eigen::Array4d(of_member.in_plane_peak, of_member.in_plane_residual, of_member.vertical_peak, of_member.vertical_residual));
    }
    for (std::size_t i = 0; i < response.speeds.size(); ++i)
        if (response.speeds[i].speed) summary.speeds[i].speed.add(one(*response.speeds[i].speed));
    summary.damage.add(one(response.damage.index));
}

/// A member's results, added to the sums when they count.
void add_member(EnsembleSummary& summary, BandSum& bands, const EnsembleMember& member, const std::filesystem::path& folder,
                std::optional<int> axis, MemberResult& result) {
    const StoredRun run = read_run(folder);
    if (!is_scene_of(run.scene, member))
        throw ResultError(folder.string() + ": holds results of another scene than its name says; remove it");
    const MemberStatus status = judge(run);
    if (status == MemberStatus::completed || status == MemberStatus::collapsed) {
        if (summary.scales) axis = summary.axis;
        result.response = measure_response(run, {.axis = axis, .window = {}});
        bands.add(run.history, run.spine, run.collapse_time);
        summary.axis = result.response->axis;
        if (!summary.scales) summary.scales = result.response->scales;
        if (status == MemberStatus::completed) add_response(summary, *result.response);
    }
    result.reason = explain(status, run);
    result.collapse_time = run.collapse_time;
    result.state_hash = run.state_hash;
    result.status = status;
}

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

std::string to_string(MemberStatus status) {
    constexpr std::array kNames{"completed", "collapsed", "diverged", "unsettled", "failed"};
    return kNames.at(static_cast<std::size_t>(status));
}

int EnsembleSummary::count(MemberStatus status) const {
    return static_cast<int>(
        std::count_if(members.begin(), members.end(), [&](const MemberResult& member) { return member.status == status; }));
}

EnsembleSummary summarize_ensemble(const std::filesystem::path& directory, const std::vector<EnsembleMember>& members,
                                   const std::vector<MemberReport>& reports, std::optional<int> axis) {
    EnsembleSummary summary;
    summary.name = members.front().scene.name;
    BandSum bands;
    for (std::size_t i = 0; i < members.size(); ++i) {
        MemberResult& result = summary.members.emplace_back();
        result.name = members[i].name;
        result.seed = members[i].seed;
        result.reason = reports[i].error;
        if (!result.reason.empty()) continue;
        try {
            add_member(summary, bands, members[i], member_folder(directory, members[i]), axis, result);
        } catch (const std::exception& error) {
            result.reason = error.what();
            result.response.reset();
        }
    }
    summary.bands = bands.bands();
    return summary;
}

}  // namespace musim::lsdem
