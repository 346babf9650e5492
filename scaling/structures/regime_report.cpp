#include "scaling/structures/regime_report.hpp"

#include <fmt/format.h>

#include <limits>

#include "scaling/structures/group_values.hpp"
#include "scaling/structures/regime_borders.hpp"

namespace musim::scaling {
namespace {

/// Whether contacts are rigid in prototype and model; nothing when the properties do not decide it.
std::optional<bool> are_rigid(const std::vector<GroupComparison>& groups, std::string_view measure) {
    for (const GroupComparison& group : groups) {
        if (group.name == measure) return group.prototype < kRigidContact && group.model < kRigidContact;
    }
    return std::nullopt;
}

/// κ_n, δ_w/σ_H and C^N matter only where contacts give way.
void weigh_contacts(std::vector<GroupComparison>& groups) {
    const std::optional<bool> is_overlap_small = are_rigid(groups, "delta_w/sigma_H");
    for (GroupComparison& group : groups) {
        if (!group.severity) continue;
        if (group.name == "kappa_n" || group.name == "delta_w/sigma_H") {
            if (!is_overlap_small) {
                group.effect += "; whether that matters is open: without sigma_H of both the share of dead weight is not known";
            } else if (*is_overlap_small) {
                group.severity = Severity::note;
                group.effect += "; of no weight here: the overlap at the base is small against sigma_H in both";
            }
        } else if (group.name == "C^N" && group.prototype < kRigidContact && group.model < kRigidContact) {
            group.severity = Severity::note;
            group.effect += "; of no weight here: these waves are far faster than the motion in both";
        }
    }
}

GroupComparison compare(const GroupValue& prototype, const GroupValue& model, const KeptNumbers& kept) {
    const GroupMeaning& meaning = find_group_meaning(prototype.name);
    GroupComparison group{.name = meaning.name,
                          .kind = meaning.kind,
                          .direction = prototype.direction,
                          .prototype = *prototype.value,
                          .model = *model.value,
                          .is_required = meaning.is_required_by(kept),
                          .sources = meaning.list_sources()};
    group.severity = find_severity(group.factor());
    if (group.severity) group.effect = meaning.effect(group.factor());
    return group;
}

}  // namespace

double GroupComparison::factor() const {
    if (prototype == model) return 1.0;
    return prototype == 0.0 ? std::numeric_limits<double>::infinity() : model / prototype;
}

RegimeReport make_regime_report(const PairProperties& properties, const Similitude& similitude, const KeptNumbers& kept) {
    check(properties);
    PairProperties pair = properties;
    if (pair.motion && !pair.model_motion) pair.model_motion = to_model(*pair.motion, similitude);
    const bool is_shaken = pair.motion && pair.model_motion;

    const Length block_height = pair.prototype.block[2];
    const auto of_prototype = find_group_values(pair.prototype, is_shaken ? &*pair.motion : nullptr, block_height);
    const auto of_model = find_group_values(pair.model, is_shaken ? &*pair.model_motion : nullptr, similitude.length() * block_height);

    RegimeReport report;
    for (std::size_t i = 0; i < of_prototype.size(); ++i) {
        const GroupValue &prototype = of_prototype[i], &model = of_model[i];
        if (prototype.value && model.value) {
            report.groups.push_back(compare(prototype, model, kept));
        } else if (prototype.direction != Direction::wide) {
            report.untold.push_back({prototype.name, prototype.value ? "model" : model.value ? "prototype" : "both"});
        }
    }
    weigh_contacts(report.groups);
    for (GroupComparison& group : report.groups) {
        if (const auto border = detail::cross_border(group)) {
            report.regimes.push_back(*border);
            if (border->severity) {
                group.severity = border->severity;
                group.effect = border->statement;
            }
        }
    }
    if (is_shaken) detail::add_first_motions(report.regimes, pair);
    detail::add_contacts(report.regimes, report.groups);
    if (is_shaken && pair.table) detail::add_table(report.regimes, *pair.model_motion, *pair.table);
    return report;
}

}  // namespace musim::scaling
