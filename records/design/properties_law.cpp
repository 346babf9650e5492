#include "records/design/properties_law.hpp"

#include <fmt/format.h>

#include <cmath>

#include "records/design/design_law.hpp"
#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/model_scales.hpp"
#include "scaling/structures/distortion.hpp"
#include "scaling/structures/structural_speed.hpp"

namespace musim::records {
namespace {

KnownFactors find_known(const DesignLaw& law, const scaling::PairProperties& properties, double length) {
    const scaling::ScaleFactors given = make_scale_factors(properties, length);
    const scaling::StructureProperties &prototype = properties.prototype, &model = properties.model;
    return {.length = {find_length_name(law.law(), law.set()), length},
            .friction = given.friction,
            .density = given.density,
            .gravity = given.gravity,
            .properties = {{"E", scaling::find_ratio(find_structural_speeds(model).modulus, find_structural_speeds(prototype).modulus)},
                           {"e", scaling::find_ratio(model.restitution, prototype.restitution)},
                           {"k_s", scaling::find_ratio(model.shear_stiffness, prototype.shear_stiffness)}}};
}

void require_single_length(const DesignLaw& law) {
    if (law.has("l")) return;
    throw scaling::SimilitudeError(
        fmt::format("law {}: it settles no single length l (groups and motion of a real model are held against one); choose another law "
                    "(a design takes this one)",
                    law.name()));
}

/// A gravity that the law sets is where the model stands.
void require_gravity(const DesignLaw& law, double given) {
    for (const scaling::GivenFactor& factor : law.set()) {
        if (factor.name != "g" || std::abs(factor.factor / given - 1.0) <= scaling::kFactorRounding) continue;
        throw scaling::SimilitudeError(
            fmt::format("law {}: it sets g to {:.6g}, where gravity of model and prototype has the ratio {:.6g}; correct \"set\", or give "
                        "the model its \"gravity\"",
                        law.name(), factor.factor, given));
    }
}

}  // namespace

scaling::LawFormulas solve_for(const DesignLaw& law, const scaling::PairProperties& properties, double length) {
    require_single_length(law);
    return scaling::LawFormulas(solve_law(law.law(), give_factors(law, find_known(law, properties, length))));
}

scaling::Similitude apply_law(const DesignLaw& law, const scaling::LawFormulas& formulas, const scaling::PairProperties& properties,
                              double length) {
    const KnownFactors known = find_known(law, properties, length);
    require_gravity(law, *known.gravity);
    return make_similitude(formulas, formulas.choose(give_factors(law, known)));
}

}  // namespace musim::records
