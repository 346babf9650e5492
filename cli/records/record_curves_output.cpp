#include "cli/records/record_curves_output.hpp"

#include "cli/named_values.hpp"

namespace musim::cli {
namespace {

const char* scale_of(const records::ComponentCurves& component) { return component.model ? "model" : "prototype"; }

template <class Peak>
void add_peak(nlohmann::json& object, const char* value_key, const char* time_key, const std::optional<Peak>& peak, double unit) {
    object[value_key] = peak ? nlohmann::json(peak->value.value() / unit) : nlohmann::json();
    object[time_key] = peak ? nlohmann::json(peak->time.value()) : nlohmann::json();
}

}  // namespace

nlohmann::json to_json(const std::vector<records::ComponentCurves>& components) {
    nlohmann::json list = nlohmann::json::array();
    for (const records::ComponentCurves& component : components) {
        nlohmann::json object{{"file", component.file},
                              {"component", component.component},
                              {"scale", scale_of(component)},
                              {"highpass_hz", or_null(in_si(component.corner))}};
        add_peak(object, "pga_g", "pga_time_s", component.intensity.pga, scaling::kStandardGravity.value());
        add_peak(object, "pgv_cm_s", "pgv_time_s", component.intensity.pgv, 0.01);
        add_peak(object, "pgd_cm", "pgd_time_s", component.intensity.pgd, 0.01);
        list.push_back(std::move(object));
    }
    return list;
}

}  // namespace musim::cli
