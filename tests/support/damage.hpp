#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <random>
#include <string>

namespace musim::tests {

/// Number of damages that a test tries: as many as MUSIM_DAMAGES says (scripts/damage), else so many that it is quick.
inline int count_damages() {
    const char* wanted = std::getenv("MUSIM_DAMAGES");
    return wanted == nullptr ? 100 : std::atoi(wanted);
}

/// Damage that may happen to a file: a bit flipped, its end cut off, a run of bytes zeroed or written twice. Kind, place and length are
/// drawn; the bytes that come back differ from those given.
inline std::string damage(const std::string& bytes, std::mt19937_64& random) {
    std::string damaged = bytes;
    while (damaged == bytes) {
        const std::size_t at = random() % bytes.size();
        const std::size_t length = std::min(bytes.size() - at, std::size_t{1} << random() % 12);
        switch (random() % 4) {
            case 0:
                damaged[at] = static_cast<char>(damaged[at] ^ static_cast<char>(1U << random() % 8));
                break;
            case 1:
                damaged.resize(at);
                break;
            case 2:
                std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(at), length, '\0');
                break;
            default:
                damaged.insert(at, bytes, at, length);
        }
    }
    return damaged;
}

}  // namespace musim::tests
