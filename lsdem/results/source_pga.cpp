#include "lsdem/results/source_pga.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>

#include "lsdem/base_motion.hpp"
#include "scaling/units.hpp"

namespace musim::lsdem {
namespace {

std::string in_gravities(double acceleration) { return fmt::format("{:.4g} g", acceleration / scaling::kStandardGravity.value()); }

const char* name_source(const SourcePga& source) { return source.is_record ? "record" : "scene"; }
const char* describe_source(const SourcePga& source) { return source.is_record ? "record at this scale" : "scene"; }

}  // namespace

bool SourcePga::differs_from(double base) const { return acceleration > 0.0 && in_gravities(acceleration) != in_gravities(base); }

std::array<SourcePga, 3> find_source_pga(const std::array<BaseComponent, 3>& motion, double end) {
    const lsdem::BaseMotion base(motion);
    const Vector3 until_end = base.peak_acceleration(end);
    const Vector3 whole = base.peak_acceleration(std::numeric_limits<double>::infinity());
    std::array<SourcePga, 3> sources;
    for (std::size_t axis = 0; axis < sources.size(); ++axis) {
        const MotionSource& from = motion[axis].source;
        const auto a = static_cast<int>(axis);
        const char* why = until_end[a] < whole[a] ? "the run ends before its peak"
                          : from.is_processed     ? "cut, filtered or brought to rest for the base"
                                                  : "velocity linear between samples";
        sources[axis] = {.acceleration = from.peak_acceleration, .is_record = from.is_record, .why = why};
    }
    return sources;
}

std::string describe_pga(double base, const SourcePga& source) {
    if (!source.differs_from(base)) return "PGA " + in_gravities(base);
    return fmt::format("PGA {} at the base ({} in the {}: {})", in_gravities(base), in_gravities(source.acceleration),
                       describe_source(source), source.why);
}

nlohmann::json to_json(const std::array<SourcePga, 3>& sources) {
    nlohmann::json list = nlohmann::json::array();
    for (const SourcePga& source : sources) {
        if (source.acceleration > 0.0) {
            list.push_back(
                {{"of", name_source(source)}, {"pga_g", source.acceleration / scaling::kStandardGravity.value()}, {"why", source.why}});
        } else {
            list.push_back(nullptr);
        }
    }
    return list;
}

std::array<SourcePga, 3> parse_source_pga(const nlohmann::json& json) {
    std::array<SourcePga, 3> sources;
    for (std::size_t axis = 0; axis < sources.size(); ++axis) {
        const nlohmann::json& one = json.at(axis);
        if (one.is_null()) continue;
        sources[axis] = {.acceleration = one.at("pga_g").get<double>() * scaling::kStandardGravity.value(),
                         .is_record = one.at("of") == "record",
                         .why = one.at("why").get<std::string>()};
    }
    return sources;
}

}  // namespace musim::lsdem
