#pragma once

#include <string>
#include <vector>

#include "scaling/pi/pi_text.hpp"

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
