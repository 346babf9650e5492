#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lsdem/study/tilt.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/units.hpp"

/// Results of a tilted structure as JSON and for people.
namespace musim::lsdem {
namespace {

using nlohmann::json;
using scaling::kDegrees;

json to_json(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

json degrees_or_null(const std::optional<double>& angle) { return angle ? json(*angle * kDegrees) : json(); }

json list_tries(const std::vector<TiltTry>& tries, const BlockTable& blocks) {
    json list = json::array();
    for (const TiltTry& tried : tries) {
        list.push_back({{"from_deg", tried.from * kDegrees},
                        {"angle_deg", tried.angle * kDegrees},
                        {"stands", tried.stands},
                        {"speed_over_sqrt_gh", tried.fallen ? json() : json(tried.speed)},
                        {"fallen", tried.fallen ? json(blocks.label(*tried.fallen)) : json()}});
    }
    return list;
}

json list_joints(const Mechanism& mechanism, const BlockTable& blocks) {
    json list = json::array();
    for (const JointMotion& joint : mechanism.joints) {
        list.push_back({{"block", blocks.label(joint.block)},
                        {"on", joint.other ? blocks.label(*joint.other) : "ground"},
                        {"event", to_string(joint.event)},
                        {"opening_m", joint.opening},
                        {"least_opening_m", joint.least_opening},
                        {"slip_m", joint.slip}});
    }
    return list;
}

/// "y", "-x", or "the axis 30 degrees from x".
std::string name_axis(const Vector3& axis) {
    for (const int i : {0, 1}) {
        if (std::abs(axis[i]) == 1.0) return fmt::format("{}{}", axis[i] < 0.0 ? "-" : "", "xy"[i]);
    }
    return fmt::format("the axis {:g} degrees from x", std::atan2(axis.y(), axis.x()) * kDegrees);
}

}  // namespace

json to_json(const TiltCollapse& result) {
    json object{{"axis", to_json(result.axis)},
                {"downhill", to_json(result.downhill())},
                {"collapses", result.high.has_value()},
                {"angle_deg", result.high ? json(result.angle() * kDegrees) : json()},
                {"error_deg", result.high ? json(result.error() * kDegrees) : json()},
                {"stands_at_deg", result.low * kDegrees},
                {"falls_at_deg", degrees_or_null(result.high)},
                {"rate_excess_deg", result.rate_excess * kDegrees},
                {"statics_deg", degrees_or_null(result.statics)},
                {"height_m", result.height},
                {"unit_time_s", result.unit_time},
                {"time_step_s", result.time_step},
                {"steps", result.steps},
                {"tries", list_tries(result.tries, result.blocks)},
                {"mechanism", json()}};
    if (!result.fall) return object;
    json& mechanism = object["mechanism"] = {{"sentence", result.fall->sentence}, {"time_s", result.fall->time}};
    if (!result.fall->mechanism) return object;
    mechanism["bodies"] = result.fall->mechanism->bodies;
    mechanism["body_of_block"] = result.fall->mechanism->body;
    mechanism["joints"] = list_joints(*result.fall->mechanism, result.blocks);
    return object;
}

std::vector<std::string> describe(const TiltCollapse& result) {
    std::vector<std::string> lines;
    const std::string about = name_axis(result.axis);
    if (result.high) {
        lines.push_back(fmt::format("collapses when tilted about {} to {:.4g} +- {:.2g} degrees, tan {:.4f}", about,
                                    result.angle() * kDegrees, result.error() * kDegrees, std::tan(result.angle())));
        lines.push_back(fmt::format("stands at {:.5g}, falls at {:.5g} degrees; by at most {:.2g} earlier than if tilted infinitely slowly",
                                    result.low * kDegrees, *result.high * kDegrees, result.rate_excess * kDegrees));
    } else {
        lines.push_back(fmt::format("stands up to {:.4g} degrees about {}, the largest angle", result.low * kDegrees, about));
    }
    if (result.fall && !result.fall->sentence.empty()) lines.push_back("mechanism: " + result.fall->sentence);
    if (result.fall && !result.fall->mechanism) lines.emplace_back("mechanism: not named, since some blocks are round");
    if (result.statics) {
        lines.push_back(fmt::format("rigid statics: {:.4g} degrees, of blocks that slide an upper bound", *result.statics * kDegrees));
    }
    lines.push_back(fmt::format("{} angles tried, {} steps of {}", result.tries.size(), result.steps,
                                scaling::format_quantity(scaling::Time::from_value(result.time_step), 3)));
    return lines;
}

}  // namespace musim::lsdem
