#include "cli/record_source.hpp"

#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <cstdint>

#include "cli/files.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/whole_option.hpp"
#include "lsdem/run/use_record.hpp"
#include "records/synthesis/synthetic.hpp"

namespace musim::cli {
namespace {

/// Names the record that needs no file.
constexpr const char* kBuiltInRecord = "synthetic";

std::string check_quantity(const std::string& text) {
    return records::find_sample_quantity(text) ? "" : "\"" + text + "\" is none of " + records::sample_quantity_names();
}

std::string check_unit(const std::string& text) {
    return records::find_sample_unit(text) ? ""
                                           : "\"" + text + "\" is no unit of a record (known: " + records::all_sample_unit_names() + ")";
}

std::string check_columns(const std::string& text) {
    try {
        records::parse_column_choices(text);
    } catch (const records::ReadError& error) {
        return error.what();
    }
    return "";
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

void TextRecordOptions::add_to(CLI::App& command, CLI::Option* file) {
    constexpr std::uint64_t kMostLines = 1'000'000'000;  // more than a file of the largest size that is read can have
    CLI::Option* const options[] = {
        command.add_option("--dt", dt, "Time step [s] of a text file without a time column")->type_name("NUMBER")->check(above_zero()),
        command.add_option("--unit", unit, "Unit of a plain text file, e.g. g, cm/s^2 or deg/s (default SI of translations)")
            ->type_name("UNIT")
            ->check(CLI::Validator(check_unit, "")),
        command
            .add_option("--columns", columns,
                        "Columns of a plain text file, counted from 1 or by their titles, e.g. time=2,x=3 (default: as its titles say)")
            ->type_name("NAME=COLUMN,...")
            ->check(CLI::Validator(check_columns, "")),
        add_whole_option(command, "--skip", skip, "Lines at the beginning of a text file that are not read", {0, kMostLines})
            ->type_name("LINES"),
    };
    for (CLI::Option* const option : options)
        if (file != nullptr) option->needs(file);
}

records::ReadOptions TextRecordOptions::read_options() const {
    records::ReadOptions options;
    if (dt) options.dt = dt->value * scaling::si::seconds;
    options.unit = unit;
    if (columns) options.columns = records::parse_column_choices(*columns);
    if (skip) options.skipped_lines = static_cast<std::size_t>(*skip);
    return options;
}

CLI::Option* add_at_rest_option(CLI::App& command, std::string& at_rest) {
    return command
        .add_option(
            "--at-rest", at_rest,
            "How the base ends: yes, at rest where it began; displaced, at rest elsewhere; no, as the record leaves it (default yes)")
        ->type_name("HOW")
        ->check(one_of({"yes", "displaced", "no"}));
}

records::AtRest find_at_rest(const std::string& at_rest) {
    if (at_rest == "displaced") return records::AtRest::displaced;
    return at_rest == "no" ? records::AtRest::as_given : records::AtRest::home;
}

void RecordSourceOptions::add_to(CLI::App& command, CLI::Option* file) {
    text.add_to(command, file);
    CLI::Option* const options[] = {
        command
            .add_option("--quantity", quantity,
                        "What a text file or counts are, or which series to take of a file with several: acceleration, velocity, "
                        "displacement, angular_acceleration, angular_velocity or angle")
            ->type_name("NAME")
            ->check(CLI::Validator(check_quantity, "")),
        command
            .add_option(
                "--sensitivity", sensitivity,
                "Of counts (miniSEED, SLIST, TSPAIR): counts per m/s^2 (or m/s, m, as the instrument has it); 1 where samples are SI")
            ->type_name("NUMBER")
            ->check(above_zero()),
        command.add_option("--station-xml", station_xml, "StationXML file that gives the sensitivity of counts")->type_name("FILE"),
    };
    for (CLI::Option* const option : options)
        if (file != nullptr) option->needs(file);
}

records::ReadOptions RecordSourceOptions::read_options() const {
    records::ReadOptions options = text.read_options();
    if (sensitivity) options.sensitivity = sensitivity->value;
    if (!station_xml.empty()) options.station_xml = station_xml;
    if (quantity) options.quantity = records::find_sample_quantity(*quantity);
    return options;
}

std::vector<std::string> RecordSourceOptions::find_files(std::vector<std::string> sources) const {
    std::erase(sources, kBuiltInRecord);
    if (!station_xml.empty()) sources.push_back(station_xml);
    return sources;
}

records::GroundMotion RecordSourceOptions::load(const std::string& source) const {
    if (source == kBuiltInRecord) return records::make_synthetic_record();
    records::GroundMotion motion = records::read_record(source, read_options());
    for (const std::string& line : motion.history) {
        if (line.find(records::kUnitNotGiven) != std::string::npos) note_at_end("musim: note: " + line + "; add --unit if that is wrong");
        if (line.starts_with(records::kReadingNote)) note_at_end("musim: " + line);
    }
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
    source.add_to(command, option);
    add_at_rest_option(command, at_rest)->needs(option);
}

void RecordMotionOptions::apply(lsdem::Scene& scene) const {
    const std::vector<std::string> steps =
        lsdem::use_record(scene, record, parse_components(components), source.read_options(), find_at_rest(at_rest));
    for (const std::string& line : steps) note("{}: {}\n", record, line);
}

}  // namespace musim::cli
