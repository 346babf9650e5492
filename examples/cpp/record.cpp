// Demand of a record on a structure: the peak of each component and its spectral acceleration at a period, as recorded and at 1:25.
#include <fmt/format.h>

#include <array>
#include <exception>
#include <stdexcept>

#include "records/records.hpp"
#include "scaling/scaling.hpp"

int main(int argc, char** argv) try {
    using namespace musim;
    if (argc != 3) throw std::invalid_argument("usage: record RECORD PERIOD (\"0.5 s\")");
    const records::GroundMotion motion = records::read_record(argv[1]);
    const auto period = scaling::parse_quantity<scaling::Time>(argv[2]);
    const auto similitude = scaling::make_similitude("froude", {.length = 1.0 / 25.0});

    for (const records::Component& component : motion.components) {
        const auto peak = records::find_peak_acceleration(component.series);
        const std::array periods{period}, periods_of_model{similitude.to_model(period)};
        const auto model = records::rescale(component.series, scaling::ModelScales(similitude));
        fmt::print("{}: peak {} at {}, PSA {:.4g} m/s^2, of the model {:.4g} m/s^2\n", component.name, scaling::format_quantity(peak.value),
                   scaling::format_quantity(peak.time),
                   records::compute_response_spectrum(component.series, periods).pseudo_acceleration().front(),
                   records::compute_response_spectrum(model, periods_of_model).pseudo_acceleration().front());
    }
} catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
}
