#pragma once

#include <string>
#include <vector>

#include "scaling/pi_quantity.hpp"

namespace musim::scaling {

/// How a product of powers is written.
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
