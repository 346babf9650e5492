#include "lsdem/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lsdem/plot/figure.hpp"
#include "lsdem/report/json_parts.hpp"
#include "lsdem/report/record_figure.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "records/processing/scale_record.hpp"

namespace musim::lsdem {
namespace {

using records::GroundMotion;
using scaling::ModelScales;

/// Which way a component of a base motion goes, by name.
constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

/// From the record to the base, by the scene that the run carries; nothing for a scene that cannot be read or scales nothing.
std::optional<ModelScales> find_scales(const ReportedRun& reported) {
    try {
        const SceneMotion motion = parse_scene(reported.run.scene).base_motion;
        const auto* record = std::get_if<RecordMotion>(&motion.source);
        const bool scales_record = record != nullptr && record->scale.has_value();
        const MotionFactors& more = motion.factors;
        const bool is_model = !(more == MotionFactors{});
        if (!scales_record && !is_model) return std::nullopt;
        ModelScales scales;
        if (scales_record) scales = ModelScales(make_similitude(*record->scale));
        if (is_model) {
            const std::string law = find_text(find_object(reported.summary, "similitude"), "law", "its scene's own");
            scales.law += (scales.law.empty() ? "" : ", then ") + law;
        }
        scales.time *= more.time;
        scales.frequency /= more.time;
        scales.velocity *= more.velocity;
        scales.velocity_vertical *= more.velocity_vertical;
        scales.acceleration = scales.velocity / scales.time;
        scales.acceleration_vertical = scales.velocity_vertical / scales.time;
        scales.displacement = scales.velocity * scales.time;
        scales.displacement_vertical = scales.velocity_vertical * scales.time;
        return scales;
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
}

/// The components along which the base moves, over the scales that are given.
GroundMotion make_motion(const ReportedRun& reported, const ModelScales& over) {
    const History& history = reported.run.history;
    GroundMotion motion{.source = reported.label};
    if (history.samples() < 3) return motion;
    const double interval = (history.time.back() - history.time.front()) / static_cast<double>(history.samples() - 1);
    for (int axis = 0; axis < 3; ++axis) {
        const scaling::Shaking direction = axis == 2 ? scaling::Shaking::vertical : scaling::Shaking::horizontal;
        const double unit = interval * over.shaking(direction).acceleration;
        std::vector<double> acceleration;
        for (std::size_t k = 1; k < history.samples(); ++k) {
            acceleration.push_back((history.base[k].velocity[axis] - history.base[k - 1].velocity[axis]) / unit);
        }
        if (std::all_of(acceleration.begin(), acceleration.end(), [](double a) { return a == 0.0; })) continue;
        const scaling::Time step = interval / over.time * scaling::si::seconds;
        motion.components.push_back({.name = kAxes[static_cast<std::size_t>(axis)],
                                     .azimuth_deg = {},
                                     .series = {records::SampleQuantity::acceleration, 0.5 * step, step, std::move(acceleration)}});
    }
    return motion;
}

/// Gives a component the PGA of the run: samples of the base may miss the peak of its acceleration.
void name_peak(records::ComponentCurves& curves, const ReportedRun& reported, const ModelScales& over) {
    const auto axis = std::find(kAxes.begin(), kAxes.end(), curves.component) - kAxes.begin();
    if (axis == 3 || !curves.intensity.pga) return;
    const scaling::Shaking direction = axis == 2 ? scaling::Shaking::vertical : scaling::Shaking::horizontal;
    const double peak = reported.run.peak_base_acceleration[axis] / over.shaking(direction).acceleration;
    if (peak > 0.0) curves.intensity.pga->value = scaling::Acceleration::from_value(peak);
}

/// One line for each axis that a record moves, and for one whose PGA is not that of its formula.
std::string make_change_notes(const ReportedRun& reported) {
    std::string html;
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
        const double pga = reported.run.peak_base_acceleration[static_cast<int>(axis)];
        const std::optional<BaseChange>& change = reported.run.base_changes[axis];
        const std::string text = describe_base(pga, change);
        if (!change || text.find('(') == std::string::npos) continue;
        const bool is_changed = change->of_record && change->peaks.is_changed();
        html += make_statement(is_changed ? Tone::warning : Tone::note, fmt::format("{} along {}: {}", reported.label, kAxes[axis], text));
    }
    return html;
}

ReportFigure make_base_figure(const ReportedRun& reported, const std::optional<ModelScales>& scales, std::size_t number) {
    RecordFigure figure{.damping = records::CurveRequest{}.damping,
                        .windowed = false,
                        .title = scales ? fmt::format("Base motion of {}, before and after it was rescaled", reported.label)
                                        : fmt::format("Base motion of {}", reported.label),
                        .model_of = scales};
    const GroundMotion prototype = make_motion(reported, scales.value_or(ModelScales{}));
    const GroundMotion model = make_motion(reported, ModelScales{});
    for (std::size_t i = 0; i < prototype.components.size(); ++i) {
        figure.components.push_back(records::compute_curves(prototype, prototype.components[i], {}));
        name_peak(figure.components.back(), reported, scales.value_or(ModelScales{}));
        if (!scales) continue;
        figure.components.push_back(records::compute_curves(model, model.components[i], {}, scales));
        name_peak(figure.components.back(), reported, ModelScales{});
    }
    return make_figure(fmt::format("base_motion_{}", number), figure);
}

}  // namespace

ReportSection make_record_section(const ReportContent& content) {
    ReportSection section{.id = "records", .title = "Records"};
    HtmlTable table{.caption = "Components; peaks and spectra of translations below",
                    .heads = {"file", "format", "station", "component", "samples", "step [s]", "duration [s]", "integrated"}};
    // more components than looks are drawn in figures of their own
    const std::size_t most = count_styles(find_styles(false));
    for (const ReportedRecord& record : content.records) {
        GroundMotion motion = record.motion;
        for (const records::Component& component : motion.components) {
            table.rows.push_back({{.text = record.label},
                                  {.text = motion.format},
                                  {.text = make_title(motion)},
                                  {.text = component.name},
                                  number_cell(static_cast<double>(component.series.size()), 9),
                                  number_cell(component.series.dt().value()),
                                  number_cell(component.series.duration().value(), 6),
                                  {.text = motion.integration_corner
                                               ? fmt::format("high-passed at {:.4g} Hz (uncorrected)", motion.integration_corner->value())
                                               : "no filter"}});
        }
        // peaks and spectra are those of accelerations
        std::erase_if(motion.components, [](const records::Component& component) { return records::is_rotation(component); });
        for (std::size_t first = 0; first < motion.components.size(); first += most) {
            RecordFigure figure{.damping = records::CurveRequest{}.damping,
                                .windowed = false,
                                .title = fmt::format("{}: {}", record.label, make_title(motion))};
            const std::size_t last = std::min(first + most, motion.components.size());
            for (std::size_t i = first; i < last; ++i) {
                figure.components.push_back(records::compute_curves(motion, motion.components[i], {}));
            }
            section.figures.push_back(make_figure(fmt::format("record_{}", section.figures.size() + 1), figure));
        }
    }
    section.html = to_html(table);
    return section;
}

std::optional<ReportSection> make_base_motion_section(const ReportContent& content) {
    ReportSection section{.id = "base", .title = "Base motion"};
    for (const ReportedRun& run : content.runs) {
        if (make_motion(run, ModelScales{}).components.empty()) continue;
        section.html += make_change_notes(run);
        section.figures.push_back(make_base_figure(run, find_scales(run), section.figures.size() + 1));
    }
    if (section.figures.empty()) return std::nullopt;
    return section;
}

}  // namespace musim::lsdem
