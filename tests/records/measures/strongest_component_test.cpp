#include <doctest/doctest.h>

#include "records/measures/intensity.hpp"

namespace musim::records {
namespace {

Component make_component(const char* name, std::optional<double> azimuth, double peak) {
    return {.name = name,
            .azimuth_deg = azimuth,
            .series = TimeSeries(SampleQuantity::acceleration, 0.0 * scaling::si::seconds, 0.01 * scaling::si::seconds,
                                 {0.0, -peak, 0.5 * peak})};
}

}  // namespace

TEST_CASE("the strongest component is looked for among those with a direction, where there are any") {
    GroundMotion motion;
    motion.components = {make_component("360", 360.0, 2.0), make_component("90", 90.0, 3.0), make_component("Up", {}, 5.0)};
    CHECK(find_strongest_horizontal(motion).name == "90");
    for (Component& component : motion.components) component.azimuth_deg.reset();
    CHECK(find_strongest_horizontal(motion).name == "Up");
}

}  // namespace musim::records
