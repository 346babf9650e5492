#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scaling/laws/scale_law.hpp"

namespace musim::scaling {

/// Names of the laws that come with musim (scaling/laws/, compiled in), sorted.
const std::vector<std::string>& scale_law_names();

/// The law of that name that comes with musim, if there is one.
std::optional<ScaleLaw> find_scale_law(std::string_view name);

/// A law by name, or else from a file. Throws PiError: neither, or what parse_scale_law() refuses.
ScaleLaw load_scale_law(const std::string& name_or_file);

/// "there is no law \"frode\"; choose one of ...", for messages.
std::string no_such_law(std::string_view name);

}  // namespace musim::scaling
