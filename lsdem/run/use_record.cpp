#include "lsdem/run/use_record.hpp"

#include <fmt/format.h>

#include <cmath>

#include "records/measures/intensity.hpp"
#include "records/processing/base_window.hpp"

namespace musim::lsdem {
namespace {

/// Series from which measures of a component are taken: many instruments add an offset, in which a weak motion would drown.
records::TimeSeries level(const records::GroundMotion& motion, const records::Component& component) {
    return records::level_uncorrected(component.series, motion.integration_corner);
}

std::string describe_filter(const records::GroundMotion& motion) {
    if (motion.integration_corner) {
        return fmt::format("zero-phase high-pass at {:g} Hz, as the record is uncorrected", motion.integration_corner->value());
    }
    return "no high-pass, as the file does not say that the record is uncorrected; if it is, set base_motion.highpass, e.g. \"0.05 Hz\"";
}

const char* describe_end(records::AtRest at_rest) {
    switch (at_rest) {
        case records::AtRest::displaced:
            return "integrated to a velocity that ends at rest";
        case records::AtRest::as_given:
            return "integrated as it is; the base keeps its last velocity";
        default:
            return "integrated to a velocity and a displacement that end at rest";
    }
}

}  // namespace

std::vector<std::string> use_record(Scene& scene, const std::filesystem::path& file, const AxisComponents& components,
                                    const records::ReadOptions& reading, records::AtRest at_rest) {
    const records::GroundMotion motion = records::read_record(file, reading);
    std::vector<std::string> steps;
    for (const std::string& line : motion.history) {
        if (line.find(records::kUnitNotGiven) != std::string::npos) steps.push_back(line + "; give the unit if that is wrong");
        if (line.starts_with(records::kReadingNote)) steps.push_back(line.substr(std::string_view(records::kReadingNote).size()));
    }

    RecordMotion source;
    source.file = std::filesystem::absolute(file);
    std::copy(components.begin(), components.end(), source.components.begin());
    source.unit = reading.unit;
    source.quantity = reading.quantity;
    source.dt = reading.dt;
    source.sensitivity = reading.sensitivity;
    if (reading.station_xml) source.station_xml = std::filesystem::absolute(*reading.station_xml);
    source.columns = reading.columns;
    source.skip = reading.skipped_lines;
    if (std::none_of(components.begin(), components.end(), [](const auto& name) { return name.has_value(); })) {
        source.components[0] = records::find_strongest_horizontal(motion).name;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!source.components[axis]) continue;
        const records::Component& component = motion.find_component(*source.components[axis]);
        source.components[axis] = component.name;
        const double peak = std::abs(records::find_peak_acceleration(level(motion, component)).value.value());
        steps.push_back(fmt::format("component {} of {} along {}, the record's own peak {:.4g} g", component.name, motion.component_names(),
                                    "xyz"[axis], peak / scaling::kStandardGravity.value()));
    }

    source.highpass_corner = motion.integration_corner;
    source.at_rest = at_rest;
    const records::BaseMotionSettings settings{.high_pass = source.highpass_corner, .at_rest = at_rest};
    std::vector<std::string> used;
    for (const auto& name : source.components) {
        if (name) used.push_back(*name);
    }
    const records::TimeWindow window = records::find_base_window(motion, used, settings);
    source.window = {window.start, window.end};
    scene.time.duration = window.end - window.start;
    steps.push_back(fmt::format("strong motion from {:.2f} s to {:.2f} s of the record, opened and closed where the base is easily at rest",
                                window.start.value(), window.end.value()));
    steps.push_back(describe_filter(motion));
    steps.emplace_back(describe_end(at_rest));

    scene.base_motion = {};
    scene.base_motion.source = source;
    return steps;
}

void scale_record(Scene& scene, const RecordScale& scale) {
    const scaling::Similitude similitude = make_similitude(scale);
    if (similitude.is_identity()) return;
    scene.time.duration = similitude.to_model(scene.time.duration);
    std::get<RecordMotion>(scene.base_motion.source).scale = scale;
}

}  // namespace musim::lsdem
