#pragma once

#include <string>
#include <vector>

namespace musim::lsdem {

/// Accuracy of a run, for scenes that do not want to choose every number.
enum class Accuracy { fast, standard, reference };

/// Settings that an accuracy stands for. Chosen from `musim bench accuracy`; docs/validation/accuracy.md has the sweep and the errors.
struct AccuracyPreset {
    double safety = 0.8;  ///< time step over the critical one
};

const AccuracyPreset& find_accuracy_preset(Accuracy accuracy);

/// "fast", "standard", "reference", in this order.
const std::vector<std::string>& accuracy_names();
std::string to_string(Accuracy accuracy);

}  // namespace musim::lsdem
