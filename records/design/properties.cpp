#include "records/design/properties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/error.hpp"
#include "records/measures/intensity.hpp"
#include "records/measures/measures.hpp"
#include "records/measures/own_spectrum.hpp"
#include "records/measures/strongest_component.hpp"
#include "records/shake_table/table_axes.hpp"
#include "records/shake_table/table_check.hpp"

namespace musim::records {
namespace {

template <class Quantity>
Quantity absolute(const records::Peak<Quantity>& peak) {
    return Quantity::from_value(std::abs(peak.value.value()));
}

template <class Quantity>
std::optional<Quantity> absolute(const std::optional<records::Peak<Quantity>>& peak) {
    return peak ? std::optional(absolute(*peak)) : std::nullopt;
}

void require_acceleration(const records::GroundMotion& motion, const records::Component& component) {
    if (component.series.quantity() == records::SampleQuantity::acceleration) return;
    throw records::ReadError(fmt::format("{}: component {} holds no acceleration (peaks and periods are taken from one); name another",
                                         motion.source.empty() ? "record" : motion.source, component.name));
}

const records::Component* find_vertical(const records::GroundMotion& motion, const std::string& name) {
    if (!name.empty()) return &motion.find_component(name);
    const auto found = std::find_if(motion.components.begin(), motion.components.end(), records::is_vertical);
    return found == motion.components.end() ? nullptr : &*found;
}

}  // namespace

scaling::MotionProperties measure_motion(const records::GroundMotion& motion, const RecordOfMotion& record) {
    const records::Component& component =
        record.component.empty() ? records::find_strongest_horizontal(motion) : motion.find_component(record.component);
    require_acceleration(motion, component);
    const auto corner = record.high_pass ? record.high_pass : motion.integration_corner;
    const records::Intensity intensity = records::compute_intensity(component.series, corner);
    const records::TimeSeries leveled = records::level_uncorrected(component.series, corner);
    const records::ResponseSpectrum spectrum = records::compute_own_spectrum(leveled, corner);

    scaling::MotionProperties properties{.acceleration = absolute(*intensity.pga),
                                         .velocity = absolute(intensity.pgv),
                                         .displacement = absolute(intensity.pgd),
                                         .predominant_period = records::find_predominant_period(spectrum),
                                         .pulse_period = records::find_pulse_period(spectrum),
                                         .duration = intensity.d5_95,
                                         .step = component.series.dt()};
    if (const records::Component* const vertical = find_vertical(motion, record.vertical)) {
        require_acceleration(motion, *vertical);
        properties.vertical_acceleration = absolute(*records::compute_intensity(vertical->series, corner).pga);
    }
    records::GroundMotion alone = motion;
    alone.components = {component};
    const records::TableDemand demand =
        records::find_demands(alone, {.high_pass = record.high_pass}, records::ShakeTable{}.energy_share).front();
    properties.lowest_frequency = demand.lowest_frequency;
    properties.highest_frequency = demand.highest_frequency;
    return properties;
}

scaling::Bandwidth find_bandwidth(const records::TableAxis& axis, scaling::Mass payload) {
    // what is asked of the axis does not move its limits
    const records::TableDemand any{scaling::Length{},       scaling::Length{},          scaling::Velocity{},
                                   scaling::Acceleration{}, 1.0 / scaling::si::seconds, 1.0 / scaling::si::seconds};
    scaling::Bandwidth band;
    for (const records::LimitUse& use : records::check_axis(any, axis, {.mass = payload, .height = scaling::Length{}})) {
        const auto limit = scaling::Frequency::from_value(use.limit);
        switch (use.which) {
            case records::TableLimit::lowest_frequency:
                band.lowest = limit;
                break;
            case records::TableLimit::highest_frequency:
            case records::TableLimit::oil_column:
            case records::TableLimit::controller_band:
                band.highest = std::min(band.highest.value_or(limit), limit);
                break;
            default:
                break;
        }
    }
    return band;
}

scaling::Mass find_mass(const scaling::StructureProperties& properties) {
    return static_cast<double>(properties.blocks_per_layer.value_or(0)) * static_cast<double>(properties.layers) * properties.block_mass();
}

}  // namespace musim::records
