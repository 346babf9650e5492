#pragma once

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>

#include "scaling/factor_rounding.hpp"
#include "scaling/laws/law_formulas.hpp"
#include "scaling/laws/model_scales.hpp"
#include "scaling/rational_dimension.hpp"
#include "scaling/setting.hpp"

namespace musim::scaling::detail {

/// Factors of a law by the names of its quantities.
class NamedFactors {
  public:
    NamedFactors(const LawFormulas& formulas, const ChosenFactors& chosen)
        : formulas_(formulas), solved_(formulas.solved()), chosen_(chosen) {}

    /// Throws SimilitudeError `law NAME: what; remedy`.
    [[noreturn]] void fail(std::string_view what, const Remedy& remedy = "choose another law (a similitude of motions needs more)") const {
        throw SimilitudeError(fmt::format("law {}: {}", solved_.law.name, what), remedy);
    }

    /// The factor of a quantity; none when the law does not have it.
    template <class Quantity>
    std::optional<double> find(std::string_view name) const {
        for (std::size_t j = 0; j < solved_.problem.quantities.size(); ++j) {
            const PiQuantity& quantity = solved_.problem.quantities[j];
            if (quantity.name != name) continue;
            static const RationalDimension kExpected = rational_dimension_of<Quantity>();
            if (quantity.dimension != kExpected) fail(fmt::format("its {} has another dimension than expected", name));
            const auto value = formulas_.factor(j, chosen_);
            if (!value) fail(fmt::format("{} is open", name), Remedy{"give it as ", Setting::factor});
            return value;
        }
        return std::nullopt;
    }

    /// The same; fails where the law does not have it.
    template <class Quantity>
    double require(std::string_view name) const {
        const auto value = find<Quantity>(name);
        if (!value) fail(fmt::format("it has no {}", name));
        return *value;
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

/// λ of the time t of a law, or else √(λ_u/λ_a). Throws SimilitudeError when the law has neither.
double find_time(const NamedFactors& factors);

/// λ of a horizontal shaking: of u, v and a where the law has them, of others by the time. Throws SimilitudeError when it has none of the
/// three, or when those that it has do not belong to one time.
ShakingScales find_horizontal(const NamedFactors& factors, double time);

/// λ of a vertical shaking: of u_v, v_v and a_v where the law has them, of others as far from the horizontal ones as these are; those of
/// the horizontal where it has none. Throws SimilitudeError when they differ from the horizontal ones by more than one factor.
ShakingScales find_vertical(const NamedFactors& factors, const ShakingScales& horizontal);

}  // namespace musim::scaling::detail
