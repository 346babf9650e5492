#pragma once

namespace musim::scaling::detail {

/// ln x, e^x and ln(1 + x) from IEEE arithmetic alone, to a few units in the last place: random numbers made with them are the same bits
/// wherever doubles are; those of a C library differ from one to the next. ln for x > 0, ln(1 + x) for x >= 0, all finite.
double portable_log(double x);
double portable_exp(double x);
double portable_log1p(double x);

}  // namespace musim::scaling::detail
