#include "records/sample_unit.hpp"

#include <array>

#include "records/detail/text.hpp"
#include "scaling/units.hpp"

namespace musim::records {
namespace {

struct NamedQuantity {
    SampleQuantity quantity;
    std::string_view name;
    std::string_view si_unit;
};

constexpr std::array<NamedQuantity, 3> kQuantities{{
    {SampleQuantity::acceleration, "acceleration", "m/s^2"},
    {SampleQuantity::velocity, "velocity", "m/s"},
    {SampleQuantity::displacement, "displacement", "m"},
}};

const NamedQuantity& entry(SampleQuantity quantity) { return kQuantities.at(static_cast<std::size_t>(quantity)); }

const std::array<SampleUnit, 14>& known_units() {
    static const std::array<SampleUnit, 14> kUnits{{
        {"m/s^2", SampleQuantity::acceleration, 1.0},
        {"g", SampleQuantity::acceleration, scaling::kStandardGravity.value()},
        {"gal", SampleQuantity::acceleration, 0.01},
        {"cm/s^2", SampleQuantity::acceleration, 0.01},
        {"mm/s^2", SampleQuantity::acceleration, 0.001},
        {"nm/s^2", SampleQuantity::acceleration, 1e-9},
        {"m/s", SampleQuantity::velocity, 1.0},
        {"cm/s", SampleQuantity::velocity, 0.01},
        {"mm/s", SampleQuantity::velocity, 0.001},
        {"nm/s", SampleQuantity::velocity, 1e-9},
        {"m", SampleQuantity::displacement, 1.0},
        {"cm", SampleQuantity::displacement, 0.01},
        {"mm", SampleQuantity::displacement, 0.001},
        {"nm", SampleQuantity::displacement, 1e-9},
    }};
    return kUnits;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
}

// "(CM/SEC/SEC)." → "cm/s^2"
std::string canonical_spelling(std::string_view text) {
    std::string unit;
    for (const char letter : text) {
        if (std::string_view(" \t()[]").find(letter) == std::string_view::npos) unit += detail::to_lower(letter);
    }
    while (!unit.empty() && (unit.back() == '.' || unit.back() == ',')) unit.pop_back();
    replace_all(unit, "sec", "s");
    replace_all(unit, "**", "^");
    replace_all(unit, "/s/s", "/s^2");
    if (unit.ends_with("/s2")) unit.replace(unit.size() - 3, 3, "/s^2");
    return unit;
}

}  // namespace

std::string_view to_string(SampleQuantity quantity) { return entry(quantity).name; }

std::string_view si_unit_name(SampleQuantity quantity) { return entry(quantity).si_unit; }

std::optional<SampleQuantity> find_sample_quantity(std::string_view name) {
    for (const NamedQuantity& candidate : kQuantities) {
        if (detail::equal_ignoring_case(candidate.name, name)) return candidate.quantity;
    }
    return std::nullopt;
}

std::optional<SampleUnit> find_sample_unit(std::string_view text) {
    const std::string name = canonical_spelling(text);
    for (const SampleUnit& unit : known_units()) {
        if (unit.name == name) return unit;
    }
    return std::nullopt;
}

std::string sample_unit_names() {
    std::string names;
    for (const SampleUnit& unit : known_units()) names += (names.empty() ? "" : ", ") + std::string(unit.name);
    return names;
}

}  // namespace musim::records
