#include <algorithm>
#include <cctype>
#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/record_source.hpp"
#include "cli/report.hpp"
#include "records/intensity.hpp"
#include "records/scale_record.hpp"
#include "records/write_record.hpp"

namespace musim::cli {
namespace {

struct RescaleOptions {
    std::string record;
    RecordSourceOptions source;
    SimilitudeOptions scales;
    std::string out;
    std::string format;     ///< empty: by the extension of `out`
    std::string component;  ///< for formats that hold one
    bool json = false;
};

/// "at2" or "csv", from --format or else from the extension.
std::string find_format(const RescaleOptions& options) {
    std::string format = options.format.empty() ? std::filesystem::path(options.out).extension().string() : options.format;
    if (format.starts_with('.')) format.erase(0, 1);
    std::transform(format.begin(), format.end(), format.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (format == "vt2" || format == "dt2") format = "at2";
    if (format != "at2" && format != "csv") {
        throw records::WriteError(options.out + ": the format is not told by the extension; add --format at2 or --format csv");
    }
    return format;
}

void write(const RescaleOptions& options, const records::GroundMotion& model) {
    if (find_format(options) == "csv") {
        records::write_csv(options.out, model);
        return;
    }
    if (options.component.empty() && model.components.size() > 1) {
        throw records::WriteError(options.out + ": a PEER file holds one component; choose one with --component (" +
                                  model.component_names() + ")");
    }
    records::write_at2(options.out, model, options.component.empty() ? model.components.front().name : options.component);
}

/// Peaks of one component in SI.
struct Peaks {
    std::optional<double> pga, pgv;
    double duration = 0.0;
    double dt = 0.0;
};

Peaks find_peaks(const records::GroundMotion& motion, const records::Component& component) {
    const records::Intensity intensity = records::compute_intensity(component.series, motion.integration_corner);
    Peaks peaks{.pga = {}, .pgv = {}, .duration = component.series.duration().value(), .dt = component.series.dt().value()};
    if (intensity.pga) peaks.pga = std::abs(intensity.pga->value.value()) / scaling::kStandardGravity.value();
    if (intensity.pgv) peaks.pgv = 100.0 * std::abs(intensity.pgv->value.value());
    return peaks;
}

nlohmann::json to_json(const Peaks& peaks) {
    nlohmann::json object{{"dt_s", peaks.dt}, {"duration_s", peaks.duration}, {"pga_g", nullptr}, {"pgv_cm_s", nullptr}};
    if (peaks.pga) object["pga_g"] = *peaks.pga;
    if (peaks.pgv) object["pgv_cm_s"] = *peaks.pgv;
    return object;
}

void print_peaks(const char* what, const std::string& component, const Peaks& peaks) {
    print("{:<10} {:<10} {:>12.7g} {:>12.7g} {:>10} {:>11}\n", what, component, peaks.dt, peaks.duration,
          peaks.pga ? fmt::format("{:.5g}", *peaks.pga) : "-", peaks.pgv ? fmt::format("{:.5g}", *peaks.pgv) : "-");
}

int run_rescale(const RescaleOptions& options) {
    const scaling::Similitude similitude = options.scales.similitude();
    find_format(options);
    const records::GroundMotion prototype = options.source.load(options.record);
    const records::GroundMotion model = records::rescale(prototype, similitude);
    write(options, model);

    nlohmann::json components = nlohmann::json::array();
    if (!options.json) {
        print("Law {}: time {:.7g}, velocity {:.7g}, acceleration {:.7g} (model/prototype)\n\n", scaling::to_string(similitude.law()),
              similitude.time(), similitude.velocity(), similitude.acceleration());
        print("{:<10} {:<10} {:>12} {:>12} {:>10} {:>11}\n", "", "component", "dt [s]", "length [s]", "PGA [g]", "PGV [cm/s]");
    }
    for (std::size_t c = 0; c < model.components.size(); ++c) {
        const std::string& name = model.components[c].name;
        const Peaks before = find_peaks(prototype, prototype.components[c]);
        const Peaks after = find_peaks(model, model.components[c]);
        components.push_back({{"component", name}, {"prototype", to_json(before)}, {"model", to_json(after)}});
        if (!options.json) {
            print_peaks("prototype", name, before);
            print_peaks("model", name, after);
        }
    }
    if (options.json) {
        nlohmann::json object = study::to_json(similitude);
        object["out"] = options.out;
        object["components"] = components;
        print_json(object);
    } else {
        print("\nWritten to {}\n", options.out);
    }
    return kDone;
}

}  // namespace

void add_rescale_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<RescaleOptions>();
    CLI::App* command = app.add_subcommand("rescale", "The record a model must be shaken with, from the prototype's");
    command->add_option("record", options->record, kRecordArgument)->required()->type_name("RECORD");
    options->scales.add_to(*command);
    command->add_option("-o,--out", options->out, "File to write: .csv (all components) or .at2 (one)")->required()->type_name("OUT");
    command->add_option("--format", options->format, "at2 or csv, when the extension does not tell")->type_name("FORMAT");
    command->add_option("--component", options->component, "Component for a .at2 file, e.g. 360")->type_name("NAME");
    options->source.add_to(*command);
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim rescale CICLC.v1 --length 1/107 --friction 0.63/0.59 -o model.csv\n"
        "  musim rescale CICLC.v1 --length 1/25 --component 360 -o model.at2\n"
        "  musim rescale synthetic --length 1/107 --law froude -o model.csv --json");
    command->callback([&action, options] { action = [options] { return run_rescale(*options); }; });
}

}  // namespace musim::cli
