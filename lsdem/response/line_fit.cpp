#include "lsdem/response/line_fit.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace musim::lsdem {

LineFit fit_line(std::span<const double> x, std::span<const double> y) {
    if (x.size() != y.size() || x.size() < 2) throw std::invalid_argument("line fit: needs two points or more, as many x as y");
    const auto n = static_cast<double>(x.size());
    double x_mean = 0.0, y_mean = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) x_mean += x[i] / n, y_mean += y[i] / n;
    double xx = 0.0, xy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - x_mean) * (x[i] - x_mean);
        xy += (x[i] - x_mean) * (y[i] - y_mean);
    }
    if (!(xx > 0.0)) throw std::invalid_argument("line fit: all points have the same x");
    LineFit fit{.intercept = y_mean - xy / xx * x_mean, .slope = xy / xx, .slope_error = 0.0};
    if (x.size() == 2) return fit;
    double squares = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double residual = y[i] - fit.intercept - fit.slope * x[i];
        squares += residual * residual;
    }
    fit.slope_error = std::sqrt(squares / (n - 2.0) / xx);
    return fit;
}

}  // namespace musim::lsdem
