#include "records/processing/recipe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "records/error.hpp"
#include "records/json_rules.hpp"
#include "records/processing/align.hpp"
#include "records/processing/surface_rotation.hpp"
#include "scaling/detail/overloaded.hpp"

namespace musim::records {
namespace {

using detail::Json;
using scaling::JsonReader;
using scaling::detail::Overloaded;

constexpr std::string_view kRecipeSchema = "musim-recipe/1";

/// Mark before a step's own line in a history.
constexpr std::string_view kHistoryMark = "{\"step\":";

/// Names of the steps in recipes, in the order of Step.
constexpr std::string_view kStepNames[] = {
    "align",   "level",    "rest",   "differentiate", "baseline",        "taper",           "pad", "cut", "energy_window", "filter",
    "amplify", "resample", "rotate", "integrate",     "to_acceleration", "surface_rotation"};
static_assert(std::size(kStepNames) == std::variant_size_v<Step>);

/// A setting that has no default.
struct Required {
    double& value;
    std::string_view what_to_do;
};

/// A setting with two values: their names and which of them it is.
template <class Value>
struct Either {
    Value& value;
    std::array<std::string_view, 2> names;

    bool is_second() const { return static_cast<bool>(value); }
};

/// Gives a visitor the settings of a step: reading, writing and rescaling are what it does with them.
template <class Visitor>
void describe(Step& step, Visitor&& visit) {
    std::visit(Overloaded{[](auto&) {},
                          [&](step::Rest& s) {
                              visit("end", Either<bool>{s.displaced, {"home", "displaced"}});
                          },
                          [&](step::Baseline& s) { visit("order", s.order); }, [&](step::Taper& s) { visit("fraction", s.fraction); },
                          [&](step::Pad& s) { visit("before", s.before), visit("after", s.after); },
                          [&](step::Cut& s) { visit("window", s.window); },
                          [&](step::EnergyWindow& s) { visit("from", s.from), visit("to", s.to), visit("margin", s.margin); },
                          [&](step::Filter& s) {
                              visit("low", s.band.low), visit("high", s.band.high), visit("order", s.order);
                              visit("phase", Either<FilterPhase>{s.phase, {"zero", "causal"}});
                          },
                          [&](step::Amplify& s) {
                              visit("factor", Required{s.factor, "add it"});
                          },
                          [&](step::Resample& s) {
                              visit("dt", s.dt), visit("between", Either<Between>{s.between, {"band_limited", "straight"}});
                          },
                          [&](step::Rotate& s) {
                              visit("azimuth_deg", Required{s.azimuth_deg, "add degrees clockwise from north"});
                          },
                          [&](step::Integrate& s) {
                              visit("by", Either<bool>{s.by_frequency, {"trapezoid", "frequency"}});
                          },
                          [&](step::SurfaceRotation& s) {
                              visit("velocity", s.velocity), visit("vertical", s.vertical), visit("transverse", s.transverse);
                          }},
               step);
}

/// Takes settings from JSON; those that are not there stay as they are.
struct SettingReader {
    const JsonReader& fields;

    template <class Number>
    void operator()(const char* key, Number& value) {
        fields.read(key, value);
    }
    void operator()(const char* key, scaling::Time& value) { value = fields.get<scaling::Time>(key); }
    void operator()(const char* key, scaling::Velocity& value) { value = fields.get<scaling::Velocity>(key); }
    void operator()(const char* key, std::optional<scaling::Frequency>& value) { value = fields.find<scaling::Frequency>(key); }
    void operator()(const char* key, TimeWindow& value) {
        if (!fields.has(key) || !fields[key].json().is_array() || fields[key].json().size() != 2) {
            fields.fail(fmt::format("{} is no pair of times", key), "write [\"10 s\", \"40 s\"]");
        }
        value = {fields[key].part(0).quantity<scaling::Time>(), fields[key].part(1).quantity<scaling::Time>()};
    }
    void operator()(const char* key, Required setting) {
        if (!fields.has(key)) fields.fail(fmt::format("{} is missing", key), std::string(setting.what_to_do));
        setting.value = fields.get<double>(key);
    }
    template <class Value>
    void operator()(const char* key, Either<Value> setting) {
        if (!fields.has(key)) return;
        const Json& name = fields[key].json();
        if (name != setting.names[0] && name != setting.names[1]) {
            fields.fail(fmt::format("{} is neither \"{}\" nor \"{}\"", key, setting.names[0], setting.names[1]), "write one of them");
        }
        setting.value = static_cast<Value>(name == setting.names[1]);
    }
};

/// Adds settings to JSON.
struct SettingWriter {
    Json& json;

