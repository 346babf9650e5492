#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lsdem/plot/figure.hpp"
#include "lsdem/report/report_figure.hpp"
#include "records/ground_motion.hpp"
#include "records/measures/record_curves.hpp"
#include "scaling/laws/model_scales.hpp"

namespace musim::lsdem {

/// Components as a figure.
struct RecordFigure {
    std::vector<records::ComponentCurves> components = {};  ///< with a similitude: each prototype is followed by its model
    double damping = 0.05;                                  ///< of PSA
    bool windowed = false;                                  ///< the histories are parts of the records
    std::string title = {};                                 ///< event, station
    std::optional<scaling::ModelScales> model_of = {};      ///< of the models
};

/// Styles that distinguish curves of components, or of prototypes and their models.
CurveStyles find_styles(bool with_models);

/// Event and station, as far as the record names them, or else its file.
std::string make_title(const records::GroundMotion& motion);

/// Histories above each other on one time axis with peaks and D5-95 marked, Fourier amplitudes and PSA beside them, on top a table of the
/// measures, each component's own, which is the twin too. CSV: all points of all curves, a row each: file, component, scale (prototype or
/// model), the names of value and abscissa with their units, both.
ReportFigure make_figure(const std::string& name, const RecordFigure& figure);

}  // namespace musim::lsdem
