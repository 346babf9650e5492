#pragma once

#include <string>
#include <vector>

#include "lsdem/model.hpp"

namespace musim::lsdem {

/// Errors that a program could make when it scales a structure, put into a model on purpose to see whether they are found.
enum class ModelError {
    // a property is 1 + size times what it should be
    normal_stiffness,
    shear_stiffness,
    friction,
    restitution,
    mass,
    gravity,
    record_step,
    absolute_tolerance,  ///< places rounded to whole multiples of size · 1 mm, whatever the scale: the mistake itself
    lost_friction        ///< what friction bore in the middle one of the contacts is dropped, whatever the size
};

/// "normal_stiffness" and so on.
std::string to_string(ModelError error);
/// In the order above.
std::vector<ModelError> all_model_errors();

/// Puts an error of this size [-] into a model.
void inject(ModelError error, double size, Model& model);

}  // namespace musim::lsdem
