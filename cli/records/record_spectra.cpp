#include "cli/records/record_spectra.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "cli/records/record_peaks.hpp"
#include "lsdem/plot/line_plot.hpp"
#include "records/formats/csv_cell.hpp"
#include "records/measures/intensity.hpp"
#include "records/measures/response_spectrum.hpp"
#include "records/measures/rotated_peaks.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::cli {
namespace {

using records::Component;
using records::GroundMotion;
using ComponentPair = std::pair<const Component&, const Component&>;

const double kG = scaling::kStandardGravity.value();  // [m/s²]
constexpr double kCentimeter = 0.01;                  // [m]

std::vector<double> in_units(std::vector<double> values, double unit) {
    for (double& value : values) value /= unit;
    return values;
}

SpectrumTable make_table(const std::string& file, const Component& component, const SpectrumRequest& request, double damping) {
    const auto spectrum = records::compute_response_spectrum(component.series, request.periods, damping);
    return {.file = file,
            .component = component.name,
            .rotated = false,
            .damping = damping,
            .period = spectrum.period,
            .columns = {{"psa_g", "PSA [g]", component.name, in_units(spectrum.pseudo_acceleration(), kG)},
                        {"psv_cm_s", "PSV [cm/s]", "", in_units(spectrum.pseudo_velocity(), kCentimeter)},
                        {"sd_cm", "SD [cm]", "", in_units(spectrum.displacement, kCentimeter)},
                        {"sa_g", "SA [g]", "", in_units(spectrum.acceleration, kG)},
                        {"sv_cm_s", "SV [cm/s]", "", in_units(spectrum.velocity, kCentimeter)}}};
}

/// The first samples of a series; never more than it has.
records::TimeSeries keep_first(const records::TimeSeries& series, std::size_t count) {
    const auto samples = series.samples().first(std::min(count, series.size()));
    return series.with_samples({samples.begin(), samples.end()});
}

SpectrumTable make_rotated_table(const std::string& file, const ComponentPair& pair, const SpectrumRequest& request, double damping) {
    const auto& [first, second] = pair;
    const std::vector<records::RotatedPeaks> peaks = records::compute_rotated_spectrum(
        keep_first(first.series, second.series.size()), keep_first(second.series, first.series.size()), request.periods, damping);
    SpectrumTable table{.file = file,
                        .component = first.name + "," + second.name,
                        .rotated = true,
                        .damping = damping,
                        .period = {},
                        .columns = {{"rotd00_psa_g", "RotD00 PSA [g]", "RotD00", {}},
                                    {"rotd50_psa_g", "RotD50 PSA [g]", "RotD50", {}},
                                    {"rotd100_psa_g", "RotD100 PSA [g]", "RotD100", {}},
                                    {"rotd100_deg", "RotD100 at [deg]", "", {}}}};
    for (std::size_t i = 0; i < peaks.size(); ++i) {
        table.period.push_back(request.periods[i].value());
        table.columns[0].values.push_back(peaks[i].least / kG);
        table.columns[1].values.push_back(peaks[i].median / kG);
        table.columns[2].values.push_back(peaks[i].largest / kG);
        table.columns[3].values.push_back(peaks[i].largest_at);
    }
    return table;
}

GroundMotion load_leveled(const RecordSourceOptions& source, const std::string& file) {
    GroundMotion motion = keep_translations(source.load(file), file, "has no spectrum");
    for (Component& component : motion.components) {
        component.series = records::level_uncorrected(component.series, motion.integration_corner);
    }
    return motion;
}

void add_tables(std::vector<SpectrumTable>& tables, const std::string& file, const Component& component, const SpectrumRequest& request) {
    for (const double damping : request.dampings) tables.push_back(make_table(file, component, request, damping));
}

void add_rotated_tables(std::vector<SpectrumTable>& tables, const std::string& file, const ComponentPair& pair,
                        const SpectrumRequest& request) {
    if (&pair.first == &pair.second) {
        throw records::ReadError(fmt::format("{}: --rotd names component '{}' twice; name two", file, pair.first.name));
    }
    for (const double damping : request.dampings) tables.push_back(make_rotated_table(file, pair, request, damping));
}

std::vector<SpectrumTable> make_tables(const std::string& file, const GroundMotion& motion, const SpectrumRequest& request) {
    std::vector<SpectrumTable> tables;
    if (request.has_rotd() && motion.components.size() > 1) {
        const ComponentPair pair{motion.find_component(request.rotd.first), motion.find_component(request.rotd.second)};
        add_tables(tables, file, pair.first, request);
        add_tables(tables, file, pair.second, request);
        add_rotated_tables(tables, file, pair, request);
    } else if (!request.component.empty()) {
        add_tables(tables, file, motion.find_component(request.component), request);
    } else {
        for (const Component& component : motion.components) add_tables(tables, file, component, request);
    }
    return tables;
}

/// The components that --rotd names in two records of one component each, in either order; in this one when both have the same name.
ComponentPair find_pair(const GroundMotion& first, const GroundMotion& second, const SpectrumRequest& request) {
    const auto& [name, other_name] = request.rotd;
    if (first.components.front().name == second.components.front().name) {
        return {first.find_component(name), second.find_component(other_name)};
    }
    const GroundMotion both{.source = first.source + " + " + second.source,
                            .components = {first.components.front(), second.components.front()}};
    const auto find = [&](const std::string& wanted) -> const Component& {
        return (&both.find_component(wanted) == both.components.data() ? first : second).components.front();
    };
    return {find(name), find(other_name)};
}

/// Does `work` for a file; what is wrong with the file becomes its error.
void use_file(FileSpectra& result, const std::string& file, const std::function<void()>& work) {
    try {
        work();
    } catch (const records::ReadError& error) {
        result = {.tables = {}, .error = word(error)};
    } catch (const records::ProcessingError& error) {
        result = {.tables = {}, .error = file + ": " + word(error)};
    }
}

const SpectrumColumn* find_column(const SpectrumTable& table, const std::string& key) {
    const auto found =
        std::find_if(table.columns.begin(), table.columns.end(), [&](const SpectrumColumn& column) { return column.key == key; });
    return found == table.columns.end() ? nullptr : &*found;
}

/// Keys of all columns, in the order in which they first occur.
std::vector<std::string> find_keys(const std::vector<SpectrumTable>& tables) {
    std::vector<std::string> keys;
    for (const SpectrumTable& table : tables) {
        for (const SpectrumColumn& column : table.columns) {
            if (std::find(keys.begin(), keys.end(), column.key) == keys.end()) keys.push_back(column.key);
        }
    }
    return keys;
}

std::string percent(double damping) { return fmt::format("{:.4g} %", 100.0 * damping); }

/// Do not all tables have the same `member`?
template <class Member>
bool differ(const std::vector<SpectrumTable>& tables, Member member) {
    return std::any_of(tables.begin(), tables.end(), [&](const SpectrumTable& table) { return table.*member != tables.front().*member; });
}

}  // namespace

