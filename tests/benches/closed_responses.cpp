#include "tests/benches/closed_responses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace musim::lsdem {

using std::numbers::pi;

PushedSlider compute_pushed_slider(double strength) {
    const double limit = 1.0 / strength;
    if (!(limit < 1.0)) throw std::invalid_argument(fmt::format("pushed slider: strength {} never slips (must exceed 1)", strength));
    // slips from where a = μg on; x = πt/T
    const double start = std::asin(limit), left = 1.0 - start / pi;
    const double speed = (1.0 + std::cos(start)) / pi - limit * left;
    if (!(speed > 0.0)) {
        throw std::invalid_argument(fmt::format("pushed slider: strength {} stops during the push; use 1.4 or more", strength));
    }
    const double during = std::cos(start) / pi * left + std::sin(start) / (pi * pi) - 0.5 * limit * left * left;
    return {.slip = during + 0.5 * speed * speed / limit, .end = 1.0 + speed / limit};
}

double compute_pushed_tilt(double strength, double rate) {
    if (!(strength > 1.0)) return 0.0;
    // φ = θ/α, time in 1/p: φ'' − φ = s sin(wt) − 1 from φ = φ' = 0 where s sin(wt) = 1
    const double phase = std::asin(1.0 / strength), elapsed = (pi - phase) / rate, share = 1.0 + rate * rate;
    const double a = rate * std::sqrt(strength * strength - 1.0) / share, b = -rate * rate / share;
    const double tilt = 1.0 + a * std::sinh(elapsed) + b * std::cosh(elapsed);
    const double speed = strength * rate / share + a * std::cosh(elapsed) + b * std::sinh(elapsed);
    if (!(speed > 0.0)) {
        throw std::invalid_argument(
            fmt::format("pushed rocker: strength {} at rate {} turns back during the push; make it stronger or shorter", strength, rate));
    }
    // free: (1 − φ)² − φ'² is kept
    const double kept = (1.0 - tilt) * (1.0 - tilt) - speed * speed;
    if (tilt >= 1.0 || kept <= 0.0) return 1.0;
    return 1.0 - std::sqrt(kept);
}

double compute_soft_tilt(double strength, double rate, double sinking) {
    const auto acceleration = [&](double tilt, double time) {
        const double held = tilt > 2.0 * sinking ? 1.0 - 2.0 / 3.0 * std::sqrt(2.0 * sinking / tilt) : tilt / (6.0 * sinking);
        const double push = time * rate < pi ? strength * std::sin(rate * time) : 0.0;
        return tilt + push - held;
    };
    const double step = 0.02 * std::sqrt(6.0 * sinking);
    double tilt = 0.0, speed = 0.0, time = 0.0, greatest = 0.0, now = acceleration(tilt, time);
    // until it turns back after the push, or overturns
    while (tilt < 1.0 && (speed >= 0.0 || time * rate < pi)) {
        speed += 0.5 * step * now;
        tilt += step * speed;
        time += step;
        now = acceleration(tilt, time);
        speed += 0.5 * step * now;
        greatest = std::max(greatest, tilt);
    }
    return std::min(greatest, 1.0);
}

}  // namespace musim::lsdem
