#include "lsdem/statics/linear_program.hpp"

namespace musim::lsdem {

bool has_linear_programs() { return false; }

std::optional<std::vector<double>> find_least_cost(const LinearProgram& /*program*/, int /*most_iterations*/) { return std::nullopt; }

}  // namespace musim::lsdem
