#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/files.hpp"
#include "cli/interruption.hpp"
#include "cli/named_values.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/record_source.hpp"
#include "cli/records/record_output.hpp"
#include "records/error.hpp"
#include "records/measures/intensity.hpp"
#include "records/synthesis/match_spectrum.hpp"
#include "scaling/number.hpp"

namespace musim::cli {
namespace {

struct RecordMatchOptions {
    std::string file;
    RecordSourceOptions source;
    std::string target, column = "psa_g";
    Number damping{0.05}, tolerance{0.05};
    std::vector<Number> band{{0.0}, {std::numeric_limits<double>::infinity()}};  ///< [s]
    RecordOutputOptions output;
    bool json = false;
};

/// Cells of a CSV line; a cell in quotes may hold commas.
std::vector<std::string> split_cells(const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char letter : line) {
        if (letter == '"') quoted = !quoted;
        if (letter == ',' && !quoted) {
            cells.emplace_back();
        } else if (letter != '"' && letter != '\r') {
            cells.back() += letter;
        }
    }
    return cells;
}

bool is_number(const std::string& text) {
    try {
        scaling::parse_number(text);
        return true;
    } catch (const scaling::ParseError&) {
        return false;
    }
}

/// A line of the file, for messages.
struct Place {
    const std::string& file;
    std::size_t line;

    [[noreturn]] void fail(const std::string& message) const { throw records::ReadError(fmt::format("{}:{}: {}", file, line, message)); }
};

std::size_t find_column(const std::vector<std::string>& titles, const std::string& title, const Place& place) {
    const auto found = std::find(titles.begin(), titles.end(), title);
    if (found == titles.end()) {
        place.fail(fmt::format("there is no column {} (columns: {}); name it so, or the PSA in g by --target-column", title,
                               fmt::join(titles, ", ")));
    }
    return static_cast<std::size_t>(found - titles.begin());
}

double read_cell(const std::vector<std::string>& cells, std::size_t column, const Place& place) {
    if (column >= cells.size() || !is_number(cells[column])) {
        place.fail(fmt::format("column {} holds no number; correct or remove the line", column + 1));
    }
    return scaling::parse_number(cells[column]);
}

/// Periods of a target that are used [s].
struct PeriodBand {
    double first = 0.0, last = 0.0;
};

/// Reads a target spectrum from CSV: one line of titles with `period_s` and `column` [g] among them, as `musim record spectrum` writes, or
/// none, and then the first two columns. Lines that begin with # are left out, and periods beyond the band. Throws records::ReadError
/// `file:line: what (why); what to do` for missing columns, cells that are no numbers, periods that do not rise, and when none is left.
records::TargetSpectrum read_target_spectrum(const std::string& file, const std::string& column, const PeriodBand& band, double damping) {
    std::istringstream text(read_input_file(file, "a spectrum as CSV"));
    records::TargetSpectrum target{.damping = damping, .period = {}, .psa = {}};
    std::size_t period_column = 0, psa_column = 1;
    bool first = true;
    double before = 0.0;
    Place place{file, 0};
    for (std::string line; std::getline(text, line);) {
        ++place.line;
        if (line.empty() || line == "\r" || line.starts_with('#')) continue;
        const std::vector<std::string> cells = split_cells(line);
        const bool titles = first && !is_number(cells.front());
        first = false;
        if (titles) {
            period_column = find_column(cells, "period_s", place);
            psa_column = find_column(cells, column, place);
            continue;
        }
        const double period = read_cell(cells, period_column, place), psa = read_cell(cells, psa_column, place);
        if (!(period > before)) {
            place.fail(
                fmt::format("period {} s follows {} s (must rise); give one spectrum, such as one of a single component", period, before));
        }
        before = period;
        if (period < band.first || period > band.last) continue;
        target.period.push_back(period * scaling::si::seconds);
        target.psa.push_back(psa * scaling::kStandardGravity);
    }
    if (target.period.empty()) {
        throw records::ReadError(
            fmt::format("{}: no period lies from {:g} to {:g} s; widen the band or give another spectrum", file, band.first, band.last));
    }
    return target;
}

/// Misfit and intensity of a motion before or after.
NamedValues describe(const records::SpectrumMisfit& misfit, const records::GroundMotion& motion, const records::Component& component) {
    const records::Intensity intensity = records::compute_intensity(component.series, motion.integration_corner);
    return {{"largest_misfit", "largest |ln|", misfit.largest},
            {"largest_misfit_at_s", "at T [s]", misfit.largest_at.value()},
            {"mean_misfit", "mean |ln|", misfit.mean},
            {"pga_g", "PGA [g]", std::abs(intensity.pga->value.value()) / scaling::kStandardGravity.value()},
            {"pgv_cm_s", "PGV [cm/s]", 100.0 * std::abs(intensity.pgv->value.value())},
            {"pgd_cm", "PGD [cm]", 100.0 * std::abs(intensity.pgd->value.value())},
            {"arias_m_s", "Ia [m/s]", intensity.arias->value()}};
}

/// The component asked for, or the only one.
const std::string& find_component_name(const RecordMatchOptions& options, const records::GroundMotion& motion) {
    if (!options.output.component.empty()) return options.output.component;
    if (motion.components.size() == 1) return motion.components.front().name;
    throw records::ProcessingError(
        fmt::format("{}: one component is matched at a time; choose one with --component ({})", options.file, motion.component_names()));
}

int run_record_match(const RecordMatchOptions& options) {
    require_ascending("--band", options.band);
    options.output.check();
    std::vector<std::string> inputs = options.source.find_files({options.file});
    inputs.push_back(options.target);
    refuse_overwriting(inputs, {options.output.out});
    const records::TargetSpectrum target =
        read_target_spectrum(options.target, options.column, {options.band.at(0), options.band.at(1)}, options.damping);
    const records::GroundMotion motion = options.source.load(options.file);
    const std::string& name = find_component_name(options, motion);
    const records::MatchedRecord matched = records::match_spectrum(motion, name, target, {.tolerance = options.tolerance});
    options.output.write(matched.motion);

    const records::SpectrumMatch& match = matched.match;
    const NamedValues before = describe(match.before, motion, motion.find_component(name));
    const NamedValues after = describe(match.after, matched.motion, matched.motion.components.front());
    if (options.json) {
        nlohmann::json object{{"out", options.output.out},
                              {"component", name},
                              {"damping", target.damping},
                              {"periods", target.period.size()},
                              {"first_period_s", target.period.front().value()},
                              {"last_period_s", target.period.back().value()},
                              {"factor", match.factor},
                              {"iterations", match.iterations},
                              {"history", matched.motion.history}};
        add_to_json(object["before"], before);
        add_to_json(object["after"], after);
        print_json(object);
        return kDone;
    }
    print("{} periods from {:g} to {:g} s, damping {:g}: multiplied by {:.5g}, {} iterations\n", target.period.size(),
          target.period.front().value(), target.period.back().value(), target.damping, match.factor, match.iterations);
    print_titles("", before);
    print_row("before", before);
    print_row("after", after);
    print("\nWritten to {}\n", options.output.out);
    return kDone;
}

}  // namespace

