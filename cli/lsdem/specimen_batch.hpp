#pragma once

#include <string>

#include "lsdem/run/specimen_batch.hpp"

/// Parts that the commands which prepare specimens have in common.
namespace musim::cli {

/// A batch without scene and seeds that goes to `folder` and gives its warnings on stderr.
lsdem::SpecimenBatch begin_batch(const std::string& folder, int threads, double checkpoint_interval);

/// One line on stderr when blocks of a specimen fell while it was prepared.
void warn_of_fallen(const lsdem::SpecimenReport& report);

}  // namespace musim::cli
