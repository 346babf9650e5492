#include "records/recipe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "records/align.hpp"
#include "records/detail/json_fields.hpp"
#include "scaling/detail/overloaded.hpp"

namespace musim::records {
namespace {

using detail::JsonFields;
using scaling::detail::Overloaded;
using Json = nlohmann::ordered_json;

constexpr std::string_view kSchema = "musim-recipe/1";

/// What comes before a step's own line in a history.
constexpr std::string_view kHistoryMark = "{\"step\":";

Step read_filter(JsonFields& reader) {
    step::Filter filter;
    filter.band = {reader.optional_quantity<scaling::Frequency>("low"), reader.optional_quantity<scaling::Frequency>("high")};
    if (!filter.band.low && !filter.band.high) reader.fail("has no corner", "add \"low\", \"high\" or both");
    filter.order = reader.integer("order", filter.order);
    filter.phase = reader.is_second("phase", "zero", "causal") ? FilterPhase::causal : FilterPhase::zero;
    return filter;
}

Step read_resample(JsonFields& reader) {
    step::Resample resample{.dt = reader.quantity<scaling::Time>("dt")};
    resample.between = reader.is_second("between", "band_limited", "straight") ? Between::straight : Between::band_limited;
    return resample;
}

Step read_amplify(JsonFields& reader) {
    if (!reader.has("factor")) reader.fail("factor is missing", "add it");
    return step::Amplify{reader.number("factor", 1.0)};
}

Step read_energy_window(JsonFields& reader) {
    const step::EnergyWindow standard;
    return step::EnergyWindow{reader.number("from", standard.from), reader.number("to", standard.to),
                              reader.number("margin", standard.margin)};
}

Step read_rotate(JsonFields& reader) {
    if (!reader.has("azimuth_deg")) reader.fail("azimuth_deg is missing", "add degrees clockwise from north");
    return step::Rotate{reader.number("azimuth_deg", 0.0)};
}

/// A step by its name in a recipe.
struct Named {
    std::string_view name;
    Step (*read)(JsonFields&);
};

constexpr Named kSteps[] = {
    {"align", [](JsonFields&) -> Step { return step::Align{}; }},
    {"level", [](JsonFields&) -> Step { return step::Level{}; }},
    {"rest", [](JsonFields&) -> Step { return step::Rest{}; }},
    {"differentiate", [](JsonFields&) -> Step { return step::Differentiate{}; }},
    {"baseline", [](JsonFields& reader) -> Step { return step::Baseline{reader.integer("order", step::Baseline{}.order)}; }},
    {"taper", [](JsonFields& reader) -> Step { return step::Taper{reader.number("fraction", step::Taper{}.fraction)}; }},
    {"pad",
     [](JsonFields& reader) -> Step {
         return step::Pad{reader.quantity<scaling::Time>("before"), reader.quantity<scaling::Time>("after")};
     }},
    {"cut", [](JsonFields& reader) -> Step { return step::Cut{reader.window("window")}; }},
    {"energy_window", read_energy_window},
    {"filter", read_filter},
    {"amplify", read_amplify},
    {"resample", read_resample},
    {"rotate", read_rotate},
    {"integrate", [](JsonFields& reader) -> Step { return step::Integrate{reader.is_second("by", "trapezoid", "frequency")}; }},
};

std::string list_names() {
    std::string names;
    for (const Named& named : kSteps) names += (names.empty() ? "" : ", ") + std::string(named.name);
    return names;
}

Step read_step(const Json& object, const std::string& place) {
    if (!object.is_object()) throw ReadError(place + ": is no object; write {\"step\": NAME, ...}");
    if (!object.contains("step") || !object["step"].is_string()) {
        throw ReadError(place + ": has no name; add \"step\": \"filter\" or another");
    }
    const auto name = object["step"].get<std::string>();
    JsonFields reader(object, fmt::format("{} ({})", place, name), nullptr, detail::PlainNumbers::are_si);
    reader.has("step");
    const auto* const named = std::find_if(std::begin(kSteps), std::end(kSteps), [&](const Named& n) { return n.name == name; });
    if (named == std::end(kSteps)) reader.fail("is no step", "take one of " + list_names());
    Step step = named->read(reader);
    reader.refuse_unknown_keys();
    return step;
}

Json to_json(const Step& step) {
    return std::visit(Overloaded{[](const step::Align&) {
                                     return Json{{"step", "align"}};
                                 },
                                 [](const step::Level&) {
                                     return Json{{"step", "level"}};
                                 },
                                 [](const step::Rest&) {
                                     return Json{{"step", "rest"}};
                                 },
                                 [](const step::Differentiate&) {
                                     return Json{{"step", "differentiate"}};
                                 },
                                 [](const step::Baseline& s) {
                                     return Json{{"step", "baseline"}, {"order", s.order}};
                                 },
                                 [](const step::Taper& s) {
                                     return Json{{"step", "taper"}, {"fraction", s.fraction}};
                                 },
                                 [](const step::Pad& s) {
                                     return Json{{"step", "pad"}, {"before", s.before.value()}, {"after", s.after.value()}};
                                 },
                                 [](const step::Cut& s) {
                                     return Json{{"step", "cut"}, {"window", {s.window.start.value(), s.window.end.value()}}};
                                 },
                                 [](const step::EnergyWindow& s) {
                                     return Json{{"step", "energy_window"}, {"from", s.from}, {"to", s.to}, {"margin", s.margin}};
                                 },
                                 [](const step::Filter& s) {
                                     Json json{{"step", "filter"}};
                                     if (s.band.low) json["low"] = s.band.low->value();
                                     if (s.band.high) json["high"] = s.band.high->value();
                                     json["order"] = s.order;
                                     json["phase"] = s.phase == FilterPhase::zero ? "zero" : "causal";
                                     return json;
                                 },
                                 [](const step::Amplify& s) {
                                     return Json{{"step", "amplify"}, {"factor", s.factor}};
                                 },
                                 [](const step::Resample& s) {
                                     return Json{{"step", "resample"},
                                                 {"dt", s.dt.value()},
                                                 {"between", s.between == Between::straight ? "straight" : "band_limited"}};
                                 },
                                 [](const step::Rotate& s) {
                                     return Json{{"step", "rotate"}, {"azimuth_deg", s.azimuth_deg}};
                                 },
                                 [](const step::Integrate& s) {
                                     return Json{{"step", "integrate"}, {"by", s.by_frequency ? "frequency" : "trapezoid"}};
                                 }},
                      step);
}

using SeriesStep = std::function<TimeSeries(const TimeSeries&)>;

GroundMotion for_each(GroundMotion motion, const SeriesStep& change) {
    for (Component& component : motion.components) component.series = change(component.series);
    return motion;
}

GroundMotion cut_to_energy(const GroundMotion& motion, const step::EnergyWindow& s) {
    std::optional<TimeWindow> whole;
    for (const Component& component : motion.components) {
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

GroundMotion filter(const GroundMotion& motion, const step::Filter& s) {
    GroundMotion filtered = for_each(motion, [&](const TimeSeries& series) { return apply_butterworth(series, s.band, s.order, s.phase); });
    if (s.band.low) filtered.integration_corner.reset();
    return filtered;
}

GroundMotion carry_out(const GroundMotion& motion, const Step& step) {
    return std::visit(
        Overloaded{
            [&](const step::Align&) { return align(motion); }, [&](const step::Level&) { return level(motion); },
            [&](const step::Rest&) { return for_each(motion, bring_to_rest); },
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
            [&](const step::Integrate& s) { return for_each(motion, s.by_frequency ? integrate_by_frequency : integrate); }},
        step);
}

std::string name_of(const Step& step) { return to_json(step)["step"].get<std::string>(); }

}  // namespace

Recipe parse_recipe(std::string_view json, const std::string& source) {
    const Json object = detail::parse_json(json, source, R"(write {"schema": "musim-recipe/1", "steps": [...]})");
    if (!object.is_object() || !object.contains("schema") || object["schema"] != kSchema) {
        throw ReadError(fmt::format("{}: is no recipe; add \"schema\": \"{}\"", source, kSchema));
    }
    if (!object.contains("steps") || !object["steps"].is_array()) throw ReadError(source + ": has no list of steps; add \"steps\": [...]");
    for (const auto& [key, value] : object.items()) {
        if (key != "schema" && key != "steps" && key != "name") {
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
    std::string text = fmt::format("{{\n  \"schema\": \"{}\",\n  \"steps\": [", kSchema);
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
            throw ProcessingError(fmt::format("step {} ({}): {}", i + 1, name_of(recipe[i]), error.what()));
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
    for (Step& step : model) {
        std::visit(Overloaded{[](auto&) {},
                              [&](step::Pad& s) {
                                  s = {similitude.to_model(s.before), similitude.to_model(s.after)};
                              },
                              [&](step::Cut& s) {
                                  s.window = {similitude.to_model(s.window.start), similitude.to_model(s.window.end)};
                              },
                              [&](step::Resample& s) { s.dt = similitude.to_model(s.dt); },
                              [&](step::Filter& s) {
                                  if (s.band.low) s.band.low = similitude.to_model(*s.band.low);
                                  if (s.band.high) s.band.high = similitude.to_model(*s.band.high);
                              }},
                   step);
    }
    return model;
}

}  // namespace musim::records
