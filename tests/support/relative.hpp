#pragma once

#include <doctest/doctest.h>

namespace musim::lsdem::tests {

/// `value` within a relative `tolerance`. doctest's Approx alone adds 1 to the size of the numbers, which makes it absolute for small ones.
inline doctest::Approx relative(double value, double tolerance) { return doctest::Approx(value).epsilon(tolerance).scale(0.0); }

}  // namespace musim::lsdem::tests
