#pragma once

#include <span>

namespace musim::lsdem {

/// Least-squares line y = intercept + slope·x.
struct LineFit {
    double intercept = 0.0;
    double slope = 0.0;
    double slope_error = 0.0;  ///< standard error of the slope from the residuals, √(Σr²/(n − 2)/Σ(x − x̄)²); 0 for two points
};

/// Fits a line through at least two points with different x. Throws std::invalid_argument otherwise.
LineFit fit_line(std::span<const double> x, std::span<const double> y);

}  // namespace musim::lsdem
