#pragma once

#include <cmath>

#include "scaling/units.hpp"

/// Dimensionless groups of frictional block structures, in the square-root form: a speed over a speed. The classical Froude number
/// v²/(g l) and Cauchy number ρ v²/E are the squares of ours. Groups marked "derived" are musim's, see docs/theory/similitude.md; the rest
/// is quoted. All expect positive arguments and return plain numbers.
namespace musim::scaling::groups {

/// mu number μ^N = v/√(μ g l): inertia against friction over the height l of the structure [Andrade22] eq. (3), [Rosakis21].
inline double mu_number(IsVelocity auto v, double friction, IsAcceleration auto g, IsLength auto l) {
    return v.value() / std::sqrt(friction * g.value() * l.value());
}

/// Froude number Fr^N = v/√(g l): inertia against weight. μ^N = Fr^N/√μ [Andrade22].
inline double froude_number(IsVelocity auto v, IsAcceleration auto g, IsLength auto l) {
    return v.value() / std::sqrt(g.value() * l.value());
}

/// a/(μ g): demand over sliding strength; above 1 a block slides [Andrade22] eq. (3).
inline double sliding_demand(IsAcceleration auto a, double friction, IsAcceleration auto g) { return a.value() / (friction * g.value()); }

/// a/(g tan α): demand over uplift strength, tan α = width/height; above 1 a block starts to rock [Housner63].
inline double rocking_demand(IsAcceleration auto a, IsAcceleration auto g, double slenderness) {
    return a.value() / (g.value() * slenderness);
}

/// μ/tan α: above 1 rocking can start before sliding, below 1 a block slides first [ShentonJones91], [Shenton96].
inline double regime(double friction, double slenderness) { return friction / slenderness; }

/// t √(μ g/l): time in units of the mu law; also of record steps, durations and pulse periods (derived).
inline double sliding_time(IsTime auto t, double friction, IsAcceleration auto g, IsLength auto l) {
    return t.value() * std::sqrt(friction * g.value() / l.value());
}

/// Frequency parameter p = √(3 g/(4 R)) of a rectangular block with half diagonal R [1/s] [Housner63].
inline Frequency frequency_parameter(IsAcceleration auto g, IsLength auto half_diagonal) {
    return Frequency::from_value(std::sqrt(3.0 * g.value() / (4.0 * half_diagonal.value())));
}

/// ω/p: excitation frequency over the frequency parameter, the size of a rocking block [Housner63], [ZhangMakris01].
inline double rocking_frequency(IsFrequency auto omega, IsAcceleration auto g, IsLength auto half_diagonal) {
    return omega.value() / frequency_parameter(g, half_diagonal).value();
}

/// κ_n = k_n/(ρ g H²): contact stiffness of a face against the block's weight; to infinity for rigid blocks (derived).
inline double contact_rigidity(IsStiffness auto normal, IsDensity auto rho, IsAcceleration auto g, IsLength auto block_height) {
    return normal.value() / (rho.value() * g.value() * block_height.value() * block_height.value());
}

/// Stack wave speed c = H √(k/m) of blocks of height H and mass m on face springs k [m/s] [Brillouin53]; k_n gives c_n, k_s gives c_e.
inline Velocity stack_wave_speed(IsLength auto block_height, IsStiffness auto stiffness, IsMass auto block_mass) {
    return Velocity::from_value(block_height.value() * std::sqrt(stiffness.value() / block_mass.value()));
}

/// Cauchy number C^N = v/c_n: inertia against contact elasticity (derived).
inline double cauchy_number(IsVelocity auto v, IsLength auto block_height, IsStiffness auto normal, IsMass auto block_mass) {
    return v.value() / stack_wave_speed(block_height, normal, block_mass).value();
}

/// S_e^N = √(k_s H/(N μ m g)) = c_e/√(μ g l) with l = N H: elastic structural speed before sliding (derived; S^N of [Rosakis21]).
inline double structural_speed_number(IsStiffness auto shear, IsLength auto block_height, int layers, double friction,
                                      IsMass auto block_mass, IsAcceleration auto g) {
    return std::sqrt(shear.value() * block_height.value() / (static_cast<double>(layers) * friction * block_mass.value() * g.value()));
}

/// Static base overlap over height deviation δ_w/σ_H = N m g/(k_n σ_H): far below 1, contacts are few and mass plays no part (derived).
inline double overlap_over_height_deviation(int layers, IsMass auto block_mass, IsAcceleration auto g, IsStiffness auto normal,
                                            IsLength auto height_deviation) {
    return static_cast<double>(layers) * block_mass.value() * g.value() / (normal.value() * height_deviation.value());
}

/// Angular velocity after over before the impact of a slender rigid block that does not bounce: 1 - 1.5 sin²α [Housner63].
inline double rocking_restitution(double slenderness) {
    const double tan_squared = slenderness * slenderness;
    return 1.0 - 1.5 * tan_squared / (1.0 + tan_squared);
}

}  // namespace musim::scaling::groups
