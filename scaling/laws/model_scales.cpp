#include "scaling/laws/model_scales.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/named_factors.hpp"
#include "scaling/setting.hpp"

namespace musim::scaling {

ModelScales::ModelScales(const Similitude& from)
    : law(from.law_name()),
      similitude(from),
      height(from.length()),
      width(from.length()),
      friction(from.friction()),
      gravity(from.gravity()),
      mass(from.mass()),
      weight(from.force_vertical()),
      static_stiffness(from.stiffness_static()),
      time(from.time()),
      frequency(from.frequency()),
      displacement(from.length()),
      velocity(from.velocity()),
      acceleration(from.acceleration()),
      displacement_vertical(from.displacement_vertical()),
      velocity_vertical(from.velocity_vertical()),
      acceleration_vertical(from.acceleration_vertical()) {}

ShakingScales ModelScales::shaking(Shaking direction) const {
    if (direction == Shaking::vertical) return {displacement_vertical, velocity_vertical, acceleration_vertical};
    return {displacement, velocity, acceleration};
}

double ModelScales::arias_intensity(Shaking direction) const {
    const double acceleration_there = shaking(direction).acceleration;
    return acceleration_there * acceleration_there * time / gravity;
}

std::vector<NamedFactor> ModelScales::factors() const {
    if (similitude) return similitude->factors();
    std::vector<NamedFactor> factors;
    for (const ModelScale& scale : kModelScales) factors.push_back({scale.name, this->*scale.factor});
    return factors;
}

ModelScales make_model_scales(const LawFormulas& formulas, const ChosenFactors& chosen) {
    const detail::NamedFactors factors(formulas, chosen);
    if (factors.find<Length>("l")) return make_similitude(formulas, chosen);
    const auto height = factors.find<Length>("H");
    const auto mass = factors.find<Mass>("m");
    ModelScales scales;
    scales.law = formulas.solved().law.name;
    scales.length_name = height ? "H" : find_length_name(formulas.solved().law, {});
    scales.height = height ? *height : factors.require<Length>(scales.length_name);
    scales.width = factors.find<Length>("b").value_or(scales.height);
    scales.friction = factors.find<Ratio>("mu").value_or(1.0);
    scales.gravity = factors.find<Acceleration>("g").value_or(1.0);
    scales.mass = mass ? *mass : factors.require<Density>("rho") * scales.width * scales.width * scales.height;
    scales.weight = scales.mass * scales.gravity;
    scales.static_stiffness = scales.weight / scales.height;
    scales.time = detail::find_time(factors);
    const ShakingScales horizontal = detail::find_horizontal(factors, scales.time);
    const ShakingScales vertical = detail::find_vertical(factors, horizontal);
    scales.displacement = horizontal.displacement;
    scales.velocity = horizontal.velocity;
    scales.acceleration = horizontal.acceleration;
    // 1/t; the root is that of a similitude to the bit
    scales.frequency = std::sqrt(scales.acceleration / scales.displacement);
    scales.displacement_vertical = vertical.displacement;
    scales.velocity_vertical = vertical.velocity;
    scales.acceleration_vertical = vertical.acceleration;
    return scales;
}

std::string find_length_name(const ScaleLaw& law, const std::vector<GivenFactor>& set) {
    const std::vector<PiQuantity> quantities = quantities_of(law);
    const auto is_named_l = [](const PiQuantity& quantity) { return quantity.name == "l"; };
    if (std::any_of(quantities.begin(), quantities.end(), is_named_l)) return "l";
    std::vector<std::string> open, settled;
    for (const LawChoice& choice : law.choices) {
        if (quantities[find_quantity(quantities, choice.name)].dimension != rational_dimension_of<Length>()) continue;
        if (std::any_of(set.begin(), set.end(), [&](const GivenFactor& given) { return given.name == choice.name; })) continue;
        (choice.fallback ? settled : open).push_back(choice.name);
    }
    const std::vector<std::string>& names = open.empty() ? settled : open;
    if (names.size() == 1) return names.front();
    if (names.empty()) {
        throw SimilitudeError(
            fmt::format("law {}: it expects no length to be chosen{} (a model's length scale is that of l, or of the one length among "
                        "\"chosen\"); {}",
                        law.name, set.empty() ? "" : " beside the factors that are set",
                        set.empty() ? "choose another law, or add a length to it" : "leave one of them out, or the length scale"));
    }
    throw SimilitudeError(fmt::format("law {}: {} are lengths to be chosen (a model's length scale is that of one alone)", law.name,
                                      fmt::join(names, " and ")),
                          Remedy{"give the factors of all others, e.g. of " + names.back() + ", each as ", Setting::factor});
}

}  // namespace musim::scaling
