#pragma once

#include <string>
#include <vector>

#include "scaling/pi/pi_text.hpp"

namespace musim::scaling {

/// A scale factor as a product of powers of other factors: "l^2*sqrt(mu*g)" with the names of the quantities for their factors, which
/// parse_group() reads back, or in LaTeX `l^{2}\,\sqrt{...}` with `\lambda_{...}` for each. Halves under one root; "1" when all exponents
/// are zero.
std::string format_factor(const std::vector<Rational>& exponents, const std::vector<PiQuantity>& quantities,
                          PiNotation notation = PiNotation::text);

/// `\lambda_{\mu}`.
std::string latex_factor_name(const std::string& quantity);

}  // namespace musim::scaling
