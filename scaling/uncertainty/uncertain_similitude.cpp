#include "scaling/uncertainty/uncertain_similitude.hpp"

#include <fmt/format.h>

#include <span>
#include <string_view>
#include <utility>

#include "scaling/laws/groups.hpp"
#include "scaling/uncertainty/input_values.hpp"

namespace musim::scaling {

namespace {

using detail::add_ratio;
using detail::InputValues;
using detail::Place;
using detail::RatioPlace;
using detail::Values;

template <class Quantity>
Place add_optional(InputValues& quantities, const std::string& name, const std::optional<UncertainQuantity<Quantity>>& quantity) {
    return quantity ? Place(quantities.add(name, quantity->si(), dimension_of<Quantity>())) : std::nullopt;
}

/// The prototype's friction coefficient: given, or the denominator of the friction factor, or both as one input.
Place add_prototype_friction(InputValues& quantities, const RatioPlace& friction, const UncertainScales& scales) {
    const std::optional<Uncertain>& given = scales.friction_prototype;
    if (!given) return friction.denominator;
    if (!friction.denominator) return quantities.add("friction_prototype", *given);
    const Uncertain& denominator = *scales.friction.denominator;
    if (given->value == denominator.value && (!given->is_uncertain() || given->uncertainty == denominator.uncertainty)) {
        return friction.denominator;
    }
    throw SimilitudeError(fmt::format(
        "similitude: the prototype's friction coefficient is {:g} +/- {:g}, the denominator of the friction factor {:g} +/- {:g} "
        "(both are the prototype's); leave one out",
        given->value, given->uncertainty, denominator.value, denominator.uncertainty));
}

/// Places of everything in UncertainScales.
struct Places {
    RatioPlace length, friction, gravity, density;
    std::vector<RatioPlace> others;
    Place friction_prototype, height, pga, pgv, pgd, arias, duration, time_step;
    std::vector<std::size_t> slenderness;
};

Places add_all(InputValues& quantities, const UncertainScales& scales) {
    Places places;
    places.length = add_ratio(quantities, "length", scales.length);
    places.friction = add_ratio(quantities, "friction", scales.friction);
    places.gravity = add_ratio(quantities, "gravity", scales.gravity);
    places.density = add_ratio(quantities, "density", scales.density);
    for (const auto& [name, factor] : scales.others) places.others.push_back(add_ratio(quantities, name, factor));
    places.friction_prototype = add_prototype_friction(quantities, places.friction, scales);
    for (std::size_t i = 0; i < scales.slenderness.size(); ++i) {
        places.slenderness.push_back(quantities.add(fmt::format("slenderness_{}", i + 1), scales.slenderness[i]));
    }
    places.height = add_optional(quantities, "height", scales.height);
    places.pga = add_optional(quantities, "pga", scales.motion.pga);
    places.pgv = add_optional(quantities, "pgv", scales.motion.pgv);
    places.pgd = add_optional(quantities, "pgd", scales.motion.pgd);
    places.arias = add_optional(quantities, "arias", scales.motion.arias);
    places.duration = add_optional(quantities, "duration", scales.motion.duration);
    places.time_step = add_optional(quantities, "time_step", scales.motion.time_step);
    return places;
}

/// Which list of the report a result belongs to. Results at both scales come in pairs, the prototype's first.
enum class Section { factors, groups, shaken, structure, measures };

struct Entry {
    Section section;
    std::string_view name;
    double value = 1.0;
    Dimension dimension = {};
    Place direction = {};  ///< which slenderness
};

/// Everything that follows from one set of values.
class Results {
  public:
    Results(const Places& places, const Values& values, Shaking direction) : places_(places), values_(values), direction_(direction) {}

    void add_factors(const ModelScales& scales, const ModelProperties& properties) {
        for (const NamedFactor& factor : scales.factors()) entries_.push_back({Section::factors, factor.name, factor.value});
        for (const NamedFactor& group : group_factors(scales, properties)) entries_.push_back({Section::groups, group.name, group.value});
    }

    /// δ of the groups of sliding between motion factors `shaken` and a structure whose factors are `real`.
    void add_shaken(const ModelScales& shaken, const ModelScales& real) {
        const Length length = Length::from_value(real.width);
        const Acceleration gravity = Acceleration::from_value(real.gravity);
        const auto add = [&](std::string_view name, double value) { entries_.push_back({Section::shaken, name, value}); };
        add("mu^N", groups::mu_number(Velocity::from_value(shaken.velocity), real.friction, gravity, length));
        add("t*sqrt(mu*g/l)", groups::sliding_time(Time::from_value(shaken.time), real.friction, gravity, length));
        add("a/(mu*g)", groups::sliding_demand(Acceleration::from_value(shaken.acceleration), real.friction, gravity));
    }

