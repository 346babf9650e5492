#pragma once

namespace musim::tests {

/// Number of random trials that a test makes: an eighth of them under sanitizers, which watch memory and threads, not rare poses or means.
constexpr int trials(int count) {
#ifdef MUSIM_SANITIZED
    return count / 8;
#else
    return count;
#endif
}

}  // namespace musim::tests
