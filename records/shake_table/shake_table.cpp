#include "records/shake_table/shake_table.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

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

TableAxis read_axis(const JsonReader& fields, bool was_in_order) {
    TableAxis axis;
    axis.displacement = read_limit<scaling::Length>(fields, "displacement");
    axis.velocity = read_limit<scaling::Velocity>(fields, "velocity");
    axis.acceleration = read_acceleration(fields, was_in_order);
    axis.force = read_limit<scaling::Force>(fields, "force");
    axis.moving_mass = read_limit<scaling::Mass>(fields, "moving_mass");
    axis.overturning_moment = read_limit<scaling::Moment>(fields, "overturning_moment");
    axis.payload = read_limit<scaling::Mass>(fields, "payload");
    axis.lowest_frequency = read_limit<scaling::Frequency>(fields, "lowest_frequency");
    axis.highest_frequency = read_limit<scaling::Frequency>(fields, "highest_frequency");
    if (fields.has("oil_column")) axis.oil_column = read_oil_column(fields["oil_column"].object());
    if ((axis.force || axis.oil_column) && !axis.moving_mass) {
        fields.fail("moving_mass is missing (force and oil column act on table and payload)", "add the mass of platen and rods");
    }
    if (axis.lowest_frequency && axis.highest_frequency && *axis.lowest_frequency >= *axis.highest_frequency) {
        fields.fail("lowest_frequency is not below highest_frequency", "exchange them");
    }
    return axis;
}

/// Names of rotations as tables and records have them: roll, pitch, yaw, rx, rot_z, theta_x, and SEED's channels of rotational seismometers
/// (instrument J: HJE, BJ1).
bool is_rotation(std::string_view name) {
    std::string low;
    for (const char c : name) {
        if (c != '_' && c != '-' && c != ' ') low += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    constexpr std::string_view kNames[] = {"roll", "pitch", "yaw", "rx", "ry", "rz", "rotx", "roty", "rotz", "thetax", "thetay", "thetaz"};
    if (std::find(std::begin(kNames), std::end(kNames), low) != std::end(kNames)) return true;
    if (low.starts_with("rotation")) return true;
    return low.size() == 3 && low[1] == 'j' && std::string_view("zne123").find(low[2]) != std::string_view::npos;
}

/// One entry of the list stands for as many axes as it has names.
void add_axes(std::vector<TableAxis>& axes, const JsonReader& fields, bool was_in_order) {
    if (fields.has("name")) fields.fail("\"name\" is none of its settings", "write a list of names, \"names\": [\"x\"]");
    if (!fields.has("names") || !fields["names"].json().is_array() || fields["names"].json().empty()) {
        fields.fail("has no names", "add \"names\": [\"x\"], one for each direction that has these limits");
    }
    const TableAxis limits = read_axis(fields, was_in_order);
    fields.refuse_unknown_keys();
    for (const Json& name : fields["names"].json()) {
        if (!name.is_string()) fields.fail("a name is no text", "write it in quotes");
        TableAxis axis = limits;
        axis.name = name.get<std::string>();
        if (is_rotation(axis.name)) {
            fields.fail(fmt::format("\"{}\" is a rotation (a table's axes are translations here)", axis.name), "leave it out");
        }
        if (std::any_of(axes.begin(), axes.end(), [&](const TableAxis& other) { return other.name == axis.name; })) {
            fields.fail(fmt::format("the name \"{}\" comes twice", axis.name), "give every direction its own");
        }
        axes.push_back(axis);
    }
}

SampleUnit read_unit(const JsonReader& fields, SampleQuantity quantity, const char* standard) {
    const std::string key(to_string(quantity)), name = fields.find<std::string>(key).value_or(standard);
    const auto unit = find_sample_unit(name);
    if (!unit || unit->quantity != quantity) {
        fields.fail(fmt::format("{} is in no unit of its own (\"{}\")", key, name), "use one of " + sample_unit_names());
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
    if (fields.has("columns")) format.columns = read_columns(fields);
    format.separator = read_separator(fields);
    fields.read("header", format.header);
    fields.read("digits", format.digits);
    if (format.digits < 1 || format.digits > kMostDigits) fields.fail("digits is not from 1 to 17", "take 9");
    fields.refuse_unknown_keys();
    return format;
}

std::vector<std::pair<std::string, std::string>> make_pairs(const GroundMotion& motion, const ShakeTable& table) {
    std::vector<std::pair<std::string, std::string>> pairs;
    std::vector<const TableAxis*> free;
    for (const TableAxis& axis : table.axes) free.push_back(&axis);
    for (const Component& component : motion.components) {
        const bool vertical = is_vertical(component);
        const auto axis =
            std::find_if(free.begin(), free.end(), [&](const TableAxis* each) { return is_vertical_axis(*each) == vertical; });
        if (axis == free.end()) {
            throw ReadError(
                fmt::format("{}: the table has no {} axis left for component {}", motion.source.empty() ? "record" : motion.source,
                            vertical ? "vertical" : "horizontal", component.name),
                Remedy{"choose components with ", Setting::axes});
        }
        pairs.emplace_back(component.name, (*axis)->name);
        free.erase(axis);
    }
    return pairs;
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
        if (is_rotation(moved.name)) {
            throw ReadError(fmt::format("{}: component {} is a rotation (a table's axes are translations here)",
                                        motion.source.empty() ? "record" : motion.source, moved.name),
                            Remedy("name the components that are translations"));
        }
        assigned.motion.components.push_back(moved);
        assigned.axes.push_back(table.find_axis(name));
    }
    return assigned;
}

}  // namespace musim::records
