#pragma once

#include <string>
#include <vector>

#include "scaling/pi_quantity.hpp"

namespace musim::scaling {

/// Notation of a product of powers.
enum class PiNotation {
    text,   ///< v^2/(g*l), as parse_group() reads it
    latex,  ///< `\frac{v^{2}}{g\,l}`, without dollars; names such as mu and rho as Greek letters
};

/// A product of powers of the quantities; "1" when all exponents are zero.
std::string format_group(const std::vector<Rational>& exponents, const std::vector<PiQuantity>& quantities,
                         PiNotation notation = PiNotation::text);
std::string format_group(const PiGroup& group, const std::vector<PiQuantity>& quantities, PiNotation notation = PiNotation::text);

/// A name of a quantity in LaTeX: "\mu", "k_{\mathrm{n}}".
std::string latex_name(std::string_view name);

}  // namespace musim::scaling

namespace musim::scaling::detail {

/// Powers above and below a fraction bar, as text or LaTeX.
class FractionText {
  public:
    explicit FractionText(PiNotation notation) : notation_(notation) {}

    /// Multiplies by name^exponent; nothing for an exponent of 0.
    void multiply(const std::string& name, const Rational& exponent);

    bool is_empty() const { return above_.empty() && below_.empty(); }

    /// "a^2*b/(c*d)" or "\frac{a^{2}\,b}{c\,d}"; "1" when empty.
    std::string text() const;

  private:
    PiNotation notation_;
    std::vector<std::string> above_;
    std::vector<std::string> below_;
};

}  // namespace musim::scaling::detail
