#include "records/shake_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "records/detail/json_fields.hpp"
#include "scaling/shorten.hpp"

namespace musim::records {
namespace {

using detail::JsonFields;
using Json = JsonFields::Json;

constexpr std::string_view kSchema = "musim-table/1";

/// Most digits that tell a double.
constexpr int kMostDigits = 17;

template <class Quantity>
std::optional<Quantity> read_limit(JsonFields& fields, const char* key) {
    auto limit = fields.optional_quantity<Quantity>(key);
    if (limit && !(limit->value() > 0.0 && std::isfinite(limit->value()))) {
        fields.fail(fmt::format("{} is not above zero", key), "give its magnitude, or remove it where there is no limit");
    }
    return limit;
}

template <class Quantity>
Quantity require_limit(JsonFields& fields, const char* key) {
    const auto limit = read_limit<Quantity>(fields, key);
    if (!limit) fields.fail(fmt::format("{} is missing", key), "add it");
    return *limit;
}

std::vector<PayloadLimit> read_acceleration(JsonFields& fields) {
    if (!fields.has("acceleration")) return {};
    const Json& value = fields["acceleration"];
    if (!value.is_array()) return {{0.0 * scaling::si::kilograms, require_limit<scaling::Acceleration>(fields, "acceleration")}};
    std::vector<PayloadLimit> limits;
    for (const Json& entry : value) {
        JsonFields row(entry, fmt::format("{}: acceleration {}", fields.place(), limits.size() + 1), fields.reading());
        const auto payload = row.quantity<scaling::Mass>("payload");
        const auto limit = require_limit<scaling::Acceleration>(row, "limit");
        row.refuse_unknown_keys();
        const bool was_in_order = row.reading() != nullptr && row.reading()->is_moved();
        const bool rises =
            was_in_order || (limits.empty() ? payload.value() >= 0.0 : payload > limits.back().payload && limit <= limits.back().limit);
        if (!rises) row.fail("more payload must come after less, with no more acceleration", "bring the rows into order");
        limits.push_back({payload, limit});
    }
    if (limits.empty()) fields.fail("acceleration has no rows", "add {\"payload\": ..., \"limit\": ...}, or remove it");
    return limits;
}

OilColumn read_oil_column(const Json& object, const JsonFields& axis) {
    JsonFields fields(object, axis.place() + ": oil_column", axis.reading());
    OilColumn column{require_limit<scaling::Frequency>(fields, "frequency"), fields.number("share", 1.0)};
    if (!(column.share > 0.0 && column.share <= 1.0)) fields.fail("share is not above 0 and up to 1", "write the usable part, such as 0.6");
    fields.refuse_unknown_keys();
    return column;
}

TableAxis read_axis(JsonFields& fields) {
    TableAxis axis;
    axis.displacement = read_limit<scaling::Length>(fields, "displacement");
    axis.velocity = read_limit<scaling::Velocity>(fields, "velocity");
    axis.acceleration = read_acceleration(fields);
    axis.force = read_limit<scaling::Force>(fields, "force");
    axis.moving_mass = read_limit<scaling::Mass>(fields, "moving_mass");
    axis.overturning_moment = read_limit<scaling::Moment>(fields, "overturning_moment");
    axis.payload = read_limit<scaling::Mass>(fields, "payload");
    axis.lowest_frequency = read_limit<scaling::Frequency>(fields, "lowest_frequency");
    axis.highest_frequency = read_limit<scaling::Frequency>(fields, "highest_frequency");
    if (fields.has("oil_column")) axis.oil_column = read_oil_column(fields["oil_column"], fields);
    if ((axis.force || axis.oil_column) && !axis.moving_mass) {
        fields.fail("moving_mass is missing (force and oil column act on table and payload)", "add the mass of platen and rods");
    }
    if (axis.lowest_frequency && axis.highest_frequency && *axis.lowest_frequency >= *axis.highest_frequency) {
        fields.fail("lowest_frequency is not below highest_frequency", "exchange them");
    }
    return axis;
}

/// One entry of the list stands for as many axes as it has names.
void add_axes(std::vector<TableAxis>& axes, const Json& object, const std::string& place, scaling::UncertainReading* reading) {
    JsonFields fields(object, place, reading);
    if (!fields.has("names") || !fields["names"].is_array() || fields["names"].empty()) {
        fields.fail("has no names", "add \"names\": [\"x\"], one for each direction that has these limits");
    }
    const TableAxis limits = read_axis(fields);
    fields.refuse_unknown_keys();
    for (const Json& name : fields["names"]) {
        if (!name.is_string()) fields.fail("a name is no text", "write it in quotes");
        TableAxis axis = limits;
        axis.name = name.get<std::string>();
        if (std::any_of(axes.begin(), axes.end(), [&](const TableAxis& other) { return other.name == axis.name; })) {
            fields.fail(fmt::format("the name \"{}\" comes twice", axis.name), "give every direction its own");
        }
        axes.push_back(axis);
    }
}

SampleUnit read_unit(JsonFields& fields, SampleQuantity quantity, const char* standard) {
    const std::string key(to_string(quantity)), name = fields.text(key.c_str(), standard);
    const auto unit = find_sample_unit(name);
    if (!unit || unit->quantity != quantity) {
        fields.fail(fmt::format("{} is in no unit of its own (\"{}\")", key, name), "use one of " + sample_unit_names());
    }
    return *unit;
}

std::vector<DriveColumn> read_columns(JsonFields& fields) {
    constexpr std::string_view kNames[] = {"time", "displacement", "velocity", "acceleration"};
    std::vector<DriveColumn> columns;
    if (!fields["columns"].is_array() || fields["columns"].empty()) fields.fail("columns is no list", "write [\"time\", \"displacement\"]");
    for (const Json& entry : fields["columns"]) {
        const std::string name = entry.is_string() ? entry.get<std::string>() : scaling::shorten(entry.dump(), scaling::kEchoed);
        const auto* const found = std::find(std::begin(kNames), std::end(kNames), name);
        if (found == std::end(kNames)) {
            fields.fail(fmt::format("\"{}\" is no column", name), "take time, displacement, velocity, acceleration");
        }
        columns.push_back(static_cast<DriveColumn>(found - std::begin(kNames)));
    }
    return columns;
}

char read_separator(JsonFields& fields) {
    const std::string name = fields.text("separator", "comma");
    if (name == "comma") return ',';
    if (name == "tab") return '\t';
    if (name == "space") return ' ';
    fields.fail(fmt::format("separator is \"{}\"", name), "take \"comma\", \"tab\" or \"space\"");
}

ControllerFormat read_controller(const Json& object, const std::string& place) {
    JsonFields fields(object, place);
    ControllerFormat format{.rate = require_limit<scaling::Frequency>(fields, "rate")};
    format.quiet = fields.optional_quantity<scaling::Time>("quiet").value_or(format.quiet);
    if (!(format.quiet.value() >= 0.0)) fields.fail("quiet is below zero", "give a time of zero or more");
    format.displacement = read_unit(fields, SampleQuantity::displacement, "m");
    format.velocity = read_unit(fields, SampleQuantity::velocity, "m/s");
    format.acceleration = read_unit(fields, SampleQuantity::acceleration, "m/s^2");
    if (fields.has("columns")) format.columns = read_columns(fields);
    format.separator = read_separator(fields);
    format.header = fields.truth("header", format.header);
    format.digits = fields.integer("digits", format.digits);
    if (format.digits < 1 || format.digits > kMostDigits) fields.fail("digits is not from 1 to 17", "take 9");
    fields.refuse_unknown_keys();
    return format;
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
    const Json object = detail::parse_json(json, source, R"(write {"schema": "musim-table/1", "axes": [...]})");
    if (!object.is_object() || !object.contains("schema") || object["schema"] != kSchema) {
        throw ReadError(fmt::format("{}: is no shake table; add \"schema\": \"{}\"", source, kSchema));
    }
    JsonFields fields(object, source);
    fields.has("schema");
    ShakeTable table{.name = fields.text("name", ""), .source = fields.text("source", ""), .axes = {}};
    table.energy_share = fields.number("energy_share", table.energy_share);
    if (!(table.energy_share > 0.5 && table.energy_share < 1.0)) {
        fields.fail("energy_share is not between 0.5 and 1", "write 0.99 or the like");
    }
    if (!fields.has("axes") || !object["axes"].is_array() || object["axes"].empty()) fields.fail("has no axes", "add \"axes\": [...]");
    for (std::size_t i = 0; i < object["axes"].size(); ++i) {
        add_axes(table.axes, object["axes"][i], fmt::format("{}: axes {}", source, i + 1), reading);
    }
    if (fields.has("controller")) {
        table.controller = read_controller(object["controller"], source + ": controller");
        for (TableAxis& axis : table.axes) axis.controller_rate = table.controller->rate;
    }
    fields.refuse_unknown_keys();
    return table;
}

}  // namespace musim::records
