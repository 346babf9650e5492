#pragma once

#include <optional>
#include <string>

#include "lsdem/study/pair_models.hpp"
#include "scaling/laws/scale_law.hpp"

namespace musim::lsdem {

/// Properties of a model's material over those of its prototype's [-].
struct MadeOf {
    double friction = 1.0;               ///< λ_μ
    double density = 1.0;                ///< λ_ρ of the solid
    double normal_stiffness = 1.0;       ///< of a face
    double shear_stiffness = 1.0;        ///< of a face
    std::optional<double> gravity = {};  ///< λ_g, where it is settled
};

/// Is a factor of this name a model's own, which nothing else can be given for: mu, rho, rho_s, or g?
bool is_own_factor(const std::string& name);

/// A law solved for a model of a length. What a model is made of settles the factors that the law leaves to be chosen: mu, rho (rho_s where
/// mass is added), g, E = k_n/l of its contacts, k_s; E and k_s only where they are not given otherwise. Without `made` the law's defaults
/// stand. Throws scaling::SimilitudeError as solve_law does, for a law without a length l for all directions, and for a factor given that
/// is the model's own.
scaling::SolvedLaw solve_model_law(const ChosenLaw& chosen, double length, const std::optional<MadeOf>& made);

}  // namespace musim::lsdem
