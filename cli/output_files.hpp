#pragma once

#include <string>
#include <vector>

namespace musim::cli {

/// Refuses an output that is one of the inputs or another output: the same path once links and relative parts are resolved. Asked before
/// anything is computed. Empty names are options that were not given; devices and pipes may occur twice, nothing in them is lost. Throws
/// records::WriteError `OUTPUT: cannot be written (...); name another file`.
void refuse_overwriting(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

}  // namespace musim::cli
