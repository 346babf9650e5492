#include "records/design/candidate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scaling/memoized.hpp"

namespace musim::records {
namespace {

bool has_group(const std::vector<GroupFactor>& groups, std::string_view name) {
    return std::any_of(groups.begin(), groups.end(), [&](const GroupFactor& group) { return group.name == name; });
}

/// Whether a product that a law names is what a group with a name of its own does; laws with a tan α of their own differ.
bool is_reported(const std::vector<GroupFactor>& groups, const DesignLaw& law, const scaling::NamedFactor& product) {
    const std::optional<std::string> name = law.find_common_name(std::string(product.name));
    return name && std::any_of(groups.begin(), groups.end(), [&](const GroupFactor& group) {
               return group.name == *name && std::abs(group.value / product.value - 1.0) <= scaling::kFactorRounding;
           });
}

double find_measure(const std::vector<GroupFactor>& groups, const std::vector<std::string>& weighed) {
    double sum = 0.0;
    for (const GroupFactor& group : groups) {
        if (std::find(weighed.begin(), weighed.end(), group.name) != weighed.end()) sum += std::abs(std::log(group.value));
    }
    return sum;
}

/// The feasible length nearest to the one in mind, by ratio; without one the largest, where making, measuring and evenness are easiest.
double find_ranked_length(const std::vector<FeasibleRange>& ranges, const std::optional<double>& wanted) {
    if (!wanted) return ranges.back().scales.largest;
    double best = ranges.front().scales.smallest;
    for (const FeasibleRange& range : ranges) {
        const double nearest = std::clamp(*wanted, range.scales.smallest, range.scales.largest);
        if (std::abs(std::log(nearest / *wanted)) < std::abs(std::log(best / *wanted))) best = nearest;
    }
    return best;
}

/// "raise hall height to 3 m", so that the limit holds at `length`.
std::string describe_remedy(const Setting& setting, const Material& material, const DesignLaw& law, const std::string& limit,
                            double length) {
    for (const Use& use : find_state(setting, material, law, length).uses) {
        if (use.limit == limit) {
            return fmt::format("{} {} to {}", use.is_floor ? "lower" : "raise", limit, describe_amount(use.demand, use.unit));
        }
    }
    return "change " + limit;
}

std::string describe_problem(const Setting& setting, const Candidate& candidate) {
    for (const LimitRanges& limit : candidate.limits) {
        if (limit.ranges.empty()) {
            const double wanted = setting.design.length.value_or(1.0);
            return fmt::format("{} allows no length scale from {} to 1; for {} {}", limit.limit, scaling::describe_scale(kSearch.smallest),
                               scaling::describe_scale(wanted),
                               describe_remedy(setting, candidate.material, candidate.law, limit.limit, wanted));
        }
    }
    if (!candidate.conflict) return "no length scale suits all limits, though any two agree; loosen those used most";
    const Conflict& conflict = *candidate.conflict;
    return fmt::format("{} allows up to {}, {} asks for at least {}: {}, or {}", conflict.upper, scaling::describe_scale(conflict.at_most),
                       conflict.lower, scaling::describe_scale(conflict.at_least),
                       describe_remedy(setting, candidate.material, candidate.law, conflict.upper, conflict.at_least),
                       describe_remedy(setting, candidate.material, candidate.law, conflict.lower, conflict.at_most));
}

}  // namespace

std::vector<std::string> default_groups() {
    return {"mu^N", "a/(mu*g)", "a/(g*tan(alpha))", "omega/p", "mu/tan(alpha)", "c_res", "sigma_H/H", "e_r"};
}

std::vector<std::string> known_groups() {
    const scaling::ModelProperties all{.friction_prototype = 1.0,
                                       .slenderness = {1.0},
                                       .normal_stiffness = 1.0,
                                       .shear_stiffness = 1.0,
                                       .restitution = 1.0,
                                       .height_deviation = 1.0};
    std::vector<std::string> names;
    for (const scaling::NamedFactor& group : scaling::group_factors(scaling::ModelScales{}, all)) {
        names.emplace_back(group.name);
    }
    return names;
}

bool ModelState::changes_regime() const {
    return std::any_of(distortions.begin(), distortions.end(),
                       [](const scaling::Distortion& each) { return each.severity == scaling::Severity::error; });
}

ModelState find_state(const Setting& setting, const Material& material, const DesignLaw& law, double length) {
    return find_state(setting, Models(setting.design, material, law), length);
}

ModelState find_state(const Setting& setting, const Models& models, double length) {
    const Design& design = setting.design;
    const Material& material = models.material();
    const scaling::ModelScales scales = models.at(length);
    const scaling::ModelProperties properties = models.properties(scales);
    ModelState state{.length = length,
                     .scales = scales,
                     .uses = find_uses(setting, material, scales),
                     .groups = {},
                     .distortions = scaling::find_distortions(scales, properties)};
    for (const scaling::NamedFactor& group : scaling::group_factors(scales, properties)) {
        state.groups.push_back({std::string(group.name), group.value});
    }
    for (const scaling::NamedFactor& group : models.own_groups(length)) {
        if (has_group(state.groups, group.name)) continue;
        const bool is_weighed = std::find(design.groups.begin(), design.groups.end(), group.name) != design.groups.end();
        if (!is_weighed && is_reported(state.groups, models.law(), group)) continue;
        state.groups.push_back({std::string(group.name), group.value});
        if (const auto severity = scaling::find_severity(group.value)) {
            state.distortions.push_back({std::string(group.name), group.value, *severity, "a product that the law names is not kept"});
        }
    }
    state.measure = find_measure(state.groups, design.groups);
    state.mass = scales.mass * design.prototype.mass;
    const double solid = models.solid_mass(scales);
    if (scales.mass / solid - 1.0 > scaling::kFactorRounding) state.added_mass = (scales.mass - solid) * design.prototype.mass;
    if (material.price) state.cost = *material.price * (state.mass - state.added_mass).value();
    return state;
}

std::vector<LimitRanges> find_limit_ranges(const Setting& setting, const Models& models) {
    const Design& design = setting.design;
    const scaling::Memoized<scaling::ModelScales> scales([&](double length) { return models.at(length); });
    const auto uses = [&](const AxisLoad& load, double length) { return find_axis_uses(design.prototype, load, scales(length)); };
    std::vector<LimitRanges> limits;
    for (const LimitScales& limit : find_limit_scales(setting.loads, uses)) {
        limits.push_back({name_table_limit(limit.which, limit.axis), limit.ranges});
    }
    const scaling::Memoized<std::vector<Use>> own([&](double length) { return find_own_uses(design, models.material(), scales(length)); });
    for (std::size_t i = 0; i < own(1.0).size(); ++i) {
        const auto used = [&](double length) { return own(length)[i].used(); };
        limits.push_back({own(1.0)[i].limit, scaling::find_length_range(used, kSearch)});
    }
    return limits;
}

std::vector<FeasibleRange> find_common(const std::vector<LimitRanges>& limits) {
    std::vector<std::vector<scaling::LengthRange>> of_limits;
    for (const LimitRanges& limit : limits) of_limits.push_back(limit.ranges);
    const auto name = [&](const std::optional<std::size_t>& limit) { return limit ? limits[*limit].limit : std::string(); };
    std::vector<FeasibleRange> ranges;
    for (const scaling::CommonRange& common : scaling::find_common(of_limits, kSearch)) {
        ranges.push_back({common.scales, name(common.binds_below), name(common.binds_above)});
    }
    return ranges;
}

std::optional<Conflict> find_conflict(const std::vector<LimitRanges>& limits) {
    std::optional<Conflict> worst;
    for (const LimitRanges& upper : limits) {
        for (const LimitRanges& lower : limits) {
            if (upper.ranges.empty() || lower.ranges.empty()) continue;
            const Conflict conflict{upper.limit, lower.limit, upper.ranges.back().largest, lower.ranges.front().smallest};
            if (conflict.at_most >= conflict.at_least) continue;
            if (!worst || conflict.at_least / conflict.at_most > worst->at_least / worst->at_most) worst = conflict;
        }
    }
    return worst;
}

Candidate find_candidate(const Setting& setting, const Material& material, const DesignLaw& law) {
    Candidate candidate{.material = material, .law = law, .limits = {}, .ranges = {}};
    try {
        candidate.limits = find_limit_ranges(setting, Models(setting.design, material, law));
    } catch (const scaling::SimilitudeError& error) {
        candidate.problem = error.what();
        return candidate;
    }
    candidate.ranges = find_common(candidate.limits);
    const auto state_at = [&](double length) { return find_state(setting, material, law, length); };
    if (setting.design.length) candidate.chosen = state_at(*setting.design.length);
    if (!candidate.is_feasible()) {
        candidate.conflict = find_conflict(candidate.limits);
        candidate.problem = describe_problem(setting, candidate);
        return candidate;
    }
    for (const FeasibleRange& range : candidate.ranges) {
        candidate.ends.push_back(state_at(range.scales.smallest));
        candidate.ends.push_back(state_at(range.scales.largest));
    }
    candidate.ranked = state_at(find_ranked_length(candidate.ranges, setting.design.length));
    return candidate;
}

namespace {

/// A limit of what the table carries finds no mass in a prototype that gives none.
void require_mass(const Setting& setting) {
    if (setting.design.prototype.mass > scaling::Mass{}) return;
    for (const AxisLoad& load : setting.loads) {
        if (!load.axis.payload && !load.axis.overturning_moment) continue;
        throw ReadError(fmt::format("prototype: mass is missing (axis {} of the table limits what it carries); add it", load.axis.name));
    }
}

}  // namespace

std::vector<Candidate> find_candidates(const Setting& setting) {
    require_mass(setting);
    std::vector<Candidate> candidates;
    for (const Material& material : setting.design.materials) {
        for (const DesignLaw& law : setting.design.laws) candidates.push_back(find_candidate(setting, material, law));
    }
    // in single precision, so that rounding does not rank: the mu law and Froude's often distort alike
    const auto key = [](const Candidate& each) {
        const int kind = !each.is_feasible() ? 2 : each.changes_regime() ? 1 : 0;
        return std::pair(kind, static_cast<float>(each.ranked ? each.ranked->measure : 0.0));
    };
    std::stable_sort(candidates.begin(), candidates.end(), [&](const Candidate& a, const Candidate& b) { return key(a) < key(b); });
    return candidates;
}

}  // namespace musim::records
