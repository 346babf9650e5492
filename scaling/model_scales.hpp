#pragma once

#include <string>
#include <string_view>

#include "scaling/law_formulas.hpp"
#include "scaling/similitude.hpp"

namespace musim::scaling {

/// Scale factors of a model that is made and shaken, whose heights and widths may scale apart.
struct ModelScales {
    std::string law;
    double height = 1.0;  ///< λ of heights
    double width = 1.0;   ///< λ of horizontal sizes
    double friction = 1.0, gravity = 1.0;
    double mass = 1.0;              ///< with mass that is added
    double weight = 1.0;            ///< λ_m λ_g
    double static_stiffness = 1.0;  ///< of contacts that sink by a similar share of the height under dead weight: λ_m λ_g/λ_H
    double time = 1.0, frequency = 1.0;
    double displacement = 1.0, velocity = 1.0, acceleration = 1.0;                             ///< horizontal
    double displacement_vertical = 1.0, velocity_vertical = 1.0, acceleration_vertical = 1.0;  ///< of a vertical shaking

    ModelScales() = default;

    /// A similitude has one length, and scales a vertical shaking as a horizontal one.
    ModelScales(const Similitude& similitude);  // NOLINT(google-explicit-constructor): nothing is lost

    /// λ of tan α = width/height.
    double slenderness() const { return width / height; }
};

/// One of the factors that a law gives.
struct ModelScale {
    std::string_view name;  ///< "acceleration_vertical"
    double ModelScales::*factor;
};

/// The factors to be told of a model, one by one.
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

/// Those of a law as data: of its similitude where it has a length l, else by the names that mu_vertical_distortion gives its quantities:
/// H, b, t, u, v, a, u_v, a_v, m, mu, g. Throws SimilitudeError when a quantity is missing, of another dimension or open.
ModelScales make_model_scales(const LawFormulas& formulas, const ChosenFactors& chosen);

}  // namespace musim::scaling
