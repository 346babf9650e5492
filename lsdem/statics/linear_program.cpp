#include "lsdem/statics/linear_program.hpp"

#include <coin/Clp_C_Interface.h>

#include <algorithm>
#include <memory>

namespace musim::lsdem {

bool has_linear_programs() { return true; }

std::optional<std::vector<double>> find_least_cost(const LinearProgram& program, int most_iterations) {
    const std::unique_ptr<Clp_Simplex, decltype(&Clp_deleteModel)> solver(Clp_newModel(), Clp_deleteModel);
    Clp_setLogLevel(solver.get(), 0);
    Clp_loadProblem(solver.get(), static_cast<int>(program.columns()), static_cast<int>(program.right.size()), program.begin.data(),
                    program.row.data(), program.entry.data(), nullptr, program.most.data(), program.cost.data(), program.right.data(),
                    program.right.data());
    Clp_setMaximumIterations(solver.get(), most_iterations);
    // without a negative cost the dual simplex method begins feasible: it takes half to a third of the time
    const bool by_dual = std::all_of(program.cost.begin(), program.cost.end(), [](double cost) { return cost >= 0.0; });
    by_dual ? Clp_initialDualSolve(solver.get()) : Clp_initialSolve(solver.get());
    if (Clp_status(solver.get()) != 0) return std::nullopt;
    const double* const x = Clp_primalColumnSolution(solver.get());
    return std::vector<double>(x, x + program.columns());
}

}  // namespace musim::lsdem
