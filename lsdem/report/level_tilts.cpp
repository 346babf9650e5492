#include "lsdem/report/level_tilts.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "scaling/angle.hpp"

namespace musim::lsdem {
namespace {

/// The smallest value that at least this share of the sorted values does not exceed.
double find_quantile(const std::vector<double>& sorted, double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

ReportFigure make_tilt_figure(const std::string& name, const std::string& whose, const std::vector<int>& layer,
                              const std::vector<double>& tilt) {
    std::map<int, std::vector<double>> levels;
    for (std::size_t b = 0; b < tilt.size(); ++b) {
        if (layer[b] > 0) levels[layer[b]].push_back(tilt[b] / scaling::kDegree);
    }
    LinePlot plot{.title = "Tilt of the blocks at the start",
                  .subtitle = whose,
                  .x_label = "tilt [degrees]",
                  .y_label = "level",
                  .series = {},
                  .y_from_zero = true};
    const struct {
        const char* label;
        double share;
    } kinds[] = {{"median", 0.5}, {"nine of ten below", 0.9}, {"largest", 1.0}};
    for (const auto& kind : kinds) {
        PlotSeries series{.label = kind.label, .x = {}, .y = {}, .marks = true, .y_error = {}};
        for (auto& [level, tilts] : levels) {
            std::sort(tilts.begin(), tilts.end());
            series.x.push_back(find_quantile(tilts, kind.share));
            series.y.push_back(level);
        }
        plot.series.push_back(std::move(series));
    }
    return make_figure(name, plot);
}

}  // namespace musim::lsdem
