#include "records/processing/cumulative.hpp"

#include <algorithm>

namespace musim::records::detail {

std::vector<double> cumulative_trapezoid(std::span<const double> x, double dt) {
    std::vector<double> y(x.size(), 0.0);
    for (std::size_t i = 1; i < x.size(); ++i) y[i] = y[i - 1] + 0.5 * dt * (x[i - 1] + x[i]);
    return y;
}

std::vector<double> rest_correction(std::size_t size, double dt, double velocity_end, std::optional<double> displacement_end,
                                    RestShape shape) {
    std::vector<double> even(size);  // w
    std::vector<double> odd(size);   // w (1 − 2τ)
    for (std::size_t i = 0; i < size; ++i) {
        const double tau = static_cast<double>(i) / static_cast<double>(size - 1);
        even[i] = shape == RestShape::faded ? tau * (1.0 - tau) : 1.0;
        odd[i] = even[i] * (1.0 - 2.0 * tau);
    }

    // final velocity and displacement of each shape, in steps; then two equations for α and β
    const std::vector<double> even_velocity = cumulative_trapezoid(even, 1.0);
    const std::vector<double> odd_velocity = cumulative_trapezoid(odd, 1.0);
    const double even_end = cumulative_trapezoid(even_velocity, 1.0).back();
    const double odd_end = cumulative_trapezoid(odd_velocity, 1.0).back();
    const double velocity = velocity_end / dt;
    double alpha = velocity / even_velocity.back(), beta = 0.0;
    if (displacement_end) {
        const double determinant = even_velocity.back() * odd_end - odd_velocity.back() * even_end;
        const double displacement = *displacement_end / dt / dt;
        alpha = (velocity * odd_end - odd_velocity.back() * displacement) / determinant;
        beta = (even_velocity.back() * displacement - velocity * even_end) / determinant;
    }

    for (std::size_t i = 0; i < size; ++i) even[i] = alpha * even[i] + beta * odd[i];
    return even;
}

std::vector<double> end_at_rest(std::vector<double> acceleration, double dt, std::optional<double> displacement) {
    const std::vector<double> velocity = cumulative_trapezoid(acceleration, dt);
    std::optional<double> drift;
    if (displacement) drift = cumulative_trapezoid(velocity, dt).back() - *displacement;
    const std::vector<double> correction = rest_correction(acceleration.size(), dt, velocity.back(), drift);
    for (std::size_t i = 0; i < acceleration.size(); ++i) acceleration[i] -= correction[i];
    return acceleration;
}

std::vector<double> cumulative_square(const TimeSeries& series) {
    std::vector<double> square(series.samples().begin(), series.samples().end());
    for (double& value : square) value *= value;
    return cumulative_trapezoid(square, series.dt().value());
}

scaling::Time time_of_share(const TimeSeries& series, const std::vector<double>& cumulative, double share) {
    const double wanted = share * cumulative.back();
    const auto reached = std::lower_bound(cumulative.begin(), cumulative.end(), wanted);
    const auto i = static_cast<std::size_t>(reached - cumulative.begin());
    if (i == 0) return series.start();
    const double part = (wanted - cumulative[i - 1]) / (cumulative[i] - cumulative[i - 1]);
    return series.start() + (static_cast<double>(i - 1) + part) * series.dt();
}

}  // namespace musim::records::detail
