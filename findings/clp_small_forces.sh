#!/usr/bin/env bash
# COIN-OR Clp 1.17.6: equilibrium of forces in newtons as a linear program.
# Guess: a program is feasible or not, whatever unit its numbers are in: a load F needs a reaction R = F, and R <= 0 cannot give it.
# Behaviour: infeasible (status 1) for 1 N, 1 mN and 1 uN; below the absolute tolerance of 1e-7 it is "optimal" (status 0) with R = F > 0, a
# bound that is broken by all of the load. Moments of blocks of 2 mm [N m] are as small. Divide by the weights first.
set -euo pipefail
source "$(dirname "$(realpath "$0")")/support/debian.sh"
unpack coinor-libclp-dev=1.17.6-3 coinor-libclp1=1.17.6-3 coinor-libcoinutils-dev=2.11.4+repack1-2 \
    coinor-libcoinutils3v5=2.11.4+repack1-2

cat > bear.cpp <<'CODE'
#include <ClpSimplex.hpp>
#include <cstdio>
#include <cstdlib>

/// A reaction that must bear `load` [N], and may only pull.
int main(int /*argc*/, char** argv) {
    const double load = std::atof(argv[1]), one = 1.0;
    const int first = 0;
    ClpSimplex program;
    program.setLogLevel(0);
    program.resize(0, 1);
    program.setColumnBounds(0, -1e30, 0.0);
    program.addRow(1, &first, &one, load, load);
    program.initialSolve();
    std::printf("status %d, R/F %g", program.status(), program.primalColumnSolution()[0] / load);
}
CODE
g++ -std=c++17 -isystem "$root/usr/include/coin" bear.cpp -L "$lib" -lClp -lCoinUtils -Wl,--allow-shlib-undefined -o bear
for load in 1 1e-3 1e-6; do expect "$load N" "$(./bear $load)" "status 1, R/F 0"; done
for load in 5e-8 1e-9; do expect "$load N" "$(./bear $load)" "status 0, R/F 1"; done
