#include "lsdem/contract.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace {

#ifdef MUSIM_CONTRACTS
constexpr bool kChecksContracts = true;
#else
constexpr bool kChecksContracts = false;
#endif

/// The signal that ends a process which breaks a contract; 0: none does.
int break_a_contract() {
    const pid_t child = fork();
    if (child == 0) {
        std::fclose(stderr);
        EXPECTS(2 + 2 == 5);
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

}  // namespace

TEST_CASE("a broken contract ends the program where contracts are checked, and costs nothing elsewhere") {
    bool evaluated = false;
    EXPECTS((evaluated = true));
    CHECK(evaluated == kChecksContracts);
    evaluated = false;
    ENSURES((evaluated = true));
    CHECK(evaluated == kChecksContracts);
    CHECK(break_a_contract() == (kChecksContracts ? SIGABRT : 0));
}
