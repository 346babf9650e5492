#include "cli/record_source.hpp"

#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include "cli/input_file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
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

}  // namespace musim::cli
