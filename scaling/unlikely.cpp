#include "scaling/unlikely.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scaling/angle.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::scaling {
namespace {

/// The limits of the header: of words only.
constexpr double kLeastDensity = 50.0;                       // [kg/m³]
constexpr double kMostFriction = 5.0, kLargestAngle = 90.0;  // [-], [degrees]
constexpr double kLargestEdge = 25.0;                        // [m]

}  // namespace

std::optional<std::string> describe_unlikely_density(Density density) {
    const double value = density.value();
    if (!(value > 0.0 && value < kLeastDensity)) return std::nullopt;
    return fmt::format(
        "{:.6g} kg/m^3 is lighter than any wood or stone; of a density in g/cm^3 or a unit weight write the unit, \"{:.6g} {}\"", value,
        value, value < 10.0 ? "g/cm^3" : "kN/m^3");
}

std::optional<std::string> describe_unlikely_friction(double friction) {
    if (!(friction > kMostFriction && friction <= kLargestAngle)) return std::nullopt;
    return fmt::format("{:.6g} is taken as the coefficient of friction; of an angle of {:.6g} degrees write its tangent{}", friction,
                       friction, friction < kLargestAngle ? fmt::format(", {:.3g}", std::tan(friction * kDegree)) : "");
}

std::optional<std::string> describe_unlikely_length_factor(double factor, const std::string& option) {
    if (!(factor > 1.0)) return std::nullopt;
    return fmt::format("{1}{0:.7g} makes the model larger than the prototype; a model at 1:{0:.7g} is {1}1/{0:.7g}", factor, option);
}

std::optional<std::string> describe_unlikely_edge(Length edge) {
    if (!(edge.value() > kLargestEdge)) return std::nullopt;
    return fmt::format("an edge is {:.6g} m long; of millimetres write \"{:.6g} mm\"", edge.value(), edge.value());
}

}  // namespace musim::scaling
