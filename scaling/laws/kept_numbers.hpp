#pragma once

#include "scaling/laws/scale_law.hpp"

namespace musim::scaling {

/// Which of the numbers that decide what a law requires are the same in every model by it, whatever its factors.
struct KeptNumbers {
    bool mu = false;      ///< v/√(μ g l)
    bool froude = false;  ///< v/√(g l)
    bool cauchy = false;  ///< v/√(E/ρ)
};

/// Those of a law, which speaks of l, of t or a, and of mu, g, rho, E as far as it has them: a number is kept where its δ is a
/// product of no chosen factor at all. A law that has not the quantities of a number does not keep it.
KeptNumbers find_kept_numbers(const SolvedLaw& solved);

}  // namespace musim::scaling
