#include "records/measures/record_curves.hpp"

#include <span>

#include "records/measures/intensity.hpp"
#include "records/measures/measures.hpp"
#include "records/measures/response_spectrum.hpp"
#include "records/processing/scale_record.hpp"

namespace musim::records {
namespace {

/// Units that a curve's axes are divided by.
struct CurveUnits {
    double x = 1.0;
    double y = 1.0;
};

/// The units that curves are drawn in, times the factors of a model.
class Units {
  public:
    Units(const std::optional<scaling::ModelScales>& model_of, scaling::Shaking direction) {
        if (!model_of) return;
        const scaling::ShakingScales scales = model_of->shaking(direction);
        time_ = model_of->time;
        g_ *= scales.acceleration;
        cm_s_ *= scales.velocity;
        cm_ *= scales.displacement;
    }

    CurveUnits of(CurveKind kind) const {
        switch (kind) {
            case CurveKind::velocity:
                return {time_, cm_s_};
            case CurveKind::displacement:
                return {time_, cm_};
            case CurveKind::arias:
                return {time_, 0.01};
            case CurveKind::fourier:
                return {1.0 / time_, g_ * time_};
            default:
                return {time_, g_};
        }
    }

  private:
    double time_ = 1.0, g_ = scaling::kStandardGravity.value(), cm_s_ = 0.01, cm_ = 0.01;
};

/// Adds curves of one component to its result.
class CurveMaker {
  public:
    CurveMaker(ComponentCurves& result, const Units& units, const std::optional<TimeWindow>& window)
        : result_(result), units_(units), window_(window) {}

    void add_history(CurveKind kind, const TimeSeries& series) {
        const TimeSeries shown = window_ ? cut(series, *window_) : series;
        std::vector<double> times(shown.size());
        for (std::size_t i = 0; i < times.size(); ++i) times[i] = shown.time(i).value();
        add(kind, times, shown.samples());
    }

    /// A history with its peak.
    template <class Peak>
    void add_history(CurveKind kind, const TimeSeries& series, const std::optional<Peak>& peak) {
        add_history(kind, series);
        if (!peak) return;
        const CurveUnits units = units_.of(kind);
        result_.peaks.push_back({kind, peak->time.value() / units.x, peak->value.value() / units.y});
    }

    void add(CurveKind kind, std::span<const double> x, std::span<const double> y) {
        const CurveUnits units = units_.of(kind);
        Curve curve{kind, {x.begin(), x.end()}, {y.begin(), y.end()}};
        for (double& value : curve.x) value /= units.x;
        for (double& value : curve.y) value /= units.y;
        result_.curves.push_back(std::move(curve));
    }

  private:
    ComponentCurves& result_;
    const Units& units_;
    std::optional<TimeWindow> window_;
};

/// Amplitudes above frequency zero, which a logarithmic axis does not show.
void add_fourier(CurveMaker& maker, const TimeSeries& acceleration) {
    const FourierAmplitudes spectrum = compute_fourier_amplitudes(acceleration);
    std::vector<double> frequencies(spectrum.amplitude.size());
    for (std::size_t i = 0; i < frequencies.size(); ++i) frequencies[i] = static_cast<double>(i) * spectrum.step.value();
    if (!frequencies.empty()) maker.add(CurveKind::fourier, std::span(frequencies).subspan(1), std::span(spectrum.amplitude).subspan(1));
}

void add_psa(CurveMaker& maker, const TimeSeries& acceleration, const std::optional<scaling::Frequency>& corner, double damping) {
    const ResponseSpectrum spectrum = compute_own_spectrum(acceleration, corner, damping);
    maker.add(CurveKind::psa, spectrum.period, spectrum.pseudo_acceleration());
}

}  // namespace

ComponentCurves compute_curves(const GroundMotion& motion, const Component& component, const CurveRequest& request,
                               const std::optional<scaling::ModelScales>& model_of) {
    const std::optional<scaling::Frequency> corner = motion.integration_corner;
    const MotionHistories histories = compute_histories(component.series, corner);
    ComponentCurves result{.file = motion.source,
                           .component = component.name,
                           .model = model_of.has_value(),
                           .corner = corner,
                           .intensity = compute_intensity(component.series, corner),
                           .curves = {},
                           .peaks = {},
                           .d5_95 = {}};
    const Units units(model_of, find_shaking(component));
    const double time = units.of(CurveKind::acceleration).x;
    std::optional<TimeWindow> window = request.window;
    if (window) *window = {time * window->start, time * window->end};
    CurveMaker maker(result, units, window);

    if (histories.acceleration) {
        const TimeSeries& acceleration = *histories.acceleration;
        maker.add_history(CurveKind::acceleration, acceleration, result.intensity.pga);
        // a share is drawn like a history, whatever its samples are called
        maker.add_history(CurveKind::arias, acceleration.with_samples(compute_arias_share(acceleration)));
        if (result.intensity.arias->value() > 0.0) {
            const TimeWindow strong = find_energy_window(acceleration, 0.05, 0.95, 0.0);
            result.d5_95 = {strong.start / time, strong.end / time};
        }
        add_fourier(maker, acceleration);
        add_psa(maker, acceleration, corner, request.damping);
    }
    if (histories.velocity) maker.add_history(CurveKind::velocity, *histories.velocity, result.intensity.pgv);
    maker.add_history(CurveKind::displacement, histories.displacement, result.intensity.pgd);
    return result;
}

}  // namespace musim::records
