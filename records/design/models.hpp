#pragma once

#include <optional>
#include <string>
#include <vector>

#include "records/design/design.hpp"
#include "records/design/design_law.hpp"
#include "scaling/laws/law_formulas.hpp"
#include "scaling/structures/distortion.hpp"

namespace musim::records {

/// The models of one material by one law, at any length scale.
///
/// The law gets what a design knows as give_factors() has it: g where the design gives it, and E, e and the stiffness of a face
/// k_s = E_shear A/H, hence ∝ λ_l, where both materials give them.
class Models {
  public:
    /// Throws SimilitudeError: the law does not admit the material, needs another factor (MissingFactor), or has not the quantities that
    /// make_model_scales() asks for.
    Models(const Design& design, const Material& material, const DesignLaw& law);

    /// The same by the formulas of a design that gives the same properties, as samples of one do: solved once.
    Models(const Design& design, const Material& material, const DesignLaw& law, scaling::LawFormulas formulas);

    const scaling::LawFormulas& formulas() const { return formulas_; }
    const Material& material() const { return material_; }
    const DesignLaw& law() const { return law_; }

    /// Throws SimilitudeError as solve_law() and Similitude do.
    scaling::ModelScales at(double length) const;

    /// δ of the products that the law holds or watches, definitions apart, by the properties that the material really has; those that
    /// need one that is not given are left out.
    std::vector<scaling::NamedFactor> own_groups(double length) const;

    /// Properties of the model beside its scales.
    scaling::ModelProperties properties(const scaling::ModelScales& scales) const;

    /// λ of the mass of the blocks, without any that is added.
    double solid_mass(const scaling::ModelScales& scales) const;

  private:
    std::vector<scaling::GivenFactor> give(double length) const;
    std::vector<KnownProperty> properties(double length) const;

    Prototype prototype_;
    std::optional<double> gravity_;
    Material material_;
    DesignLaw law_;
    std::string length_name_;  ///< of the quantity that a length scale is given to
    scaling::LawFormulas formulas_;
};

}  // namespace musim::records
