#include "records/design/properties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/error.hpp"
#include "records/measures/intensity.hpp"
#include "records/measures/measures.hpp"
#include "records/measures/response_spectrum.hpp"
#include "records/shake_table/shake_table.hpp"
#include "records/shake_table/table_check.hpp"

namespace musim::records {
namespace {

template <class Quantity>
Quantity absolute(const Peak<Quantity>& peak) {
    return Quantity::from_value(std::abs(peak.value.value()));
}

template <class Quantity>
std::optional<Quantity> absolute(const std::optional<Peak<Quantity>>& peak) {
    return peak ? std::optional(absolute(*peak)) : std::nullopt;
}

void require_acceleration(const GroundMotion& motion, const Component& component) {
    if (component.series.quantity() == SampleQuantity::acceleration) return;
    throw ReadError(fmt::format("{}: component {} holds no acceleration (peaks and periods are taken from one); name another",
                                motion.source.empty() ? "record" : motion.source, component.name));
}

const Component* find_vertical(const GroundMotion& motion, const std::string& name) {
    if (!name.empty()) return &motion.find_component(name);
    const auto found = std::find_if(motion.components.begin(), motion.components.end(), is_vertical);
    return found == motion.components.end() ? nullptr : &*found;
}

}  // namespace

scaling::MotionProperties measure_motion(const GroundMotion& motion, const RecordOfMotion& record) {
    const Component& component = record.component.empty() ? find_strongest_horizontal(motion) : motion.find_component(record.component);
    require_acceleration(motion, component);
    const auto corner = record.high_pass ? record.high_pass : motion.integration_corner;
    const Intensity intensity = compute_intensity(component.series, corner);
    const TimeSeries leveled = level_uncorrected(component.series, corner);
    const ResponseSpectrum spectrum = compute_own_spectrum(leveled, corner);

    scaling::MotionProperties properties{.acceleration = absolute(*intensity.pga),
                                         .velocity = absolute(intensity.pgv),
                                         .displacement = absolute(intensity.pgd),
                                         .predominant_period = find_predominant_period(spectrum),
                                         .pulse_period = find_pulse_period(spectrum),
                                         .duration = intensity.d5_95,
                                         .step = component.series.dt()};
    if (const Component* const vertical = find_vertical(motion, record.vertical)) {
        require_acceleration(motion, *vertical);
        properties.vertical_acceleration = absolute(*compute_intensity(vertical->series, corner).pga);
    }
    GroundMotion alone = motion;
    alone.components = {component};
    const TableDemand demand = find_demands(alone, {.high_pass = record.high_pass}, ShakeTable{}.energy_share).front();
    properties.lowest_frequency = demand.lowest_frequency;
    properties.highest_frequency = demand.highest_frequency;
    return properties;
}

scaling::Bandwidth find_bandwidth(const TableAxis& axis, scaling::Mass payload) {
    // what is asked of the axis does not move its limits
    const TableDemand any{scaling::Length{},       scaling::Length{},          scaling::Velocity{},
                          scaling::Acceleration{}, 1.0 / scaling::si::seconds, 1.0 / scaling::si::seconds};
    scaling::Bandwidth band;
    for (const LimitUse& use : check_axis(any, axis, {.mass = payload, .height = scaling::Length{}})) {
        const auto limit = scaling::Frequency::from_value(use.limit);
        switch (use.which) {
            case TableLimit::lowest_frequency:
                band.lowest = limit;
                break;
            case TableLimit::highest_frequency:
            case TableLimit::oil_column:
            case TableLimit::controller_band:
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
