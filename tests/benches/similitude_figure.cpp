#include "tests/benches/similitude_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lsdem/plot/figure.hpp"

namespace musim::lsdem {
namespace {

std::string name(const SimilitudeCase& shown) {
    if (shown.broken.group != BrokenGroup::none) {
        return fmt::format("{}, {} × {:.4g}", to_string(shown.scene), to_string(shown.broken.group), shown.broken.factor);
    }
    if (shown.collapses) return fmt::format("{}, equal groups", to_string(shown.scene));
    return fmt::format("{}, the law alone", to_string(shown.scene));
}

std::string write_result(const SimilitudeOutcome& outcome) {
    const SimilitudeCase& shown = outcome.wanted;
    if (shown.collapses) return fmt::format("difference {:.2g} (at most {:.2g})", outcome.difference, outcome.yardstick);
    return fmt::format("{} × {:.4g} (predicted {:.4g})", shown.measure == Measure::peak ? "peak" : "peak time", outcome.ratio,
                       shown.prediction.ratio);
}

/// Part of the drawn time that shows the rest before the motion [-].
constexpr double kRestShown = 0.04;

/// Points of a drawn curve; the responses are smooth at that distance.
constexpr std::size_t kPoints = 220;

PlotSeries make_curve(const ScaledResponse& response, int style) {
    PlotSeries curve{.label = "", .x = {}, .y = {}, .style = style, .y_error = {}};
    const double from = -kRestShown * response.time.back();
    const auto begin = static_cast<std::size_t>(std::lower_bound(response.time.begin(), response.time.end(), from) - response.time.begin());
    const std::size_t stride = 1 + (response.time.size() - begin) / kPoints;
    for (std::size_t k = begin; k < response.time.size(); k += stride) {
        curve.x.push_back(response.time[k]);
        curve.y.push_back(response.value[k]);
    }
    return curve;
}

/// `scale` names the model's scale where there are several.
LinePlot make_panel(const SimilitudeOutcome& outcome, const std::string& scale) {
    LinePlot panel{.title = name(outcome.wanted) + "; " + write_result(outcome) + scale,
                   .subtitle = "",
                   .x_label = "t/λₜ [s]",
                   .y_label = outcome.wanted.scene == BenchScene::rock ? "θ/λθ [rad]" : "u/λₗ [m]",
                   .series = {}};
    panel.series.push_back(make_curve(outcome.prototype, 0));
    panel.series.push_back(make_curve(outcome.model, 1));
    return panel;
}

std::string write_scales(const TwinScales& scales) {
    const scaling::Similitude& s = scales.similitude;
    std::string text = fmt::format("λₗ = {:.4g}, λμ = {:.4g}, λg = {:.4g}, λρ = {:.4g}, λₐ = {:.4g}", s.length(), s.friction(), s.gravity(),
                                   s.density(), s.acceleration());
    if (scales.heights != 1.0) text += fmt::format("; heights λH = {:.4g}", s.length() * scales.heights);
    return text;
}

/// A model that two cases measure is drawn once.
bool is_same_model(const SimilitudeOutcome& a, const SimilitudeOutcome& b) {
    return a.wanted.scene == b.wanted.scene && a.wanted.broken.group == b.wanted.broken.group &&
           a.wanted.broken.factor == b.wanted.broken.factor && write_scales(a.wanted.scales) == write_scales(b.wanted.scales);
}

/// "scale 1", "scale 2", ...
std::string name_scale(std::size_t place) { return fmt::format("scale {}", place + 1); }

/// The scales of the models of a law, each once.
std::vector<std::string> list_scales(const std::string& law, const std::vector<SimilitudeOutcome>& outcomes) {
    std::vector<std::string> scales;
    for (const SimilitudeOutcome& outcome : outcomes) {
        const std::string scale = write_scales(outcome.wanted.scales);
        if (outcome.wanted.law == law && std::find(scales.begin(), scales.end(), scale) == scales.end()) scales.push_back(scale);
    }
    return scales;
}

}  // namespace

std::string make_similitude_svg(const std::string& law, const std::vector<SimilitudeOutcome>& outcomes) {
    FigureColumn together{.width = 430.0}, apart{.width = 430.0};
    std::vector<const SimilitudeOutcome*> drawn;
    std::vector<std::string> scales = list_scales(law, outcomes);
    for (const SimilitudeOutcome& outcome : outcomes) {
        const auto same = [&](const SimilitudeOutcome* other) { return is_same_model(*other, outcome); };
        if (outcome.wanted.law != law || std::any_of(drawn.begin(), drawn.end(), same)) continue;
        drawn.push_back(&outcome);
        const Prediction& theory = outcome.wanted.prediction;
        const auto place = std::find(scales.begin(), scales.end(), write_scales(outcome.wanted.scales)) - scales.begin();
        const std::string mark = scales.size() > 1 ? "; " + name_scale(static_cast<std::size_t>(place)) : std::string();
        (std::abs(theory.ratio - 1.0) <= theory.tolerance ? together : apart).panels.push_back(make_panel(outcome, mark));
    }
    if (scales.size() > 1) {
        for (std::size_t k = 0; k < scales.size(); ++k) scales[k] = name_scale(k) + ": " + scales[k];
    }
    Figure figure{
        .title = fmt::format("Law {}: groups equal (left), a group broken (right)", law),
        .key_headings = {"run", "drawn"},
        .key = {{0, {"prototype", "as it is"}}, {1, {"model", "in the prototype's units: times over λₜ, lengths over λₗ, angles over λθ"}}},
        .columns = {},
        .caption = std::move(scales),
        .styles = CurveStyles::pairs};
    for (FigureColumn* column : {&together, &apart}) {
        if (!column->panels.empty()) figure.columns.push_back(std::move(*column));
    }
    figure.caption.emplace_back(
        "u: motion of the top behind the base; θ: tilt. Peak and its time: the model's over the prototype's. Difference: rms over the "
        "prototype's rms. The law alone: nothing is broken on purpose.");
    return make_svg(figure);
}

}  // namespace musim::lsdem
