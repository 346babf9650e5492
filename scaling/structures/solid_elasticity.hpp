#pragma once

#include "scaling/laws/model_scales.hpp"

namespace musim::scaling {

/// E/(ρ g l) of a model made of the prototype's solid, E unchanged, over the prototype's: 1/(λ_m λ_g/λ_l²), the weight stays in the widths'
/// area. Elastic strains and elastic waves keep their share only where it is 1, which E scaled by its inverse gives.
inline double find_solid_elasticity(const ModelScales& scales) { return scales.width * scales.width / scales.weight; }

}  // namespace musim::scaling
