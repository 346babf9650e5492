#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.hpp"
#include "cli/files.hpp"
#include "cli/interruption.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/record_source.hpp"
#include "cli/records/record_spectra.hpp"
#include "records/atomic_file.hpp"
#include "records/measures/response_spectrum.hpp"

namespace musim::cli {
namespace {

struct RecordSpectrumOptions {
    std::vector<std::string> files;
    RecordSourceOptions source;
    std::vector<Number> damping{{0.05}};
    std::vector<Number> periods{{0.01}, {10.0}, {100.0}};  ///< first and last [s], how many
    std::string component;
    std::string rotd;  ///< "A,B"; empty: none
    std::string out;
    int threads = 0;
    bool json = false;
};

/// More periods than anybody needs; their number is a slip then.
constexpr double kMostPeriods = 1e5;

SpectrumRequest make_request(const RecordSpectrumOptions& options) {
    SpectrumRequest request{.periods = {}, .dampings = {}, .component = options.component, .rotd = {}};
    const double count = options.periods.at(2);
    if (!(count >= 2.0 && count <= kMostPeriods && count == std::floor(count))) {
        throw CLI::ValidationError("--periods",
                                   fmt::format("COUNT is {} (must be a whole number from 2 to {}); change it", count, kMostPeriods));
    }
    request.periods = read_option("--periods", [&] {
        return records::make_periods(options.periods.at(0).value * scaling::si::seconds, options.periods.at(1).value * scaling::si::seconds,
                                     static_cast<std::size_t>(count));
    });
    request.dampings.assign(options.damping.begin(), options.damping.end());
    const std::size_t comma = options.rotd.find(',');
    if (comma != std::string::npos) request.rotd = {options.rotd.substr(0, comma), options.rotd.substr(comma + 1)};
    return request;
}

enum class OutFormat { none, csv, svg };

OutFormat find_out_format(const std::string& out) {
    if (out.empty()) return OutFormat::none;
    const std::string extension = find_extension(out);
    if (extension == "csv") return OutFormat::csv;
    if (extension == "svg") return OutFormat::svg;
    throw CLI::ValidationError("--out", out + ": the extension implies no format; name it .csv or .svg");
}

int run_record_spectrum(const RecordSpectrumOptions& options) {
    const SpectrumRequest request = make_request(options);
    const OutFormat format = find_out_format(options.out);
    refuse_overwriting(options.source.find_files(options.files), {options.out});
    std::vector<SpectrumTable> tables;
    int exit_code = kDone;
    for (FileSpectra& file : compute_record_spectra(options.files, options.source, request, options.threads)) {
        std::move(file.tables.begin(), file.tables.end(), std::back_inserter(tables));
        if (file.error.empty()) continue;
        note("musim: error: {}\n", file.error);
        exit_code = kInputError;
    }
    if (tables.empty()) return exit_code;

    if (format == OutFormat::csv) records::write_file_atomically(options.out, make_csv(tables));
    if (format == OutFormat::svg) records::write_file_atomically(options.out, make_svg(tables));
    if (options.json) {
        print_json(to_json(tables));
    } else if (format != OutFormat::none) {
        print("{} {} written to {}\n", tables.size(), tables.size() == 1 ? "spectrum" : "spectra", options.out);
    } else {
        for (const SpectrumTable& table : tables) print_table(table);
    }
    return exit_code;
}

/// "A,B" with both names there.
std::string check_rotd(const std::string& text) {
    const auto commas = std::count(text.begin(), text.end(), ',');
    return commas == 1 && text.front() != ',' && text.back() != ',' ? "" : "'" + text + "' is no pair of components such as 360,090";
}

}  // namespace

void add_record_spectrum_command(CLI::App& record, Action& action) {
    auto options = std::make_shared<RecordSpectrumOptions>();
    CLI::App* command = record.add_subcommand("spectrum", "Response spectra of every component, and RotD of two");
    command->add_option("files", options->files, kRecordArgument)->required()->type_name("FILE");
    options->source.add_to(*command);
    command->add_option("--damping", options->damping, "Damping ratios, fractions of critical: 0.02,0.05 or repeated (default 0.05)")
        ->type_name("NUMBER,...")
        ->check(damping_ratio())
        ->delimiter(',')
        ->take_all()
        ->allow_extra_args(false);
    command->add_option("--periods", options->periods, "Periods [s] in even steps of the logarithm (default 0.01 10 100)")
        ->type_name("FIRST LAST COUNT")
        ->check(above_zero())
        ->expected(3);
    CLI::Option* component = command->add_option("--component", options->component, "This component only, e.g. 360");
    component->type_name("NAME");
    command->add_option("--rotd", options->rotd, "Two components, and RotD00, RotD50, RotD100 of their PSA, e.g. 360,090")
        ->type_name("A,B")
        ->check(check_rotd)
        ->excludes(component);
    command->add_option("-o,--out", options->out, "File to write: .csv (all), .svg (PSA over period)")->type_name("OUT");
    add_threads_option(*command, options->threads);
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim record spectrum CICLC.v1 --damping 0.02,0.05 -o spectra.csv\n"
        "  musim record spectrum CICLC.v1 --rotd 90,360 -o rotd.svg\n"
        "  musim record spectrum IELC180.AT2 IELC270.AT2 --rotd 180,270 --json\n"
        "  musim record spectrum model.csv --periods 0.01/10.7 10/10.7 100      # periods of a model, scaled like time\n"
        "Files are done side by side; one that cannot be used is an error line, the others are done (exit code 3). RotD takes two "
        "components "
        "of\n"
        "each file, or two files with one component each. Uncorrected records are taken above their initial level.");
    command->callback([&action, options] { action = [options] { return run_whole([&] { return run_record_spectrum(*options); }); }; });
}

}  // namespace musim::cli
