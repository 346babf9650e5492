#include "scaling/similitude.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace musim::scaling {

namespace {

constexpr std::array<std::pair<Law, std::string_view>, 4> kLawNames{{
    {Law::mu, "mu"},
    {Law::froude, "froude"},
    {Law::exact, "exact"},
    {Law::cauchy, "cauchy"},
}};

void check_factor(std::string_view name, double value) {
    if (std::isfinite(value) && value > 0.0) return;
    throw SimilitudeError(fmt::format(
        "similitude: the {} factor is {} (model/prototype must be positive and finite); give a number such as 0.04 or 1/25", name, value));
}

void check_chosen(const ScaleFactors& chosen) {
    check_factor("length", chosen.length);
    check_factor("friction", chosen.friction);
    check_factor("gravity", chosen.gravity);
    check_factor("density", chosen.density);
}

/// λ_a of a law: the acceleration of the force that governs.
double acceleration_factor(const ScaleFactors& chosen, Law law) {
    switch (law) {
        case Law::mu:
            return chosen.friction * chosen.gravity;
        case Law::cauchy:
            return 1.0 / (chosen.density * chosen.length);
        case Law::froude:
        case Law::exact:
            break;
    }
    return chosen.gravity;
}

/// Product of powers whose exponents are quarters, with one root at the end of each kind: √(1/8 · 2) is exact, √(1/8) · √2 is not.
class PowerProduct {
  public:
    void multiply(double base, int quarters) {
        Parts& parts = quarters > 0 ? numerator_ : denominator_;
        const int magnitude = std::abs(quarters);
        for (int i = 0; i < magnitude / 4; ++i) parts.whole *= base;
        if (magnitude % 4 >= 2) parts.half *= base;
        if (magnitude % 2 == 1) parts.quarter *= base;
    }

    double value() const {
        return numerator_.whole / denominator_.whole * std::sqrt(numerator_.half / denominator_.half) *
               std::sqrt(std::sqrt(numerator_.quarter / denominator_.quarter));
    }

  private:
    struct Parts {
        double whole = 1.0;
        double half = 1.0;
        double quarter = 1.0;
    };
    Parts numerator_;
    Parts denominator_;
};

}  // namespace

Law parse_law(std::string_view name) {
    std::string known;
    for (const auto& [law, law_name] : kLawNames) {
        if (law_name == name) return law;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", law_name);
    }
    throw SimilitudeError(fmt::format("similitude: there is no law \"{}\"; choose one of {}", name, known));
}

bool is_law(std::string_view name) {
    return std::any_of(kLawNames.begin(), kLawNames.end(), [&](const auto& known) { return known.second == name; });
}

std::string_view to_string(Law law) {
    for (const auto& [known, name] : kLawNames) {
        if (known == law) return name;
    }
    return "unknown";
}

Similitude::Similitude(const ScaleFactors& chosen, Law law)
    : chosen_(chosen),
      law_(law),
      law_name_(to_string(law)),
      acceleration_(acceleration_factor(chosen, law)),
      acceleration_vertical_(law == Law::cauchy ? acceleration_ : chosen.gravity) {
    check_chosen(chosen);
    if (law == Law::exact && chosen.friction != 1.0) {
        throw SimilitudeError(
            fmt::format("similitude: the friction factor is {} under law \"exact\" (must be 1: friction is a dimensionless group of its "
                        "own); choose law "
                        "\"mu\" or \"froude\", or give the model the prototype's friction",
                        chosen.friction));
    }
    check();
}

Similitude::Similitude(const ScaleFactors& chosen, double acceleration, std::string law_name, std::optional<double> acceleration_vertical)
    : chosen_(chosen),
      law_name_(std::move(law_name)),
      acceleration_(acceleration),
      acceleration_vertical_(acceleration_vertical.value_or(chosen.gravity)) {
    check_chosen(chosen);
    check_factor("acceleration", acceleration);
    check_factor("vertical acceleration", acceleration_vertical_);
    check();
}

void Similitude::check() const {
    for (const NamedFactor& derived : factors()) {
        if (std::isnormal(derived.value)) continue;
        throw SimilitudeError(
            fmt::format("similitude: the {} factor becomes {:g}, which leaves the range of doubles; choose factors nearer 1", derived.name,
                        derived.value));
    }
}

double Similitude::factor(Dimension dimension) const {
    // λ_m = λ_ρ λ_l³ and λ_t = √(λ_l/λ_a) put into λ_l^a λ_m^b λ_t^c; exponents come in halves, the root makes quarters of them
    PowerProduct product;
    product.multiply(chosen_.length, 2 * dimension.length + 6 * dimension.mass + dimension.time);
    product.multiply(chosen_.density, 2 * dimension.mass);
    product.multiply(acceleration_, -dimension.time);
    return product.value();
}

// the ratio comes first: where it is 1, vertical motion scales as horizontal motion to the bit
double Similitude::velocity_vertical() const { return velocity() * (acceleration_vertical_ / acceleration_); }

double Similitude::displacement_vertical() const { return chosen_.length * (acceleration_vertical_ / acceleration_); }

double Similitude::force_vertical() const { return mass() * chosen_.gravity; }

double Similitude::stress_vertical() const { return chosen_.density * chosen_.length * chosen_.gravity; }

double Similitude::energy_potential() const { return mass() * chosen_.gravity * chosen_.length; }

double Similitude::stiffness_static() const { return chosen_.density * chosen_.length * chosen_.length * chosen_.gravity; }

double Similitude::arias_intensity() const { return acceleration_ * acceleration_ * time() / chosen_.gravity; }

std::vector<NamedFactor> Similitude::factors() const {
    return {
        {"length", length()},
        {"time", time()},
        {"velocity", velocity()},
        {"acceleration", acceleration()},
        {"mass", mass()},
        {"force", force()},
        {"stiffness", stiffness()},
        {"damping", damping()},
        {"friction", friction()},
        {"gravity", gravity()},
        {"density", density()},
        {"frequency", frequency()},
        {"angular_acceleration", factor<AngularAcceleration>()},
        {"area", factor<Area>()},
        {"volume", factor<Volume>()},
        {"inertia", inertia()},
        {"moment", moment()},
        {"stress", stress()},
        {"stiffness_per_area", factor<StiffnessPerArea>()},
        {"energy", energy()},
        {"power", power()},
        {"momentum", momentum()},
        {"acceleration_vertical", acceleration_vertical()},
        {"force_vertical", force_vertical()},
        {"stress_vertical", stress_vertical()},
        {"stiffness_static", stiffness_static()},
        {"energy_potential", energy_potential()},
        {"arias_intensity", arias_intensity()},
    };
}

}  // namespace musim::scaling
