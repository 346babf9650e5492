#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/named_values.hpp"
#include "cli/option_name.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/record_source.hpp"
#include "cli/records/record_peaks.hpp"
#include "cli/usage.hpp"
#include "records/measures/intensity.hpp"
#include "records/measures/measures.hpp"
#include "records/measures/response_spectrum.hpp"
#include "records/measures/sliding_block.hpp"
#include "records/processing/processing.hpp"

namespace musim::cli {
namespace {

/// Settings that measures of a record depend on, as options --bracket, --mean-period-band, --intensity-band.
struct MeasureSettings {
    Number bracket{0.05};                                ///< threshold of the bracketed duration [g]
    std::vector<Number> mean_period_band{{0.25}, {20}};  ///< lowest and highest frequency of the mean period [Hz]
    std::vector<Number> intensity_band{{0.1}, {2.5}};    ///< first and last period of the spectrum intensity [s]

    void add_to(CLI::App& command) {
        command.add_option("--bracket", bracket, "Threshold [g] of the bracketed duration (default 0.05)")
            ->type_name("NUMBER")
            ->check(above_zero());
        command.add_option("--mean-period-band", mean_period_band, "Frequencies [Hz] of the mean period (default 0.25 20)")
            ->type_name("LOW HIGH")
            ->expected(2)
            ->check(above_zero());
        command.add_option("--intensity-band", intensity_band, "Periods [s] of Housner's spectrum intensity (default 0.1 2.5)")
            ->type_name("FIRST LAST")
            ->expected(2)
            ->check(above_zero());
    }
};

/// The structure that a record is put in proportion to, as options --friction, --length, --slenderness.
struct StructureOptions {
    std::optional<Number> friction;     ///< friction coefficient μ
    std::optional<Number> length;       ///< l [m]
    std::optional<Number> slenderness;  ///< angle α between diagonal and height of a block [deg]

