#include "cli/record_source.hpp"

#include <CLI/Error.hpp>
#include <CLI/Option.hpp>

#include "records/read_record.hpp"
#include "records/synthetic.hpp"

namespace musim::cli {

void RecordSourceOptions::add_to(CLI::App& command) {
    command.add_option("--dt", dt, "Time step [s] of a text file without a time column")->type_name("NUMBER");
    command.add_option("--unit", unit, "Unit of a plain text file, e.g. g or cm/s^2 (default SI)")->type_name("UNIT");
    command
        .add_option("--quantity", quantity,
                    "What a text file holds, or which series to take of a file with several: acceleration, velocity or displacement")
        ->type_name("NAME");
    command.add_option("--sensitivity", sensitivity, "Of miniSEED counts: counts per m/s^2 (or m/s, m, as the instrument has it)")
        ->type_name("NUMBER");
    command.add_option("--station-xml", station_xml, "StationXML file that tells the sensitivity of miniSEED counts")->type_name("FILE");
}

records::GroundMotion RecordSourceOptions::load(const std::string& source) const {
    if (source == "synthetic") return records::make_synthetic_record();
    records::ReadOptions options{.dt = {}, .unit = unit, .quantity = {}};
    if (dt) options.dt = dt->value * scaling::si::seconds;
    if (sensitivity) options.sensitivity = sensitivity->value;
    if (!station_xml.empty()) options.station_xml = station_xml;
    if (quantity) {
        options.quantity = records::find_sample_quantity(*quantity);
        if (!options.quantity) {
            throw CLI::ValidationError("--quantity", "'" + *quantity + "' is none of acceleration, velocity, displacement");
        }
    }
    return records::read_record(source, options);
}

}  // namespace musim::cli
