#pragma once

#include <optional>
#include <string>
#include <vector>

#include "records/ground_motion.hpp"
#include "records/measures/intensity.hpp"
#include "records/processing/processing.hpp"
#include "scaling/laws/model_scales.hpp"

namespace musim::records {

/// Kind of a record's curve.
enum class CurveKind { acceleration, velocity, displacement, arias, fourier, psa };

/// One curve: g, cm/s, cm, % of the Arias intensity, g·s (Fourier amplitude) or g (PSA) over s, Hz (Fourier amplitude) or s (PSA).
struct Curve {
    CurveKind kind = CurveKind::acceleration;
    std::vector<double> x, y;
};

/// A largest absolute value, with its sign and time.
struct CurvePeak {
    CurveKind kind = CurveKind::acceleration;
    double time = 0.0, value = 0.0;  ///< in the units of the curve
};

/// All curves of one component; those that its quantity does not give are left out. A model's are divided by their factors, so that they
/// fall on the prototype's.
struct ComponentCurves {
    std::string file;
    std::string component;
    bool model = false;
    std::optional<scaling::Frequency> corner;  ///< of the high-pass before integration, the component's own
    Intensity intensity;                       ///< the component's own, a model's not divided
    std::vector<Curve> curves;
    std::vector<CurvePeak> peaks;     ///< on the curves, in the order of their kinds
    std::optional<TimeWindow> d5_95;  ///< from 5 % to 95 % of the Arias intensity, on the curves' time
};

/// Request of what is drawn of every component.
struct CurveRequest {
    double damping = 0.05;
    std::optional<TimeWindow> window;  ///< of the histories, in the time of the prototype; peaks and spectra are of all samples
};

/// Curves of a component of `motion`, which is integrated as `record info` does. With model scales, it is taken for the model's. Throws
/// ProcessingError for a window beyond the record and a damping ratio that is none.
ComponentCurves compute_curves(const GroundMotion& motion, const Component& component, const CurveRequest& request,
                               const std::optional<scaling::ModelScales>& model_of = std::nullopt);

}  // namespace musim::records
