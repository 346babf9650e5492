#pragma once

#include <string_view>

#include "scaling/laws/law_formulas.hpp"
#include "scaling/laws/similitude.hpp"

namespace musim::scaling {

/// The similitude of a law that settles length, time and mass by quantities of these names: l; a, or else t; rho, or else m; mu and g,
/// which are 1 in a law that does not have them. λ_a is the law's own; a vertical shaking goes by a_v, or else v_v or u_v, without any as a
/// horizontal one. Throws SimilitudeError: a quantity is missing, of another dimension
/// or open, or the law does not keep a t²/l and m/(ρ l³).
Similitude make_similitude(const SolvedLaw& solved);

/// The similitude of a law that comes with musim (scaling/laws/), by its name: its l, μ, g and ρ as chosen, its other choices at their
/// defaults. Throws SimilitudeError as solve_law() does, and for a name that is unknown.
Similitude make_similitude(std::string_view law, const ScaleFactors& chosen);

/// The similitude of a law solved once, with the factors chosen of it.
Similitude make_similitude(const LawFormulas& formulas, const ChosenFactors& chosen);

}  // namespace musim::scaling
