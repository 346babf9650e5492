#include "scaling/uncertainty/coverage.hpp"

#include <algorithm>
#include <cmath>

#include "scaling/uncertainty/normal_quantile.hpp"

namespace musim::scaling {

CoverageInterval find_interval(const FirstOrder& result) {
    const double spread = std::exp(normal_quantile(0.5 * (1.0 + kCoverage)) * result.relative);
    const auto [lower, upper] = std::minmax({result.value / spread, result.value * spread});
    return {lower, upper};
}

}  // namespace musim::scaling
