#pragma once

#include "lsdem/run/simulate.hpp"
#include "lsdem/study/twin_growth.hpp"

namespace musim::lsdem {

/// The specimen of a twin: the prototype's with its blocks moved as `choice` says, in the units of its length (scale_specimen). Held blocks
/// are not moved.
Specimen make_twin(const Specimen& prototype, const TwinChoice& choice);

}  // namespace musim::lsdem
