#include "records/design/uses.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "records/shake_table/shake_table.hpp"
#include "scaling/angle.hpp"
#include "scaling/laws/groups.hpp"
#include "scaling/pi_quantity.hpp"

namespace musim::records {

std::string describe_amount(double value, const std::string& unit) {
    constexpr int kDigits = 4;
    // moments not in joules, frequencies not in kilohertz
    if (unit == "N m") return fmt::format("{:.{}g} kN m", value / 1e3, kDigits);
    if (unit == "Hz") return fmt::format("{:.{}g} Hz", value, kDigits);
    if (unit.starts_with("rad")) return fmt::format("{:.{}g} deg{}", value * scaling::kDegrees, kDigits, unit.substr(3));
    return scaling::format_value(value, scaling::make_pi_quantity("amount", unit), kDigits);
}

std::string name_table_limit(TableLimit limit, const std::string& axis) { return fmt::format("{} of axis {}", to_string(limit), axis); }

std::vector<LimitUse> find_axis_uses(const Prototype& prototype, const AxisLoad& load, const scaling::ModelScales& scales) {
    const TableDemand demand = to_model(load.prototype, scales, find_shaking(load.axis));
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
    for (const AxisLoad& load : setting.loads) {
        for (const LimitUse& use : find_axis_uses(setting.design.prototype, load, scales)) {
            uses.push_back({name_table_limit(use.which, load.axis.name), std::string(si_unit_name(use.which)), use.demand, use.limit,
                            use.which == TableLimit::lowest_frequency});
        }
    }
    const std::vector<Use> own = find_own_uses(setting.design, material, scales);
    uses.insert(uses.end(), own.begin(), own.end());
    return uses;
}

}  // namespace musim::records
