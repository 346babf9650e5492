#include "records/formats/detail/made_record.hpp"

#include <fmt/format.h>

#include <cmath>

namespace musim::records::detail {

void require_positive(std::string_view kind, std::initializer_list<std::pair<std::string_view, double>> settings) {
    for (const auto& [setting, value] : settings) {
        if (value > 0.0 && std::isfinite(value)) continue;
        throw ProcessingError(fmt::format("{}: {} is {} (must be positive and finite); correct it", kind, setting, value));
    }
}

void require_steps(std::string_view kind, double steps, double fewest) {
    constexpr double kMostSteps = 1e8;  // a gigabyte: surely a slip in dt or duration
    if (steps >= fewest && steps <= kMostSteps) return;
    throw ProcessingError(fmt::format("{}: {} steps (must be {} to {}); change dt or duration", kind, steps, fewest, kMostSteps));
}

void require_sampled(std::string_view kind, double frequency, double dt) {
    constexpr double kFewestSamples = 8.0;  // per period
    if (frequency * dt * kFewestSamples <= 1.0) return;
    throw ProcessingError(fmt::format("{}: time step is {:.6g} s (too long for {:.6g} Hz, which needs {} samples a period); take {:.6g} s",
                                      kind, dt, frequency, kFewestSamples, 1.0 / (kFewestSamples * frequency)));
}

GroundMotion make_record(std::string event, std::string made, scaling::Time dt, std::vector<double> samples) {
    GroundMotion motion{.format = "synthetic"};
    motion.event = std::move(event);
    motion.components.push_back(
        {.name = "1", .azimuth_deg = std::nullopt, .series = {SampleQuantity::acceleration, {}, dt, std::move(samples)}});
    motion.history.push_back("made: " + std::move(made));
    return motion;
}

}  // namespace musim::records::detail
