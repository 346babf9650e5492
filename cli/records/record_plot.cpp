#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/files.hpp"
#include "cli/named_values.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/record_source.hpp"
#include "cli/records/record_peaks.hpp"
#include "cli/report.hpp"
#include "lsdem/plot/picture_file.hpp"
#include "lsdem/report/record_figure.hpp"
#include "records/atomic_file.hpp"
#include "records/processing/scale_record.hpp"

namespace musim::cli {
namespace {

struct RecordPlotOptions {
    std::vector<std::string> files;
    RecordSourceOptions source;
    std::string component;
    std::optional<Number> highpass;
    Number damping{0.05};
    std::vector<Number> window;  ///< from and to [s]; empty: all
    SimilitudeOptions scales;
    bool scaled = false;  ///< a model is drawn too
    std::string out;
    std::string csv;
    bool json = false;
};

records::CurveRequest make_request(const RecordPlotOptions& options) {
    records::CurveRequest request{.damping = options.damping, .window = {}};
    if (!options.window.empty()) {
        request.window = {options.window.at(0).value * scaling::si::seconds, options.window.at(1).value * scaling::si::seconds};
    }
    return request;
}

/// The components that are wanted, as one motion.
records::GroundMotion load_wanted(const RecordPlotOptions& options, const std::string& file) {
    records::GroundMotion motion = options.source.load(file);
    if (!options.component.empty()) motion.components = {records::Component(motion.find_component(options.component))};
    if (options.highpass) motion.integration_corner = options.highpass->value / scaling::si::seconds;
    motion.source = file;
    return keep_translations(std::move(motion), file, "not drawn");
}

void add_components(std::vector<records::ComponentCurves>& list, const records::GroundMotion& prototype,
                    const records::CurveRequest& request, const std::optional<scaling::ModelScales>& scales) {
    const auto model = scales ? std::optional(records::rescale(prototype, *scales)) : std::nullopt;
    try {
        for (std::size_t i = 0; i < prototype.components.size(); ++i) {
            list.push_back(records::compute_curves(prototype, prototype.components[i], request));
            if (model) list.push_back(records::compute_curves(*model, model->components[i], request, scales));
        }
    } catch (const records::ProcessingError& error) {
        throw error.seen_from<records::ProcessingError>(prototype.source);
    }
}

/// Refuses more components than can be distinguished.
void require_looks(const std::vector<records::GroundMotion>& motions, bool with_models) {
    std::size_t components = 0;
    for (const records::GroundMotion& motion : motions) components += motion.components.size();
    const std::size_t most = lsdem::count_styles(lsdem::find_styles(with_models)) / (with_models ? 2 : 1);
    if (components > most) {
        throw records::ProcessingError(fmt::format(
            "record plot: {} components are too many for one figure (at most {}{} look different); draw fewer files, or one --component",
            components, most, with_models ? " with their models" : ""));
    }
}

template <class Peak>
void add_peak(nlohmann::json& object, const char* value_key, const char* time_key, const std::optional<Peak>& peak, double unit) {
    object[value_key] = peak ? nlohmann::json(peak->value.value() / unit) : nlohmann::json();
    object[time_key] = peak ? nlohmann::json(peak->time.value()) : nlohmann::json();
}

/// Peaks of the components, their own: a list of objects.
nlohmann::json peaks_to_json(const std::vector<records::ComponentCurves>& components) {
    nlohmann::json list = nlohmann::json::array();
    for (const records::ComponentCurves& component : components) {
        nlohmann::json object{{"file", component.file},
                              {"component", component.component},
                              {"scale", component.model ? "model" : "prototype"},
                              {"highpass_hz", or_null(in_si(component.corner))}};
        add_peak(object, "pga_g", "pga_time_s", component.intensity.pga, scaling::kStandardGravity.value());
        add_peak(object, "pgv_cm_s", "pgv_time_s", component.intensity.pgv, 0.01);
        add_peak(object, "pgd_cm", "pgd_time_s", component.intensity.pgd, 0.01);
        list.push_back(std::move(object));
    }
    return list;
}

int run_record_plot(const RecordPlotOptions& options) {
    // what is asked for is looked at before anything is computed
    require_ascending("--window", options.window);
    read_option("--out", [&] { lsdem::require_picture_name(options.out); });
    refuse_overwriting(options.source.find_files(options.files), {options.out, options.csv});
    options.scales.note_values_used();
    const records::CurveRequest request = make_request(options);
    lsdem::RecordFigure figure{.damping = request.damping,
                               .windowed = request.window.has_value(),
                               .model_of = options.scaled ? std::optional(options.scales.model_scales()) : std::nullopt};
    std::vector<records::GroundMotion> motions;
    for (const std::string& file : options.files) motions.push_back(load_wanted(options, file));
    require_looks(motions, options.scaled);
    for (const records::GroundMotion& motion : motions) add_components(figure.components, motion, request, figure.model_of);
    figure.title = motions.size() == 1 ? lsdem::make_title(motions.front()) : fmt::format("{} records", motions.size());

    const lsdem::ReportFigure drawn = lsdem::make_figure("records", figure);
    lsdem::write_picture(options.out, drawn.svg);
    if (!options.csv.empty()) records::write_file_atomically(options.csv, drawn.csv);
    if (options.json) {
        nlohmann::json object{{"out", options.out}, {"components", peaks_to_json(figure.components)}};
        if (!options.csv.empty()) object["csv"] = options.csv;
        if (figure.model_of) object["similitude"] = to_json(*figure.model_of);
        print_json(object);
    } else {
        print("{} component{} drawn in {}{}\n", figure.components.size(), figure.components.size() == 1 ? "" : "s", options.out,
              options.csv.empty() ? "" : ", their samples in " + options.csv);
    }
    return kDone;
}

}  // namespace

void add_record_plot_command(CLI::App& record, Action& action) {
    auto options = std::make_shared<RecordPlotOptions>();
    CLI::App* command = record.add_subcommand("plot", "A figure of records: histories, peaks, Arias build-up, spectra; of a model too");
    command->add_option("files", options->files, kRecordArgument)->required()->type_name("FILE");
    command->add_option("-o,--out", options->out, "Picture to write: .svg, .png or .pdf")->required()->type_name("OUT");
    command->add_option("--csv", options->csv, "File for all that is drawn, every sample")->type_name("FILE");
    options->source.add_to(*command);
    command->add_option("--component", options->component, "This component only, e.g. 360")->type_name("NAME");
    command
        ->add_option("--highpass", options->highpass,
                     "Corner [Hz] of the zero-phase high-pass before integration, a prototype's (default: as record info)")
        ->type_name("NUMBER");
    command->add_option("--damping", options->damping, "Damping ratio of PSA (default 0.05)")->type_name("NUMBER")->check(damping_ratio());
    command->add_option("--window", options->window, "Part of the histories to show [s of the prototype]")
        ->expected(2)
        ->type_name("FROM TO");
    options->scales.add_to(*command);
    CLI::Option* length = command->get_option("--length")->required(false);
    for (const char* other : {"--friction", "--gravity", "--density", "--law", "--set"}) command->get_option(other)->needs(length);
    add_json_option(*command, options->json);
    command->footer(
        "Examples:\n"
        "  musim record plot CICLC.v1 -o record.svg\n"
        "  musim record plot CICLC.v1 --component 360 --window 220 260 -o record.png --csv record.csv\n"
        "  musim record plot TCU052-N.AT2 TCU052-E.AT2 --damping 0.02 -o records.pdf\n"
        "  musim record plot CICLC.v1 --component 360 --length 1/107 --friction 0.63/0.59 -o both.svg\n"
        "With --length prototype and model are drawn together, the model's curves divided by its factors: they fall on the prototype's. "
        "Peaks\n"
        "and spectra are of the whole record, whatever the window; PSA goes to periods as long as the record, with as long a rest behind "
        "it; of\n"
        "uncorrected records to a quarter of it or 1/corner.");
    command->callback([&action, options, length] {
        options->scaled = length->count() > 0;
        action = [options] { return run_record_plot(*options); };
    });
}

}  // namespace musim::cli
