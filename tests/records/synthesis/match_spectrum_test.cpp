#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "records/formats/read_record.hpp"
#include "records/measures/intensity.hpp"
#include "records/measures/response_spectrum.hpp"
#include "records/processing/processing.hpp"
#include "records/synthesis/adjustment_wavelet.hpp"
#include "records/synthesis/match_spectrum.hpp"
#include "records/synthesis/synthetic.hpp"
#include "tests/support/shared_records.hpp"
#include "tests/support/temporary_folder.hpp"

namespace musim::records {
namespace {

using scaling::si::seconds;

/// PSA of a motion at 5 %, as a target.
TargetSpectrum spectrum_of(const TimeSeries& acceleration, double first, double last, std::size_t count) {
    TargetSpectrum target;
    target.period = make_periods(first * seconds, last * seconds, count);
    for (const double psa : compute_response_spectrum(acceleration, target.period).pseudo_acceleration())
        target.psa.push_back(psa * scaling::si::meters_per_second_squared);
    return target;
}

/// The target with the mean logarithm over `reach` neighbors to each side.
TargetSpectrum smooth(TargetSpectrum target, std::size_t reach) {
    const TargetSpectrum rough = target;
    for (std::size_t i = 0; i < rough.psa.size(); ++i) {
        const std::size_t first = i - std::min(i, reach), end = std::min(rough.psa.size(), i + reach + 1);
        double sum = 0.0;
        for (std::size_t k = first; k < end; ++k) sum += std::log(rough.psa[k].value());
        target.psa[i] = std::exp(sum / static_cast<double>(end - first)) * scaling::si::meters_per_second_squared;
    }
    return target;
}

/// A smooth shape like that of building codes: rising to 0.15 s, flat to 0.5 s, then 1/T.
TargetSpectrum code_shape(double first, double last, std::size_t count, double plateau) {
    TargetSpectrum target;
    target.period = make_periods(first * seconds, last * seconds, count);
    for (const scaling::Time& period : target.period) {
        const double t = period.value(), shape = t < 0.15 ? 0.4 + 0.6 * t / 0.15 : std::min(1.0, 0.5 / t);
        target.psa.push_back(plateau * shape * scaling::si::meters_per_second_squared);
    }
    return target;
}

TimeSeries short_synthetic(double dt = 0.01, double duration = 20.0) {
    return make_synthetic_record({.dt = dt * seconds, .duration = duration * seconds}).components.front().series;
}

double at(const TimeSeries& series, std::size_t i) { return series.samples()[i]; }

TEST_CASE("a real record is brought to smooth targets within 5 % over the band, and ends as it did") {
    if (!tests::have_shared_records()) return;
    const auto peer = tests::shared_records() / "peer";
    const GroundMotion record = read_record(peer / "RSN8883_14383980_13849360.AT2");
    const TimeSeries other = read_record(peer / "RSN8883_14383980_13849090.AT2").components.at(0).series;
    for (const TargetSpectrum& target : {code_shape(0.05, 5.0, 60, 3.0), smooth(spectrum_of(other, 0.05, 5.0, 60), 4)}) {
        const auto [motion, match] = match_spectrum(record, "360", target);
        CHECK(match.before.largest > 1.0);
        CHECK(match.iterations > 0);
        // computed anew by the other routine
        const TimeSeries& matched = motion.components.at(0).series;
        const std::vector<double> psa = compute_response_spectrum(matched, target.period).pseudo_acceleration();
        double largest = 0.0;
        for (std::size_t i = 0; i < psa.size(); ++i) largest = std::max(largest, std::abs(std::log(psa[i] / target.psa[i].value())));
        CHECK(largest <= 0.05 * (1.0 + 1e-9));
        CHECK(match.after.largest == doctest::Approx(largest).epsilon(1e-9));
        CHECK(match.after.mean <= match.after.largest);
        CHECK(motion.history.back().find("matched") != std::string::npos);

        // no drift: velocity and displacement end as those of the multiplied record, to rounding of sums of 10⁴ terms
        const TimeSeries& original = record.components.at(0).series;
        const TimeSeries velocity = integrate(matched), displacement = integrate(velocity);
        const TimeSeries before = integrate(original), moved = integrate(before);
        const std::size_t last = matched.size() - 1;
        CHECK(std::abs(at(velocity, last) - match.factor * at(before, last)) <
              1e-11 * std::abs(find_peak_velocity(velocity).value.value()));
        CHECK(std::abs(at(displacement, last) - match.factor * at(moved, last)) <
              1e-9 * std::abs(find_peak_displacement(displacement).value.value()));
        // the record begins as it did: wavelets fade in
        CHECK(at(matched, 0) == match.factor * at(original, 0));
    }
}

TEST_CASE("a motion that has its target stays as it is, and one that is a multiple away is multiplied") {
    const TimeSeries motion = short_synthetic();
    TargetSpectrum target = spectrum_of(motion, 0.1, 2.0, 20);
    const SpectrumMatch same = match_spectrum(motion, target);
    CHECK(same.acceleration == motion);
    CHECK(same.iterations == 0);
    CHECK(same.factor == 1.0);

    for (scaling::Acceleration& psa : target.psa) psa *= 1.2;
    const SpectrumMatch higher = match_spectrum(motion, target);
    CHECK(higher.before.largest == doctest::Approx(std::log(1.2)).epsilon(1e-9));
    CHECK(higher.iterations == 0);
    CHECK(higher.factor == doctest::Approx(1.2).epsilon(1e-12));
    CHECK(higher.after.largest < 1e-9);
    CHECK(at(higher.acceleration, 700) == higher.factor * at(motion, 700));
}

TEST_CASE("a scaled motion and target give the scaled match, bit for bit") {
    // λ_l = 1/16 in time, 1/4, and 8 in acceleration
    const TimeSeries motion = short_synthetic();
    const TargetSpectrum target = code_shape(0.1, 2.0, 15, 6.0);
    std::vector<double> samples(motion.samples().begin(), motion.samples().end());
    for (double& sample : samples) sample *= 8.0;
    TargetSpectrum small_target = target;
    for (scaling::Time& period : small_target.period) period /= 4.0;
    for (scaling::Acceleration& psa : small_target.psa) psa *= 8.0;
    const SpectrumMatch full = match_spectrum(motion, target);
    const SpectrumMatch small = match_spectrum({SampleQuantity::acceleration, {}, motion.dt() / 4.0, std::move(samples)}, small_target);
    CHECK(full.iterations > 0);
    CHECK(small.iterations == full.iterations);
    for (std::size_t i = 0; i < motion.size(); ++i) REQUIRE(at(small.acceleration, i) == 8.0 * at(full.acceleration, i));
}

TEST_CASE("a target out of reach and settings that make no sense are refused") {
    const TimeSeries motion = short_synthetic();
    // neighbors 1 % apart cannot differ tenfold at 5 % damping
    TargetSpectrum jagged = spectrum_of(motion, 0.5, 0.5 * 1.01, 2);
    jagged.psa[1] = 10.0 * jagged.psa[0];
    const std::string said = tests::message_of<ProcessingError>([&] { match_spectrum(motion, jagged, {.most_iterations = 40}); });
    CHECK(said.find("not reached") != std::string::npos);
    CHECK(said.find("wanted 0.05") != std::string::npos);

    const TargetSpectrum good = spectrum_of(motion, 0.1, 2.0, 3);
    const auto refuse = [&](const auto& change) {
        TargetSpectrum target = good;
        change(target);
        CHECK_THROWS_AS(match_spectrum(motion, target), ProcessingError);
    };
    refuse([](TargetSpectrum& target) { target.psa[1] = {}; });
    refuse([](TargetSpectrum& target) { target.psa.pop_back(); });
    refuse([](TargetSpectrum& target) { target.period[0] = target.period[1]; });
    refuse([](TargetSpectrum& target) { target.period[0] = 0.03 * seconds; });  // three steps
    refuse([](TargetSpectrum& target) { target.period[2] = 21.0 * seconds; });
    refuse([](TargetSpectrum& target) { target.damping = 1.0; });
    refuse([](TargetSpectrum& target) { target = {}; });
    CHECK_THROWS_AS(match_spectrum(motion, good, {.tolerance = 0.0}), ProcessingError);
    CHECK_THROWS_AS(match_spectrum(integrate(motion), good), ProcessingError);
    CHECK_THROWS_AS(match_spectrum(motion.with_samples(std::vector<double>(motion.size(), 0.0)), good), ProcessingError);
}

TEST_CASE("influences give the response to a wavelet, and the wavelet peaks it there") {
    constexpr double kPeriod = 0.5, kDt = 0.01;
    const double theta = 2.0 * std::numbers::pi * kDt / kPeriod;
    const detail::Wavelet wavelet = detail::make_adjustment_wavelet(theta, 0.05, 1000, 2001);
    std::vector<double> samples(2001, 0.0);
    std::copy(wavelet.samples.begin(), wavelet.samples.end(), samples.begin() + static_cast<std::ptrdiff_t>(wavelet.first));
    const TimeSeries motion(SampleQuantity::acceleration, {}, kDt * seconds, samples);
    const TimeSeries u = compute_oscillator_response(motion, kPeriod * seconds);
    // rounding of 1000 steps
    CHECK(kDt * kDt * detail::respond(detail::make_influence(theta, 0.05, 1000), wavelet) ==
          doctest::Approx(at(u, 1000)).scale(0.0).epsilon(1e-10));
    // between the samples likewise: of the same motion given twice as often
    std::vector<double> twice{samples[0]};
    for (std::size_t i = 1; i < samples.size(); ++i) twice.insert(twice.end(), {0.5 * (samples[i - 1] + samples[i]), samples[i]});
    const TimeSeries often = compute_oscillator_response({SampleQuantity::acceleration, {}, 0.5 * kDt * seconds, twice}, kPeriod * seconds);
    CHECK(kDt * kDt * detail::respond(detail::make_influence(theta, 0.05, 999.5), wavelet) ==
          doctest::Approx(at(often, 1999)).scale(0.0).epsilon(1e-10));
    // the response is largest within a step of one of its swings at the sample asked for
    CHECK(std::abs(at(u, 1000)) > std::abs(at(u, 998)));
    CHECK(std::abs(at(u, 1000)) > std::abs(at(u, 1002)));
    // no drift: e^{−13.7} = 1e-6 of what one half-swing moves
    const TimeSeries velocity = integrate(motion);
    CHECK(std::abs(at(velocity, 2000)) < 1e-5 * std::abs(find_peak_velocity(velocity).value.value()));
}

}  // namespace
}  // namespace musim::records
