#include "cli/records/table_output.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>

#include "cli/length_ranges.hpp"
#include "cli/named_values.hpp"
#include "cli/output.hpp"
#include "cli/records/record_peaks.hpp"
#include "records/measures/response_spectrum.hpp"
#include "scaling/angle.hpp"
#include "scaling/laws/length_range.hpp"

namespace musim::cli {
namespace {

using records::TableLimit;

/// The unit in which engineers quote a limit.
struct DisplayUnit {
    const char* name;
    double si;
};

/// Those of a limit: the usual one, which JSON has, and that for limits from ten thousand of it.
struct LimitUnits {
    TableLimit limit;
    DisplayUnit usual, large;
};

LimitUnits find_units(TableLimit limit) {
    static const DisplayUnit kGravity{"g", scaling::kStandardGravity.value()}, kHertz{"Hz", 1.0}, kAngle{"deg", scaling::kDegree};
    static const LimitUnits kUnits[] = {{TableLimit::displacement, {"mm", 1e-3}, {"mm", 1e-3}},
                                        {TableLimit::velocity, {"cm/s", 1e-2}, {"cm/s", 1e-2}},
                                        {TableLimit::acceleration, kGravity, kGravity},
                                        {TableLimit::force, {"kN", 1e3}, {"MN", 1e6}},
                                        {TableLimit::overturning_moment, {"kN m", 1e3}, {"MN m", 1e6}},
                                        {TableLimit::payload, {"kg", 1.0}, {"t", 1e3}},
                                        {TableLimit::angle, kAngle, kAngle},
                                        {TableLimit::angular_velocity, {"deg/s", kAngle.si}, {"deg/s", kAngle.si}},
                                        {TableLimit::angular_acceleration, {"deg/s2", kAngle.si}, {"deg/s2", kAngle.si}}};
    const auto* const found =
        std::find_if(std::begin(kUnits), std::end(kUnits), [&](const LimitUnits& each) { return each.limit == limit; });
    return found == std::end(kUnits) ? LimitUnits{limit, kHertz, kHertz} : *found;
}

/// The unit in which a use is printed.
DisplayUnit find_printed_unit(const records::LimitUse& use) {
    const LimitUnits units = find_units(use.which);
    return use.limit < 1e4 * units.usual.si ? units.usual : units.large;
}

std::string describe_end(const std::optional<TableLimit>& limit, const std::string& axis) {
    if (!limit) return "the end of the search";
    return fmt::format("{} of axis {}", to_string(*limit), axis);
}

const std::vector<scaling::LengthRange>* find_ranges(const std::vector<records::LimitScales>& scales, const std::string& axis,
                                                     TableLimit limit) {
    for (const records::LimitScales& each : scales)
        if (each.axis == axis && each.which == limit) return &each.ranges;
    return nullptr;
}

/// Peaks in the units of their keys in JSON.
std::vector<std::pair<const char*, double>> list_peaks(const records::MotionPeaks& peaks) {
    return {{"pga_g", (peaks.pga / scaling::kStandardGravity).value()},
            {"pgv_cm_s", peaks.pgv.value() / 0.01},
            {"pgd_cm", peaks.pgd.value() / 0.01}};
}

std::vector<std::pair<const char*, double>> list_peaks(const records::RotationPeaks& peaks) {
    return {{"angular_acceleration_deg_s2", peaks.acceleration.value() * scaling::kDegrees},
            {"angular_velocity_deg_s", peaks.rate.value() * scaling::kDegrees},
            {"angle_deg", peaks.angle.value() * scaling::kDegrees}};
}

/// Demand of a component in the units of its keys in JSON.
nlohmann::json list_demand(const records::TableDemand& demand, bool is_rotation) {
    if (is_rotation) {
        const records::TurnDemand& turn = demand.turn;
        return {{"angle_deg", turn.angle.value() * scaling::kDegrees},
                {"half_range_deg", turn.half_range.value() * scaling::kDegrees},
                {"angular_velocity_deg_s", turn.angular_velocity.value() * scaling::kDegrees},
                {"angular_acceleration_deg_s2", turn.angular_acceleration.value() * scaling::kDegrees}};
    }
    return {{"displacement_mm", demand.displacement.value() / 1e-3},
            {"half_range_mm", demand.half_range.value() / 1e-3},
            {"velocity_cm_s", demand.velocity.value() / 1e-2},
            {"acceleration_g", demand.acceleration.value() / scaling::kStandardGravity.value()}};
}

/// Unit of pseudo accelerations: g, or rad/s² of a rotation.
DisplayUnit find_psa_unit(const records::SpectrumChange& change) {
    return change.is_rotation ? DisplayUnit{"rad/s2", 1.0} : DisplayUnit{"g", scaling::kStandardGravity.value()};
}

std::optional<double> find_mean_psa_factor(const records::TimeSeries& before, const records::TimeSeries& after,
                                           std::span<const scaling::Time> periods) {
    if (before.quantity() != records::SampleQuantity::acceleration || periods.empty()) return std::nullopt;
    const auto psa = [&](const records::TimeSeries& series) {
        return records::compute_response_spectrum(series, periods).pseudo_acceleration();
    };
    const std::vector<double> one = psa(before), two = psa(after);
    double sum = 0.0;
    for (std::size_t i = 0; i < periods.size(); ++i) sum += std::abs(std::log(two[i] / one[i]));
    const double factor = std::exp(sum / static_cast<double>(periods.size()));
    return std::isfinite(factor) ? std::optional(factor) : std::nullopt;
}

}  // namespace

nlohmann::json to_json(const std::vector<records::ComponentUse>& uses, const std::vector<records::LimitScales>& scales) {
    nlohmann::json list = nlohmann::json::array();
    for (const records::ComponentUse& component : uses) {
        nlohmann::json limits = nlohmann::json::array();
        for (const records::LimitUse& use : component.uses) {
            const DisplayUnit unit = find_units(use.which).usual;
            limits.push_back({{"limit", std::string(to_string(use.which))},
                              {"unit", unit.name},
                              {"record", use.demand / unit.si},
                              {"table", use.limit / unit.si},
                              {"used", use.used()}});
            if (const auto* const ranges = find_ranges(scales, component.axis, use.which)) {
                limits.back()["scales"] = nlohmann::json::array();
                for (const scaling::LengthRange& range : *ranges) limits.back()["scales"].push_back({range.smallest, range.largest});
            }
        }
        nlohmann::json object = list_demand(component.demand, component.is_rotation);
        object["component"] = component.component;
        object["axis"] = component.axis;
        object["lowest_frequency_hz"] = component.demand.lowest_frequency.value();
        object["highest_frequency_hz"] = component.demand.highest_frequency.value();
        object["limits"] = limits;
        list.push_back(std::move(object));
    }
    return list;
}

nlohmann::json to_json(const records::ScaleRange& range) {
    return {{"smallest", range.smallest},
            {"largest", range.largest},
            {"binds_below", name_or_null(range.binds_below)},
            {"binds_above", name_or_null(range.binds_above)},
            {"axis_below", range.axis_below},
            {"axis_above", range.axis_above}};
}

nlohmann::json to_json(const records::Correction& correction, const scaling::ModelScales& scales) {
    nlohmann::json spectra = nlohmann::json::array();
    for (const records::SpectrumChange& change : correction.spectra) {
        const auto before = change.before.pseudo_acceleration(), after = change.after.pseudo_acceleration();
        nlohmann::json rows = nlohmann::json::array();
        for (std::size_t i = 0; i < before.size(); ++i) {
            const DisplayUnit unit = find_psa_unit(change);
            const std::string suffix = change.is_rotation ? "rad_s2" : "g";
            rows.push_back({{"period_s", change.before.period[i]},
                            {"prototype_period_s", change.before.period[i] / scales.time},
                            {"psa_before_" + suffix, before[i] / unit.si},
                            {"psa_after_" + suffix, after[i] / unit.si}});
        }
        spectra.push_back({{"component", change.component}, {"rows", rows}});
    }
    return {{"high_pass_hz", or_null(in_si(correction.settings.high_pass))},
            {"low_pass_hz", or_null(in_si(correction.settings.low_pass))},
            {"amplitude", correction.settings.amplitude},
            {"mean_change_of_ln_psa", correction.mean_change},
            {"largest_change_of_ln_psa", correction.largest_change},
            {"components", to_json(correction.uses)},
            {"spectra", spectra}};
}

void print_uses(const std::vector<records::ComponentUse>& uses, const std::vector<records::LimitScales>& scales) {
    print("{:<10} {:<8} {:<20} {:>10} {:>10} {:<5} {:>7}  {}\n", "component", "axis", "limit", "record", "table", "unit", "used",
          "length scales");
    for (const records::ComponentUse& component : uses) {
        for (const records::LimitUse& use : component.uses) {
            const DisplayUnit unit = find_printed_unit(use);
            const auto* const ranges = find_ranges(scales, component.axis, use.which);
            print("{:<10} {:<8} {:<20} {:>10.4g} {:>10.4g} {:<5} {:>7.3f}  {}{}\n", component.component, component.axis,
                  to_string(use.which), use.demand / unit.si, use.limit / unit.si, unit.name, use.used(),
                  ranges ? describe_ranges(*ranges) : "", use.used() > 1.0 ? "  <- too much" : "");
        }
    }
    for (const records::ComponentUse& component : uses) {
        const records::TableDemand& demand = component.demand;
        const DisplayUnit unit = find_units(component.is_rotation ? TableLimit::angle : TableLimit::displacement).usual;
        const double farthest = (component.is_rotation ? demand.turn.angle.value() : demand.displacement.value()) / unit.si;
        const double centered = (component.is_rotation ? demand.turn.half_range.value() : demand.half_range.value()) / unit.si;
        if (centered < 0.99 * farthest) {
            print("{}: started {:.3g} {} off the middle, it would need {:.4g} {} to either side instead of {:.4g}\n", component.component,
                  farthest - centered, unit.name, centered, unit.name, farthest);
        }
    }
}

void print_scales(const std::vector<records::ScaleRange>& ranges) {
    if (ranges.empty()) print("No length scale from 1/16384 to 1 fits the table with this record.\n");
    for (const records::ScaleRange& range : ranges) {
        print("Length scales from {} to {} fit; smaller ones are governed by {}, larger ones by {}.\n",
              scaling::describe_scale(range.smallest), scaling::describe_scale(range.largest),
              describe_end(range.binds_below, range.axis_below), describe_end(range.binds_above, range.axis_above));
    }
}

void print_correction(const records::Correction& correction, const scaling::ModelScales& scales) {
    const records::DriveSettings& settings = correction.settings;
    std::string what;
    const auto add = [&](const std::string& text) { what += (what.empty() ? "" : ", ") + text; };
    const auto describe = [&](const scaling::Frequency& corner) {
        return fmt::format("{:.4g} Hz ({:.4g} Hz of the prototype)", corner.value(), corner.value() / scales.frequency);
    };
    if (settings.high_pass) add("high-pass at " + describe(*settings.high_pass));
    if (settings.low_pass) add("low-pass at " + describe(*settings.low_pass));
    if (settings.amplitude != 1.0) add(fmt::format("amplitude times {:.4g}", settings.amplitude));
    print("{}: PSA changes by a factor {:.4g} on average, {:.4g} at most\n", what.empty() ? "nothing" : what,
          std::exp(correction.mean_change), std::exp(correction.largest_change));
}

void print_spectra(const records::Correction& correction, const scaling::ModelScales& scales) {
    constexpr std::size_t kRows = 10;
    std::string shown;
    for (const records::SpectrumChange& change : correction.spectra) {
        const DisplayUnit unit = find_psa_unit(change);
        if (shown != unit.name) {
            print("{:<10} {:>15} {:>11} {:>14} {:>17} {:>9}\n", "component", "T prototype [s]", "T model [s]",
                  fmt::format("PSA record [{}]", unit.name), fmt::format("PSA corrected [{}]", unit.name), "ratio [-]");
            shown = unit.name;
        }
        const auto before = change.before.pseudo_acceleration(), after = change.after.pseudo_acceleration();
        for (std::size_t row = 0; row < kRows; ++row) {
            const std::size_t i = row * (before.size() - 1) / (kRows - 1);
            const double period = change.before.period[i];
            print("{:<10} {:>15.4g} {:>11.4g} {:>14.4g} {:>17.4g} {:>9.4f}\n", change.component, period / scales.time, period,
                  before[i] / unit.si, after[i] / unit.si, after[i] / before[i]);
        }
    }
}

std::vector<DriveEffect> find_drive_effects(const records::GroundMotion& model, const records::DriveSettings& settings,
                                            std::span<const scaling::Time> periods) {
    const std::vector<records::DriveMotion> motions = records::make_drive_motions(model, settings);
    const std::vector<records::ComponentChange> changes = records::compare_drive_motions(model, settings);
    std::vector<DriveEffect> effects;
    for (std::size_t c = 0; c < motions.size(); ++c) {
        const records::TimeSeries record = records::level_uncorrected(model.components[c].series, model.integration_corner);
        effects.push_back({model.components[c].name, changes[c], find_mean_psa_factor(record, motions[c].acceleration, periods)});
    }
    return effects;
}

void print_drive_effects(const std::vector<DriveEffect>& effects) {
    print("The table's motion is that of the base in a run of the model's record, with filters and amplitude as said:\n");
    for (const DriveEffect& effect : effects) {
        std::string line = std::visit([](const auto& change) { return records::describe(change); }, effect.change);
        if (effect.mean_psa_factor) line += fmt::format("; PSA by a factor {:.4g} on average", *effect.mean_psa_factor);
        print("  {}: {}\n", effect.component, line);
    }
}

void warn_of_drive_effects(const std::string& record, const std::vector<DriveEffect>& effects) {
    for (const DriveEffect& effect : effects) {
        const std::string what = std::visit([](const auto& change) { return records::describe_changed_peaks(change); }, effect.change);
        if (!what.empty()) note("musim: warning: {}: component {}: the table {}\n", record, effect.component, what);
    }
}

nlohmann::json to_json(const std::vector<DriveEffect>& effects) {
    nlohmann::json list = nlohmann::json::array();
    for (const DriveEffect& effect : effects) {
        nlohmann::json object{{"component", effect.component}, {"mean_psa_factor", or_null(effect.mean_psa_factor)}};
        const auto add = [&](const auto& change) {
            for (const auto& [key, value] : list_peaks(change.record)) object[key] = nlohmann::json::array({value});
            for (const auto& [key, value] : list_peaks(change.base)) object[key].push_back(value);
            for (const auto& [key, value] : list_peaks(change.difference)) object["largest_difference"][key] = value;
        };
        std::visit(add, effect.change);
        list.push_back(std::move(object));
    }
    return list;
}

}  // namespace musim::cli