    void add_structure(const ModelScales& shaken, const ModelScales& real) {
        const Acceleration gravity = kStandardGravity;
        const Acceleration gravity_model = real.gravity * kStandardGravity;
        const auto pga = at<Acceleration>(places_.pga);
        const auto pgv = at<Velocity>(places_.pgv);
        const auto height = at<Length>(places_.height);
        const auto add = [&](std::string_view name, double prototype, double model, Place direction = {}) {
            entries_.push_back({Section::structure, name, prototype, {}, direction});
            entries_.push_back({Section::structure, name, model, {}, direction});
        };
        if (direction_ == Shaking::vertical) {
            if (pga) add("a_vertical/g", *pga / gravity, shaken.acceleration_vertical * *pga / gravity_model);
            return;
        }
        for (std::size_t i = 0; i < places_.slenderness.size() && pga; ++i) {
            const double slenderness = values_[places_.slenderness[i]];
            add("a/(g*tan(alpha))", groups::rocking_demand(*pga, gravity, slenderness),
                groups::rocking_demand(shaken.acceleration * *pga, gravity_model, slenderness * real.slenderness()), i);
        }
        if (!places_.friction_prototype) return;
        const double friction = values_[*places_.friction_prototype];
        const double friction_model = friction * real.friction;
        for (std::size_t i = 0; i < places_.slenderness.size(); ++i) {
            const double slenderness = values_[places_.slenderness[i]];
            add("mu/tan(alpha)", groups::regime(friction, slenderness), groups::regime(friction_model, slenderness * real.slenderness()),
                i);
        }
        if (pga) {
            add("a/(mu*g)", groups::sliding_demand(*pga, friction, gravity),
                groups::sliding_demand(shaken.acceleration * *pga, friction_model, gravity_model));
        }
        if (pgv && height) {
            add("mu^N", groups::mu_number(*pgv, friction, gravity, *height),
                groups::mu_number(shaken.velocity * *pgv, friction_model, gravity_model, real.width * *height));
        }
    }

    void add_measures(const ModelScales& scales) {
        const ShakingScales motion = scales.shaking(direction_);
        add_measure<Acceleration>("pga", places_.pga, motion.acceleration);
        add_measure<Velocity>("pgv", places_.pgv, motion.velocity);
        add_measure<Length>("pgd", places_.pgd, motion.displacement);
        add_measure<Velocity>("arias", places_.arias, scales.arias_intensity(direction_));
        add_measure<Time>("duration", places_.duration, scales.time);
        add_measure<Time>("time_step", places_.time_step, scales.time);
    }

    const std::vector<Entry>& entries() const { return entries_; }

  private:
    template <class Quantity>
    std::optional<Quantity> at(const Place& place) const {
        return place ? std::optional(Quantity::from_value(values_[*place])) : std::nullopt;
    }

    template <class Quantity>
    void add_measure(std::string_view name, const Place& place, double factor) {
        if (!place) return;
        entries_.push_back({Section::measures, name, values_[*place], dimension_of<Quantity>(), {}});
        entries_.push_back({Section::measures, name, values_[*place] * factor, dimension_of<Quantity>(), {}});
    }

    const Places& places_;
    const Values& values_;
    Shaking direction_;
    std::vector<Entry> entries_;
};

/// "mu/tan(alpha) at 0.32" for a group of one direction.
std::string name_of(const Entry& entry, const UncertainScales& scales) {
    if (!entry.direction) return std::string(entry.name);
    return fmt::format("{} at {:.4g}", entry.name, scales.slenderness[*entry.direction].value);
}

/// The results under their names, in the lists of a report.
void sort_into(UncertainReport& report, const std::vector<Entry>& entries, const UncertainScales& scales, ResultsInOrder& results) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Entry& entry = entries[i];
        const std::string name = name_of(entry, scales);
        UncertainResult result = results.take(name);
        if (entry.section == Section::structure || entry.section == Section::measures) {
            auto& pairs = entry.section == Section::structure ? report.structure : report.measures;
            pairs.push_back({name, entry.dimension, std::move(result), results.take(name)});
            ++i;
        } else {
            (entry.section == Section::factors  ? report.factors
             : entry.section == Section::groups ? report.groups
                                                : report.shaken)
                .push_back(std::move(result));
        }
    }
}

}  // namespace

ScaleFactors UncertainScales::factors() const {
    return {.length = length.value(), .friction = friction.value(), .gravity = gravity.value(), .density = density.value()};
}

bool UncertainScales::is_uncertain() const {
    InputValues quantities;
    add_all(quantities, *this);
    return !quantities.inputs().empty();
}

UncertainReport propagate(const UncertainScales& scales, const MakeModelScales& make_scales, const ModelProperties& properties,
                          const std::optional<MonteCarloSettings>& monte_carlo) {
    const ModelScales shaken = make_scales(scales.factors(), values_of(scales.others));
    InputValues quantities;
    const Places places = add_all(quantities, scales);
    const auto find_entries = [&](std::span<const double> drawn) {
        const Values values = quantities.fill(drawn);
        const ScaleFactors factors{.length = places.length.value(values),
                                   .friction = places.friction.value(values),
                                   .gravity = places.gravity.value(values),
                                   .density = places.density.value(values)};
        std::vector<GivenFactor> others;
        for (std::size_t i = 0; i < places.others.size(); ++i) {
            others.push_back({scales.others[i].name, places.others[i].value(values)});
        }
        const ModelScales real = make_scales(factors, others);
        Results results(places, values, scales.motion.direction);
        results.add_factors(real, properties);
        results.add_shaken(shaken, real);
        results.add_structure(shaken, real);
        results.add_measures(real);
        return results.entries();
    };
    const Evaluation evaluate = [&](std::span<const double> drawn) {
        std::vector<double> values;
        for (const Entry& entry : find_entries(drawn)) values.push_back(entry.value);
        return values;
    };

    UncertainReport report;
    report.inputs = quantities.inputs();
    std::vector<double> values;
    for (const UncertainInput& input : report.inputs) values.push_back(input.quantity.value);
    const std::vector<Entry> entries = find_entries(values);
    ResultsInOrder results(report.inputs, evaluate, monte_carlo);
    report.draws = results.draws();
    sort_into(report, entries, scales, results);
    return report;
}

}  // namespace musim::scaling
