#pragma once

#include <optional>
#include <string>
#include <vector>

#include "records/design/design_law.hpp"

namespace musim::records {

/// λ of a property that a real model has, whatever its law asks for.
struct KnownProperty {
    std::string name;
    std::optional<double> factor;  ///< none where prototype or model do not give it
};

/// What is known of a model before its law has said anything.
struct KnownFactors {
    scaling::GivenFactor length;  ///< by the name that scaling::find_length_name() has for it
    double friction = 1.0, density = 1.0;
    std::optional<double> gravity = {};
    std::vector<KnownProperty> properties = {};  ///< E, e, k_s
};

/// What a law is given of it, under the names of scaling/laws: the law's own factors; the length; mu; the density as rho_s where the law
/// has one, else as rho; g where it is known; and properties that the law expects to be chosen. What the law sets goes before g and
/// properties.
std::vector<scaling::GivenFactor> give_factors(const DesignLaw& law, const KnownFactors& known);

}  // namespace musim::records
