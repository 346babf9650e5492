#include "records/design/models.hpp"

#include <cmath>
#include <utility>

#include "scaling/structures/structure_properties.hpp"

namespace musim::records {
namespace {

std::optional<double> times(const std::optional<double>& ratio, double factor) {
    return ratio ? std::optional(*ratio * factor) : std::nullopt;
}

}  // namespace

Models::Models(const Design& design, const Material& material, const DesignLaw& law)
    : prototype_(design.prototype),
      gravity_(design.gravity),
      material_(material),
      law_(law),
      length_name_(find_length_name(law.law(), law.set())),
      // any length will do for the formulas
      formulas_(solve_law(law.law(), give(design.length.value_or(1.0)))) {
    at(design.length.value_or(1.0));
}

Models::Models(const Design& design, const Material& material, const DesignLaw& law, scaling::LawFormulas formulas)
    : prototype_(design.prototype),
      gravity_(design.gravity),
      material_(material),
      law_(law),
      length_name_(find_length_name(law.law(), law.set())),
      formulas_(std::move(formulas)) {
    at(design.length.value_or(1.0));
}

std::vector<KnownProperty> Models::properties(double length) const {
    return {{"E", scaling::find_ratio(material_.modulus, prototype_.modulus)},
            {"e", scaling::find_ratio(material_.restitution, prototype_.restitution)},
            {"k_s", times(scaling::find_ratio(material_.shear_modulus, prototype_.shear_modulus), length)}};
}

std::vector<scaling::GivenFactor> Models::give(double length) const {
    return give_factors(law_, {.length = {length_name_, length},
                               .friction = material_.friction / prototype_.friction,
                               .density = (material_.density / prototype_.density).value(),
                               .gravity = gravity_,
                               .properties = properties(length)});
}

scaling::ModelScales Models::at(double length) const { return make_model_scales(formulas_, formulas_.choose(give(length))); }

std::vector<scaling::NamedFactor> Models::own_groups(double length) const {
    std::vector<scaling::NamedFactor> groups;
    const scaling::ChosenFactors chosen = formulas_.choose(give(length));
    const scaling::ScaleProblem& problem = formulas_.solved().problem;
    const auto add = [&](const scaling::ScaleProduct& product, std::optional<double> delta, const std::string& text) {
        for (const KnownProperty& property : properties(length)) {
            if (!law_.has(property.name) || law_.sets(property.name)) continue;
            const std::size_t j = find_quantity(problem.quantities, property.name);
            const scaling::Rational& exponent = product.exponents[j];
            if (exponent == 0) continue;
            // what the material has in place of what the law asks for
            const auto asked = formulas_.factor(j, chosen);
            const double power = static_cast<double>(exponent.numerator()) / static_cast<double>(exponent.denominator());
            delta = delta && asked && property.factor ? std::optional(*delta * std::pow(*property.factor / *asked, power)) : std::nullopt;
        }
        if (delta) groups.push_back({text, *delta});
    };
    // the law's own texts outlast this object
    std::size_t held = problem.held.size() - law_.law().held.size();
    for (const std::string& text : law_.law().held) {
        add(problem.held[held], formulas_.held(held, chosen), text);
        ++held;
    }
    for (std::size_t i = 0; i < problem.watched.size(); ++i) {
        add(problem.watched[i], formulas_.watched(i, chosen), law_.law().watched[i]);
    }
    return groups;
}

scaling::ModelProperties Models::properties(const scaling::ModelScales& scales) const {
    const auto& [thin, wide, height] = prototype_.block;
    // a face stiffness is E_eff A/H
    const double face = scales.width * (scales.width / scales.height);
    const std::optional<double> deviation = scaling::find_ratio(material_.deviation, prototype_.deviation);
    return {.friction_prototype = prototype_.friction,
            .slenderness = {(thin / height).value(), (wide / height).value()},
            .normal_stiffness = times(scaling::find_ratio(material_.modulus, prototype_.modulus), face),
            .shear_stiffness = times(scaling::find_ratio(material_.shear_modulus, prototype_.shear_modulus), face),
            .restitution = scaling::find_ratio(material_.restitution, prototype_.restitution),
            .height_deviation = deviation};
}

double Models::solid_mass(const scaling::ModelScales& scales) const {
    return (material_.density / prototype_.density).value() * scales.width * scales.width * scales.height;
}

}  // namespace musim::records
