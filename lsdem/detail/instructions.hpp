#pragma once

/// One binary picks the widest instructions at run time. A kernel is written once and compiled for each; IEEE arithmetic in a fixed order
/// gives all the same bits.
namespace musim::lsdem::detail {

enum class Instructions {
    plain,  ///< what every x86-64 has, or another processor
    avx2,   ///< four doubles in one register
    avx512  ///< eight
};

/// The widest that this machine has, or that it is limited to.
Instructions active_instructions();

/// No wider than `most` from now on; for comparisons of the two paths. Not while a simulation runs on another thread.
void limit_instructions(Instructions most);

/// The one of three that suits the machine.
template <class Function>
Function* widest(Function* by_512, Function* by_256, Function* plain) {
    const Instructions most = active_instructions();
    return most >= Instructions::avx512 ? by_512 : most >= Instructions::avx2 ? by_256 : plain;
}

}  // namespace musim::lsdem::detail

#if defined(__x86_64__)
#define MUSIM_AVX2 [[gnu::target("avx2")]]
#else
#define MUSIM_AVX2
#endif

/// Functions that take or return lanes are always inlined: the way of four lanes into and out of a function depends on the instructions
/// that it is compiled for, and what both paths call is compiled for the plain ones. A lambda says so before its body.
#define MUSIM_INLINE_LAMBDA __attribute__((always_inline))
