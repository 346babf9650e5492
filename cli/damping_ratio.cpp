#include "cli/damping_ratio.hpp"

#include <fmt/format.h>

#include "cli/options.hpp"
#include "records/error.hpp"
#include "records/measures/response_spectrum.hpp"

namespace musim::cli {
namespace {

/// The library takes any; a spectrum of more than twice the critical damping is a slip.
constexpr double kMostDamping = 2.0;

}  // namespace

CLI::Validator damping_ratio() {
    return {[](const std::string& text) -> std::string {
                Number damping;
                lexical_cast(text, damping);
                try {
                    records::require_damping(damping);
                } catch (const records::ProcessingError& error) {
                    return error.what();
                }
                if (damping <= kMostDamping) return "";
                return fmt::format("{} is {:g} % of critical (at most {:g} %); write 0.05 for 5 %", text, 100.0 * damping,
                                   100.0 * kMostDamping);
            },
            ""};
}

}  // namespace musim::cli
