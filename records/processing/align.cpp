#include "records/processing/align.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/processing/processing.hpp"
#include "records/processing/resample.hpp"
#include "scaling/angle.hpp"

namespace musim::records {
namespace {

/// Clocks that agree to this part of a step are one.
constexpr double kSameClock = 1e-6;

bool is_known(const GroundMotion& motion, const std::string& name) {
    return std::any_of(motion.components.begin(), motion.components.end(), [&](const Component& other) { return other.name == name; });
}

std::string find_free_name(const GroundMotion& merged, const GroundMotion& file, const std::string& name) {
    if (!is_known(merged, name)) return name;
    if (std::string with_station = file.station + " " + name; !file.station.empty() && !is_known(merged, with_station)) {
        return with_station;
    }
    for (int number = 2;; ++number) {
        if (std::string numbered = fmt::format("{} {}", number, name); !is_known(merged, numbered)) return numbered;
    }
}

/// Refuses components that differ in quantity from the first of their kind, translation or rotation.
void require_one_kind(const GroundMotion& motion, const Component& component) {
    const auto is_alike = [&](const Component& other) { return is_rotation(other) == is_rotation(component); };
    const auto first = std::find_if(motion.components.begin(), motion.components.end(), is_alike);
    require_quantity(component.series, first->series.quantity(), "aligning components");
}

bool on_one_clock(const TimeSeries& a, const TimeSeries& b) {
    const double step = a.dt().value();
    return a.size() == b.size() && std::abs(a.dt().value() - b.dt().value()) <= kSameClock * step / static_cast<double>(a.size()) &&
           std::abs((a.start() - b.start()).value()) <= kSameClock * step;
}

/// Its samples at `start` + i·dt within the record, moved by the part of a step that its own differ.
TimeSeries put_on_grid(const TimeSeries& series, scaling::Time start) {
    const double steps = (start - series.start()).value() / series.dt().value(), part = steps - std::floor(steps);
    if (part <= kSameClock || part >= 1.0 - kSameClock) return series;
    return shift_clock(series, part * series.dt());
}

}  // namespace

GroundMotion merge(const std::vector<GroundMotion>& files) {
    if (files.empty()) throw ProcessingError("no record to merge; give at least one");
    GroundMotion merged = files.front();
    bool assumed = false;
    for (std::size_t i = 1; i < files.size(); ++i) {
        const GroundMotion& file = files[i];
        scaling::Time later;
        if (merged.time_zero.has_value() != file.time_zero.has_value()) {
            throw ProcessingError(
                fmt::format("of {} and {} only one says when it begins; cut both to one moment and write them without clocks",
                            merged.source, file.source));
        }
        if (merged.time_zero) {
            later = scaling::Time::from_value(std::chrono::duration<double>(*file.time_zero - *merged.time_zero).count());
        } else {
            assumed = true;
        }
        for (const Component& component : file.components) {
            const TimeSeries& series = component.series;
            merged.components.push_back(
                {find_free_name(merged, file, component.name), component.azimuth_deg,
                 TimeSeries(series.quantity(), series.start() + later, series.dt(), {series.samples().begin(), series.samples().end()}),
                 component.up});
        }
        if (!merged.integration_corner) merged.integration_corner = file.integration_corner;
    }
    if (files.size() > 1) {
        merged.history.push_back(fmt::format("merged from {} files{}", files.size(), assumed ? ", taken to begin together" : ""));
    }
    return merged;
}

GroundMotion align(const GroundMotion& motion) {
    GroundMotion aligned = motion;
    if (motion.components.empty()) throw ProcessingError("a record without components cannot be aligned; read one that has some");
    scaling::Time dt = motion.components.front().series.dt();
    for (const Component& component : motion.components) {
        dt = std::min(dt, component.series.dt());
        require_one_kind(motion, component);
    }
    for (Component& component : aligned.components) {
        const TimeSeries& series = component.series;
        if (std::abs(series.dt().value() - dt.value()) <= kSameClock * dt.value() / static_cast<double>(series.size())) continue;
        aligned.history.push_back(fmt::format("{} resampled from {:.9g} s to {:.9g} s", component.name, series.dt().value(), dt.value()));
        component.series = resample(series, dt);
    }
    const auto later = [](const Component& a, const Component& b) { return a.series.start() < b.series.start(); };
    const scaling::Time start = std::max_element(aligned.components.begin(), aligned.components.end(), later)->series.start();
    scaling::Time end = aligned.components.front().series.end();
    for (Component& component : aligned.components) {
        component.series = put_on_grid(component.series, start);
        end = std::min(end, component.series.end());
    }
    if (!(start <= end)) {
        throw ProcessingError(
            fmt::format("components cover no common time (one begins at {:.6g} s, one ends at {:.6g} s); check that they "
                        "are of one event",
                        start.value(), end.value()));
    }
    const auto count = static_cast<std::size_t>(std::floor((end - start).value() / dt.value() + kSameClock)) + 1;
    for (Component& component : aligned.components) {
        const TimeSeries& series = component.series;
        const auto skipped = static_cast<std::size_t>(std::llround((start - series.start()).value() / dt.value()));
        const std::span<const double> kept = series.samples().subspan(skipped, count);
        if (kept.size() != motion.components[static_cast<std::size_t>(&component - aligned.components.data())].series.size()) {
            aligned.history.push_back(fmt::format("{} cut to {:.6g} s ... {:.6g} s", component.name, start.value(), end.value()));
        }
        component.series = TimeSeries(series.quantity(), start, dt, {kept.begin(), kept.end()});
    }
    return aligned;
}

GroundMotion rotate(const GroundMotion& motion, double azimuth_deg) {
    if (!std::isfinite(azimuth_deg)) throw ProcessingError("the azimuth is no number; give degrees clockwise from north");
    std::vector<std::size_t> horizontal;
    for (std::size_t i = 0; i < motion.components.size(); ++i) {
        if (motion.components[i].azimuth_deg) horizontal.push_back(i);
    }
    if (horizontal.size() != 2) {
        throw ProcessingError(
            fmt::format("{} components have an azimuth (two are needed); present: {}", horizontal.size(), motion.component_names()));
    }
    GroundMotion rotated = motion;
    Component &first = rotated.components[horizontal[0]], &second = rotated.components[horizontal[1]];
    if (!on_one_clock(first.series, second.series)) {
        throw ProcessingError("the two horizontal components are not on one clock (start, dt or length differ); align them first");
    }
    require_quantity(second.series, first.series.quantity(), "the rotation");
    using scaling::kDegree;
    const double a = *first.azimuth_deg * kDegree, b = *second.azimuth_deg * kDegree, between = std::sin(b - a);
    constexpr double kParallel = 0.0175;  // sin 1°
    if (!(std::abs(between) > kParallel)) {
        throw ProcessingError(
            fmt::format("components {} and {} are parallel (no motion across them is known); take others", first.name, second.name));
    }
    // north and east from x = n cos a + e sin a, y = n cos b + e sin b; then the same sum along the new directions
    const auto seen_along = [&](double direction) {
        const double of_first = std::sin(b - direction) / between, of_second = std::sin(direction - a) / between;
        std::vector<double> samples;
        for (std::size_t i = 0; i < first.series.size(); ++i) {
            samples.push_back(of_first * first.series.samples()[i] + of_second * second.series.samples()[i]);
        }
        return first.series.with_samples(std::move(samples));
    };
    const auto turned = [](double degrees) { return degrees - 360.0 * std::floor(degrees / 360.0); };
    const double one = turned(azimuth_deg), two = turned(azimuth_deg + 90.0);
    TimeSeries along = seen_along(one * kDegree), across = seen_along(two * kDegree);
    rotated.history.push_back(fmt::format("{} and {} rotated to azimuths {:.6g} and {:.6g} deg", first.name, second.name, one, two));
    first = {fmt::format("{:.6g}", one), one, std::move(along)};
    second = {fmt::format("{:.6g}", two), two, std::move(across)};
    return rotated;
}

}  // namespace musim::records
