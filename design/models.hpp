#pragma once

#include <optional>
#include <vector>

#include "design/design.hpp"
#include "scaling/distortion.hpp"
#include "scaling/law_formulas.hpp"

namespace musim::design {

/// The models of one material by one law, at any length scale.
///
/// A law as data gets what a design knows, under the names of scaling/laws: the length as l, or else as the height H; μ; the material's
/// density as rho_s where the law has one, else as rho; g where the design tells it; and where the law expects them to be chosen and both
/// materials tell them the modulus E, the restitution e and the stiffness of a face k_s (E_shear A/H, hence ∝ λ_l). A factor that the law
/// sets goes before E, e, k_s, g.
class Models {
  public:
    /// Throws SimilitudeError: the law does not admit the material, needs another factor (MissingFactor), or has not the quantities that
    /// make_model_scales() asks for.
    Models(const Design& design, const Material& material, const DesignLaw& law);

    const Material& material() const { return material_; }
    const DesignLaw& law() const { return law_; }

    /// Throws SimilitudeError as solve_law() and Similitude do.
    scaling::ModelScales at(double length) const;

    /// δ of the products that a law as data holds or watches, definitions apart, by the properties that the material really has; those that
    /// need one that is not told are left out. Empty for a plain law.
    std::vector<scaling::NamedFactor> own_groups(double length) const;

    /// What the model has beside its scales.
    scaling::ModelFacts facts(const scaling::ModelScales& scales) const;

    /// λ of the mass of the blocks, without any that is added.
    double solid_mass(const scaling::ModelScales& scales) const;

  private:
    /// A property of the model that the material has, whatever the law asks for.
    struct Property {
        std::string name;
        std::optional<double> factor;  ///< none where prototype or material do not tell it
    };
    std::vector<scaling::GivenFactor> give(double length) const;
    std::vector<Property> properties(double length) const;
    bool is_set(const std::string& name) const;
    bool expects(const std::string& name) const;
    bool has(const std::string& name) const;

    Prototype prototype_;
    std::optional<double> gravity_;
    Material material_;
    DesignLaw law_;
    std::optional<scaling::LawFormulas> formulas_;  ///< of a law as data
};

}  // namespace musim::design
