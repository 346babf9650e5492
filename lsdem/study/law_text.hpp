#pragma once

#include <string>

#include "lsdem/study/pair.hpp"

namespace musim::lsdem {

/// "chosen", "scene", "measured", "assumed".
std::string to_string(LawSource source);

/// By which law a model is shaken, how that is known, and from what specimen it starts, in one sentence. Empty for the image of its
/// prototype by law `exact`, and for a scene of the same structure, of which nothing need be said.
std::string describe_law(const PairedRun& model);

}  // namespace musim::lsdem
