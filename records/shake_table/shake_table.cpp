#include "records/shake_table/shake_table.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>

#include "records/error.hpp"
#include "records/json_rules.hpp"
#include "scaling/setting.hpp"
#include "scaling/shorten.hpp"

namespace musim::records {

namespace {

using detail::Json;
using scaling::JsonReader;

constexpr std::string_view kTableSchema = "musim-table/1";

/// Most digits of a double.
constexpr int kMostDigits = 17;

constexpr const char* kGiveMagnitude = "give its magnitude, or remove it where there is no limit";

template <class Quantity>
std::optional<Quantity> read_limit(const JsonReader& fields, const char* key) {
    return detail::read_positive<Quantity>(fields, key, kGiveMagnitude);
}

template <class Quantity>
Quantity require_limit(const JsonReader& fields, const char* key) {
    return detail::require_positive<Quantity>(fields, key, kGiveMagnitude);
}

/// With `was_in_order`, rows need no longer be by increasing payload.
std::vector<PayloadLimit> read_acceleration(const JsonReader& fields, bool was_in_order) {
    if (!fields.has("acceleration")) return {};
    const JsonReader value = fields["acceleration"];
    if (!value.json().is_array()) return {{0.0 * scaling::si::kilograms, require_limit<scaling::Acceleration>(fields, "acceleration")}};
    std::vector<PayloadLimit> limits;
    for (const JsonReader& entry : value.entries()) {
        const JsonReader row = entry.object();
        const auto payload = row.get<scaling::Mass>("payload");
        const auto limit = require_limit<scaling::Acceleration>(row, "limit");
        row.refuse_unknown_keys();
        const bool rises =
            was_in_order || (limits.empty() ? payload.value() >= 0.0 : payload > limits.back().payload && limit <= limits.back().limit);
        if (!rises) row.fail("more payload must come after less, with no more acceleration", "bring the rows into order");
        limits.push_back({payload, limit});
    }
    if (limits.empty()) fields.fail("acceleration has no rows", "add {\"payload\": ..., \"limit\": ...}, or remove it");
    return limits;
}

OilColumn read_oil_column(const JsonReader& fields) {
    OilColumn column{.frequency = require_limit<scaling::Frequency>(fields, "frequency")};
    fields.read("share", column.share);
    if (!(column.share > 0.0 && column.share <= 1.0)) fields.fail("share is not above 0 and up to 1", "write the usable part, such as 0.6");
    fields.refuse_unknown_keys();
    return column;
}

/// Limits that translations and rotations share.
void read_common_limits(const JsonReader& fields, TableAxis& axis) {
    axis.overturning_moment = read_limit<scaling::Moment>(fields, "overturning_moment");
    axis.payload = read_limit<scaling::Mass>(fields, "payload");
    axis.lowest_frequency = read_limit<scaling::Frequency>(fields, "lowest_frequency");
    axis.highest_frequency = read_limit<scaling::Frequency>(fields, "highest_frequency");
    if (axis.lowest_frequency && axis.highest_frequency && *axis.lowest_frequency >= *axis.highest_frequency) {
        fields.fail("lowest_frequency is not below highest_frequency", "exchange them");
    }
}

void refuse_limits(const JsonReader& fields, std::initializer_list<const char*> keys, const char* what, const char* what_to_do) {
    for (const char* const key : keys)
        if (fields.has(key)) fields.fail(fmt::format("{} is a limit of {}", key, what), what_to_do);
}

TableAxis read_translation(const JsonReader& fields, bool was_in_order) {
    refuse_limits(fields, {"angle", "angular_velocity", "angular_acceleration"}, "rotations (this axis is a translation)",
                  "give displacement, velocity and acceleration, or name the axis roll, pitch or yaw");
    TableAxis axis;
    axis.displacement = read_limit<scaling::Length>(fields, "displacement");
    axis.velocity = read_limit<scaling::Velocity>(fields, "velocity");
    axis.acceleration = read_acceleration(fields, was_in_order);
    axis.force = read_limit<scaling::Force>(fields, "force");
    axis.moving_mass = read_limit<scaling::Mass>(fields, "moving_mass");
    read_common_limits(fields, axis);
    if (fields.has("oil_column")) axis.oil_column = read_oil_column(fields["oil_column"].object());
    if ((axis.force || axis.oil_column) && !axis.moving_mass) {
        fields.fail("moving_mass is missing (force and oil column act on table and payload)", "add the mass of platen and rods");
    }
    return axis;
}

TableAxis read_rotation(const JsonReader& fields) {
    refuse_limits(fields, {"displacement", "velocity", "acceleration", "force", "moving_mass", "oil_column"},
                  "translations (this axis is a rotation)", "give angle, angular_velocity and angular_acceleration");
    TableAxis axis;
    axis.is_rotation = true;
    axis.angle = detail::read_turn<scaling::Ratio>(fields, "angle", "5 deg", kGiveMagnitude);
    axis.angular_velocity = detail::read_turn<scaling::Frequency>(fields, "angular_velocity", "30 deg/s", kGiveMagnitude);
    axis.angular_acceleration =
        detail::read_turn<scaling::AngularAcceleration>(fields, "angular_acceleration", "200 deg/s^2", kGiveMagnitude);
    const int given = int{axis.angle.has_value()} + int{axis.angular_velocity.has_value()} + int{axis.angular_acceleration.has_value()};
    if (given != 0 && given != 3) {
        const char* const missing = !axis.angle ? "angle" : !axis.angular_velocity ? "angular_velocity" : "angular_acceleration";
        fields.fail(fmt::format("{} is missing (a rotation is limited in angle, angular_velocity and angular_acceleration)", missing),
                    "add it");
    }
    read_common_limits(fields, axis);
    return axis;
}

/// One entry of the list stands for as many axes as it has names.
void add_axes(std::vector<TableAxis>& axes, const JsonReader& fields, bool was_in_order) {
    if (fields.has("name")) fields.fail("\"name\" is none of its settings", "write a list of names, \"names\": [\"x\"]");
    if (!fields.has("names") || !fields["names"].json().is_array() || fields["names"].json().empty()) {
        fields.fail("has no names", "add \"names\": [\"x\"], one for each direction that has these limits");
    }
    const auto turns = [](const Json& name) { return name.is_string() && is_named_as_rotation(name.get<std::string>()); };
    const Json& names = fields["names"].json();
    const auto rotations = std::count_if(names.begin(), names.end(), turns);
    if (rotations != 0 && rotations != static_cast<std::ptrdiff_t>(names.size())) {
        fields.fail("names are of translations and of rotations (their limits have other units)", "write an entry of \"axes\" for each");
    }
    const TableAxis limits = rotations != 0 ? read_rotation(fields) : read_translation(fields, was_in_order);
    fields.refuse_unknown_keys();
    for (const Json& name : names) {
        if (!name.is_string()) fields.fail("a name is no text", "write it in quotes");
        TableAxis axis = limits;
        axis.name = name.get<std::string>();
        if (axis.is_rotation && axis.overturning_moment && find_turned_axis(axis.name) == 'z') {
            fields.fail(fmt::format("overturning_moment of \"{}\" (nothing overturns about the vertical)", axis.name), "remove it");
        }
        if (std::any_of(axes.begin(), axes.end(), [&](const TableAxis& other) { return other.name == axis.name; })) {
            fields.fail(fmt::format("the name \"{}\" comes twice", axis.name), "give every direction its own");
        }
        axes.push_back(axis);
    }
}

SampleUnit read_unit(const JsonReader& fields, SampleQuantity quantity, const char* standard) {
    std::string key(to_string(quantity));
    std::replace(key.begin(), key.end(), ' ', '_');
    const std::string name = fields.find<std::string>(key).value_or(standard);
    const auto unit = find_sample_unit(name);
    if (!unit || unit->quantity != quantity) {
        fields.fail(fmt::format("{} is in no unit of its own (\"{}\")", key, name), "use one of " + all_sample_unit_names());
    }
    return *unit;
}

std::vector<DriveColumn> read_columns(const JsonReader& fields) {
    constexpr std::string_view kNames[] = {"time", "displacement", "velocity", "acceleration"};
    std::vector<DriveColumn> columns;
    const Json& list = fields["columns"].json();
    if (!list.is_array() || list.empty()) fields.fail("columns is no list", "write [\"time\", \"displacement\"]");
    for (const Json& entry : list) {
        const std::string name = entry.is_string() ? entry.get<std::string>() : scaling::shorten(entry.dump(), scaling::kEchoed);
        const auto* const found = std::find(std::begin(kNames), std::end(kNames), name);
        if (found == std::end(kNames)) {
            fields.fail(fmt::format("\"{}\" is no column", name), "take time, displacement, velocity, acceleration");
        }
        columns.push_back(static_cast<DriveColumn>(found - std::begin(kNames)));
    }
    return columns;
}

char read_separator(const JsonReader& fields) {
    const std::string name = fields.find<std::string>("separator").value_or("comma");
    if (name == "comma") return ',';
    if (name == "tab") return '\t';
    if (name == "space") return ' ';
    fields.fail(fmt::format("separator is \"{}\"", name), "take \"comma\", \"tab\" or \"space\"");
}

ControllerFormat read_controller(const JsonReader& fields) {
    ControllerFormat format{.rate = require_limit<scaling::Frequency>(fields, "rate")};
    fields.read("rest", format.rest);
    if (!(format.rest.value() >= 0.0)) fields.fail("rest is below zero", "give a time of zero or more");
    format.displacement = read_unit(fields, SampleQuantity::displacement, "m");
    format.velocity = read_unit(fields, SampleQuantity::velocity, "m/s");
    format.acceleration = read_unit(fields, SampleQuantity::acceleration, "m/s^2");
    format.angle = read_unit(fields, SampleQuantity::angle, "rad");
    format.angular_velocity = read_unit(fields, SampleQuantity::angular_velocity, "rad/s");
    format.angular_acceleration = read_unit(fields, SampleQuantity::angular_acceleration, "rad/s^2");
    if (fields.has("columns")) format.columns = read_columns(fields);
    format.separator = read_separator(fields);
    fields.read("header", format.header);
    fields.read("digits", format.digits);
    if (format.digits < 1 || format.digits > kMostDigits) fields.fail("digits is not from 1 to 17", "take 9");
    fields.refuse_unknown_keys();
    return format;
}

std::string name_source(const GroundMotion& motion) { return motion.source.empty() ? "record" : motion.source; }

/// The first free axis for a component; none: the end.
std::vector<const TableAxis*>::iterator find_free_axis(std::vector<const TableAxis*>& free, const Component& component) {
    const bool turns = is_rotation(component), vertical = is_vertical(component);
    const auto direction = turns ? find_turned_axis(component.name) : std::nullopt;
    const auto fits = [&](const TableAxis* axis) {
        if (axis->is_rotation != turns) return false;
        return turns ? !direction || find_turned_axis(axis->name) == direction : is_vertical_axis(*axis) == vertical;
    };
    return std::find_if(free.begin(), free.end(), fits);
}

std::vector<std::pair<std::string, std::string>> make_pairs(const GroundMotion& motion, const ShakeTable& table) {
    std::vector<std::pair<std::string, std::string>> pairs;
    std::vector<const TableAxis*> free;
    for (const TableAxis& axis : table.axes) free.push_back(&axis);
    for (const Component& component : motion.components) {
        const auto axis = find_free_axis(free, component);
        if (axis == free.end()) {
            const char* const kind = is_rotation(component) ? "rotation" : is_vertical(component) ? "vertical" : "horizontal";
            throw ReadError(fmt::format("{}: the table has no {} axis left for component {}", name_source(motion), kind, component.name),
                            Remedy{"choose components with ", Setting::axes});
        }
        pairs.emplace_back(component.name, (*axis)->name);
        free.erase(axis);
    }
    return pairs;
}

/// Refuses a component on an axis of the other kind.
void require_same_kind(const GroundMotion& motion, const Component& component, const TableAxis& axis) {
    if (is_rotation(component) == axis.is_rotation) return;
    const std::string quantity(to_string(component.series.quantity()));
    const std::string place = fmt::format("{}: component {} is {}", name_source(motion), component.name, quantity);
    if (!is_rotation(component) && is_named_as_rotation(component.name)) {
        throw ReadError(place + " by its unit, and a rotation by its name", Remedy("name the unit of its samples, such as rad/s"));
    }
    throw ReadError(fmt::format("{}, and axis {} is a {}", place, axis.name, axis.is_rotation ? "rotation" : "translation"),
                    Remedy{"choose components with ", Setting::axes});
}

}  // namespace

const TableAxis& ShakeTable::find_axis(std::string_view wanted) const {
    const auto axis = std::find_if(axes.begin(), axes.end(), [&](const TableAxis& candidate) { return candidate.name == wanted; });
    if (axis != axes.end()) return *axis;
    std::string names;
    for (const TableAxis& each : axes) names += (names.empty() ? "" : ", ") + each.name;
    throw ReadError(fmt::format("the table has no axis \"{}\"; choose one of {}", wanted, names));
}

ShakeTable parse_shake_table(std::string_view json, const std::string& source, scaling::UncertainReading* reading) {
    const Json object = detail::parse_object(json, source, kTableSchema, "shake table", R"("axes": [...])");
    const detail::JsonRules rules(reading), controller_rules;
    const JsonReader fields(object, rules, source);
    ShakeTable table;
    fields.read("name", table.name);
    fields.read("source", table.source);
    fields.read("energy_share", table.energy_share);
    if (!(table.energy_share > 0.5 && table.energy_share < 1.0)) {
        fields.fail("energy_share is not between 0.5 and 1", "write 0.99 or the like");
    }
    if (!fields.has("axes") || !object["axes"].is_array() || object["axes"].empty()) fields.fail("has no axes", "add \"axes\": [...]");
    const bool was_in_order = reading != nullptr && reading->is_moved();
    for (const JsonReader& entry : fields["axes"].entries()) add_axes(table.axes, entry.object(), was_in_order);
    if (fields.has("controller")) {
        table.controller = read_controller(JsonReader(object["controller"], controller_rules, source + ": controller").object());
        for (TableAxis& axis : table.axes) axis.controller_rate = table.controller->rate;
    }
    fields.refuse_unknown_keys();
    return table;
}

bool is_vertical_axis(const TableAxis& axis) { return axis.name == "z" || axis.name == "vertical"; }

std::optional<char> find_turned_axis(std::string_view name) {
    constexpr std::pair<std::string_view, char> kNames[] = {{"roll", 'x'}, {"pitch", 'y'}, {"yaw", 'z'}};
    std::string low(name);
    for (char& letter : low) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    for (const auto& [title, direction] : kNames)
        if (low == title) return direction;
    const char last = low.empty() ? ' ' : low.back();
    return last == 'x' || last == 'y' || last == 'z' ? std::optional(last) : std::nullopt;
}

scaling::Shaking find_shaking(const TableAxis& axis) {
    return is_vertical_axis(axis) ? scaling::Shaking::vertical : scaling::Shaking::horizontal;
}

AssignedAxes assign_axes(const GroundMotion& motion, const ShakeTable& table,
                         const std::vector<std::pair<std::string, std::string>>& wanted) {
    AssignedAxes assigned{motion, {}};
    assigned.motion.components.clear();
    for (const auto& [component, axis] : wanted.empty() ? make_pairs(motion, table) : wanted) {
        const std::string& name = axis;
        if (std::any_of(assigned.axes.begin(), assigned.axes.end(), [&](const TableAxis& other) { return other.name == name; })) {
            throw ReadError(fmt::format("axis {} is to make two components; give each its own", name));
        }
        const Component& moved = motion.find_component(component);
        require_same_kind(motion, moved, table.find_axis(name));
        assigned.motion.components.push_back(moved);
        assigned.axes.push_back(table.find_axis(name));
    }
    return assigned;
}

}  // namespace musim::records
