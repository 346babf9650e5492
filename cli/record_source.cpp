#include "cli/record_source.hpp"

#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include "cli/files.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "lsdem/run/use_record.hpp"
#include "records/formats/read_record.hpp"
#include "records/synthesis/synthetic.hpp"

namespace musim::cli {
namespace {

/// Names the record that needs no file.
constexpr const char* kBuiltInRecord = "synthetic";

std::string check_quantity(const std::string& text) {
    return records::find_sample_quantity(text) ? "" : "\"" + text + "\" is none of acceleration, velocity, displacement";
}

std::string check_unit(const std::string& text) {
    return records::find_sample_unit(text) ? "" : "\"" + text + "\" is no unit of a record (known: " + records::sample_unit_names() + ")";
}

/// "x=360 y=90" as names along the axes.
lsdem::AxisComponents parse_components(const std::vector<std::string>& texts) {
    lsdem::AxisComponents components;
    for (const std::string& text : texts) {
        const std::size_t axis = text.size() > 2 && text[1] == '=' ? std::string("xyz").find(text[0]) : std::string::npos;
        if (axis == std::string::npos) throw CLI::ValidationError("--component", "'" + text + "' is not AXIS=NAME, e.g. x=360");
        components[axis] = text.substr(2);
    }
    return components;
}

}  // namespace

void add_text_record_options(CLI::App& command, std::optional<std::string>& unit, std::optional<Number>& dt) {
    command.add_option("--dt", dt, "Time step [s] of a text file without a time column")->type_name("NUMBER")->check(above_zero());
    command.add_option("--unit", unit, "Unit of a plain text file, e.g. g or cm/s^2 (default SI)")
        ->type_name("UNIT")
        ->check(CLI::Validator(check_unit, ""));
}

void RecordSourceOptions::add_to(CLI::App& command) {
    add_text_record_options(command, unit, dt);
    command
        .add_option("--quantity", quantity,
                    "What a text file holds, or which series to take of a file with several: acceleration, velocity or displacement")
        ->type_name("NAME")
        ->check(CLI::Validator(check_quantity, ""));
    command.add_option("--sensitivity", sensitivity, "Of miniSEED counts: counts per m/s^2 (or m/s, m, as the instrument has it)")
        ->type_name("NUMBER")
        ->check(above_zero());
    command.add_option("--station-xml", station_xml, "StationXML file that gives the sensitivity of miniSEED counts")->type_name("FILE");
}

std::vector<std::string> RecordSourceOptions::find_files(std::vector<std::string> sources) const {
    std::erase(sources, kBuiltInRecord);
    if (!station_xml.empty()) sources.push_back(station_xml);
    return sources;
}

records::GroundMotion RecordSourceOptions::load(const std::string& source) const {
    if (source == kBuiltInRecord) return records::make_synthetic_record();
    records::ReadOptions options{.dt = {}, .unit = unit, .quantity = {}};
    if (dt) options.dt = dt->value * scaling::si::seconds;
    if (sensitivity) options.sensitivity = sensitivity->value;
    if (!station_xml.empty()) options.station_xml = station_xml;
    if (quantity) options.quantity = records::find_sample_quantity(*quantity);
    records::GroundMotion motion = records::read_record(source, options);
    for (const std::string& line : motion.history)
        if (line.find(records::kUnitNotGiven) != std::string::npos) note_at_end("musim: note: " + line + "; add --unit if that is wrong");
    return motion;
}

records::GroundMotion RecordSourceOptions::load_beside(const std::string& naming_file, const std::string& source) const {
    return load(source == kBuiltInRecord ? source : find_beside(naming_file, source));
}

void RecordMotionOptions::add_to(CLI::App& command, const std::string& help) {
    CLI::Option* option = command.add_option("--record", record, help)->type_name("FILE");
    command.add_option("--component", components, "Component along an axis, e.g. x=360 (default: the strongest horizontal along x)")
        ->type_name("AXIS=NAME")
        ->needs(option);
    add_text_record_options(command, unit, dt);
    command.get_option("--unit")->needs(option);
    command.get_option("--dt")->needs(option);
}

void RecordMotionOptions::apply(lsdem::Scene& scene) const {
    const std::optional<scaling::Time> step = dt ? std::optional(dt->value * scaling::si::seconds) : std::nullopt;
    const std::vector<std::string> steps = lsdem::use_record(scene, record, parse_components(components), unit, step);
    for (const std::string& line : steps) note("{}: {}\n", record, line);
}

}  // namespace musim::cli
