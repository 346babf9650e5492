#include "cli/damping_ratio.hpp"

#include <fmt/format.h>

#include "records/error.hpp"
#include "records/response_spectrum.hpp"

namespace musim::cli {
namespace {

/// The library takes any; a spectrum of more than twice the critical damping is a slip.
constexpr double kMostDamping = 2.0;

}  // namespace

void require_damping_ratio(double damping) {
    records::require_damping(damping);
    if (damping > kMostDamping) {
        throw records::ProcessingError(fmt::format("--damping: {:g} is {:g} % of critical (at most {:g} %); write 0.05 for 5 %", damping,
                                                   100.0 * damping, 100.0 * kMostDamping));
    }
}

}  // namespace musim::cli