    void add_to(CLI::App& command) {
        command.add_option("--friction", friction, "Friction coefficient of a structure, for groups and sliding")
            ->type_name("MU")
            ->check(above_zero());
        command.add_option("--length", length, "Length [m] of a structure, for groups")->type_name("L")->check(above_zero());
        command.add_option("--slenderness", slenderness, "Angle [deg] between a block's diagonal and its height, for groups")
            ->type_name("ALPHA")
            ->check(above_zero())
            ->check(check_number([](double degrees) { return degrees < 90.0; }, " is not below 90"));
    }
    bool any() const { return friction || length || slenderness; }
};

struct RecordInfoOptions {
    std::vector<std::string> files;
    RecordSourceOptions source;
    std::optional<Number> highpass;
    MeasureSettings measures;
    StructureOptions structure;
    bool json = false;
};

/// One component with its measures.
struct ComponentInfo {
    std::string file;
    const records::GroundMotion& motion;
    const records::Component& component;
    std::optional<scaling::Frequency> corner;  ///< of the high-pass before integration
    records::Intensity intensity;
    NamedValues measures;
    NamedValues groups;  ///< with a structure; none: empty
};

/// When a component begins, where its file says so.
std::optional<records::UtcTime> find_first_sample(const ComponentInfo& info) {
    if (!info.motion.time_zero) return std::nullopt;
    return records::find_instant(*info.motion.time_zero, info.component.series.start());
}

/// Step and peaks, in the units engineers quote.
NamedValues list_peaks(const ComponentInfo& info) {
    const records::TimeSeries& series = info.component.series;
    const records::Intensity& intensity = info.intensity;
    NamedValues values{
        {"component", {}, info.component.name},
        {"quantity", "quantity", records::to_string(series.quantity()), "", records::is_rotation(info.component) ? -20 : -12},
        {"dt_s", {}, series.dt().value()},
        {{}, "dt [ms]", 1e3 * series.dt().value(), ".6g", 9},
        {"npts", "npts", series.size(), "", 7}};
    const auto add = [&](const NamedValues& more) { values.insert(values.end(), more.begin(), more.end()); };
    if (records::is_rotation(info.component)) {
        add(list_rotation_peaks(intensity));
    } else {
        add({{"pga_g", "PGA [g]", or_null(size_of(intensity.pga, scaling::kStandardGravity.value())), ".4g", 8},
             {"pgv_cm_s", "PGV [cm/s]", or_null(size_of(intensity.pgv, 0.01)), ".4g", 9},
             {"pgd_cm", "PGD [cm]", or_null(size_of(intensity.pgd, 0.01)), ".4g", 8},
             {"arias_m_s", "Ia [m/s]", or_null(in_si(intensity.arias)), ".4g", 9},
             {"d5_95_s", "D5-95 [s]", or_null(in_si(intensity.d5_95)), ".4g", 8}});
    }
    add({{"highpass_hz", {}, or_null(in_si(info.corner))}, {{}, "integrated", describe_integration(info.corner), "", -1}});
    return values;
}

nlohmann::json component_json(const ComponentInfo& info) {
    const records::TimeSeries& series = info.component.series;
    const auto first = find_first_sample(info);
    nlohmann::json object{{"file", info.file},
                          {"format", info.motion.format},
                          {"station", info.motion.station},
                          {"unit", records::si_unit_name(series.quantity())},
                          {"start_s", series.start().value()},
                          {"first_sample_utc", first ? nlohmann::json(records::to_string(*first)) : nlohmann::json()},
                          {"begins_in_motion", info.corner && records::begins_in_motion(series)},
                          {"history", info.motion.history}};
    add_to_json(object, list_peaks(info));
    add_to_json(object, info.measures);
    if (!info.groups.empty()) add_to_json(object["groups"], info.groups);
    return object;
}

/// When components begin, what was done to their samples since the file, sensitivities included, and levels that are not taken from rest.
void print_origin(std::span<const ComponentInfo> infos) {
    for (const ComponentInfo& info : infos) {
        const auto first = find_first_sample(info);
        print("{:<10} starts at {:.9g} s{}{}\n", info.component.name, info.component.series.start().value(),
              first ? ", " + records::to_string(*first) + " UTC" : "",
              info.corner && records::begins_in_motion(info.component.series) ? ", in motion: its level is the mean of all samples" : "");
    }
    for (const std::string& step : infos.front().motion.history) print("{:<10} {}\n", "", step);
}

/// A table of the components that have these values, under the titles of the first.
template <class Find>
void print_values(std::span<const ComponentInfo> infos, bool of_rotations, const Find& find) {
    bool is_first = true;
    for (const ComponentInfo& info : infos) {
        const NamedValues values = find(info);
        if (records::is_rotation(info.component) != of_rotations || values.empty()) continue;
        if (is_first) print_titles("component", values);
        print_row(info.component.name, values);
        is_first = false;
    }
}

/// The components of one file: peaks, measures, and groups if there are.
void print_tables(std::span<const ComponentInfo> infos) {
    const records::GroundMotion& motion = infos.front().motion;
    print("{}: {}{}{}\n", infos.front().file, motion.format, motion.station.empty() ? "" : ", station ", motion.station);
    for (const bool of_rotations : {false, true}) print_values(infos, of_rotations, list_peaks);
    print_origin(infos);
    print_values(infos, false, [](const ComponentInfo& info) { return info.measures; });
    print_values(infos, false, [](const ComponentInfo& info) { return info.groups; });
}

/// Duration, energy and periods of an acceleration; those that another quantity does not give are missing. `intensity` is that of the same
/// series, leveled like it (records::level_uncorrected), both with `corner` for uncorrected records. Throws records::ProcessingError for
/// settings that make no sense.
NamedValues measure_record(const records::TimeSeries& leveled, const records::Intensity& intensity,
                           const std::optional<scaling::Frequency>& corner, const MeasureSettings& settings) {
    std::optional<double> d5_75, cav, rms, bracketed, housner, vmax_over_amax, mean_period, predominant_period, pulse_period;
    if (leveled.quantity() == records::SampleQuantity::acceleration) {
        d5_75 = records::compute_significant_duration(leveled, 0.05, 0.75).value();
        cav = records::compute_cumulative_absolute_velocity(leveled).value();
        rms = records::compute_rms_acceleration(leveled) / scaling::kStandardGravity;
        bracketed = in_si(records::compute_bracketed_duration(leveled, settings.bracket.value * scaling::kStandardGravity));
        housner = records::compute_spectrum_intensity(leveled, settings.intensity_band.at(0).value * scaling::si::seconds,
                                                      settings.intensity_band.at(1).value * scaling::si::seconds)
                      .value() /
                  0.01;
        mean_period = in_si(records::compute_mean_period(records::compute_fourier_amplitudes(leveled),
                                                         settings.mean_period_band.at(0).value / scaling::si::seconds,
                                                         settings.mean_period_band.at(1).value / scaling::si::seconds));
        const auto spectrum = records::compute_own_spectrum(leveled, corner);
        predominant_period = in_si(records::find_predominant_period(spectrum));
        pulse_period = in_si(records::find_pulse_period(spectrum));
    }
    if (intensity.pga && intensity.pgv && intensity.pga->value.value() != 0.0) {
        vmax_over_amax = std::abs(intensity.pgv->value.value() / intensity.pga->value.value());
    }
    return {{"d5_75_s", "D5-75 [s]", or_null(d5_75)},
            {"cav_m_s", "CAV [m/s]", or_null(cav)},
            {"rms_g", "RMS [g]", or_null(rms)},
            {"bracketed_s", "bracketed [s]", or_null(bracketed)},
            {"housner_cm", "SI [cm]", or_null(housner)},
            {"vmax_over_amax_s", "PGV/PGA [s]", or_null(vmax_over_amax)},
            {"mean_period_s", "T mean [s]", or_null(mean_period)},
            {"predominant_period_s", "T PSA [s]", or_null(predominant_period)},
            {"pulse_period_s", "T PSV [s]", or_null(pulse_period)}};
}

/// Strength of a horizontal component for a structure in standard gravity, in dimensionless groups, and how far a Newmark block slides
/// (its largest distance); missing of vertical ones, and where the structure or the record does not give it. `leveled` and `intensity` as
/// above.
NamedValues compute_record_groups(const records::TimeSeries& leveled, const records::Intensity& intensity, bool is_vertical,
                                  const StructureOptions& structure) {
    const double g = scaling::kStandardGravity.value();
    std::optional<double> pga_friction, pgv_friction, pga_slenderness, sliding, sliding_length;
    if (structure.friction && !is_vertical) {
        const double yield = structure.friction->value * g;  // [m/s²]
        if (intensity.pga) pga_friction = std::abs(intensity.pga->value.value()) / yield;
        if (intensity.pgv && structure.length) {
            pgv_friction = std::abs(intensity.pgv->value.value()) / std::sqrt(yield * structure.length->value);
        }
        if (leveled.quantity() == records::SampleQuantity::acceleration) {
            sliding = records::compute_sliding(leveled, scaling::Acceleration::from_value(yield)).largest.value();
            if (structure.length) sliding_length = *sliding / structure.length->value;
        }
    }
    if (structure.slenderness && intensity.pga && !is_vertical) {
        pga_slenderness = std::abs(intensity.pga->value.value()) / (g * std::tan(structure.slenderness->value * std::numbers::pi / 180.0));
    }
    return {{"pga_over_mu_g", "PGA/(mu g)", or_null(pga_friction)},
            {"pgv_over_sqrt_mu_g_l", "PGV/sqrt(mu g l)", or_null(pgv_friction)},
            {"pga_over_g_tan_alpha", "PGA/(g tan alpha)", or_null(pga_slenderness)},
            {"newmark_sliding_m", "sliding [m]", or_null(sliding)},
            {"newmark_sliding_over_length", "sliding/l", or_null(sliding_length)}};
}

ComponentInfo make_info(const RecordInfoOptions& options, const std::string& file, const records::GroundMotion& motion,
                        const records::Component& component) {
    auto corner = motion.integration_corner;
    if (options.highpass) corner = options.highpass->value / scaling::si::seconds;
    const records::Intensity intensity = records::compute_intensity(component.series, corner);
    const records::TimeSeries leveled = records::level_uncorrected(component.series, corner);
    ComponentInfo info{file, motion, component, corner, intensity, {}, {}};
    if (records::is_rotation(component)) return info;
    info.measures = measure_record(leveled, intensity, corner, options.measures);
    if (options.structure.any()) {
        info.groups = compute_record_groups(leveled, intensity, records::is_vertical(component), options.structure);
    }
    return info;
}

/// A displacement that is largest where the record ends has drifted, as a rule.
void note_drift(const ComponentInfo& info) {
    constexpr double kEnd = 0.01;  // of the record
    if (info.corner || !info.intensity.pgd) return;
    const records::TimeSeries& series = info.component.series;
    if (info.intensity.pgd->time < series.end() - kEnd * series.duration()) return;
    note_at_end(
        fmt::format("musim: note: {}: displacement of {} is largest at the end, {:.3g} m: drift, unless the ground moved for good; a "
                    "high-pass takes it out (--highpass 0.05)",
                    info.file, info.component.name, std::abs(info.intensity.pgd->value.value())));
}

/// A file and its components, or what is wrong with it.
struct FileInfo {
    std::optional<records::GroundMotion> motion;
    std::vector<ComponentInfo> components;
    std::string error;
};

/// Fills in one file; the components refer to the motion beside them.
void read_info(const RecordInfoOptions& options, const std::string& file, FileInfo& info) {
    try {
        info.motion = options.source.load(file);
        for (const records::Component& component : info.motion->components) {
            info.components.push_back(make_info(options, file, *info.motion, component));
            note_drift(info.components.back());
        }
    } catch (const records::ReadError& error) {
        info.error = word(error);
    } catch (const records::ProcessingError& error) {
        info.error = file + ": " + word(error);
    }
    if (!info.error.empty()) info.components.clear();
}

int run_record_info(const RecordInfoOptions& options) {
    require_ascending("--mean-period-band", options.measures.mean_period_band);
    require_ascending("--intensity-band", options.measures.intensity_band);
    std::vector<FileInfo> infos(options.files.size());
    for (std::size_t i = 0; i < infos.size(); ++i) read_info(options, options.files[i], infos[i]);
    const bool any = std::any_of(infos.begin(), infos.end(), [](const FileInfo& info) { return info.error.empty(); });
    if (options.json && any) {
        nlohmann::json list = nlohmann::json::array();
        for (const FileInfo& of_file : infos) {
            for (const ComponentInfo& info : of_file.components) list.push_back(component_json(info));
        }
        print_json({{"components", list}});
    } else {
        for (const FileInfo& of_file : infos) {
            if (!of_file.components.empty()) print_tables(of_file.components);
        }
    }
    int code = kDone;
    for (const FileInfo& of_file : infos) {
        if (of_file.error.empty()) continue;
        note("musim: error: {}\n", of_file.error);
        code = kInputError;
    }
    return code;
}

}  // namespace

void add_record_command(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("record", "Ground-motion records");
    command->require_subcommand(1);
    auto options = std::make_shared<RecordInfoOptions>();
    CLI::App* info = command->add_subcommand("info", "Peaks, intensity, durations and periods of every component");
    info->add_option("files", options->files, kRecordArgument)->required()->type_name("FILE");
    options->source.add_to(*info);
    info->add_option("--highpass", options->highpass,
                     "Corner [Hz] of the zero-phase high-pass before integration (default: none for corrected records, 0.05 for "
                     "uncorrected, or as the format says)")
        ->type_name("NUMBER")
        ->check(above_zero());
    options->measures.add_to(*info);
    options->structure.add_to(*info);
    add_json_option(*info, options->json);
    info->footer(
        "Examples:\n"
        "  musim record info CICLC.v1\n"
        "  musim record info CICLC.v1 --highpass 0.064\n"
        "  musim record info IELC180.AT2 IELC270.AT2 --json\n"
        "  musim record info motion.txt --unit g --dt 0.005\n"
        "  musim record info phone.csv            # columns such as \"gyro x (deg/s)\" are rotations: their peaks stand in a table of "
        "their own\n"
        "  musim record info CICLC.v1 --friction 0.59 --length 1.36 --slenderness 17.7      # groups, sliding of a Newmark block\n"
        "  musim record info model.csv --mean-period-band 2.67 214\n"
        "T mean: of the Fourier amplitudes; T PSA and T PSV: of the largest 5 % PSA and PSV among 200 periods from 4 dt to the duration, "
        "with\n"
        "as long a rest behind the record; of uncorrected records to a quarter of it or 1/corner. Measures of uncorrected records are of "
        "the samples above their initial level.\n"
        "SI: Housner's spectrum intensity, the area below PSV at 5 % from 0.1 to 2.5 s. A file that cannot be used is an error line, the "
        "others\n"
        "are shown (exit code 3).");
    info->callback([&action, options] { action = [options] { return run_record_info(*options); }; });
    add_record_plot_command(*command, action);
    add_record_spectrum_command(*command, action);
    add_record_process_command(*command, action);
    add_record_match_command(*command, action);
    add_record_make_command(*command, action);
    group_commands(*command, "Measure a record", {"info", "plot", "spectrum"});
    group_commands(*command, "Change a record", {"process", "match"});
    group_commands(*command, "Make a motion", {"make"});
}

}  // namespace musim::cli
