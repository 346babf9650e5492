#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/record_curves.hpp"
#include "lsdem/study/figure.hpp"
#include "scaling/model_scales.hpp"

namespace musim::cli {

/// Components as a figure.
struct RecordFigure {
    std::vector<ComponentCurves> components;       ///< with a similitude: each prototype is followed by its model
    double damping = 0.05;                         ///< of PSA
    bool windowed = false;                         ///< the histories are parts of the records
    std::string title;                             ///< event, station
    std::optional<scaling::ModelScales> model_of;  ///< of the models
};

/// How curves of components, or of prototypes and their models, are told apart.
lsdem::study::CurveLooks find_looks(bool with_models);

/// Histories above each other on one time axis with peaks and D5-95 marked, Fourier amplitudes and PSA beside them, on top a table of the
/// measures, each component's own. An SVG document.
std::string make_svg(const RecordFigure& figure);

}  // namespace musim::cli
