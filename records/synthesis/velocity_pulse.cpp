#include "records/synthesis/velocity_pulse.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "records/formats/detail/made_record.hpp"
#include "records/processing/cumulative.hpp"

namespace musim::records {
namespace {

using std::numbers::pi;

constexpr const char* kVelocityPulse = "velocity pulse";

double find_theta(const VelocityPulse& pulse, scaling::Time tau) { return 2.0 * pi * pulse.frequency.value() * tau.value(); }

double find_phase(const VelocityPulse& pulse) { return pulse.phase_deg * (pi / 180.0); }

/// Is the motion over, or not yet begun?
bool is_outside(const VelocityPulse& pulse, double theta) { return std::abs(theta) >= pi * pulse.cycles; }

/// Displacement but for its constant, in units of A/(4π f_p).
double displacement_shape(const VelocityPulse& pulse, double theta) {
    const double gamma = pulse.cycles, nu = find_phase(pulse);
    return std::sin(theta + nu) + 0.5 * gamma / (gamma - 1.0) * std::sin((gamma - 1.0) / gamma * theta + nu) +
           0.5 * gamma / (gamma + 1.0) * std::sin((gamma + 1.0) / gamma * theta + nu);
}

void check(const VelocityPulse& pulse, scaling::Time dt) {
    detail::require_positive(kVelocityPulse, {{"amplitude", pulse.amplitude.value()},
                                              {"frequency", pulse.frequency.value()},
                                              {"number of cycles", pulse.cycles},
                                              {"time step", dt.value()}});
    if (!(pulse.cycles > 1.0)) {
        throw ProcessingError(fmt::format("{}: number of cycles is {} (must be above 1); raise it", kVelocityPulse, pulse.cycles));
    }
    if (!std::isfinite(pulse.phase_deg)) {
        throw ProcessingError(fmt::format("{}: phase is {} degrees (must be finite); correct it", kVelocityPulse, pulse.phase_deg));
    }
    detail::require_sampled(kVelocityPulse, pulse.frequency.value(), dt.value());
}

}  // namespace

scaling::Acceleration VelocityPulse::acceleration(scaling::Time tau) const {
    const double theta = find_theta(*this, tau), nu = find_phase(*this);
    if (is_outside(*this, theta)) return {};
    const double shape = std::sin(theta / cycles) * std::cos(theta + nu) / cycles + (1.0 + std::cos(theta / cycles)) * std::sin(theta + nu);
    return amplitude * frequency * (-pi * shape);
}

scaling::Velocity VelocityPulse::velocity(scaling::Time tau) const {
    const double theta = find_theta(*this, tau);
    if (is_outside(*this, theta)) return {};
    return amplitude * (0.5 * (1.0 + std::cos(theta / cycles)) * std::cos(theta + find_phase(*this)));
}

scaling::Length VelocityPulse::displacement(scaling::Time tau) const {
    const double theta = find_theta(*this, tau);
    if (is_outside(*this, theta)) return theta < 0.0 ? scaling::Length() : residual_displacement();
    return amplitude / frequency * ((displacement_shape(*this, theta) - displacement_shape(*this, -pi * cycles)) / (4.0 * pi));
}

scaling::Length VelocityPulse::residual_displacement() const {
    return amplitude / frequency * (std::sin(pi * cycles) * std::cos(find_phase(*this)) / (2.0 * pi * (1.0 - cycles * cycles)));
}

GroundMotion make_velocity_pulse_record(const VelocityPulse& pulse, scaling::Time dt, bool return_home) {
    check(pulse, dt);
    const double half = std::ceil(0.5 * pulse.cycles / (pulse.frequency.value() * dt.value()));
    detail::require_steps(kVelocityPulse, 2.0 * half, 4.0);
    std::vector<double> samples(2 * static_cast<std::size_t>(half) + 1);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = pulse.acceleration((static_cast<double>(i) - half) * dt).value();

    const scaling::Length residual = return_home ? scaling::Length() : pulse.residual_displacement();
    samples = detail::end_at_rest(std::move(samples), dt.value(), residual.value());
    return detail::make_record(
        fmt::format("{}, {:.6g} Hz", kVelocityPulse, pulse.frequency.value()),
        fmt::format("{} [MavroeidisPapageorgiou03], A {:.9g} m/s, f_p {:.9g} Hz, gamma {:.9g}, nu {:.9g} deg, middle at {:.9g} s; brought "
                    "to rest {:.9g} m from its start{}",
                    kVelocityPulse, pulse.amplitude.value(), pulse.frequency.value(), pulse.cycles, pulse.phase_deg, half * dt.value(),
                    residual.value(),
                    return_home ? fmt::format(" instead of {:.9g} m", pulse.residual_displacement().value()) : std::string()),
        dt, std::move(samples));
}

}  // namespace musim::records
