#include "records/design/uses.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "records/shake_table/table_axes.hpp"
#include "scaling/laws/groups.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::records {
namespace {

std::string find_unit(records::TableLimit limit) {
    switch (limit) {
        case records::TableLimit::displacement:
            return "m";
        case records::TableLimit::velocity:
            return "m/s";
        case records::TableLimit::acceleration:
            return "m/s^2";
        case records::TableLimit::force:
            return "N";
        case records::TableLimit::overturning_moment:
            return "N m";
        case records::TableLimit::payload:
            return "kg";
        case records::TableLimit::lowest_frequency:
        case records::TableLimit::highest_frequency:
        case records::TableLimit::oil_column:
        case records::TableLimit::controller_band:
            break;
    }
    return "Hz";
}

}  // namespace

std::string describe_amount(double value, const std::string& unit) {
    constexpr int kDigits = 4;
    if (unit == "m") return scaling::format_quantity(scaling::Length::from_value(value), kDigits);
    if (unit == "m/s") return scaling::format_quantity(scaling::Velocity::from_value(value), kDigits);
    if (unit == "m/s^2") return scaling::format_quantity(scaling::Acceleration::from_value(value), kDigits);
    if (unit == "N") return scaling::format_quantity(scaling::Force::from_value(value), kDigits);
    if (unit == "kg") return scaling::format_quantity(scaling::Mass::from_value(value), kDigits);
    if (unit == "N m") return fmt::format("{:.{}g} kN m", value / 1e3, kDigits);
    return fmt::format("{:.{}g}{}", value, kDigits, unit == "-" ? "" : " " + unit);
}

std::string name_table_limit(records::TableLimit limit, const std::string& axis) {
    return fmt::format("{} of axis {}", records::to_string(limit), axis);
}

std::vector<records::LimitUse> find_axis_uses(const Prototype& prototype, const records::AxisLoad& load,
                                              const scaling::ModelScales& scales) {
    const records::TableDemand demand = to_model(load.prototype, scales, find_shaking(load.axis));
    return check_axis(demand, load.axis, {scales.mass * prototype.mass, scales.height * prototype.mass_center, false});
}

std::vector<Use> find_own_uses(const Design& design, const Material& material, const scaling::ModelScales& scales) {
    const Prototype& prototype = design.prototype;
    const Limits& limits = design.limits;
    const auto& [thin, wide, high] = prototype.block;
    const scaling::Length block_height = scales.height * high, height = scales.height * prototype.height;
    std::vector<Use> uses;
    if (limits.hall_height) uses.push_back({"hall height", "m", height.value(), limits.hall_height->value()});
    if (material.smallest_edge) {
        const scaling::Length edge = std::min({scales.width * thin, scales.width * wide, block_height});
        uses.push_back({"smallest edge", "m", edge.value(), material.smallest_edge->value(), true});
    }
    if (limits.deviation_ratio && material.deviation) {
        uses.push_back({"height deviation", "-", (*material.deviation / block_height).value(), *limits.deviation_ratio});
    }
    if (limits.overlap_ratio && material.deviation && material.modulus) {
        // k_n = E_eff A/H and N m = ρ A l of the prototype, with the model's modulus and scales
        const double weight = prototype.density.value() * scaling::kStandardGravity.value() * scales.weight;
        const double overlap =
            weight * prototype.height.value() * high.value() * scales.height / (scales.width * scales.width) / material.modulus->value();
        uses.push_back({"overlap", "-", overlap / material.deviation->value(), *limits.overlap_ratio});
    }
    if (limits.camera_rate) {
        // one second of the model in sliding times of the prototype
        const double second = scaling::groups::sliding_time(scaling::Time::from_value(1.0 / scales.time), prototype.friction,
                                                            scaling::kStandardGravity, prototype.height);
        uses.push_back({"camera", "Hz", limits.pictures * second, limits.camera_rate->value()});
    }
    return uses;
}

std::vector<Use> find_uses(const Setting& setting, const Material& material, const scaling::ModelScales& scales) {
    std::vector<Use> uses;
    for (const records::AxisLoad& load : setting.loads) {
        for (const records::LimitUse& use : find_axis_uses(setting.design.prototype, load, scales)) {
            uses.push_back({name_table_limit(use.which, load.axis.name), find_unit(use.which), use.demand, use.limit,
                            use.which == records::TableLimit::lowest_frequency});
        }
    }
    const std::vector<Use> own = find_own_uses(setting.design, material, scales);
    uses.insert(uses.end(), own.begin(), own.end());
    return uses;
}

}  // namespace musim::records
