#include "scaling/laws/law_similitude.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "scaling/laws/named_factors.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"

namespace musim::scaling {

Similitude make_similitude(const SolvedLaw& solved) { return make_similitude(LawFormulas(solved), solved.problem.chosen); }

Similitude make_similitude(std::string_view name, const ScaleFactors& chosen) {
    const std::optional<ScaleLaw> law = find_scale_law(name);
    if (!law) throw SimilitudeError(fmt::format("similitude: {}", no_such_law(name)));
    std::vector<GivenFactor> given;
    for (const ChosenScale& scale : kChosenScales) {
        const auto is_it = [&](const LawChoice& choice) { return choice.name == scale.quantity; };
        const bool is_expected = std::any_of(law->choices.begin(), law->choices.end(), is_it);
        const double factor = chosen.*scale.factor;
        // of what the law settles by itself, solve_law() says what contradicts
        if (is_expected || factor != 1.0) given.push_back({scale.quantity, factor});
    }
    return make_similitude(solve_law(*law, given));
}

Similitude make_similitude(const LawFormulas& formulas, const ChosenFactors& chosen) {
    const detail::NamedFactors factors(formulas, chosen);
    const auto length = factors.find<Length>("l");
    const auto time = factors.find<Time>("t");
    const auto acceleration = factors.find<Acceleration>("a");
    const auto density = factors.find<Density>("rho");
    const auto mass = factors.find<Mass>("m");
    if (!length) factors.fail("it has no length l for all directions");
    if (!time && !acceleration) factors.fail("it has neither a time t nor an acceleration a");
    if (!density && !mass) factors.fail("it has neither a density rho nor a mass m");
    const double volume = *length * *length * *length;
    if (time && acceleration) factors.require_equal(*acceleration * *time * *time, *length, "a t^2/l");
    if (density && mass) factors.require_equal(*density * volume, *mass, "m/(rho l^3)");
    const ScaleFactors scales{.length = *length,
                              .friction = factors.find<Ratio>("mu").value_or(1.0),
                              .gravity = factors.find<Acceleration>("g").value_or(1.0),
                              .density = density ? *density : *mass / volume};
    const double horizontal = acceleration ? *acceleration : *length / (*time * *time);
    const double duration = time ? *time : std::sqrt(*length / horizontal);
    const ShakingScales vertical = detail::find_vertical(factors, {*length, *length / duration, horizontal});
    return Similitude(scales, horizontal, formulas.solved().law.name, vertical.acceleration);
}

}  // namespace musim::scaling
