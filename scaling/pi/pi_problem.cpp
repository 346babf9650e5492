#include "scaling/pi/pi_problem.hpp"

#include <fmt/format.h>

#include "scaling/detail/json_reading.hpp"

namespace musim::scaling {

std::vector<PiQuantity> parse_pi_problem(std::string_view text, std::string_view origin) {
    const std::string file(origin);
    const detail::Json document = detail::parse_json(text, file);
    const detail::PiRules rules;
    const JsonReader problem(document.is_object() && document.contains("problem") ? document["problem"] : document, rules, file);
    const detail::Json& json = problem.json();
    constexpr std::string_view kExample = R"({"quantities": [{"name": "v", "unit": "m/s"}, ...]})";
    if (!json.is_object()) problem.fail(fmt::format("not an object; write {}", kExample));
    if (problem.object({"quantities"}); !json.contains("quantities") || !json["quantities"].is_array()) {
        problem.fail(fmt::format("no list of \"quantities\"; write {}", kExample));
    }
    std::vector<PiQuantity> quantities;
    for (const JsonReader& entry : detail::list_at(problem, "quantities", "")) quantities.push_back(detail::parse_quantity_object(entry));
    try {
        check_quantities(quantities);
    } catch (const PiError& error) {
        problem.fail(error.what());
    }
    return quantities;
}

}  // namespace musim::scaling
