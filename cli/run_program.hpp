#pragma once

namespace musim::cli {

/// All that the program does: carries out a command line, prints what it has to say; its exit code. Throws nothing. A process may carry out
/// several, one after the other.
int run_program(int argc, char** argv);

}  // namespace musim::cli
