#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scaling/laws/scale_law.hpp"

namespace musim::records {

/// A law by which models are searched, with factors of its own.
class DesignLaw {
  public:
    /// `set` are factors that are the same at every length. Throws PiError as check_law() does.
    DesignLaw(scaling::ScaleLaw law, std::vector<scaling::GivenFactor> set = {});  // NOLINT(google-explicit-constructor): it is one

    const std::string& name() const { return name_; }

    /// Its texts stay where they are as long as a copy of this lives.
    const scaling::ScaleLaw& law() const { return *law_; }

    const std::vector<scaling::GivenFactor>& set() const { return set_; }

    /// Whether the law sets a factor, expects one to be chosen, and has a quantity.
    bool sets(std::string_view quantity) const;
    bool expects(std::string_view quantity) const;
    bool has(std::string_view quantity) const;

    /// The name by which scaling::group_factors() gives a product that this law holds or watches, "a_vertical/g" of "a_v/g"; none when it
    /// has no such name.
    std::optional<std::string> find_common_name(const std::string& product) const;

    /// By name and factors.
    bool operator==(const DesignLaw& other) const;

  private:
    std::string name_;
    std::shared_ptr<const scaling::ScaleLaw> law_;
    std::vector<scaling::GivenFactor> set_;
    std::map<std::string, std::string> common_names_;  ///< by the law's own texts
};

/// λ of a property that a real model has, whatever its law asks for.
struct KnownProperty {
    std::string name;
    std::optional<double> factor;  ///< none where prototype or model do not give it
};

/// Factors of a model that are known before its law has said anything.
struct KnownFactors {
    scaling::GivenFactor length;  ///< by the name that scaling::find_length_name() has for it
    double friction = 1.0, density = 1.0;
    std::optional<double> gravity = {};
    std::vector<KnownProperty> properties = {};  ///< E, e, k_s
};

/// Factors that a law is given of it, under the names of scaling/laws: the law's own factors; the length; mu; the density as rho_s where
/// the law has one, else as rho; g where it is known; and properties that the law expects to be chosen. What the law sets goes before g and
/// properties.
std::vector<scaling::GivenFactor> give_factors(const DesignLaw& law, const KnownFactors& known);

}  // namespace musim::records
