#pragma once

#include <string>

namespace musim::lsdem {

/// Build on which the kernel's bits may depend besides its source: compiler and version, processor family, options of the compiler other
/// than warnings and debugging. Two builds of equal text give equal bits.
std::string describe_build();

}  // namespace musim::lsdem
