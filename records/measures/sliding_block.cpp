#include "records/measures/sliding_block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace musim::records {
namespace {

/// The smallest root above zero of u + b t + c t² = 0 with u of the sign `way`, at which the sum changes sign; infinity when there is none.
double find_stop(double u, double b, double c) {
    const double never = HUGE_VAL;
    if (c == 0.0) return b * u < 0.0 ? -u / b : never;
    const double square = b * b - 4.0 * c * u;
    if (!(square > 0.0)) return never;
    // Citardauq: no cancellation
    const double q = -0.5 * (b + std::copysign(std::sqrt(square), b));
    double stop = never;
    for (const double root : {q / c, q != 0.0 ? u / q : never})
        if (root > 0.0) stop = std::min(stop, root);
    return stop;
}

/// The block within one step of the record.
class Slider {
  public:
    explicit Slider(double yield) : yield_(yield) {}

    /// `from`, `to`: acceleration of the base at both ends of a step of length `h`.
    void step(double from, double to, double h) {
        const double slope = (to - from) / h;
        double t = 0.0;
        // it begins, stops, and begins the other way at most; more comes of rounding at an instant where it does both
        constexpr int kMostEvents = 8;
        for (int event = 0; event < kMostEvents && t < h; ++event) {
            const double now = from + slope * t;
            if (way_ == 0.0) {
                const double begins = find_yield(now, slope);
                if (!(begins < h - t)) return;
                t += begins;
                // at the very instant the acceleration is the limit; the way it goes on decides
                const double there = from + slope * t;
                way_ = std::abs(there) > yield_ ? std::copysign(1.0, there) : std::copysign(1.0, slope);
                velocity_ = 0.0;
                if (t >= h) return;
                continue;
            }
            double relative = now - way_ * yield_;
            if (velocity_ == 0.0 && relative * way_ < 0.0) relative = 0.0;  // at the instant it begins, by rounding
            double lasts = velocity_ == 0.0 ? find_stop_from_rest(relative, slope) : find_stop(velocity_, relative, 0.5 * slope);
            const bool stops = lasts < h - t;
            lasts = std::min(lasts, h - t);
            place_ += lasts * (velocity_ + lasts * (0.5 * relative + lasts * slope / 6.0));
            largest_ = std::max(largest_, std::abs(place_));
            velocity_ = stops ? 0.0 : velocity_ + lasts * (relative + 0.5 * lasts * slope);
            t = stops ? t + lasts : h;
            if (stops) way_ = std::abs(from + slope * t) > yield_ ? std::copysign(1.0, from + slope * t) : 0.0;
        }
    }

    double place() const { return place_; }
    double largest() const { return largest_; }

  private:
    /// Time until the base accelerates by more than the block can follow.
    double find_yield(double now, double slope) const {
        if (std::abs(now) > yield_) return 0.0;
        if (slope == 0.0) return HUGE_VAL;
        return (std::copysign(yield_, slope) - now) / slope;
    }

    /// Time at which a velocity that is zero now is zero again.
    static double find_stop_from_rest(double relative, double slope) {
        const double stop = slope == 0.0 ? -1.0 : -2.0 * relative / slope;
        return stop > 0.0 ? stop : HUGE_VAL;
    }

    double yield_;
    double way_ = 0.0;       ///< of the base relative to the block; zero while it sticks
    double velocity_ = 0.0;  ///< of the base relative to the block [m/s]
    double place_ = 0.0, largest_ = 0.0;
};

}  // namespace

Sliding compute_sliding(const TimeSeries& acceleration, scaling::Acceleration yield) {
    require_quantity(acceleration, SampleQuantity::acceleration, "the sliding block");
    if (!(yield.value() > 0.0 && std::isfinite(yield.value())))
        throw ProcessingError(fmt::format("the block's limit is {} m/s^2 (must be above 0); give friction times gravity", yield.value()));
    Slider slider(yield.value());
    const std::span<const double> a = acceleration.samples();
    for (std::size_t i = 1; i < a.size(); ++i) slider.step(a[i - 1], a[i], acceleration.dt().value());
    return {scaling::Length::from_value(slider.largest()), scaling::Length::from_value(slider.place())};
}

}  // namespace musim::records
