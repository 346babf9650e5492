#include "lsdem/report/record_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>

#include "lsdem/plot/figure.hpp"
#include "records/formats/csv_cell.hpp"

namespace musim::lsdem {
namespace {

using records::ComponentCurves;
using records::Curve;
using records::CurveKind;
using records::CurvePeak;

/// Widths of the axes [px]: with the margins 7.2 inches at 120 px per inch.
constexpr double kHistoryWidth = 424.0, kSpectrumWidth = 256.0;
/// Histories without spectra beside them have the same page to themselves.
constexpr double kAloneWidth = 768.0;

/// Fourier amplitudes are rounding noise far below the largest.
constexpr double kFourierDecades = 5.0;

/// Over the rows of measures.
const std::vector<std::string> kKeyHeadings{"component", "PGA [g]", "PGV [cm/s]", "PGD [cm]", "Arias [m/s]", "D5-95 [s]"};

/// Texts of a kind of curve, in pictures and files.
struct CurveTexts {
    const char* title;
    const char* y_label;
    const char* x_label;
    const char* y_factor;  ///< what a model's values are divided by; empty: nothing
    const char* x_factor;
    const char* value_key;
    const char* over_key;  ///< of what the value is over
};

CurveTexts texts_of(CurveKind kind) {
    switch (kind) {
        case CurveKind::acceleration:
            return {"acceleration", "a{} [g]", "time{} [s]", "/λₐ", "/λₜ", "acceleration_g", "time_s"};
        case CurveKind::velocity:
            return {"velocity", "v{} [cm/s]", "time{} [s]", "/λᵥ", "/λₜ", "velocity_cm_s", "time_s"};
        case CurveKind::displacement:
            return {"displacement", "d{} [cm]", "time{} [s]", "/λₗ", "/λₜ", "displacement_cm", "time_s"};
        case CurveKind::arias:
            return {"build-up of the Arias intensity, D5-95", "share{} [%]", "time{} [s]", "", "/λₜ", "arias_percent", "time_s"};
        case CurveKind::fourier:
            return {"Fourier amplitude", "|A|{} [g·s]", "frequency{} [Hz]", "/(λₐλₜ)", "·λₜ", "fourier_g_s", "frequency_hz"};
        default:
            return {"PSA", "PSA{} [g]", "period{} [s]", "/λₐ", "/λₜ", "psa_g", "period_s"};
    }
}

const Curve* find_curve(const ComponentCurves& component, CurveKind kind) {
    const auto found =
        std::find_if(component.curves.begin(), component.curves.end(), [&](const Curve& curve) { return curve.kind == kind; });
    return found == component.curves.end() ? nullptr : &*found;
}

PlotSeries make_marks(int style) { return {.marks = true, .line = false, .style = style}; }

/// The peak, when it is among the samples that are drawn.
PlotSeries mark_peak(const ComponentCurves& component, const Curve& curve, int style) {
    PlotSeries marks = make_marks(style);
    for (const CurvePeak& peak : component.peaks) {
        if (peak.kind != curve.kind || peak.time < curve.x.front() || peak.time > curve.x.back()) continue;
        marks.x.push_back(peak.time);
        marks.y.push_back(peak.value);
    }
    return marks;
}

/// All components in one panel; one without curves when they have none of this kind.
LinePlot make_panel(const RecordFigure& figure, CurveKind kind) {
    const CurveTexts texts = texts_of(kind);
    const bool divided = figure.model_of.has_value();
    LinePlot panel{.title = texts.title,
                   .subtitle = "",
                   .x_label = fmt::format(fmt::runtime(texts.x_label), divided ? texts.x_factor : ""),
                   .y_label = fmt::format(fmt::runtime(texts.y_label), divided ? texts.y_factor : ""),
                   .x_logarithmic = kind == CurveKind::fourier || kind == CurveKind::psa,
                   .y_logarithmic = kind == CurveKind::fourier || kind == CurveKind::psa,
                   .y_most_decades = kFourierDecades};
    if (kind == CurveKind::psa) panel.title = fmt::format("PSA, damping {:.4g} %", 100.0 * figure.damping);
    std::vector<PlotSeries> marks;
    for (std::size_t i = 0; i < figure.components.size(); ++i) {
        const ComponentCurves& component = figure.components[i];
        const Curve* curve = find_curve(component, kind);
        if (curve == nullptr) continue;
        const int style = static_cast<int>(i);
        PlotSeries series{.x = curve->x, .y = curve->y, .style = style};
        if (kind == CurveKind::arias && component.d5_95) {
            series.bands.push_back({component.d5_95->start.value(), component.d5_95->end.value()});
        }
        panel.series.push_back(std::move(series));
        marks.push_back(mark_peak(component, *curve, style));
    }
    // peaks lie on top of all curves
    std::move(marks.begin(), marks.end(), std::back_inserter(panel.series));
    return panel;
}

FigureColumn make_column(const RecordFigure& figure, double width, bool common_x, const std::vector<CurveKind>& kinds) {
    FigureColumn column{.width = width, .common_x = common_x};
    for (const CurveKind kind : kinds) {
        LinePlot panel = make_panel(figure, kind);
        if (!panel.series.empty()) column.panels.push_back(std::move(panel));
    }
    return column;
}

std::string name(const ComponentCurves& component, bool many_files, bool models) {
    std::string text = component.component;
    if (models) text += component.model ? " model" : " prototype";
    // last, because it may be long
    if (many_files) text += fmt::format(" {}", std::filesystem::path(component.file).stem().string());
    return text;
}

template <class Peak>
std::string write_peak(const std::optional<Peak>& peak, double unit) {
    return peak ? fmt::format("{:.4g} at {:.5g} s", std::abs(peak->value.value()) / unit, peak->time.value()) : "-";
}

template <class Quantity>
std::string write_value(const std::optional<Quantity>& value) {
    return value ? fmt::format("{:.4g}", value->value()) : "-";
}

std::vector<KeyRow> make_key(const RecordFigure& figure) {
    const std::vector<ComponentCurves>& all = figure.components;
    const bool many_files =
        std::any_of(all.begin(), all.end(), [&](const ComponentCurves& component) { return component.file != all.front().file; });
    std::vector<KeyRow> rows;
    for (const ComponentCurves& component : all) {
        const records::Intensity& own = component.intensity;
        rows.push_back({static_cast<int>(rows.size()),
                        {name(component, many_files, figure.model_of.has_value()), write_peak(own.pga, scaling::kStandardGravity.value()),
                         write_peak(own.pgv, 0.01), write_peak(own.pgd, 0.01), write_value(own.arias), write_value(own.d5_95)}});
    }
    return rows;
}

/// A way in which records were integrated.
struct Integration {
    std::string way;
    bool model = false;
    std::vector<std::string> records;
    bool is_that_of(const Integration& other) const { return way == other.way && model == other.model; }
};

/// The ways, each once.
std::vector<Integration> find_integrations(const std::vector<ComponentCurves>& components) {
    std::vector<Integration> ways;
    for (const ComponentCurves& component : components) {
        const std::string record = std::filesystem::path(component.file).stem().string();
        const Integration own{
            component.corner ? fmt::format("high-pass {:.4g} Hz", component.corner->value()) : "no filter", component.model, {record}};
        const auto same = std::find_if(ways.begin(), ways.end(), [&](const Integration& known) { return known.is_that_of(own); });
        if (same == ways.end()) {
            ways.push_back(own);
        } else if (same->records.back() != record) {
            same->records.push_back(record);
        }
    }
    return ways;
}

/// Integration of the records, and which ones so unless all were alike.
std::string describe_integration(const RecordFigure& figure) {
    const std::vector<Integration> ways = find_integrations(figure.components);
    const bool alike = ways.size() == (figure.model_of ? 2 : 1);
    std::vector<std::string> texts;
    for (const Integration& integration : ways) {
        std::string whose = figure.model_of ? (integration.model ? "model" : "prototype") : "";
        if (!alike) whose += fmt::format("{}{}", whose.empty() ? "" : " of ", fmt::join(integration.records, ", "));
        texts.push_back(integration.way + (whose.empty() ? "" : " (" + whose + ")"));
    }
    return fmt::format("Integrated: {}.{}", fmt::join(texts, ", "),
                       figure.windowed ? " Histories are a window; measures and spectra are of the whole record." : "");
}

std::vector<std::string> make_caption(const RecordFigure& figure) {
    std::vector<std::string> lines{describe_integration(figure)};
    if (figure.model_of) {
        const scaling::ModelScales& scales = *figure.model_of;
        lines.push_back(
            fmt::format("Model curves are divided by their factors, law {}: λₜ = {:.6g}, λₐ = {:.6g}, λᵥ = {:.6g}, λₗ = {:.6g}.",
                        scales.law, scales.time, scales.acceleration, scales.velocity, scales.displacement));
        if (scales.acceleration_vertical != scales.acceleration) {
            lines.push_back(fmt::format("Of vertical components (Up, Z and the like): λₐ = {:.6g}, λᵥ = {:.6g}, λₗ = {:.6g}.",
                                        scales.acceleration_vertical, scales.velocity_vertical, scales.displacement_vertical));
        }
        lines.emplace_back("Upper axes and the table's rows of models are in the model's own units.");
    }
    return lines;
}

const char* scale_of(const ComponentCurves& component) { return component.model ? "model" : "prototype"; }

std::string make_csv(const std::vector<ComponentCurves>& components) {
    std::string text = "file,component,scale,quantity,over,x,value\n";
    for (const ComponentCurves& component : components) {
        for (const Curve& curve : component.curves) {
            const CurveTexts texts = texts_of(curve.kind);
            const std::string start =
                fmt::format("{},{},{},{},{}", records::csv_cell(component.file), records::csv_cell(component.component),
                            scale_of(component), texts.value_key, texts.over_key);
            for (std::size_t i = 0; i < curve.x.size(); ++i) {
                fmt::format_to(std::back_inserter(text), "{},{},{}\n", start, curve.x[i], curve.y[i]);
            }
        }
    }
    return text;
}

HtmlTable make_twin(const RecordFigure& figure, const std::vector<KeyRow>& key) {
    HtmlTable table{.caption = fmt::format("{}: largest values of each component", figure.title), .heads = kKeyHeadings};
    for (const KeyRow& row : key) {
        std::vector<HtmlCell>& cells = table.rows.emplace_back();
        for (const std::string& text : row.cells) cells.push_back({.text = text, .is_number = !cells.empty()});
    }
    return table;
}

}  // namespace

CurveStyles find_styles(bool with_models) { return with_models ? CurveStyles::pairs : CurveStyles::apart; }

std::string make_title(const records::GroundMotion& motion) {
    if (motion.event.empty() && motion.station.empty()) return std::filesystem::path(motion.source).filename().string();
    return motion.event + (motion.event.empty() || motion.station.empty() ? "" : ", ") + motion.station;
}

ReportFigure make_figure(const std::string& name, const RecordFigure& figure) {
    FigureColumn spectra = make_column(figure, kSpectrumWidth, false, {CurveKind::fourier, CurveKind::psa});
    FigureColumn histories = make_column(figure, spectra.panels.empty() ? kAloneWidth : kHistoryWidth, true,
                                         {CurveKind::acceleration, CurveKind::velocity, CurveKind::displacement, CurveKind::arias});
    if (figure.model_of) {
        const double time = figure.model_of->time;
        histories.second_x = {{"time of the model [s]", time}};
        spectra.second_x = {{"frequency of the model [Hz]", 1.0 / time}, {"period of the model [s]", time}};
    }
    std::vector<FigureColumn> columns{std::move(histories)};
    if (!spectra.panels.empty()) columns.push_back(std::move(spectra));
    const std::vector<KeyRow> key = make_key(figure);
    const Figure drawing{.title = figure.title,
                         .key_headings = kKeyHeadings,
                         .key = key,
                         .columns = std::move(columns),
                         .caption = make_caption(figure),
                         .styles = find_styles(figure.model_of.has_value())};
    return {
        .name = name, .title = figure.title, .svg = make_svg(drawing), .csv = make_csv(figure.components), .twin = make_twin(figure, key)};
}

}  // namespace musim::lsdem
