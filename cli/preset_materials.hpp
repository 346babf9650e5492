#pragma once

#include <vector>

#include "records/design/design.hpp"

namespace musim::cli {

/// The measured materials of scenes by their names, face stiffnesses as moduli of the solid; for files of designs and properties.
std::vector<records::Material> make_preset_materials();

}  // namespace musim::cli
