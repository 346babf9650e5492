#include "cli/record_curves_output.hpp"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "cli/csv_cell.hpp"

namespace musim::cli {
namespace {

/// Names in files: of the value, and of what it is over.
struct CurveKeys {
    const char* value;
    const char* over;
};

CurveKeys keys_of(CurveKind kind) {
    switch (kind) {
        case CurveKind::acceleration:
            return {"acceleration_g", "time_s"};
        case CurveKind::velocity:
            return {"velocity_cm_s", "time_s"};
        case CurveKind::displacement:
            return {"displacement_cm", "time_s"};
        case CurveKind::arias:
            return {"arias_percent", "time_s"};
        case CurveKind::fourier:
            return {"fourier_g_s", "frequency_hz"};
        default:
            return {"psa_g", "period_s"};
    }
}

const char* scale_of(const ComponentCurves& component) { return component.model ? "model" : "prototype"; }

template <class Peak>
void add_peak(nlohmann::json& object, const char* value_key, const char* time_key, const std::optional<Peak>& peak, double unit) {
    object[value_key] = peak ? nlohmann::json(peak->value.value() / unit) : nlohmann::json();
    object[time_key] = peak ? nlohmann::json(peak->time.value()) : nlohmann::json();
}

}  // namespace

std::string make_csv(const std::vector<ComponentCurves>& components) {
    std::string text = "file,component,scale,quantity,over,x,value\n";
    for (const ComponentCurves& component : components) {
        for (const Curve& curve : component.curves) {
            const CurveKeys keys = keys_of(curve.kind);
            const std::string start = fmt::format("{},{},{},{},{}", csv_cell(component.file), csv_cell(component.component),
                                                  scale_of(component), keys.value, keys.over);
            for (std::size_t i = 0; i < curve.x.size(); ++i)
                fmt::format_to(std::back_inserter(text), "{},{},{}\n", start, curve.x[i], curve.y[i]);
        }
    }
    return text;
}

nlohmann::json to_json(const std::vector<ComponentCurves>& components) {
    nlohmann::json list = nlohmann::json::array();
    for (const ComponentCurves& component : components) {
        nlohmann::json object{{"file", component.file},
                              {"component", component.component},
                              {"scale", scale_of(component)},
                              {"highpass_hz", component.corner ? nlohmann::json(component.corner->value()) : nlohmann::json()}};
        add_peak(object, "pga_g", "pga_time_s", component.intensity.pga, scaling::kStandardGravity.value());
        add_peak(object, "pgv_cm_s", "pgv_time_s", component.intensity.pgv, 0.01);
        add_peak(object, "pgd_cm", "pgd_time_s", component.intensity.pgd, 0.01);
        list.push_back(std::move(object));
    }
    return list;
}

}  // namespace musim::cli
