#include "scaling/laws/similitude.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <utility>

#include "scaling/factor_rounding.hpp"

namespace musim::scaling {

namespace {

void check_factor(std::string_view name, double value) {
    if (std::isfinite(value) && value > 0.0) return;
    throw SimilitudeError(fmt::format(
        "similitude: the {} factor is {} (model/prototype must be positive and finite); give a number such as 0.04 or 1/25", name, value));
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

Similitude::Similitude(const ScaleFactors& chosen, double acceleration, std::string law_name, std::optional<double> acceleration_vertical)
    : chosen_(chosen),
      law_name_(std::move(law_name)),
      acceleration_(acceleration),
      acceleration_vertical_(acceleration_vertical.value_or(chosen.gravity)) {
    check_factor("length", chosen.length);
    check_factor("friction", chosen.friction);
    check_factor("gravity", chosen.gravity);
    check_factor("density", chosen.density);
    check_factor("acceleration", acceleration_);
    check_factor("vertical acceleration", acceleration_vertical_);
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

bool Similitude::keeps_statics() const {
    const auto is_one = [](double ratio) { return std::abs(ratio - 1.0) <= kFactorRounding; };
    return is_one(chosen_.friction) && is_one(acceleration_ / chosen_.gravity);
}

bool Similitude::is_identity() const {
    const auto& [length, friction, gravity, density] = chosen_;
    return length == 1.0 && friction == 1.0 && gravity == 1.0 && density == 1.0 && acceleration_ == 1.0 && acceleration_vertical_ == 1.0;
}

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
