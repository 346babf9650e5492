#include "lsdem/scene/detail/parse_motion.hpp"

#include <fmt/format.h>

#include "lsdem/scene/detail/json_text.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"

namespace musim::lsdem::detail {
namespace {

using scaling::JsonReader;

const std::vector<std::string>& axis_names() {
    static const std::vector<std::string> kNames{"x", "y", "z"};
    return kNames;
}

RecordScale parse_record_scale(const JsonReader& value, const std::filesystem::path& origin) {
    const JsonReader object = to_object(value, "scale");
    RecordScale scale;
    object.read("law", scale.law);
    for (const scaling::ChosenScale& chosen : scaling::kChosenScales) {
        if (object.has(chosen.name)) object.read(chosen.name, scale.set[chosen.quantity]);
    }
    if (object.has("set")) {
        const JsonReader set = object["set"];
        if (!set.json().is_object()) set.fail(R"(an object of factors is wanted; write {"F_R": "1/500"})");
        for (const auto& [name, unused] : set.json().items()) {
            const JsonReader factor = set.at(name);
            if (!scale.set.emplace(name, factor.number()).second) factor.fail("the factor is given twice; give it once");
        }
    }
    if (scaling::find_scale_law(scale.law)) return scale;
    if (scale.law.find_first_of("./") == std::string::npos) object.at("law").fail(scaling::no_such_law(scale.law) + ", or a law file");
    scale.law = resolve(scale.law, origin).string();
    return scale;
}

RecordMotion parse_record(const JsonReader& object, const std::filesystem::path& origin) {
    RecordMotion motion;
    motion.file = resolve(object.get<std::string>("record"), origin);
    const JsonReader components = to_object(object["components"], "components");
    for (std::size_t axis = 0; axis < 3; ++axis) motion.components[axis] = components.find<std::string>(axis_names()[axis]);
    motion.unit = object.find<std::string>("unit");
    if (object.has("quantity")) {
        const std::vector<std::string> names{"acceleration", "velocity", "displacement"};
        motion.quantity = records::find_sample_quantity(names[to_choice(object["quantity"], names)]);
    }
    motion.dt = object.find<scaling::Time>("dt");
    if (object.has("window")) {
        const JsonReader window = object["window"];
        if (!window.json().is_array() || window.json().size() != 2) {
            window.fail("a list of two times is wanted; write [\"225 s\", \"265 s\"]");
        }
        const std::vector<JsonReader> times = window.entries();
        motion.window = {times[0].quantity<scaling::Time>(), times[1].quantity<scaling::Time>()};
    }
    motion.highpass_corner = object.find<scaling::Frequency>("highpass");
    if (object.has("scale")) motion.scale = parse_record_scale(object["scale"], origin);
    return motion;
}

Signal parse_signal_shape(const JsonReader& object, const std::string& kind) {
    if (kind == "step") return StepSignal{object.get<scaling::Velocity>("velocity")};
    if (kind == "synthetic") {
        SyntheticSignal synthetic;
        synthetic.pga = object.get<scaling::Acceleration>("pga");
        synthetic.pgv = object.get<scaling::Velocity>("pgv");
        synthetic.duration = object.get<scaling::Time>("duration");
        synthetic.dt = object.get<scaling::Time>("dt");
        object.read("seed", synthetic.seed);
        return synthetic;
    }
    const auto amplitude = object.get<scaling::Acceleration>("amplitude");
    if (kind == "half_sine") return HalfSineSignal{amplitude, object.get<scaling::Time>("duration")};
    const auto frequency = object.get<scaling::Frequency>("frequency");
    if (kind == "ricker") return RickerSignal{amplitude, frequency};
    return SineSignal{amplitude, frequency, object.get<double>("cycles")};
}

SignalMotion parse_signal(const JsonReader& value) {
    const std::string kind = read_kind(value, "signal", {"step", "sine", "half_sine", "ricker", "synthetic"});
    const JsonReader object = to_object(value, kind);
    SignalMotion motion;
    motion.signal = parse_signal_shape(object, kind);
    if (object.has("direction")) motion.axis = static_cast<int>(to_choice(object["direction"], axis_names()));
    object.read("start", motion.start);
    // a synthetic record has a time step of its own, a step needs none
    if (kind != "synthetic" && kind != "step") motion.dt = object.find<scaling::Time>("dt");
    return motion;
}

}  // namespace

SceneMotion parse_base_motion(const JsonReader& value, const std::filesystem::path& origin) {
    const Json& json = value.json();
    SceneMotion motion;
    if (!json.is_object() || json.contains("record") == json.contains("signal")) {
        value.fail("an object with either a \"record\" or a \"signal\" is wanted; add one of them, or leave base_motion out");
    }
    if (json.contains("record")) {
        motion.source = parse_record(to_object(value, "record"), origin);
    } else {
        motion.source = parse_signal(value);
    }
    if (json.contains("factors")) {
        const JsonReader factors = to_object(value.at("factors"), "factors");
        factors.read("time", motion.factors.time);
        factors.read("velocity", motion.factors.velocity);
        motion.factors.velocity_vertical = motion.factors.velocity;
        factors.read("velocity_vertical", motion.factors.velocity_vertical);
    }
    return motion;
}

namespace {

MotionEntry parse_motion(const JsonReader& value, const std::filesystem::path& origin) {
    const JsonReader object = to_object(value, "motion");
    MotionEntry entry;
    object.read("name", entry.name);
    entry.base_motion = parse_base_motion(object["base_motion"], origin);
    entry.duration = object.find<scaling::Time>("duration");
    object.read("settle", entry.settle);
    object.read("repeat", entry.repeat);
    return entry;
}

}  // namespace

std::vector<MotionEntry> parse_motions(const JsonReader& list, const std::filesystem::path& origin) {
    if (!list.json().is_array() || list.json().empty()) {
        list.fail("a list [ ... ] of motions is wanted; write at least one, or \"base_motion\" instead");
    }
    std::vector<MotionEntry> motions;
    for (const JsonReader& entry : list.entries()) motions.push_back(parse_motion(entry, origin));
    return motions;
}

}  // namespace musim::lsdem::detail
