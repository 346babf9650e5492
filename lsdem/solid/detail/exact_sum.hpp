#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lsdem/solid/vectors.hpp"

namespace musim::lsdem::detail {

/// A sum of doubles without rounding, as parts that do not overlap, the least first [Shewchuk97]. Products must be far from underflow.
class ExactSum {
  public:
    void add(double term) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const double sum = term + parts_[i], share = sum - term, rest = (term - (sum - share)) + (parts_[i] - share);
            if (rest != 0.0) parts_[kept++] = rest;
            term = sum;
        }
        parts_.resize(kept);
        if (term != 0.0) parts_.push_back(term);
    }

    void add_product(double a, double b) {
        const double product = a * b;
        add(std::fma(a, b, -product));
        add(product);
    }

    void add_product(double a, double b, double c) {
        const double product = a * b;
        add_product(std::fma(a, b, -product), c);
        add_product(product, c);
    }

    int sign() const { return parts_.empty() ? 0 : (parts_.back() > 0.0 ? 1 : -1); }

    /// The sum with the rounding of a few parts.
    double value() const {
        double sum = 0.0;
        for (const double part : parts_) sum += part;
        return sum;
    }

  private:
    std::vector<double> parts_;
};

/// The sign of (u × v)·w, without rounding.
inline int find_exact_sign(const Vector3& u, const Vector3& v, const Vector3& w) {
    ExactSum sum;
    for (Eigen::Index k = 0; k < 3; ++k) {
        const Eigen::Index i = (k + 1) % 3, j = (k + 2) % 3;
        sum.add_product(u[i], v[j], w[k]);
        sum.add_product(-u[j], v[i], w[k]);
    }
    return sum.sign();
}

/// Twice the vector of area of a loop of corners, Σ x_i × x_{i+1} [m²] (Newell), rounded only at the end: the normal of a face however
/// narrow it is and however far from the origin.
inline Vector3 sum_cross_products(std::span<const Vector3> corners, std::span<const std::uint32_t> loop) {
    Vector3 result;
    for (Eigen::Index k = 0; k < 3; ++k) {
        const Eigen::Index i = (k + 1) % 3, j = (k + 2) % 3;
        ExactSum sum;
        for (std::size_t n = 0; n < loop.size(); ++n) {
            const Vector3 &here = corners[loop[n]], &next = corners[loop[(n + 1) % loop.size()]];
            sum.add_product(here[i], next[j]);
            sum.add_product(-here[j], next[i]);
        }
        result[k] = sum.value();
    }
    return result;
}

}  // namespace musim::lsdem::detail
