#pragma once

#include "scaling/laws/model_scales.hpp"
#include "scaling/laws/named_factors.hpp"

namespace musim::scaling::detail {

/// λ of the time t of a law, or else √(λ_u/λ_a). Throws SimilitudeError when the law has neither.
double find_time(const NamedFactors& factors);

/// λ of a horizontal shaking: of u, v and a where the law has them, of others by the time. Throws SimilitudeError when it has none of the
/// three, or when those that it has do not belong to one time.
ShakingScales find_horizontal(const NamedFactors& factors, double time);

/// λ of a vertical shaking: of u_v, v_v and a_v where the law has them, of others as far from the horizontal ones as these are; those of
/// the horizontal where it has none. Throws SimilitudeError when they differ from the horizontal ones by more than one factor.
ShakingScales find_vertical(const NamedFactors& factors, const ShakingScales& horizontal);

}  // namespace musim::scaling::detail
