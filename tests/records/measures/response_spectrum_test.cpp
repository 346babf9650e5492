#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "records/formats/read_record.hpp"
#include "records/measures/response_spectrum.hpp"
#include "records/measures/rotated_peaks.hpp"
#include "records/processing/processing.hpp"
#include "tests/records/sampled_spectrum.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/shared_records.hpp"

namespace musim::records {
namespace {

using lsdem::tests::relative;
using scaling::si::seconds;
using std::numbers::pi;

TimeSeries make_sine_acceleration(std::vector<double> samples, double dt) {
    return {SampleQuantity::acceleration, 0.0 * seconds, dt * seconds, std::move(samples)};
}

/// An uneven but fixed sequence in [−1, 1].
std::vector<double> make_noise(std::size_t count, unsigned seed) {
    std::vector<double> samples;
    unsigned state = seed;
    for (std::size_t i = 0; i < count; ++i) {
        state = 1664525U * state + 1013904223U;
        samples.push_back(static_cast<double>(state) / 2147483648.0 - 1.0);
    }
    return samples;
}

TEST_CASE("an oscillator under a constant acceleration follows the closed form at any step and damping") {
    // u = −(a/ω²)(1 − e^{−ζωt}(cos ω_d t + ζω/ω_d sin ω_d t)) below critical damping, and its continuation above
    constexpr double kPeriod = 2.0, kLoad = 3.0;
    const double omega = 2.0 * pi / kPeriod;
    for (const double damping : {0.0, 0.02, 0.05, 0.7, 1.5}) {
        for (const double dt : {0.3, 0.02, 0.001}) {
            CAPTURE(damping);
            CAPTURE(dt);
            const TimeSeries response =
                compute_oscillator_response(make_sine_acceleration(std::vector<double>(400, kLoad), dt), kPeriod * seconds, damping);
            double worst = 0.0;
            for (std::size_t i = 0; i < response.size(); ++i) {
                const double t = response.time(i).value();
                double free = 0.0;
                if (damping < 1.0) {
                    const double damped = omega * std::sqrt(1.0 - damping * damping);
                    free = std::exp(-damping * omega * t) * (std::cos(damped * t) + damping * omega / damped * std::sin(damped * t));
                } else {
                    const double root = omega * std::sqrt(damping * damping - 1.0), slow = damping * omega - root,
                                 fast = damping * omega + root;
                    free = (fast * std::exp(-slow * t) - slow * std::exp(-fast * t)) / (fast - slow);
                }
                worst = std::max(worst, std::abs(response.samples()[i] + kLoad / (omega * omega) * (1.0 - free)));
            }
            // rounding of 400 steps, relative to a/ω²
            CHECK(worst < 1e-12 * kLoad / (omega * omega));
        }
    }
}

TEST_CASE("a ramp is followed exactly, critical damping and tiny steps included") {
    // u = −(r/ω²)(t − 2ζ/ω) + homogeneous part; at ζ = 1: u = −(r/ω²)(t − 2/ω + (t + 2/ω)e^{−ωt})
    constexpr double kPeriod = 1.0, kRate = 5.0;
    const double omega = 2.0 * pi / kPeriod;
    for (const double dt : {0.2, 0.01, 1e-5}) {
        CAPTURE(dt);
        std::vector<double> ramp;
        ramp.reserve(300);
        for (int i = 0; i < 300; ++i) ramp.push_back(kRate * dt * i);
        const TimeSeries response = compute_oscillator_response(make_sine_acceleration(ramp, dt), kPeriod * seconds, 1.0);
        for (const std::size_t i : {std::size_t{1}, std::size_t{20}, std::size_t{299}}) {
            const double t = response.time(i).value(), x = omega * t;
            // for small x the closed form is a difference of large numbers: −r t³/6 (1 − x/2 + 3x²/20 − x³/30 + x⁴/168 − ...)
            const double exact =
                x < 0.02 ? -kRate * t * t * t / 6.0 * (1.0 - x / 2.0 + 3.0 * x * x / 20.0 - x * x * x / 30.0 + x * x * x * x / 168.0)
                         : -kRate / (omega * omega) * (t - 2.0 / omega + (t + 2.0 / omega) * std::exp(-x));
            CHECK(response.samples()[i] == relative(exact, x < 0.02 ? 1e-9 : 1e-10));
        }
    }
}

TEST_CASE("spectra hold the peaks of the responses, and pseudo values follow from them") {
    const TimeSeries motion = make_sine_acceleration(make_noise(3000, 7), 0.01);
    std::vector<scaling::Time> periods = make_periods(0.03 * seconds, 4.0 * seconds, 21);
    periods.insert(periods.begin(), 0.0 * seconds);
    const ResponseSpectrum spectrum = compute_response_spectrum(motion, periods, 0.05);
    const std::vector<double> psa = spectrum.pseudo_acceleration(), psv = spectrum.pseudo_velocity();
    double peak = 0.0;
    for (const double a : motion.samples()) peak = std::max(peak, std::abs(a));
    CHECK(psa[0] == peak);
    CHECK(spectrum.acceleration[0] == peak);
    CHECK(spectrum.displacement[0] == 0.0);
    CHECK(psv[0] == 0.0);
    for (std::size_t i = 1; i < periods.size(); ++i) {
        const TimeSeries response = compute_oscillator_response(motion, periods[i], 0.05);
        double most = 0.0;
        for (const double u : response.samples()) most = std::max(most, std::abs(u));
        const double omega = 2.0 * pi / periods[i].value();
        // peaks lie between the samples
        CHECK(spectrum.displacement[i] >= most * (1.0 - 1e-12));
        CHECK(psa[i] == relative(omega * omega * spectrum.displacement[i], 1e-14));
        CHECK(psv[i] == relative(omega * spectrum.displacement[i], 1e-14));
    }
    // a stiff oscillator rides with its base, a soft one stays where it is
    const std::array ends{1e-3 * seconds, 1e4 * seconds};
    const ResponseSpectrum extreme = compute_response_spectrum(motion, ends, 0.05);
    CHECK(extreme.pseudo_acceleration()[0] == relative(peak, 0.05));
    CHECK(extreme.acceleration[1] < 1e-3 * peak);
}

// Free vibration after a pulse of one step: u = U cos(ω_d t + φ) e^{−ζωt}. Undamped, its peaks are U, U ω and U ω² wherever samples fall.
TEST_CASE("peaks between the samples of an undamped free vibration are its amplitude at any period") {
    constexpr double kDt = 0.02;
    const TimeSeries motion = make_sine_acceleration({0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, kDt);
    for (const double period : {0.0101, 0.0153, 0.0333, 0.0407, 0.071, 0.077, 0.119, 0.23}) {
        CAPTURE(period);
        const double omega = 2.0 * pi / period;
        // a triangle is a box on a box: its transform is dt·(sin(ω dt/2)/(ω dt/2))²
        const double box = std::sin(0.5 * omega * kDt) / (0.5 * omega * kDt), amplitude = kDt * box * box / omega;
        // of the free vibration alone, where it is larger than the response to the pulse
        const ResponseSpectrum spectrum = compute_response_spectrum(motion, std::array{period * seconds}, 0.0);
        const std::array<double, 3> found{spectrum.displacement[0], spectrum.velocity[0] / omega, spectrum.acceleration[0] / omega / omega};
        const bool free_rules = period > 0.1;
        for (const double value : found) {
            if (free_rules) CHECK(value == relative(amplitude, 2e-5));
            if (!free_rules) CHECK(value >= amplitude * (1.0 - 2e-5));
        }
    }
}

/// Largest |u| and |u̇| of the exact solution, looked at `looks` times a period and 16 times a step at least: y = u̇ − λ̄u follows ẏ = λy − a,
/// λ = −ζω + iω_d.
std::array<double, 2> look_closely(const TimeSeries& motion, double period, double damping, double looks) {
    using Complex = std::complex<double>;
    const double omega = 2.0 * pi / period, damped = omega * std::sqrt(1.0 - damping * damping);
    const Complex lambda(-damping * omega, damped);
    const int parts = std::max(16, static_cast<int>(std::ceil(looks * motion.dt().value() / period)));
    const double h = motion.dt().value() / parts;
    const Complex decay = std::exp(lambda * h), constant = (decay - 1.0) / lambda, ramp = (constant - h) / lambda / h;
    Complex y;
    std::array<double, 2> most{};
    for (std::size_t i = 1; i < motion.size(); ++i) {
        const double first = motion.samples()[i - 1], rise = (motion.samples()[i] - first) / parts;
        for (int part = 0; part < parts; ++part) {
            y = decay * y - constant * (first + rise * part) - ramp * rise;
            const double u = y.imag() / damped;
            most[0] = std::max(most[0], std::abs(u));
            most[1] = std::max(most[1], std::abs(y.real() - damping * omega * u));
        }
    }
    return most;
}

/// Checks SD and SV of a motion against the exact solution.
void check_closely(const TimeSeries& motion, std::span<const double> periods, double damping) {
    for (const double period : periods) {
        CAPTURE(period);
        CAPTURE(damping);
        constexpr double kLooks = 64.0;  // a period: values at looks are up to (2π/64)²/8 = 1.2e-3 below the peak
        const std::array<double, 2> exact = look_closely(motion, period, damping, kLooks);
        const ResponseSpectrum spectrum = compute_response_spectrum(motion, std::array{period * seconds}, damping);
        const std::array<double, 2> found{spectrum.displacement[0], spectrum.velocity[0]};
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK(found[i] >= exact[i] * (1.0 - 2e-5));
            CHECK(found[i] <= exact[i] * 1.0025);
        }
    }
}

TEST_CASE("peaks between the samples are those of the exact solution at any period and damping") {
    const TimeSeries motion = make_sine_acceleration(make_noise(300, 5), 0.02);
    constexpr std::array kPeriods{0.004, 0.01, 0.013, 0.02, 0.033, 0.05, 0.075, 0.11, 0.3, 0.9, 2.7};
    for (const double damping : {0.001, 0.05, 0.3, 0.9}) check_closely(motion, kPeriods, damping);
    // above critical damping, and so stiff that its substeps are not fine: between the samples of the same motion given ten times as often
    std::vector<double> often;
    for (std::size_t i = 0; i < 10 * (motion.size() - 1) + 1; ++i) {
        const std::size_t at = std::min(i / 10, motion.size() - 2);
        often.push_back(motion.samples()[at] + (motion.samples()[at + 1] - motion.samples()[at]) * 0.1 * static_cast<double>(i - 10 * at));
    }
    const TimeSeries finer = make_sine_acceleration(often, 0.002);
    for (const double damping : {1.0, 2.0, 50.0, 100.0}) {
        for (const double period : {0.0001, 0.001, 0.01, 0.1, 1.0}) {
            CAPTURE(period);
            CAPTURE(damping);
            const ResponseSpectrum one = compute_response_spectrum(motion, std::array{period * seconds}, damping),
                                   two = compute_response_spectrum(finer, std::array{period * seconds}, damping);
            CHECK(one.displacement[0] == relative(two.displacement[0], 1e-3));
            CHECK(one.acceleration[0] == relative(two.acceleration[0], 1e-2));
        }
    }
}

TEST_CASE("a record scaled in time and amplitude has the scaled spectrum to the last bit when the factors are powers of two") {
    const std::vector<double> samples = make_noise(2000, 3);
    std::vector<double> scaled = samples;
    for (double& a : scaled) a *= 4.0;
    const std::vector<scaling::Time> periods = make_periods(0.02 * seconds, 3.0 * seconds, 13);
    std::vector<scaling::Time> scaled_periods = periods;
    for (scaling::Time& period : scaled_periods) period *= 0.125;
    const ResponseSpectrum one = compute_response_spectrum(make_sine_acceleration(samples, 0.005), periods);
    const ResponseSpectrum two = compute_response_spectrum(make_sine_acceleration(scaled, 0.005 * 0.125), scaled_periods);
    for (std::size_t i = 0; i < periods.size(); ++i) {
        CHECK(two.acceleration[i] == 4.0 * one.acceleration[i]);
        CHECK(two.velocity[i] == 0.5 * one.velocity[i]);
        CHECK(two.displacement[i] == 0.0625 * one.displacement[i]);
    }
}

TEST_CASE("impossible periods and damping ratios are refused in words") {
    const TimeSeries motion = make_sine_acceleration({0.0, 1.0, 0.0}, 0.01);
    const std::array good{1.0 * seconds}, negative{-1.0 * seconds};
    CHECK_THROWS_WITH_AS(compute_response_spectrum(motion, negative), "period is -1 s (must be 0 or more); change it", ProcessingError);
    CHECK_THROWS_WITH_AS(compute_response_spectrum(motion, good, -0.1),
                         "damping ratio is -0.1 (must be a fraction of critical from 0 to 100); give 0.05 for 5 %", ProcessingError);
    CHECK_THROWS_WITH_AS(compute_oscillator_response(motion, 0.0 * seconds), "period is 0 s (must be above 0); change it", ProcessingError);
    CHECK_THROWS_AS(compute_response_spectrum(integrate(motion), good), ProcessingError);
    CHECK_THROWS_AS(make_periods(1.0 * seconds, 0.5 * seconds, 10), ProcessingError);
}

TEST_CASE("rotated spectra hold the peaks between the samples, also of motions along one line") {
    const TimeSeries first = make_sine_acceleration(make_noise(300, 5), 0.02), second = make_sine_acceleration(make_noise(300, 6), 0.02);
    const auto turn = [&](double c, double s, const TimeSeries& one, const TimeSeries& other) {
        std::vector<double> samples;
        for (std::size_t i = 0; i < one.size(); ++i) samples.push_back(c * one.samples()[i] + s * other.samples()[i]);
        return one.with_samples(std::move(samples));
    };
    for (const double period : {0.01, 0.033, 0.075, 0.3, 2.0}) {
        CAPTURE(period);
        const std::array periods{period * seconds};
        std::array<double, 180> peaks{};
        for (std::size_t degree = 0; degree < peaks.size(); ++degree) {
            const double angle = static_cast<double>(degree) * (pi / 180.0);
            peaks[degree] =
                compute_response_spectrum(turn(std::cos(angle), std::sin(angle), first, second), periods).pseudo_acceleration()[0];
        }
        const RotatedPeaks found = compute_rotated_spectrum(first, second, periods)[0];
        std::sort(peaks.begin(), peaks.end());
        CHECK(found.least == relative(peaks.front(), 1e-4));
        CHECK(found.median == relative(0.5 * (peaks[89] + peaks[90]), 1e-4));
        CHECK(found.largest == relative(peaks.back(), 1e-4));
        const double alone = compute_response_spectrum(first, periods).pseudo_acceleration()[0];
        CHECK(compute_rotated_spectrum(first, turn(2.4, 0.0, first, second), periods)[0].largest == relative(2.6 * alone, 1e-4));
    }
}

TEST_CASE("rotated peaks are those of brute force, and of a circle the same in every direction") {
    const std::vector<double> x = make_noise(5000, 11), y = make_noise(5000, 12);
    std::array<double, 180> peaks{};
    for (std::size_t degree = 0; degree < peaks.size(); ++degree) {
        const double angle = static_cast<double>(degree) * (pi / 180.0), c = std::cos(angle), s = std::sin(angle);
        for (std::size_t i = 0; i < x.size(); ++i) peaks[degree] = std::max(peaks[degree], std::abs(x[i] * c + y[i] * s));
    }
    const RotatedPeaks found = find_rotated_peaks(x, y);
    CHECK(found.largest == peaks[static_cast<std::size_t>(found.largest_at)]);
    std::sort(peaks.begin(), peaks.end());
    CHECK(found.least == peaks.front());
    CHECK(found.median == 0.5 * (peaks[89] + peaks[90]));
    CHECK(found.largest == peaks.back());

    std::vector<double> circle_x, circle_y;
    for (int degree = 0; degree < 360; ++degree) {
        circle_x.push_back(std::cos(degree * pi / 180.0));
        circle_y.push_back(std::sin(degree * pi / 180.0));
    }
    const RotatedPeaks round = find_rotated_peaks(circle_x, circle_y);
    CHECK(round.least == relative(1.0, 1e-12));
    CHECK(round.largest == relative(1.0, 1e-12));
    // along a line RotD00 is what is left across it, one degree apart at most
    const std::vector<double> line{0.0, 1.0, -2.0, 0.5};
    const RotatedPeaks straight = find_rotated_peaks(line, std::vector<double>(4, 0.0));
    CHECK(straight.largest == 2.0);
    CHECK(straight.largest_at == 0.0);
    CHECK(straight.least < 1e-15);
    CHECK_THROWS_AS(find_rotated_peaks(line, std::vector<double>(3, 0.0)), ProcessingError);
}

/// PEER NGA-West2's own spectra of a pair of components: RotD50 and both, 5 %, in g.
struct PublishedSpectra {
    std::vector<scaling::Time> periods;
    std::vector<double> rotd50, h1, h2;
};

/// From reference/peer_nga_west2.json.gz, unpacked by gzip; empty when that is not to be had.
std::string unpack(const std::filesystem::path& file) {
    std::string text;
    FILE* const pipe = popen(("gzip -dc '" + file.string() + "'").c_str(), "r");  // NOLINT(cert-env33-c): a fixed command
    if (pipe == nullptr) return text;
    std::array<char, 65536> chunk{};
    for (std::size_t got = 1; got > 0;) {
        got = fread(chunk.data(), 1, chunk.size(), pipe);
        text.append(chunk.data(), got);
    }
    pclose(pipe);
    return text;
}

PublishedSpectra read_spectra(const nlohmann::json& record) {
    PublishedSpectra spectra;
    for (const double period : record.at("period")) spectra.periods.push_back(period * seconds);
    for (const nlohmann::json& entry : record.at("spectra")) {
        if (entry.at("damping") != 0.05) continue;
        spectra.rotd50 = entry.at("rotd50").get<std::vector<double>>();
        spectra.h1 = entry.at("h1").get<std::vector<double>>();
        spectra.h2 = entry.at("h2").get<std::vector<double>>();
    }
    return spectra;
}

TEST_CASE("spectra and RotD50 of Chino Hills with peaks at ten looks a period are PEER's own") {
    if (!tests::have_shared_records()) return;
    const auto table = nlohmann::json::parse(unpack(tests::shared_records() / "reference" / "peer_nga_west2.json.gz"));
    REQUIRE(table.size() == 2);
    const double g = scaling::kStandardGravity.value();
    for (const nlohmann::json& record : table) {
        const PublishedSpectra published = read_spectra(record);
        const auto load = [&](std::size_t i) {
            return read_record(tests::shared_records() / "peer" / record.at("fnames").at(i).get<std::string>()).components.at(0).series;
        };
        const TimeSeries first = load(0), second = load(1);
        for (std::size_t i = 0; i < published.periods.size(); ++i) {
            const double period = published.periods[i].value();
            CAPTURE(record.at("rsn").get<int>());
            CAPTURE(period);
            // PEER looks ten times a period at least, on straight lines between the samples; RotD50 has five digits
            const TimeSeries one = tests::look_ten_times(first, period), two = tests::look_ten_times(second, period);
            const auto psa = [&](const TimeSeries& motion) { return tests::sampled_spectrum(motion, period).pseudo_acceleration()[0]; };
            CHECK(psa(one) / g == relative(published.h1[i], 1e-4));
            CHECK(psa(two) / g == relative(published.h2[i], 1e-4));
            CHECK(tests::sampled_rotated(one, two, period).median / g == relative(published.rotd50[i], 1e-4));
            // the true peaks are at most as much higher as a quarter of a turn of π/5 allows: 1/cos(π/10)
            const double exact = compute_response_spectrum(first, std::array{period * seconds}).pseudo_acceleration()[0] / g;
            CHECK(exact >= published.h1[i] * (1.0 - 1e-4));
            CHECK(exact <= published.h1[i] / std::cos(pi / 10.0));
        }
    }
}

/// All accelerations of the shared records; a text file that names neither unit nor step gets both, since spectra do not depend on them.
std::vector<TimeSeries> load_all_accelerations() {
    std::vector<TimeSeries> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(tests::shared_records())) {
        if (!entry.is_regular_file() || entry.path().parent_path().filename() == "reference") continue;
        for (const ReadOptions& options : {ReadOptions{}, ReadOptions{.dt = 0.01 * seconds, .unit = "cm/s^2"}}) {
            try {
                const GroundMotion motion = read_record(entry.path(), options);
                for (const Component& component : motion.components) {
                    if (component.series.quantity() == SampleQuantity::acceleration) all.push_back(component.series);
                }
                break;
            } catch (const ReadError&) {
                continue;  // a spectrum file, or one that needs an option
            }
        }
    }
    return all;
}

TEST_SUITE("slow") {
    TEST_CASE("spectra of every shared record are those of the exact solution from 0.01 s on") {
        if (!tests::have_shared_records()) return;
        const std::vector<TimeSeries> all = load_all_accelerations();
        CHECK(all.size() >= 120);
        // each record at a third of the periods, each period with a third of the records
        constexpr std::array kPeriods{std::array{0.01, 0.05, 0.15, 1.0}, std::array{0.02, 0.075, 0.2, 3.0},
                                      std::array{0.03, 0.1, 0.5, 3.0}};
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::span<const double> samples = all[i].samples();
            if (std::all_of(samples.begin(), samples.end(), [](double a) { return a == 0.0; })) continue;
            check_closely(all[i], kPeriods[i % kPeriods.size()], 0.05);
        }
    }
}

}  // namespace
}  // namespace musim::records