std::vector<FileSpectra> compute_record_spectra(const std::vector<std::string>& files, const RecordSourceOptions& source,
                                                const SpectrumRequest& request, int threads) {
    const bool may_pair = request.has_rotd() && files.size() == 2;
    std::vector<FileSpectra> results(files.size());
    std::vector<std::optional<GroundMotion>> halves(files.size());  // records of one component that may be half a pair
    std::vector<std::function<void()>> jobs;
    for (std::size_t i = 0; i < files.size(); ++i) {
        jobs.emplace_back([&, i] {
            use_file(results[i], files[i], [&] {
                GroundMotion motion = load_leveled(source, files[i]);
                const bool alone = motion.components.size() == 1;
                if (request.has_rotd() && alone && !may_pair) {
                    throw records::ReadError(
                        fmt::format("{}: '{}' is its only component (--rotd takes two); give it with the other one's "
                                    "file alone",
                                    files[i], motion.components.front().name));
                }
                results[i].tables = make_tables(files[i], motion, request);
                if (may_pair && alone) halves[i] = std::move(motion);
            });
        });
    }
    {
        ProgressLine progress("spectra");
        scaling::run_side_by_side(jobs, threads, [&](double fraction) { progress.update(fraction); });
    }
    if (may_pair && halves[0] && halves[1]) {
        const std::string file = files[0] + " + " + files[1];
        use_file(results[1], file,
                 [&] { add_rotated_tables(results[1].tables, file, find_pair(*halves[0], *halves[1], request), request); });
    }
    return results;
}

