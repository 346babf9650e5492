#pragma once

namespace musim::cli {

/// All that the program does: carries out the command line, prints what it has to say; its exit code. Throws nothing.
int run_program(int argc, char** argv);

}  // namespace musim::cli
