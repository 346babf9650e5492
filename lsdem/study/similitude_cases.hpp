#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lsdem/scene/scene.hpp"
#include "lsdem/study/similitude_scenes.hpp"
#include "scaling/similitude.hpp"

namespace musim::lsdem::study {

/// What is set wrong in a model on purpose.
enum class BrokenGroup {
    none,
    friction,   ///< μ
    gravity,    ///< g
    amplitude,  ///< acceleration of the base, its times kept
    duration,   ///< times of the base motion, its accelerations kept
    stiffness,  ///< of all contacts
};

std::string_view to_string(BrokenGroup group);

/// A quantity of the model over what the law asks for.
struct Break {
    BrokenGroup group = BrokenGroup::none;
    double factor = 1.0;
};

/// What is compared between model and prototype, both scaled back.
enum class Measure {
    peak,       ///< greatest displacement relative to the base, or tilt
    peak_time,  ///< when, since the base began to move
};

std::string_view to_string(Measure measure);

/// Model over prototype, as theory has it.
struct Prediction {
    double ratio = 1.0;
    double tolerance = 0.0;  ///< of the ratio, absolute: what the closed form leaves out
};

/// One model of one prototype, and what should come of it.
struct SimilitudeCase {
    std::string law;  ///< as in similitude_law_names()
    BenchScene scene = BenchScene::slide;
    scaling::Similitude similitude;
    Break broken = {};
    Measure measure = Measure::peak;
    Prediction prediction = {};
    bool collapses = false;  ///< every group that matters is equal: the curves are to be one, and `prediction` is 1
};

/// "mu", "froude", "exact", "cauchy", and "centrifuge", which is exact with λ_g = 1/λ_l in the prototype's own solid.
std::vector<std::string> similitude_law_names();

/// The cases of a law, or of all when the name is empty. Throws scaling::SimilitudeError for another name.
std::vector<SimilitudeCase> make_similitude_cases(const std::string& law = "");

/// Ratio of the measure from the groups of the model over those of the prototype; docs/similitude.md has the derivation. Throws
/// std::invalid_argument for the column, which has no closed form, and as the closed forms do.
Prediction predict(BenchScene scene, const scaling::Similitude& similitude, const Break& broken, Measure measure);

/// The similar twin of a prototype, with one quantity wrong.
scene::Scene make_model_scene(const SimilitudeCase& wanted);

}  // namespace musim::lsdem::study
