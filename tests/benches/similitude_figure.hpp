#pragma once

#include <string>
#include <vector>

#include "tests/benches/similitude_bench.hpp"

namespace musim::lsdem {

/// Figure of one law as an SVG document: on the left the models that are to be one curve with their prototype, on the right those that are
/// not, each with its predicted and measured ratio. Cases of other laws are passed over.
std::string make_similitude_svg(const std::string& law, const std::vector<SimilitudeOutcome>& outcomes);

}  // namespace musim::lsdem
