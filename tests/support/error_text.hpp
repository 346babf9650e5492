#pragma once

#include <stdexcept>
#include <string>

namespace musim::tests {

/// What a call complains of; empty when it does not.
template <class Call>
std::string error_text(const Call& call) {
    try {
        call();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

}  // namespace musim::tests
