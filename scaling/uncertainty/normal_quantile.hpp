#pragma once

namespace musim::scaling {

/// z with Φ(z) = p, the quantile of the standard normal distribution, for 0 < p < 1: rational functions, 1e-15 relative [Wichura88]. The
/// same bits on every machine with IEEE doubles.
double normal_quantile(double p);

}  // namespace musim::scaling