void add_record_match_command(CLI::App& record, Action& action) {
    auto options = std::make_shared<RecordMatchOptions>();
    CLI::App* command = record.add_subcommand("match", "Match a component to a target response spectrum by wavelets in time");
    command->add_option("file", options->file, kRecordArgument)->required()->type_name("FILE");
    command->add_option("--target", options->target, "Spectrum (CSV): period_s [s] and PSA [g], or what `musim record spectrum` writes")
        ->required()
        ->type_name("SPECTRUM.csv");
    command->add_option("--target-column", options->column, "Column of the PSA [g], e.g. rotd50_psa_g")->capture_default_str();
    command->add_option("--damping", options->damping, "Damping ratio of the target, fraction of critical (default 0.05)")
        ->type_name("NUMBER")
        ->check(damping_ratio());
    command->add_option("--band", options->band, "Periods to match [s] (default: all of the target)")
        ->type_name("T1 T2")
        ->expected(2)
        ->check(not_negative());
    command->add_option("--tolerance", options->tolerance, "Largest |ln(PSA/target)| over the band (default 0.05)")
        ->type_name("NUMBER")
        ->check(above_zero());
    options->output.add_to(*command);
    command->get_option("--component")->description("Component to match, e.g. 360 (default: the only one)");
    options->source.add_to(*command);
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim record match CICLC.v1 --component 360 --target code.csv --band 0.05 5 -o matched.csv\n"
        "  musim record spectrum IELC180.AT2 --periods 0.05 5 60 -o target.csv && musim record match synthetic --target target.csv -o "
        "m.csv\n"
        "  musim record match IELC180.AT2 --target rotd.csv --target-column rotd50_psa_g --tolerance 0.03 -o matched.at2 --json\n"
        "Only the periods of the target are matched: give it 20 or more a decade. A target that cannot be reached is an error, and "
        "nothing\n"
        "is written.");
    command->callback([&action, options] { action = [options] { return run_whole([&] { return run_record_match(*options); }); }; });
}

}  // namespace musim::cli
