// A law of one's own: a model in the same water keeps the Reynolds number; gravity and friction are not held.
#include <fmt/format.h>

#include <exception>

#include "scaling/scaling.hpp"

constexpr const char* kLaw = R"law({
    "schema": "musim-law/1", "name": "reynolds", "title": "viscosity governs",
    "description": "Keeps the Reynolds number of the flow around blocks.",
    "extends": "mechanics", "sources": ["own"], "assumptions": ["rigid blocks", "gravity and friction do not count"],
    "quantities": [{"name": "nu", "unit": "m^2/s", "meaning": "kinematic viscosity of the fluid"}],
    "chosen": [{"name": "l"}, {"name": "nu", "default": 1}, {"name": "rho", "default": 1}],
    "held": ["v*l/nu"], "watched": ["v/sqrt(g*l)"]
})law";

int main() try {
    using namespace musim::scaling;
    const ScaleLaw law = parse_scale_law(kLaw, "own_law.cpp");
    const SolvedLaw model = solve_law(law, {{"l", 1.0 / 25.0}});
    for (const char* name : {"t", "v", "a", "m"}) fmt::print("{} {:.6g}\n", name, model.factor(name).value());
} catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
}
