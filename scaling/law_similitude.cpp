#include "scaling/law_similitude.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "scaling/distortion.hpp"

namespace musim::scaling {

namespace {

/// Factors of a law by the names that a similitude knows.
class Factors {
  public:
    Factors(const LawFormulas& formulas, const ChosenFactors& chosen) : formulas_(formulas), solved_(formulas.solved()), chosen_(chosen) {}

    [[noreturn]] void fail(std::string_view what) const {
        throw SimilitudeError(fmt::format("law {}: {}; `musim scale` takes it, a similitude of motions does not", solved_.law.name, what));
    }

    /// The factor of a quantity; none when the law does not have it.
    template <class Quantity>
    std::optional<double> find(std::string_view name) const {
        for (std::size_t j = 0; j < solved_.problem.quantities.size(); ++j) {
            const PiQuantity& quantity = solved_.problem.quantities[j];
            if (quantity.name != name) continue;
            if (quantity.dimension != rational_dimension_of<Quantity>())
                fail(fmt::format("its {} has another dimension than expected", name));
            const auto value = formulas_.factor(j, chosen_);
            if (!value) fail(fmt::format("{} is open (give --set {}=NUMBER)", name, name));
            return value;
        }
        return std::nullopt;
    }

    /// Two ways to one factor must agree.
    void require_equal(double a, double b, std::string_view product) const {
        if (std::abs(a / b - 1.0) > kFactorRounding) fail(fmt::format("it does not keep {}", product));
    }

  private:
    const LawFormulas& formulas_;
    const SolvedLaw& solved_;
    const ChosenFactors& chosen_;
};

}  // namespace

Similitude make_similitude(const SolvedLaw& solved) { return make_similitude(LawFormulas(solved), solved.problem.chosen); }

Similitude make_similitude(const LawFormulas& formulas, const ChosenFactors& chosen) {
    const Factors factors(formulas, chosen);
    const auto length = factors.find<Length>("l");
    const auto time = factors.find<Time>("t");
    const auto acceleration = factors.find<Acceleration>("a");
    const auto density = factors.find<Density>("rho");
    const auto mass = factors.find<Mass>("m");
    if (!length) factors.fail("it has no length l for all directions");
    if (!time && !acceleration) factors.fail("it has neither a time t nor an acceleration a");
    if (!density && !mass) factors.fail("it has neither a density rho nor a mass m");
    const double volume = *length * *length * *length;
    if (time && acceleration) factors.require_equal(*acceleration * *time * *time, *length, "a t^2/l");
    if (density && mass) factors.require_equal(*density * volume, *mass, "m/(rho l^3)");
    const ScaleFactors scales{.length = *length,
                              .friction = factors.find<Ratio>("mu").value_or(1.0),
                              .gravity = factors.find<Acceleration>("g").value_or(1.0),
                              .density = density ? *density : *mass / volume};
    return Similitude(scales, acceleration ? *acceleration : *length / (*time * *time), formulas.solved().law.name);
}

}  // namespace musim::scaling
