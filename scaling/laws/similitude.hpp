#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scaling/dimension.hpp"
#include "scaling/error.hpp"
#include "scaling/units.hpp"

namespace musim::scaling {

/// The factors one chooses, each λ = model/prototype [-].
struct ScaleFactors {
    double length = 1.0;    ///< λ_l
    double friction = 1.0;  ///< λ_μ, ratio of the friction coefficients
    double gravity = 1.0;   ///< λ_g, above 1 in a centrifuge
    double density = 1.0;   ///< λ_ρ
};

/// One of them, as files and options call it, and the quantity of laws whose factor it is.
struct ChosenScale {
    const char* name;
    const char* quantity;
    double ScaleFactors::*factor;
};
inline constexpr ChosenScale kChosenScales[] = {{"length", "l", &ScaleFactors::length},
                                                {"friction", "mu", &ScaleFactors::friction},
                                                {"gravity", "g", &ScaleFactors::gravity},
                                                {"density", "rho", &ScaleFactors::density}};

/// A derived factor and the key it has in files.
struct NamedFactor {
    std::string_view name;
    double value = 1.0;
};

/// Scale factors of every mechanical quantity between a prototype and its model.
///
/// A law and four chosen factors give λ_l, λ_m = λ_ρ λ_l³ and λ_t = √(λ_l/λ_a); a quantity of dimension L^a M^b T^c then scales by
/// λ_l^a λ_m^b λ_t^c. Products and square roots only, so that factors that are powers of two stay exact (λ_l = 1/16: λ_t = 1/4).
///
/// Under the mu law with λ_μ ≠ 1 a type stands for its dynamic, horizontal quantity (friction and inertia, λ_a = λ_μ λ_g). What
/// weighs scales with λ_g alone and the type does not know; those factors have names of their own (..._vertical, ..._static, ...).
class Similitude {
  public:
    /// The prototype itself, by law "exact": every factor is 1.
    Similitude() : Similitude({}, 1.0, "exact") {}

    /// Similitude that a law called `law_name` makes of the chosen factors (make_similitude()): λ_a, and that of vertical shaking, by
    /// default λ_g. Throws SimilitudeError when a factor is not positive and finite, or when derived factors leave the range of doubles.
    Similitude(const ScaleFactors& chosen, double acceleration, std::string law_name, std::optional<double> acceleration_vertical = {});

    /// Whether a structure at rest has an exact image, whatever the law's name: λ_μ = 1 and λ_a = λ_g, to kFactorRounding.
    ///
    /// Weights scale by λ_g, what contacts bear by λ_a (their stiffness has the dimension λ_m λ_a/λ_l), what friction holds by λ_μ
    /// times what presses: shape apart, overlap over length, friction over weight and its limit are all that decides at rest.
    bool keeps_statics() const;

    /// True of a prototype to itself: every factor is 1.
    bool is_identity() const;

    const std::string& law_name() const { return law_name_; }
    const ScaleFactors& chosen() const { return chosen_; }

    /// λ of the dimension of `Quantity`, e.g. factor<Velocity>() = √(λ_l λ_a).
    template <QuantityWithUnit Quantity>
    double factor() const {
        return factor(dimension_of<Quantity>());
    }

    /// λ of a dimension known at run time.
    double factor(Dimension dimension) const;

    /// Prototype quantity → model quantity: multiplied by its factor.
    template <QuantityWithUnit Quantity>
    Quantity to_model(Quantity prototype) const {
        return Quantity::from_value(prototype.value() * factor<Quantity>());
    }

    /// Model quantity → prototype quantity: divided by its factor.
    template <QuantityWithUnit Quantity>
    Quantity to_prototype(Quantity model) const {
        return Quantity::from_value(model.value() / factor<Quantity>());
    }

    double length() const { return chosen_.length; }
    double friction() const { return chosen_.friction; }
    double gravity() const { return chosen_.gravity; }
    double density() const { return chosen_.density; }
    double acceleration() const { return acceleration_; }     ///< λ_a, horizontal
    double time() const { return factor<Time>(); }            ///< √(λ_l/λ_a)
    double velocity() const { return factor<Velocity>(); }    ///< √(λ_l λ_a)
    double frequency() const { return factor<Frequency>(); }  ///< √(λ_a/λ_l), also angular velocity
    double mass() const { return factor<Mass>(); }            ///< λ_ρ λ_l³
    double inertia() const { return factor<Inertia>(); }      ///< λ_ρ λ_l⁵
    double force() const { return factor<Force>(); }          ///< λ_ρ λ_l³ λ_a
    double moment() const { return factor<Moment>(); }        ///< λ_ρ λ_l⁴ λ_a
    double stress() const { return factor<Stress>(); }        ///< λ_ρ λ_l λ_a, shear
    double stiffness() const { return factor<Stiffness>(); }  ///< λ_ρ λ_l² λ_a, dynamic: vibration periods scale by λ_t
    double damping() const { return factor<Damping>(); }      ///< λ_ρ λ_l^2.5 √λ_a
    double energy() const { return factor<Energy>(); }        ///< λ_ρ λ_l⁴ λ_a, kinetic and frictional
    double power() const { return factor<Power>(); }          ///< λ_ρ λ_l^3.5 λ_a^1.5
    double momentum() const { return factor<Momentum>(); }    ///< λ_ρ λ_l^3.5 √λ_a

    /// Vertical shaking: λ_g, which keeps a_v/g and with it the share by which normal forces change; λ_a by laws that neglect gravity.
    double acceleration_vertical() const { return acceleration_vertical_; }
    /// Velocities of a vertical shaking, on the one clock of all directions: λ_v λ_a,vertical/λ_a.
    double velocity_vertical() const;
    /// Displacements of it: λ_l λ_a,vertical/λ_a.
    double displacement_vertical() const;
    /// Weights and vertical reactions: λ_ρ λ_l³ λ_g.
    double force_vertical() const;
    /// Stress under dead weight: λ_ρ λ_l λ_g.
    double stress_vertical() const;
    /// Potential energy m g h: λ_ρ λ_l⁴ λ_g.
    double energy_potential() const;
    /// Normal contact stiffness that sinks by a similar overlap under dead weight: λ_ρ λ_l² λ_g.
    double stiffness_static() const;
    /// Arias intensity π/(2g) ∫a² dt with the g of each scale: λ_a² λ_t/λ_g.
    double arias_intensity() const;

    /// Every factor above under its key in files, in a fixed order: "length", "time", "velocity", "acceleration", ...
    std::vector<NamedFactor> factors() const;

  private:
    ScaleFactors chosen_;
    std::string law_name_;
    double acceleration_;
    double acceleration_vertical_;
};

}  // namespace musim::scaling
