#pragma once

#include <optional>

#include "lsdem/study/pair_models.hpp"

namespace musim::lsdem {

/// A scene of its own as a model. One of the prototype's structure is compared as it is, unless it is to be judged as an own model or a law
/// is given: see make_scaled. Any other has its own scale: it runs as long as the prototype does, and is sampled at the same dimensionless
/// times.
///
/// Its similitude has the lengths, friction, density and gravity of the first block over the prototype's. λ_a is that of `law`, if given;
/// else λ_l/λ_t² of the motions of both bases (measure_base_shaking), a step's λ_v²/λ_l; where neither base moves λ_g; else, where the
/// bases move differently, that of the mu law. Throws SceneError for a list of motions; as make_base_components and solve_model_law do.
ScaledScene take_as_model(const Scene& prototype, const Scene& model, std::optional<Materials> materials,
                          const std::optional<ChosenLaw>& law);

}  // namespace musim::lsdem