nlohmann::json to_json(const std::vector<SpectrumTable>& tables) {
    nlohmann::json object{{"spectra", nlohmann::json::array()}, {"rotd", nlohmann::json::array()}};
    for (const SpectrumTable& table : tables) {
        nlohmann::json spectrum{
            {"file", table.file}, {"component", table.component}, {"damping", table.damping}, {"period_s", table.period}};
        for (const SpectrumColumn& column : table.columns) spectrum[column.key] = column.values;
        object[table.rotated ? "rotd" : "spectra"].push_back(std::move(spectrum));
    }
    return object;
}

void print_table(const SpectrumTable& table) {
    print("{}: {}, damping {}\n{:>12}", table.file, table.component, percent(table.damping), "period [s]");
    for (const SpectrumColumn& column : table.columns) print(" {:>16}", column.title);
    print("\n");
    for (std::size_t i = 0; i < table.period.size(); ++i) {
        print("{:>12.5g}", table.period[i]);
        for (const SpectrumColumn& column : table.columns) print(" {:>16.5g}", column.values[i]);
        print("\n");
    }
}

std::string make_csv(const std::vector<SpectrumTable>& tables) {
    const std::vector<std::string> keys = find_keys(tables);
    std::string text = "file,component,damping,period_s";
    for (const std::string& key : keys) text += "," + key;
    text += "\n";
    for (const SpectrumTable& table : tables) {
        const std::string start = fmt::format("{},{},{}", records::csv_cell(table.file), records::csv_cell(table.component), table.damping);
        std::vector<const SpectrumColumn*> columns;
        columns.reserve(keys.size());
        for (const std::string& key : keys) columns.push_back(find_column(table, key));
        for (std::size_t i = 0; i < table.period.size(); ++i) {
            fmt::format_to(std::back_inserter(text), "{},{}", start, table.period[i]);
            for (const SpectrumColumn* column : columns) text += column != nullptr ? fmt::format(",{}", column->values[i]) : ",";
            text += "\n";
        }
    }
    return text;
}

std::string make_svg(const std::vector<SpectrumTable>& tables) {
    const bool many_files = differ(tables, &SpectrumTable::file), many_dampings = differ(tables, &SpectrumTable::damping);
    lsdem::LinePlot plot{.title = "Pseudo-spectral acceleration",
                         .subtitle = many_dampings ? "" : "damping " + percent(tables.front().damping),
                         .x_label = "period [s]",
                         .y_label = "PSA [g]",
                         .series = {},
                         .x_logarithmic = true,
                         .y_logarithmic = true};
    for (const SpectrumTable& table : tables) {
        for (const SpectrumColumn& column : table.columns) {
            if (column.curve.empty()) continue;
            std::string label = column.curve;
            if (many_dampings) label += ", " + percent(table.damping);
            // last, because it may be long
            if (many_files && !table.rotated) label += " " + std::filesystem::path(table.file).stem().string();
            plot.series.push_back({.label = label, .x = table.period, .y = column.values, .y_error = {}});
        }
    }
    return lsdem::make_svg(plot);
}

}  // namespace musim::cli
