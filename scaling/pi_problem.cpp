#include "scaling/pi_problem.hpp"

#include <fmt/format.h>

#include "scaling/detail/json_reading.hpp"

namespace musim::scaling {

std::vector<PiQuantity> parse_pi_problem(std::string_view text, std::string_view origin) {
    const detail::Json document = detail::parse_json(text, origin);
    const detail::Json& problem = document.is_object() && document.contains("problem") ? document["problem"] : document;
    constexpr std::string_view kExample = R"({"quantities": [{"name": "v", "unit": "m/s"}, ...]})";
    if (!problem.is_object()) detail::fail_at(origin, fmt::format("not an object; write {}", kExample));
    detail::refuse_unknown_keys(problem, {"quantities"}, origin);
    if (!problem.contains("quantities") || !problem["quantities"].is_array()) {
        detail::fail_at(origin, fmt::format("no list of \"quantities\"; write {}", kExample));
    }
    std::vector<PiQuantity> quantities;
    for (const detail::Json& object : problem["quantities"]) {
        quantities.push_back(detail::parse_quantity_object(object, fmt::format("{}: /quantities/{}", origin, quantities.size())));
    }
    try {
        check_quantities(quantities);
    } catch (const PiError& error) {
        detail::fail_at(origin, error.what());
    }
    return quantities;
}

}  // namespace musim::scaling
