#include "records/sample_unit.hpp"

#include <array>
#include <utility>

#include "records/detail/text.hpp"
#include "scaling/angle.hpp"
#include "scaling/units.hpp"

namespace musim::records {
namespace {

struct NamedQuantity {
    SampleQuantity quantity;
    std::string_view name;
    std::string_view si_unit;
};

constexpr std::array<NamedQuantity, 6> kQuantities{{
    {SampleQuantity::acceleration, "acceleration", "m/s^2"},
    {SampleQuantity::velocity, "velocity", "m/s"},
    {SampleQuantity::displacement, "displacement", "m"},
    {SampleQuantity::angular_acceleration, "angular acceleration", "rad/s^2"},
    {SampleQuantity::angular_velocity, "angular velocity", "rad/s"},
    {SampleQuantity::angle, "angle", "rad"},
}};
constexpr int kDerivatives = 3;  ///< quantities of a translation, and of a rotation, the highest derivative first

const NamedQuantity& entry(SampleQuantity quantity) { return kQuantities.at(static_cast<std::size_t>(quantity)); }

constexpr double kFoot = 0.3048;  // m, by definition; an inch is a twelfth

const std::array<SampleUnit, 42>& known_units() {
    using scaling::kDegree;
    constexpr SampleQuantity kTurn = SampleQuantity::angle, kRate = SampleQuantity::angular_velocity,
                             kTurnAcceleration = SampleQuantity::angular_acceleration;
    static const double kG = scaling::kStandardGravity.value();
    static const std::array<SampleUnit, 42> kUnits{{
        {"m/s^2", SampleQuantity::acceleration, 1.0},
        {"g", SampleQuantity::acceleration, kG},
        {"mg", SampleQuantity::acceleration, 1e-3 * kG},
        {"ug", SampleQuantity::acceleration, 1e-6 * kG},
        {"%g", SampleQuantity::acceleration, 0.01 * kG},
        {"gal", SampleQuantity::acceleration, 0.01},
        {"mgal", SampleQuantity::acceleration, 1e-5},
        {"cm/s^2", SampleQuantity::acceleration, 0.01},
        {"mm/s^2", SampleQuantity::acceleration, 0.001},
        {"um/s^2", SampleQuantity::acceleration, 1e-6},
        {"nm/s^2", SampleQuantity::acceleration, 1e-9},
        {"in/s^2", SampleQuantity::acceleration, kFoot / 12.0},
        {"ft/s^2", SampleQuantity::acceleration, kFoot},
        {"m/s", SampleQuantity::velocity, 1.0},
        {"cm/s", SampleQuantity::velocity, 0.01},
        {"mm/s", SampleQuantity::velocity, 0.001},
        {"um/s", SampleQuantity::velocity, 1e-6},
        {"nm/s", SampleQuantity::velocity, 1e-9},
        {"in/s", SampleQuantity::velocity, kFoot / 12.0},
        {"ft/s", SampleQuantity::velocity, kFoot},
        {"m", SampleQuantity::displacement, 1.0},
        {"cm", SampleQuantity::displacement, 0.01},
        {"mm", SampleQuantity::displacement, 0.001},
        {"um", SampleQuantity::displacement, 1e-6},
        {"nm", SampleQuantity::displacement, 1e-9},
        {"in", SampleQuantity::displacement, kFoot / 12.0},
        {"ft", SampleQuantity::displacement, kFoot},
        {"rad", kTurn, 1.0},
        {"mrad", kTurn, 1e-3},
        {"urad", kTurn, 1e-6},
        {"nrad", kTurn, 1e-9},
        {"deg", kTurn, kDegree},
        {"rad/s", kRate, 1.0},
        {"mrad/s", kRate, 1e-3},
        {"urad/s", kRate, 1e-6},
        {"nrad/s", kRate, 1e-9},
        {"deg/s", kRate, kDegree},
        {"mdeg/s", kRate, 1e-3 * kDegree},
        {"rad/s^2", kTurnAcceleration, 1.0},
        {"mrad/s^2", kTurnAcceleration, 1e-3},
        {"urad/s^2", kTurnAcceleration, 1e-6},
        {"deg/s^2", kTurnAcceleration, kDegree},
    }};
    return kUnits;
}

using Replacement = std::pair<std::string_view, std::string_view>;

/// Letters beyond ASCII in units, in UTF-8 and as the single bytes of ISO 8859-1.
constexpr Replacement kLetters[] = {
    {"\xC2\xB2", "2"},     {"\xC2\xB3", "3"},     {"\xC2\xB9", "1"},     {"\xE2\x81\xBB", "-"},
    {"\xE2\x88\x92", "-"}, {"\xC2\xB7", "*"},     {"\xE2\x8B\x85", "*"}, {"\xC3\x97", "*"},
    {"\xC2\xB5", "u"},     {"\xCE\xBC", "u"},     {"\xC2\xB0", "deg"},   {"\xE2\x80\xB0", "o/oo"},
    {"\xC2\xA0", " "},     {"\xE2\x80\xAF", " "}, {"\xCE\xA9", "ohm"},   {"\xB2", "2"},
    {"\xB7", "*"},         {"\xB5", "u"},         {"\xB0", "deg"},
};

/// Words and spellings, longer ones before what they contain.
constexpr Replacement kSpellings[] = {
    {"**", "^"},
    {"squared", "^2"},
    {"metre", "meter"},
    {"centimeters", "cm"},
    {"centimeter", "cm"},
    {"millimeters", "mm"},
    {"millimeter", "mm"},
    {"micrometers", "um"},
    {"micrometer", "um"},
    {"microns", "um"},
    {"micron", "um"},
    {"nanometers", "nm"},
    {"nanometer", "nm"},
    {"meters", "m"},
    {"meter", "m"},
    {"inches", "in"},
    {"inch", "in"},
    {"feet", "ft"},
    {"foot", "ft"},
    {"seconds", "s"},
    {"second", "s"},
    {"secs", "s"},
    {"sec", "s"},
    {"milligals", "mgal"},
    {"milligal", "mgal"},
    {"gals", "gal"},
    {"milli-g", "mg"},
    {"milli g", "mg"},
    {"millig", "mg"},
    {"micro-g", "ug"},
    {"micro g", "ug"},
    {"percent of g", "%g"},
    {"percent g", "%g"},
    {"% of g", "%g"},
    {"g's", "g"},
    {" per ", "/"},
    {"_per_", "/"},
    {"milliradian", "mrad"},
    {"microradian", "urad"},
    {"nanoradian", "nrad"},
    {"radians", "rad"},
    {"radian", "rad"},
    {"rads", "rad"},
    {"degrees", "deg"},
    {"degree", "deg"},
    {"degs", "deg"},
};

/// Names of their own.
constexpr Replacement kAliases[] = {
    {"gs", "g"},      {"g0", "g"},       {"gn", "g"},        {"g_n", "g"},     {"g_0", "g"},
    {"kine", "cm/s"}, {"kines", "cm/s"}, {"ips2", "in/s^2"}, {"ips", "in/s"},  {"fps2", "ft/s^2"},
    {"fps", "ft/s"},  {"\"", "in"},      {"pctg", "%g"},     {"dps", "deg/s"}, {"mdps", "mdeg/s"},
};

/// Endings that make an acceleration and a velocity of a length or an angle, blanks, brackets and signs of products left out.
constexpr std::string_view kPerSecondSquared[] = {"/s^2", "/s2",  "/s/s", "/ss",  "s^-2", "s-2", "ps2", "ps^2", "psps",
                                                  "_s2",  "_s^2", "_s_2", "_s-2", "_ps2", "s2",  "ss",  "pss",  "_s_s"};
constexpr std::string_view kPerSecond[] = {"/s", "s^-1", "s-1", "ps", "_s", "_s-1", "_ps"};
constexpr std::string_view kLengths[] = {"nm", "um", "mm", "cm", "in", "ft", "m", "nrad", "urad", "mrad", "rad", "mdeg", "deg"};

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
}

bool contains(const auto& list, std::string_view text) {
    for (const std::string_view entry : list)
        if (entry == text) return true;
    return false;
}

/// "cms-2" → "cm/s^2", the name of a known unit; the text itself where it is none.
std::string unit_name(std::string_view text) {
    for (const auto& [alias, name] : kAliases)
        if (alias == text) return std::string(name);
    for (const std::string_view length : kLengths) {
        if (!text.starts_with(length)) continue;
        const std::string_view rest = text.substr(length.size());
        if (contains(kPerSecondSquared, rest)) return std::string(length) + "/s^2";
        if (contains(kPerSecond, rest)) return std::string(length) + "/s";
        // "ms" is a millisecond
        if (rest == "s" && length.size() == 2) return std::string(length) + "/s";
    }
    return std::string(text);
}

bool are_brackets(char open, char close) {
    return (open == '(' && close == ')') || (open == '[' && close == ']') || (open == '{' && close == '}') ||
           (open == '<' && close == '>') || (open == '\'' && close == '\'') || (open == '"' && close == '"');
}

template <class Is>
std::string list_units(const Is& is) {
    std::string names;
    for (const SampleUnit& unit : known_units())
        if (is(unit)) names += (names.empty() ? "" : ", ") + std::string(unit.name);
    return names;
}

}  // namespace

