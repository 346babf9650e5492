#pragma once

#include <cstdio>
#include <cstdlib>

/// Contracts of functions whose wrong call would corrupt results in silence: of a caller (EXPECTS) and of a function's own work (ENSURES).
/// A build with MUSIM_CONTRACTS (Debug, sanitizers) checks them and ends with the place; others do not evaluate them. Input of people is
/// no matter of contracts.
namespace musim::lsdem::detail {

[[noreturn]] inline void break_contract(const char* contract, const char* file, int line) {
    std::fprintf(stderr, "%s:%d: %s does not hold\n", file, line, contract);
    std::abort();
}

}  // namespace musim::lsdem::detail

#ifdef MUSIM_CONTRACTS
#define EXPECTS(condition) \
    ((condition) ? static_cast<void>(0) : ::musim::lsdem::detail::break_contract("EXPECTS(" #condition ")", __FILE__, __LINE__))
#define ENSURES(condition) \
    ((condition) ? static_cast<void>(0) : ::musim::lsdem::detail::break_contract("ENSURES(" #condition ")", __FILE__, __LINE__))
#else
#define EXPECTS(condition) static_cast<void>(0)
#define ENSURES(condition) static_cast<void>(0)
#endif
