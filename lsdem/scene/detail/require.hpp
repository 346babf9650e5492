#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "lsdem/scene/detail/json_text.hpp"
#include "lsdem/scene/detail/scene_fields.hpp"
#include "scaling/quantity_text.hpp"

/// Checks of the values of a scene. All throw SceneError, `place: value (why); what to do`.
namespace musim::lsdem::detail {

/// Largest number of layers, nodes, ...: keeps mistaken input from exhausting the memory.
inline constexpr int kLargestCount = 1'000'000;

inline double to_si(double value) { return value; }

template <class Quantity>
double to_si(Quantity quantity) {
    return quantity.value();
}

inline std::string describe(double value) { return fmt::format("{:.6g}", value); }

template <class Quantity>
std::string describe(Quantity value) {
    return std::isfinite(value.value()) ? scaling::format_quantity(value) : describe(value.value());
}

template <class Part>
void require_fields(const Part& part, const JsonPlace& place);

/// Check of the numbers and quantities of a scene.
template <class Value>
void require(const Value& value, Range range, const JsonPlace& place) {
    if constexpr (std::is_same_v<Value, int>) {
        const int least = range == Range::four_or_more ? 4 : range == Range::three_or_more ? 3 : 1;
        if (range != Range::any && (value < least || value > kLargestCount)) {
            fail(place, fmt::format("{} (must be from {} to {}); correct the number", value, least, kLargestCount));
        }
    } else if constexpr (std::is_same_v<Value, double> || scaling::QuantityWithUnit<Value>) {
        const double number = to_si(value);
        const bool fits =
            std::isfinite(number) && (range == Range::finite || number > 0.0 || (range == Range::not_negative && number == 0.0));
        if (range == Range::any || fits) return;
        const char* wanted = range == Range::finite ? "be finite" : range == Range::positive ? "be positive" : "not be negative";
        fail(place, fmt::format("{} (must {}); correct the value", describe(value), wanted));
    } else if constexpr (kHasFields<Value>) {
        require_fields(value, place);
    }
}

template <class Value, std::size_t Count>
void require(const std::array<Value, Count>& values, Range range, const JsonPlace& place) {
    for (std::size_t k = 0; k < Count; ++k) require(values[k], range, place.at(k));
}

template <class Value>
void require(const std::vector<Value>& values, Range range, const JsonPlace& place) {
    for (std::size_t k = 0; k < values.size(); ++k) require(values[k], range, place.at(k));
}

template <class Value>
void require(const std::optional<Value>& value, Range range, const JsonPlace& place) {
    if (value) require(*value, range, place);
}

/// Each field of a part for itself.
template <class Part>
void require_fields(const Part& part, const JsonPlace& place) {
    for_each_field(part, [&](const auto& field, const auto& value) { require(value, field.range, place.at(field.key)); });
}

/// That four numbers (w, x, y, z) are a rotation, of whatever length.
void require_rotation(const std::array<double, 4>& quaternion, const JsonPlace& place);

/// That a name can head columns of tables, and is none that results give by themselves.
void check_name(const std::string& name, const JsonPlace& place);

/// That each of the sensors of a scene reads something that there is. Whether there is its block is found with the model.
void check_sensors(const Scene& scene, const JsonPlace& place);

/// Each of the loads of a scene by itself; which blocks they act on is found with the model.
void check_loads(const Scene& scene, const JsonPlace& place);

/// Each of the shapes of a scene, and that blocks name one of them.
void check_shapes(const Scene& scene, const JsonPlace& root);

/// That all blocks meet in one way: spheres, and boxes by nodes, at their nodes, all else by the overlap of flat faces.
void check_kinds(const Scene& scene, const JsonPlace& root);

}  // namespace musim::lsdem::detail
