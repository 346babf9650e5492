#include "cli/records/record_measures.hpp"

#include <CLI/Option.hpp>
#include <cmath>

#include "records/measures/measures.hpp"
#include "records/measures/response_spectrum.hpp"

namespace musim::cli {

void MeasureSettings::add_to(CLI::App& command) {
    command.add_option("--bracket", bracket, "Threshold [g] of the bracketed duration (default 0.05)")
        ->type_name("NUMBER")
        ->check(above_zero());
    command.add_option("--mean-period-band", mean_period_band, "Frequencies [Hz] of the mean period (default 0.25 20)")
        ->type_name("LOW HIGH")
        ->expected(2)
        ->check(above_zero());
    command.add_option("--intensity-band", intensity_band, "Periods [s] of Housner's spectrum intensity (default 0.1 2.5)")
        ->type_name("FIRST LAST")
        ->expected(2)
        ->check(above_zero());
}

NamedValues measure_record(const records::TimeSeries& leveled, const records::Intensity& intensity,
                           const std::optional<scaling::Frequency>& corner, const MeasureSettings& settings) {
    std::optional<double> d5_75, cav, rms, bracketed, housner, vmax_over_amax, mean_period, predominant_period, pulse_period;
    if (leveled.quantity() == records::SampleQuantity::acceleration) {
        d5_75 = records::compute_significant_duration(leveled, 0.05, 0.75).value();
        cav = records::compute_cumulative_absolute_velocity(leveled).value();
        rms = records::compute_rms_acceleration(leveled) / scaling::kStandardGravity;
        bracketed = in_si(records::compute_bracketed_duration(leveled, settings.bracket.value * scaling::kStandardGravity));
        housner = records::compute_spectrum_intensity(leveled, settings.intensity_band.at(0).value * scaling::si::seconds,
                                                      settings.intensity_band.at(1).value * scaling::si::seconds)
                      .value() /
                  0.01;
        mean_period = in_si(records::compute_mean_period(records::compute_fourier_amplitudes(leveled),
                                                         settings.mean_period_band.at(0).value / scaling::si::seconds,
                                                         settings.mean_period_band.at(1).value / scaling::si::seconds));
        const auto spectrum = records::compute_own_spectrum(leveled, corner);
        predominant_period = in_si(records::find_predominant_period(spectrum));
        pulse_period = in_si(records::find_pulse_period(spectrum));
    }
    if (intensity.pga && intensity.pgv && intensity.pga->value.value() != 0.0) {
        vmax_over_amax = std::abs(intensity.pgv->value.value() / intensity.pga->value.value());
    }
    return {{"d5_75_s", "D5-75 [s]", or_null(d5_75)},
            {"cav_m_s", "CAV [m/s]", or_null(cav)},
            {"rms_g", "RMS [g]", or_null(rms)},
            {"bracketed_s", "bracketed [s]", or_null(bracketed)},
            {"housner_cm", "SI [cm]", or_null(housner)},
            {"vmax_over_amax_s", "PGV/PGA [s]", or_null(vmax_over_amax)},
            {"mean_period_s", "T mean [s]", or_null(mean_period)},
            {"predominant_period_s", "T PSA [s]", or_null(predominant_period)},
            {"pulse_period_s", "T PSV [s]", or_null(pulse_period)}};
}

}  // namespace musim::cli
