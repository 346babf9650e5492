#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "records/ground_motion.hpp"
#include "records/processing/butterworth.hpp"
#include "records/processing/processing.hpp"
#include "records/processing/resample.hpp"
#include "scaling/laws/similitude.hpp"

/// Processing as data: what is done to a record, step by step.
namespace musim::records {

/// The steps; what each does is said beside the function of its name.
namespace step {
struct Align {};
struct Level {};
struct Rest {
    bool displaced = false;  ///< at its end; else where it began
};
struct Differentiate {};
struct Baseline {
    int order = 1;
};
struct Taper {
    double fraction = 0.05;
};
struct Pad {
    scaling::Time before, after;
};
struct Cut {
    TimeWindow window;
};
/// All components, from where the first of them begins to where the last of them ends; translations say where, if there are any.
struct EnergyWindow {
    double from = 0.05, to = 0.95, margin = 0.0;
};
struct Filter {
    FilterBand band;
    int order = 2;
    FilterPhase phase = FilterPhase::zero;
};
struct Amplify {
    double factor = 1.0;
};
struct Resample {
    scaling::Time dt;
    Between between = Between::band_limited;
};
struct Rotate {
    double azimuth_deg = 0.0;
};
struct Integrate {
    bool by_frequency = false;
};
/// All components to accelerations, angular ones of rotations.
struct ToAcceleration {};
/// Adds the components ry and rz that waves along +x make, from those that are named; one of them may be missing.
struct SurfaceRotation {
    scaling::Velocity velocity;
    std::string vertical, transverse;
};
}  // namespace step

using Step = std::variant<step::Align, step::Level, step::Rest, step::Differentiate, step::Baseline, step::Taper, step::Pad, step::Cut,
                          step::EnergyWindow, step::Filter, step::Amplify, step::Resample, step::Rotate, step::Integrate,
                          step::ToAcceleration, step::SurfaceRotation>;
using Recipe = std::vector<Step>;

/// Reads {"schema": "musim-recipe/1", "steps": [{"step": "filter", "low": "0.05 Hz", "order": 2, "phase": "zero"}, ...]}; quantities are SI
/// numbers or text with a unit. `source` is named in messages. Throws ReadError `source: step N (name): what (why); what to do` for
/// anything else, unknown keys and missing ones included.
Recipe parse_recipe(std::string_view json, const std::string& source);

/// The same as text, one step a line, every number to the last bit.
std::string write_recipe(const Recipe& recipe);

/// Carries out all steps in turn on all components; each is a line of the history, as write_recipe() has it. A high-pass makes a record
/// one that is integrated without a filter. Throws ProcessingError, naming the step.
GroundMotion process(const GroundMotion& motion, const Recipe& recipe);

/// The steps that the history of a record names: applied to the record it was made from, they give it again.
Recipe recipe_of(const GroundMotion& motion);

/// The recipe for the model: times times λ_t, frequencies over it. Processing and rescaling can then be exchanged.
Recipe rescale(const Recipe& recipe, const scaling::Similitude& similitude);

}  // namespace musim::records
