#pragma once

#include "records/design/design_law.hpp"
#include "scaling/laws/law_formulas.hpp"
#include "scaling/laws/similitude.hpp"
#include "scaling/structures/structure_properties.hpp"

namespace musim::records {

/// A law as properties ask for it: λ_μ, λ_g and λ_ρ, where it expects them λ_E, e and k_s, are theirs; λ_l is the chosen one. Throws
/// SimilitudeError, which names the law: it settles no single length, or the properties contradict it; as solve_law() does.
scaling::LawFormulas solve_for(const DesignLaw& law, const scaling::PairProperties& properties, double length);

/// The similitude of properties that give the same quantities, with values of their own. Throws SimilitudeError: the law sets a gravity
/// that the model does not stand in; as LawFormulas::choose() and make_similitude() do.
scaling::Similitude apply_law(const DesignLaw& law, const scaling::LawFormulas& formulas, const scaling::PairProperties& properties,
                              double length);

}  // namespace musim::records
