#pragma once

#include <span>
#include <vector>

#include "records/error.hpp"
#include "records/sample_unit.hpp"
#include "scaling/units.hpp"

namespace musim::records {

/// A uniformly sampled history: sample i belongs to the time start + i·dt.
///
/// Samples are raw doubles in the SI unit of the quantity: m/s² (acceleration), m/s (velocity) or m (displacement); of a rotation rad/s²,
/// rad/s or rad.
class TimeSeries {
  public:
    /// Throws ProcessingError when dt is not positive and finite, the start not finite, there is no sample or a sample is not finite.
    TimeSeries(SampleQuantity quantity, scaling::Time start, scaling::Time dt, std::vector<double> samples);

    SampleQuantity quantity() const { return quantity_; }
    scaling::Time start() const { return start_; }
    scaling::Time dt() const { return dt_; }
    std::size_t size() const { return samples_.size(); }
    std::span<const double> samples() const { return samples_; }  ///< [SI unit of quantity()]

    /// Time of sample i: start + i·dt.
    scaling::Time time(std::size_t i) const { return start_ + static_cast<double>(i) * dt_; }
    /// Time of the last sample.
    scaling::Time end() const { return time(size() - 1); }
    /// From the first to the last sample: (size − 1)·dt.
    scaling::Time duration() const { return static_cast<double>(size() - 1) * dt_; }

    /// The same clock with other samples, e.g. after a filter; throws as the constructor does.
    TimeSeries with_samples(std::vector<double> samples) const { return {quantity_, start_, dt_, std::move(samples)}; }
    /// The same clock with other samples of another quantity, e.g. after integration; throws as the constructor does.
    TimeSeries with_samples(SampleQuantity quantity, std::vector<double> samples) const {
        return {quantity, start_, dt_, std::move(samples)};
    }

    friend bool operator==(const TimeSeries&, const TimeSeries&) = default;

  private:
    SampleQuantity quantity_;
    scaling::Time start_;
    scaling::Time dt_;
    std::vector<double> samples_;
};

/// Largest absolute value; 0 of no samples.
double find_largest(std::span<const double> samples);

/// Mean of at least one sample.
double find_mean(std::span<const double> samples);

/// Throws ProcessingError, naming `step`, unless the series holds `wanted`.
void require_quantity(const TimeSeries& series, SampleQuantity wanted, std::string_view step);

/// Throws ProcessingError, naming `step`, unless the series holds accelerations or angular accelerations.
void require_acceleration(const TimeSeries& series, std::string_view step);

}  // namespace musim::records
