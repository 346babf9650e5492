#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scaling/laws/law_formulas.hpp"
#include "scaling/laws/similitude.hpp"

namespace musim::scaling {

/// Which way the ground shakes.
enum class Shaking { horizontal, vertical };

/// λ of a shaking in one direction.
struct ShakingScales {
    double displacement = 1.0, velocity = 1.0, acceleration = 1.0;
};

/// Scale factors of a model that is made and shaken, whose heights and widths may scale apart.
struct ModelScales {
    std::string law;
    std::string length_name = "l";         ///< of the length that is chosen; its λ is `height`
    std::optional<Similitude> similitude;  ///< what these are of, where one length scales all
    double height = 1.0;                   ///< λ of heights
    double width = 1.0;                    ///< λ of horizontal sizes
    double friction = 1.0, gravity = 1.0;
    double mass = 1.0;              ///< with mass that is added
    double weight = 1.0;            ///< λ_m λ_g
    double static_stiffness = 1.0;  ///< of contacts that sink by a similar share of the height under dead weight: λ_m λ_g/λ_H
    double time = 1.0, frequency = 1.0;
    double displacement = 1.0, velocity = 1.0, acceleration = 1.0;                             ///< horizontal
    double displacement_vertical = 1.0, velocity_vertical = 1.0, acceleration_vertical = 1.0;  ///< of a vertical shaking

    ModelScales() = default;

    /// A similitude has one length.
    ModelScales(const Similitude& from);  // NOLINT(google-explicit-constructor): nothing is lost

    /// λ of displacements, velocities and accelerations of a shaking. All directions share the time.
    ShakingScales shaking(Shaking direction) const;

    /// λ of angular velocities and angular accelerations of any rotation: 1/λ_t and 1/λ_t²; angles keep their size in every law.
    double angular_velocity() const { return frequency; }
    double angular_acceleration() const { return frequency * frequency; }

    /// λ of Arias intensities π/(2g) ∫a² dt with the g of each scale: λ_a² λ_t/λ_g.
    double arias_intensity(Shaking direction) const;

    /// Those of the similitude, or else of kModelScales.
    std::vector<NamedFactor> factors() const;

    /// λ of tan α = width/height.
    double slenderness() const { return width / height; }
};

/// One of the factors that a law gives.
struct ModelScale {
    std::string_view name;  ///< "acceleration_vertical"
    double ModelScales::*factor;
};

/// The factors to be reported of a model, one by one.
inline constexpr ModelScale kModelScales[] = {{"height", &ModelScales::height},
                                              {"width", &ModelScales::width},
                                              {"time", &ModelScales::time},
                                              {"displacement", &ModelScales::displacement},
                                              {"velocity", &ModelScales::velocity},
                                              {"acceleration", &ModelScales::acceleration},
                                              {"acceleration_vertical", &ModelScales::acceleration_vertical},
                                              {"gravity", &ModelScales::gravity},
                                              {"friction", &ModelScales::friction},
                                              {"mass", &ModelScales::mass}};

/// Those of a law: of its similitude where it has a length l. Else the height is H, or the length that find_length_name() says,
/// the width b, or else as the height; further t, or else u and a; of u, v, a and of u_v, v_v, a_v those that the law has, at least one
/// for the horizontal, as the time settles the others; without any for the vertical it moves as the horizontal; m, or else rho; mu and
/// g, 1 in a law without them. Throws SimilitudeError when a quantity is missing, of another dimension or open, or when those of one
/// direction do not keep v t/u and a t/v.
ModelScales make_model_scales(const LawFormulas& formulas, const ChosenFactors& chosen);

/// The quantity of a law that a model's length scale belongs to: l, or else the one length that the law expects to be chosen; one without
/// a default goes first, one in `set`, whose factor is given by itself, does not count. Throws SimilitudeError when there is none or more
/// than one.
std::string find_length_name(const ScaleLaw& law, const std::vector<GivenFactor>& set);

/// E/(ρ g l) of a model made of the prototype's solid, E unchanged, over the prototype's: 1/(λ_m λ_g/λ_l²), the weight stays in the widths'
/// area. Elastic strains and elastic waves keep their share only where it is 1, which E scaled by its inverse gives.
inline double find_solid_elasticity(const ModelScales& scales) { return scales.width * scales.width / scales.weight; }

}  // namespace musim::scaling
