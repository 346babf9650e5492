#include "lsdem/results/base_change.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "lsdem/base_motion.hpp"
#include "scaling/units.hpp"

namespace musim::lsdem {
namespace {

using records::MotionPeaks;

double to_gravities(scaling::Acceleration acceleration) { return (acceleration / scaling::kStandardGravity).value(); }

std::string write_gravities(scaling::Acceleration acceleration) { return fmt::format("{:.4g} g", to_gravities(acceleration)); }

/// Samples of a component up to the one that ends the interval in which `end` lies.
std::size_t count_samples(const BaseComponent& component, double end) {
    const double intervals = std::ceil((end - component.start) / component.dt);
    const auto all = static_cast<double>(component.velocity.size());
    return static_cast<std::size_t>(std::clamp(intervals + 1.0, 1.0, all));
}

BaseChange compare_with_record(const BaseComponent& component, double end) {
    const std::size_t count = count_samples(component, end);
    const auto part = [count](const std::vector<double>& samples) { return std::span(samples).first(std::min(count, samples.size())); };
    return {records::compare_motions(part(component.velocity), part(component.source.velocity), part(component.source.acceleration),
                                     component.dt),
            true};
}

/// Comparison with a formula, whose PGA counts once the run has reached the base's.
BaseChange compare_with_formula(const BaseComponent& component, double reached, double whole, double end) {
    const auto part = std::span(component.velocity).first(count_samples(component, end));
    BaseChange change{records::compare_motions(part, part, {}, component.dt), false};
    if (reached < whole) return change;
    change.peaks.record.pga = scaling::Acceleration::from_value(component.source.peak_acceleration);
    change.peaks.difference.pga = scaling::Acceleration::from_value(std::abs(component.source.peak_acceleration - whole));
    return change;
}

nlohmann::json write_peaks(const MotionPeaks& peaks) {
    return {{"pga_g", to_gravities(peaks.pga)}, {"pgv_m_s", peaks.pgv.value()}, {"pgd_m", peaks.pgd.value()}};
}

MotionPeaks parse_peaks(const nlohmann::json& json) {
    return {json.at("pga_g").get<double>() * scaling::kStandardGravity, scaling::Velocity::from_value(json.at("pgv_m_s").get<double>()),
            scaling::Length::from_value(json.at("pgd_m").get<double>())};
}

}  // namespace

BaseChanges find_base_changes(const BaseComponents& motion, double end) {
    const lsdem::BaseMotion base(motion);
    const Vector3 until_end = base.peak_acceleration(end);
    const Vector3 whole = base.peak_acceleration(std::numeric_limits<double>::infinity());
    BaseChanges changes;
    for (std::size_t axis = 0; axis < changes.size(); ++axis) {
        const MotionSource& from = motion.shift[axis].source;
        const auto a = static_cast<int>(axis);
        if (!from.velocity.empty()) {
            changes[axis] = compare_with_record(motion.shift[axis], end);
        } else if (from.peak_acceleration > 0.0) {
            changes[axis] = compare_with_formula(motion.shift[axis], until_end[a], whole[a], end);
        }
    }
    return changes;
}

BaseChanges scale_back(BaseChanges changes, const std::array<double, 3>& acceleration, const std::array<double, 3>& velocity,
                       const std::array<double, 3>& length) {
    for (std::size_t axis = 0; axis < changes.size(); ++axis) {
        if (!changes[axis]) continue;
        records::MotionChange& change = changes[axis]->peaks;
        for (MotionPeaks* peaks : {&change.record, &change.base, &change.difference}) {
            peaks->pga = peaks->pga / acceleration[axis];
            peaks->pgv = peaks->pgv / velocity[axis];
            peaks->pgd = peaks->pgd / length[axis];
        }
    }
    return changes;
}

std::string describe_base(double pga, const std::optional<BaseChange>& change) {
    if (!change) return "PGA " + write_gravities(scaling::Acceleration::from_value(pga));
    if (change->of_record) return records::describe(change->peaks);
    const std::string base = write_gravities(change->peaks.base.pga), formula = write_gravities(change->peaks.record.pga);
    return base == formula ? "PGA " + base : fmt::format("PGA {} (formula {})", base, formula);
}

std::vector<std::string> warn_of_changes(const BaseChanges& changes) {
    std::vector<std::string> warnings;
    for (std::size_t axis = 0; axis < changes.size(); ++axis) {
        if (!changes[axis] || !changes[axis]->of_record) continue;
        const records::MotionChange& change = changes[axis]->peaks;
        const std::string what = records::describe_changed_peaks(change);
        if (what.empty()) continue;
        const bool is_treated = change.difference.pgv > records::kChangedPeak * change.record.pgv ||
                                change.difference.pga > records::kChangedPeak * change.record.pga;
        warnings.push_back(fmt::format(
            "the base {} along {} ({}", what, "xyz"[axis],
            is_treated ? "it was cut, filtered or brought to rest); choose a \"window\" that begins and ends near rest, or another "
                         "\"highpass\"; \"at_rest\": false leaves it as it is"
                       : "its velocity is linear between samples, so that its acceleration is the mean of two); resample the record to a "
                         "finer step, if so short a peak matters"));
    }
    return warnings;
}

nlohmann::json to_json(const BaseChange& change) {
    return {{"of", change.of_record ? "record" : "formula"},
            {"base", write_peaks(change.peaks.base)},
            {"source", write_peaks(change.peaks.record)},
            {"largest_difference", write_peaks(change.peaks.difference)}};
}

nlohmann::json to_json(const BaseChanges& changes) {
    nlohmann::json list = nlohmann::json::array();
    for (const std::optional<BaseChange>& change : changes) list.push_back(change ? to_json(*change) : nlohmann::json());
    return list;
}

BaseChanges parse_base_changes(const nlohmann::json& json) {
    BaseChanges changes;
    for (std::size_t axis = 0; axis < changes.size(); ++axis) {
        const nlohmann::json& one = json.at(axis);
        if (one.is_null()) continue;
        changes[axis] = BaseChange{{parse_peaks(one.at("source")), parse_peaks(one.at("base")), parse_peaks(one.at("largest_difference"))},
                                   one.at("of") == "record"};
    }
    return changes;
}

}  // namespace musim::lsdem
