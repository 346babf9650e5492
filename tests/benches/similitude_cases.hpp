#pragma once

#include <string>
#include <vector>

#include "tests/benches/similitude_model.hpp"
#include "tests/benches/similitude_prediction.hpp"
#include "tests/benches/similitude_scenes.hpp"

namespace musim::lsdem {

/// One model of one prototype, and what should come of it.
struct SimilitudeCase {
    std::string law;  ///< as in similitude_law_names()
    BenchScene scene = BenchScene::slide;
    TwinScales scales;
    Break broken = {};
    Measure measure = Measure::peak;
    Prediction prediction = {};
    bool collapses = false;  ///< every group that matters is equal: the curves are to be one, and `prediction` is 1
};

/// The laws that are tried: all that come with musim but "mechanics", which says nothing about forces.
const std::vector<std::string>& similitude_law_names();

/// The cases of a law, or of all when the name is empty. Throws scaling::SimilitudeError for another name.
std::vector<SimilitudeCase> make_similitude_cases(const std::string& law = "");

}  // namespace musim::lsdem
