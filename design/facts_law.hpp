#pragma once

#include <optional>

#include "design/design_law.hpp"
#include "scaling/kept_numbers.hpp"
#include "scaling/scale_law.hpp"
#include "scaling/structure_facts.hpp"

namespace musim::design {

/// The similitude of facts by a law.
struct FactsLaw {
    scaling::Similitude similitude;
    scaling::KeptNumbers kept;
    std::optional<scaling::SolvedLaw> solved = {};  ///< of a law as data
};

/// λ_μ, λ_g and λ_ρ, where a law as data expects them λ_E, e and k_s, are those of the facts; λ_l is the chosen one.
/// Throws SimilitudeError, which names the law: it settles no single length, sets a gravity that the model does not stand in, or is
/// contradicted by the facts; as solve_law(), make_similitude() and Similitude do.
FactsLaw apply_law(const DesignLaw& law, const scaling::PairFacts& facts, double length);

}  // namespace musim::design