std::string_view to_string(SampleQuantity quantity) { return entry(quantity).name; }

bool is_rotation(SampleQuantity quantity) { return static_cast<int>(quantity) >= kDerivatives; }

int derivative_order(SampleQuantity quantity) { return kDerivatives - 1 - static_cast<int>(quantity) % kDerivatives; }

SampleQuantity find_quantity(bool of_rotation, int derivatives) {
    return static_cast<SampleQuantity>((of_rotation ? kDerivatives : 0) + kDerivatives - 1 - derivatives);
}

std::string_view si_unit_name(SampleQuantity quantity) { return entry(quantity).si_unit; }

std::optional<SampleQuantity> find_sample_quantity(std::string_view name) {
    std::string plain(name);
    for (char& letter : plain)
        if (letter == '_' || letter == '-') letter = ' ';
    for (const NamedQuantity& candidate : kQuantities) {
        if (detail::equal_ignoring_case(candidate.name, plain)) return candidate.quantity;
    }
    return std::nullopt;
}

std::string sample_quantity_names() {
    std::string names;
    for (const NamedQuantity& each : kQuantities) names += (names.empty() ? "" : ", ") + std::string(each.name);
    return names;
}

std::string plain_unit_text(std::string_view text) {
    std::string plain(text);
    for (const auto& [from, to] : kLetters) replace_all(plain, from, to);
    for (char& letter : plain) letter = detail::to_lower(letter);
    std::string_view core = detail::trim(plain);
    for (std::size_t before = 0; before != core.size();) {
        before = core.size();
        if (core.size() > 1 && std::string_view(".,:").find(core.back()) != std::string_view::npos) core.remove_suffix(1);
        if (core.size() > 2 && are_brackets(core.front(), core.back())) core = core.substr(1, core.size() - 2);
        core = detail::trim(core);
    }
    return std::string(core);
}

std::optional<SampleUnit> find_sample_unit(std::string_view text) {
    std::string name = plain_unit_text(text);
    for (const auto& [from, to] : kSpellings) replace_all(name, from, to);
    std::erase_if(name, [](char letter) { return std::string_view(" \t*.()[]{}").find(letter) != std::string_view::npos; });
    name = unit_name(name);
    for (const SampleUnit& unit : known_units()) {
        if (unit.name == name) return unit;
    }
    return std::nullopt;
}

std::string sample_unit_names() {
    return list_units([](const SampleUnit& unit) { return !is_rotation(unit.quantity); });
}

std::string all_sample_unit_names() {
    return list_units([](const SampleUnit&) { return true; });
}

}  // namespace musim::records
