#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/record_source.hpp"
#include "records/intensity.hpp"

namespace musim::cli {
namespace {

struct RecordInfoOptions {
    std::vector<std::string> files;
    RecordSourceOptions source;
    std::optional<Number> highpass;
    bool json = false;
};

/// One component with its measures.
struct ComponentInfo {
    std::string file;
    const records::GroundMotion& motion;
    const records::Component& component;
    std::optional<scaling::Frequency> corner;  ///< of the high-pass before integration
    records::Intensity intensity;
};

std::optional<double> absolute(const auto& peak, double unit) {
    return peak ? std::optional(std::abs(peak->value.value()) / unit) : std::nullopt;
}

nlohmann::json or_null(const std::optional<double>& value) { return value ? nlohmann::json(*value) : nlohmann::json(); }

std::string or_dash(const std::optional<double>& value, int digits) { return value ? fmt::format("{:.{}g}", *value, digits) : "-"; }

/// Measures in the units engineers quote.
struct Measures {
    std::optional<double> pga_g, pgv_cm_s, pgd_cm, arias_m_s, d5_95_s;
};

Measures measure(const records::Intensity& intensity) {
    Measures measures{absolute(intensity.pga, scaling::kStandardGravity.value()), absolute(intensity.pgv, 0.01),
                      absolute(intensity.pgd, 0.01), std::nullopt, std::nullopt};
    if (intensity.arias) measures.arias_m_s = intensity.arias->value();
    if (intensity.d5_95) measures.d5_95_s = intensity.d5_95->value();
    return measures;
}

nlohmann::json to_json(const ComponentInfo& info) {
    const records::TimeSeries& series = info.component.series;
    const Measures measures = measure(info.intensity);
    return {{"file", info.file},
            {"format", info.motion.format},
            {"station", info.motion.station},
            {"component", info.component.name},
            {"quantity", std::string(records::to_string(series.quantity()))},
            {"unit", std::string(records::si_unit_name(series.quantity()))},
            {"dt_s", series.dt().value()},
            {"npts", series.size()},
            {"highpass_hz", info.corner ? nlohmann::json(info.corner->value()) : nlohmann::json()},
            {"pga_g", or_null(measures.pga_g)},
            {"pgv_cm_s", or_null(measures.pgv_cm_s)},
            {"pgd_cm", or_null(measures.pgd_cm)},
            {"arias_m_s", or_null(measures.arias_m_s)},
            {"d5_95_s", or_null(measures.d5_95_s)}};
}

void print_row(const ComponentInfo& info) {
    const records::TimeSeries& series = info.component.series;
    const Measures m = measure(info.intensity);
    print("{:<10} {:<12} {:>9.6g} {:>7} {:>8} {:>9} {:>8} {:>9} {:>8}  {}\n", info.component.name, records::to_string(series.quantity()),
          series.dt().value(), series.size(), or_dash(m.pga_g, 4), or_dash(m.pgv_cm_s, 4), or_dash(m.pgd_cm, 4), or_dash(m.arias_m_s, 4),
          or_dash(m.d5_95_s, 4), info.corner ? fmt::format("high-pass {:g} Hz", info.corner->value()) : "as it stands");
}

void print_table(const std::vector<ComponentInfo>& infos) {
    const records::GroundMotion* motion = nullptr;
    for (const ComponentInfo& info : infos) {
        if (motion != &info.motion) {
            motion = &info.motion;
            print("{}: {}{}{}\n", info.file, motion->format, motion->station.empty() ? "" : ", station ", motion->station);
            print("{:<10} {:<12} {:>9} {:>7} {:>8} {:>9} {:>8} {:>9} {:>8}  {}\n", "component", "quantity", "dt [s]", "npts", "PGA [g]",
                  "PGV [cm/s]", "PGD [cm]", "Ia [m/s]", "D5-95 [s]", "integrated");
        }
        print_row(info);
    }
}

int run_record_info(const RecordInfoOptions& options) {
    // everything is read before anything is printed
    std::vector<records::GroundMotion> motions;
    for (const std::string& file : options.files) motions.push_back(options.source.load(file));
    std::vector<ComponentInfo> infos;
    for (std::size_t i = 0; i < motions.size(); ++i) {
        auto corner = motions[i].integration_corner;
        if (options.highpass) corner = options.highpass->value / scaling::si::seconds;
        for (const records::Component& component : motions[i].components) {
            infos.push_back({options.files[i], motions[i], component, corner, records::compute_intensity(component.series, corner)});
        }
    }
    if (options.json) {
        nlohmann::json list = nlohmann::json::array();
        for (const ComponentInfo& info : infos) list.push_back(to_json(info));
        print_json({{"components", list}});
    } else {
        print_table(infos);
    }
    return kDone;
}

}  // namespace

void add_record_command(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("record", "Ground-motion records");
    command->require_subcommand(1);
    auto options = std::make_shared<RecordInfoOptions>();
    CLI::App* info = command->add_subcommand("info", "Peaks, intensity and duration of every component");
    info->add_option("files", options->files, kRecordArgument)->required()->type_name("FILE");
    options->source.add_to(*info);
    info->add_option(
            "--highpass", options->highpass,
            "Corner [Hz] of the zero-phase high-pass before integration (default: none for corrected records, 0.05 for uncorrected)")
        ->type_name("NUMBER");
    add_json_option(*info, options->json);
    info->footer(
        "Examples:\n"
        "  musim record info CICLC.v1\n"
        "  musim record info CICLC.v1 --highpass 0.064\n"
        "  musim record info IELC180.AT2 IELC270.AT2 --json\n"
        "  musim record info motion.txt --unit g --dt 0.005");
    info->callback([&action, options] { action = [options] { return run_record_info(*options); }; });
    add_record_process_command(*command, action);
}

}  // namespace musim::cli
