#include "records/ground_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

#include "records/detail/text.hpp"

namespace musim::records {
namespace {

// "090" and "90" are the same direction, "000" and "0" as well
std::string_view without_leading_zeros(std::string_view name) {
    while (name.size() > 1 && name.front() == '0' && detail::is_digit(name[1])) name.remove_prefix(1);
    return name;
}

}  // namespace

const Component& GroundMotion::find_component(std::string_view name) const {
    const Component* found = nullptr;
    const std::string where = source.empty() ? "record" : source;
    for (const Component& component : components) {
        if (!detail::equal_ignoring_case(without_leading_zeros(component.name), without_leading_zeros(name))) continue;
        if (found != nullptr) {
            throw ReadError(
                fmt::format("{}: component '{}' occurs more than once (components: {}); split the file", where, name, component_names()));
        }
        found = &component;
    }
    const std::optional<std::size_t> number = format == kTextFormat ? detail::parse_count(name) : std::nullopt;
    if (found == nullptr && number && *number >= 1 && *number <= components.size()) return components[*number - 1];
    if (found == nullptr) {
        throw ReadError(fmt::format("{}: no component '{}' (components: {}); name one of these", where, name, component_names()));
    }
    return *found;
}

std::string GroundMotion::component_names() const {
    std::string names;
    for (const Component& component : components) names += (names.empty() ? "" : ", ") + component.name;
    return names;
}

std::optional<double> find_azimuth_deg(std::string_view component_name) {
    if (detail::equal_ignoring_case(component_name, "N")) return 0.0;
    if (detail::equal_ignoring_case(component_name, "E")) return 90.0;
    if (detail::equal_ignoring_case(component_name, "S")) return 180.0;
    if (detail::equal_ignoring_case(component_name, "W")) return 270.0;
    const std::optional<double> degrees = detail::parse_real(component_name);
    if (!degrees || *degrees < 0.0 || *degrees > 360.0) return std::nullopt;
    return degrees;
}

bool is_rotation(const Component& component) { return is_rotation(component.series.quantity()); }

bool is_named_as_rotation(std::string_view name) {
    std::string low;
    for (const char letter : name) {
        if (letter != '_' && letter != '-' && letter != ' ') low += detail::to_lower(letter);
    }
    constexpr std::string_view kNames[] = {"roll", "pitch", "yaw", "rx", "ry", "rz", "rotx", "roty", "rotz", "thetax", "thetay", "thetaz"};
    if (std::find(std::begin(kNames), std::end(kNames), low) != std::end(kNames)) return true;
    if (low.starts_with("rotation")) return true;
    return low.size() == 3 && low[1] == 'j' && std::string_view("zne123").find(low[2]) != std::string_view::npos;
}

bool is_vertical(const Component& component) {
    if (is_rotation(component)) return false;
    if (component.up) return true;
    if (component.azimuth_deg) return false;
    std::string name;
    for (const char letter : component.name) name += detail::to_lower(letter);
    while (!name.empty() && name.back() >= '0' && name.back() <= '9') name.pop_back();
    if (name.size() == 3 && name.back() == 'z') return true;
    constexpr std::string_view kNames[] = {"up", "ud", "u-d", "u", "z", "v", "ver", "vert", "vertical", "down", "dwn"};
    return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

}  // namespace musim::records
