#include "lsdem/study/ensemble.hpp"

#include <algorithm>
#include <array>
#include <exception>

#include "lsdem/results/read_results.hpp"

namespace musim::lsdem {
namespace {

MemberStatus judge(const StoredRun& run) {
    if (run.status == RunStatus::diverged) return MemberStatus::diverged;
    if (!run.at_rest) return MemberStatus::unsettled;
    return run.status == RunStatus::collapsed ? MemberStatus::collapsed : MemberStatus::completed;
}

std::string explain(MemberStatus status, const StoredRun& run) {
    if (status == MemberStatus::diverged) return run.divergence;
    if (status == MemberStatus::unsettled) return "it did not come to rest before t = 0; see summary.json in its folder";
    return {};
}

Eigen::ArrayXd one(double value) { return Eigen::ArrayXd::Constant(1, value); }

/// What counts of a member that stands to the end.
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