    template <class Number>
    void operator()(const char* key, const Number& value) {
        json[key] = value;
    }
    void operator()(const char* key, scaling::Time value) { json[key] = value.value(); }
    void operator()(const char* key, scaling::Velocity value) { json[key] = value.value(); }
    void operator()(const char* key, const std::string& value) {
        if (!value.empty()) json[key] = value;
    }
    void operator()(const char* key, const std::optional<scaling::Frequency>& value) {
        if (value) json[key] = value->value();
    }
    void operator()(const char* key, const TimeWindow& value) { json[key] = {value.start.value(), value.end.value()}; }
    void operator()(const char* key, Required setting) { json[key] = setting.value; }
    template <class Value>
    void operator()(const char* key, Either<Value> setting) {
        json[key] = setting.names[setting.is_second() ? 1 : 0];
    }
};

/// The step at a place of Step, as it is without settings.
template <std::size_t... I>
Step make_step(std::size_t index, std::index_sequence<I...>) {
    static const Step kSteps[] = {Step(std::in_place_index<I>)...};
    return kSteps[index];
}

Step read_step(const Json& object, const std::string& place) {
    if (!object.is_object()) throw ReadError(place + ": is no object; write {\"step\": NAME, ...}");
    if (!object.contains("step") || !object["step"].is_string()) {
        throw ReadError(place + ": has no name; add \"step\": \"filter\" or another");
    }
    const auto name = object["step"].get<std::string>();
    const detail::JsonRules rules(nullptr, detail::PlainNumbers::are_si);
    const JsonReader fields(object, rules, fmt::format("{} ({})", place, name));
    fields.has("step");
    const auto* const named = std::find(std::begin(kStepNames), std::end(kStepNames), name);
    if (named == std::end(kStepNames)) fields.fail("is no step", fmt::format("take one of {}", fmt::join(kStepNames, ", ")));
    Step step = make_step(static_cast<std::size_t>(named - std::begin(kStepNames)), std::make_index_sequence<std::size(kStepNames)>());
    describe(step, SettingReader{fields});
    const auto* const filter = std::get_if<step::Filter>(&step);
    if (filter != nullptr && !filter->band.low && !filter->band.high) fields.fail("has no corner", "add \"low\", \"high\" or both");
    const auto* const rotation = std::get_if<step::SurfaceRotation>(&step);
    if (rotation != nullptr && rotation->vertical.empty() && rotation->transverse.empty()) {
        fields.fail("names no component", "add \"vertical\", for rocking, \"transverse\", for torsion, or both");
    }
    fields.refuse_unknown_keys();
    return step;
}

Json to_json(Step step) {
    Json json{{"step", kStepNames[step.index()]}};
    describe(step, SettingWriter{json});
    return json;
}

using SeriesStep = std::function<TimeSeries(const TimeSeries&)>;

GroundMotion for_each(GroundMotion motion, const SeriesStep& change) {
    for (Component& component : motion.components) component.series = change(component.series);
    return motion;
}

GroundMotion cut_to_energy(const GroundMotion& motion, const step::EnergyWindow& s) {
    std::optional<TimeWindow> whole;
    const bool has_translation =
        std::any_of(motion.components.begin(), motion.components.end(), [](const Component& c) { return !is_rotation(c); });
    for (const Component& component : motion.components) {
        if (has_translation && is_rotation(component)) continue;
        const TimeWindow own = find_energy_window(component.series, s.from, s.to, s.margin);
        whole = whole ? TimeWindow{std::min(whole->start, own.start), std::max(whole->end, own.end)} : own;
    }
    return for_each(motion, [&](const TimeSeries& series) {
        return cut(series, {std::max(whole->start, series.start()), std::min(whole->end, series.end())});
    });
}

/// Takes off the initial level; says so where the record does not begin at rest, for then it is another.
GroundMotion level(const GroundMotion& motion) {
    GroundMotion leveled = for_each(motion, remove_initial_level);
    for (const Component& component : motion.components) {
        if (!begins_in_motion(component.series)) continue;
        leveled.history.push_back(fmt::format("{} begins in motion ({:.2g} of its rms): level took the mean of all samples", component.name,
                                              find_initial_motion(component.series)));
    }
    return leveled;
}

/// Rotations that waves along +x make, behind the components.
GroundMotion add_surface_rotation(const GroundMotion& motion, const step::SurfaceRotation& s) {
    GroundMotion turned = motion;
    const auto add = [&](const char* name, TimeSeries series) {
        const auto has_name = [&](const Component& other) { return other.name == name; };
        if (std::any_of(motion.components.begin(), motion.components.end(), has_name)) {
            throw ProcessingError(fmt::format("the record has a component {} already; leave this step out", name));
        }
        turned.components.push_back({.name = name, .azimuth_deg = std::nullopt, .series = std::move(series)});
    };
    if (!s.vertical.empty()) add("ry", find_rocking(motion.find_component(s.vertical).series, s.velocity));
    if (!s.transverse.empty()) add("rz", find_torsion(motion.find_component(s.transverse).series, s.velocity));
    return turned;
}

TimeSeries to_acceleration(const TimeSeries& series) {
    TimeSeries acceleration = series;
    while (derivative_order(acceleration.quantity()) < 2) acceleration = differentiate(acceleration);
    return acceleration;
}

GroundMotion filter(const GroundMotion& motion, const step::Filter& s) {
    GroundMotion filtered = for_each(motion, [&](const TimeSeries& series) { return apply_butterworth(series, s.band, s.order, s.phase); });
    if (s.band.low) filtered.integration_corner.reset();
    return filtered;
}

GroundMotion carry_out(const GroundMotion& motion, const Step& step) {
    return std::visit(
        Overloaded{
            [&](const step::Align&) { return align(motion); }, [&](const step::Level&) { return level(motion); },
            [&](const step::Rest& s) {
                const AtRest at_rest = s.displaced ? AtRest::displaced : AtRest::home;
                return for_each(motion, [&](const TimeSeries& series) { return bring_to_rest(series, at_rest); });
            },
            [&](const step::Differentiate&) { return for_each(motion, differentiate); },
            [&](const step::Baseline& s) {
                return for_each(motion, [&](const TimeSeries& series) { return remove_baseline(series, s.order); });
            },
            [&](const step::Taper& s) { return for_each(motion, [&](const TimeSeries& series) { return taper(series, s.fraction); }); },
            [&](const step::Pad& s) { return for_each(motion, [&](const TimeSeries& series) { return pad(series, s.before, s.after); }); },
            [&](const step::Cut& s) { return for_each(motion, [&](const TimeSeries& series) { return cut(series, s.window); }); },
            [&](const step::EnergyWindow& s) { return cut_to_energy(motion, s); }, [&](const step::Filter& s) { return filter(motion, s); },
            [&](const step::Amplify& s) { return for_each(motion, [&](const TimeSeries& series) { return amplify(series, s.factor); }); },
            [&](const step::Resample& s) {
                return for_each(motion, [&](const TimeSeries& series) { return resample(series, s.dt, s.between); });
            },
            [&](const step::Rotate& s) { return rotate(motion, s.azimuth_deg); },
            [&](const step::Integrate& s) { return for_each(motion, s.by_frequency ? integrate_by_frequency : integrate); },
            [&](const step::ToAcceleration&) { return for_each(motion, to_acceleration); },
            [&](const step::SurfaceRotation& s) { return add_surface_rotation(motion, s); }},
        step);
}

}  // namespace

Recipe parse_recipe(std::string_view json, const std::string& source) {
    const Json object = detail::parse_object(json, source, kRecipeSchema, "recipe", R"("steps": [...])");
    if (!object.contains("steps") || !object["steps"].is_array()) throw ReadError(source + ": has no list of steps; add \"steps\": [...]");
    for (const auto& [key, value] : object.items()) {
        if (key != "steps" && key != "name") {
            throw ReadError(fmt::format("{}: \"{}\" is no key of a recipe; remove it", source, key));
        }
    }
    Recipe recipe;
    for (std::size_t i = 0; i < object["steps"].size(); ++i) {
        recipe.push_back(read_step(object["steps"][i], fmt::format("{}: step {}", source, i + 1)));
    }
    return recipe;
}

std::string write_recipe(const Recipe& recipe) {
    std::string text = fmt::format("{{\n  \"schema\": \"{}\",\n  \"steps\": [", kRecipeSchema);
    for (std::size_t i = 0; i < recipe.size(); ++i) text += (i == 0 ? "\n    " : ",\n    ") + to_json(recipe[i]).dump();
    return text + (recipe.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

GroundMotion process(const GroundMotion& motion, const Recipe& recipe) {
    GroundMotion processed = motion;
    for (std::size_t i = 0; i < recipe.size(); ++i) {
        try {
            GroundMotion next = carry_out(processed, recipe[i]);
            // remarks that the step made itself come after it
            next.history.insert(next.history.begin() + static_cast<std::ptrdiff_t>(processed.history.size()), to_json(recipe[i]).dump());
            processed = std::move(next);
        } catch (const ProcessingError& error) {
            throw error.seen_from<ProcessingError>(fmt::format("step {} ({})", i + 1, kStepNames[recipe[i].index()]));
        }
    }
    return processed;
}

Recipe recipe_of(const GroundMotion& motion) {
    Recipe recipe;
    for (const std::string& line : motion.history) {
        if (!line.starts_with(kHistoryMark)) continue;
        const Json object = detail::parse_json(line, motion.source + ": a step of the history", "process the record anew");
        recipe.push_back(read_step(object, fmt::format("{}: step {} of the history", motion.source, recipe.size() + 1)));
    }
    return recipe;
}

Recipe rescale(const Recipe& recipe, const scaling::Similitude& similitude) {
    Recipe model = recipe;
    const Overloaded to_model{[](const char*, const auto&) {},
                              [&](const char*, scaling::Time& value) { value = similitude.to_model(value); },
                              [&](const char*, scaling::Velocity& value) { value = similitude.to_model(value); },
                              [&](const char*, std::optional<scaling::Frequency>& value) {
                                  if (value) value = similitude.to_model(*value);
                              },
                              [&](const char*, TimeWindow& value) {
                                  value = {similitude.to_model(value.start), similitude.to_model(value.end)};
                              }};
    for (Step& step : model) describe(step, to_model);
    return model;
}

}  // namespace musim::records
