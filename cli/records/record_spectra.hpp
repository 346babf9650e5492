#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/record_source.hpp"
#include "records/ground_motion.hpp"

namespace musim::cli {

/// One quantity over the periods of a spectrum.
struct SpectrumColumn {
    std::string key;    ///< in JSON and CSV, with the unit: "psa_g"
    std::string title;  ///< over its column: "PSA [g]"
    std::string curve;  ///< in a plot of PSA; empty: not drawn there
    std::vector<double> values;
};

/// Response spectrum of a component, or RotD of two, at one damping ratio.
struct SpectrumTable {
    std::string file;            ///< "a.at2 + b.at2" when it takes two
    std::string component;       ///< "360", or "360,090" for RotD
    bool rotated = false;        ///< RotD
    double damping = 0.05;       ///< fraction of critical
    std::vector<double> period;  ///< [s]
    std::vector<SpectrumColumn> columns;
};

/// Request for every record.
struct SpectrumRequest {
    std::vector<scaling::Time> periods;
    std::vector<double> dampings;
    std::string component;                     ///< empty: all
    std::pair<std::string, std::string> rotd;  ///< two components, and RotD of both; empty: no RotD
    bool has_rotd() const { return !rotd.first.empty(); }
};

/// Spectra of one file, or why there are none.
struct FileSpectra {
    std::vector<SpectrumTable> tables;
    std::string error;  ///< why it has none; empty when it has
};

/// Spectra of all files, `threads` at a time (0: all cores), in the order of the files. Uncorrected records are taken above their initial
/// level. RotD is of two components of each file, or of two files with a component each, and follows in the second one's tables then; as
/// long as both components last. Files that cannot be read or used have an error, the others go on.
std::vector<FileSpectra> compute_record_spectra(const std::vector<std::string>& files, const RecordSourceOptions& source,
                                                const SpectrumRequest& request, int threads);

/// {"spectra": [...], "rotd": [...]}: file, component, damping, and a list of numbers for the period and every column.
nlohmann::json to_json(const std::vector<SpectrumTable>& tables);

/// A table on stdout.
void print_table(const SpectrumTable& table);

/// One row per table and period; a column that a table has not is empty in its rows.
std::string make_csv(const std::vector<SpectrumTable>& tables);

/// PSA over period on logarithmic axes, one curve per component, RotD and damping ratio.
std::string make_svg(const std::vector<SpectrumTable>& tables);

}  // namespace musim::cli
