#include "records/shake_table/write_drive_file.hpp"

#include <fmt/format.h>

#include <cmath>

#include "records/atomic_file.hpp"

namespace musim::records {
namespace {

/// A column of numbers with its heading.
struct Column {
    std::string title;
    const TimeSeries* series;  ///< none: the time
    double unit = 1.0;         ///< SI value of one
};

std::string make_title(const std::string& axis, const SampleUnit& unit) {
    return fmt::format("{} {} [{}]", axis, to_string(unit.quantity), unit.name);
}

Column make_column(DriveColumn column, const AxisMotion& axis, const ControllerFormat& format) {
    const DriveMotion& motion = axis.motion;
    const bool turns = is_rotation(motion.displacement.quantity());
    const auto make = [&](const TimeSeries& series, const SampleUnit& along, const SampleUnit& about) {
        const SampleUnit& unit = turns ? about : along;
        return Column{make_title(axis.axis, unit), &series, unit.si};
    };
    switch (column) {
        case DriveColumn::displacement:
            return make(motion.displacement, format.displacement, format.angle);
        case DriveColumn::velocity:
            return make(motion.velocity, format.velocity, format.angular_velocity);
        case DriveColumn::acceleration:
            return make(motion.acceleration, format.acceleration, format.angular_acceleration);
        case DriveColumn::time:
            break;
    }
    return {"time [s]", nullptr};
}

std::vector<Column> make_columns(const std::vector<AxisMotion>& axes, const ControllerFormat& format) {
    std::vector<Column> columns;
    for (const AxisMotion& axis : axes) {
        for (const DriveColumn column : format.columns) {
            if (column != DriveColumn::time || &axis == &axes.front()) columns.push_back(make_column(column, axis, format));
        }
    }
    return columns;
}

void require_one_clock(const std::filesystem::path& path, const std::vector<AxisMotion>& axes, const ControllerFormat& format) {
    if (axes.empty()) throw WriteError(path.string() + ": there is no motion to write; give one");
    const TimeSeries& first = axes.front().motion.acceleration;
    for (const AxisMotion& axis : axes) {
        const TimeSeries& series = axis.motion.acceleration;
        if (series.size() != first.size() || series.start() != first.start() || series.dt() != first.dt()) {
            throw WriteError(path.string() + ": the axes have different clocks; align them first");
        }
    }
    constexpr double kSameStep = 1e-9;  // of a step
    if (std::abs((first.dt() * format.rate).value() - 1.0) > kSameStep) {
        throw WriteError(fmt::format("{}: the motion has {:.9g} samples a second, the controller {:.9g}; resample it", path.string(),
                                     1.0 / first.dt().value(), format.rate.value()));
    }
}

}  // namespace

void write_drive_file(const std::filesystem::path& path, const std::vector<AxisMotion>& axes, const ControllerFormat& format) {
    require_one_clock(path, axes, format);
    const std::vector<Column> columns = make_columns(axes, format);
    std::string text;
    const auto end_cell = [&](const Column& column) { text += &column == &columns.back() ? '\n' : format.separator; };
    if (format.header) {
        for (const Column& column : columns) {
            text += column.title;
            end_cell(column);
        }
    }
    for (std::size_t i = 0; i < axes.front().motion.acceleration.size(); ++i) {
        for (const Column& column : columns) {
            const double value = column.series ? column.series->samples()[i] / column.unit : static_cast<double>(i) / format.rate.value();
            fmt::format_to(std::back_inserter(text), "{:.{}g}", value, format.digits);
            end_cell(column);
        }
    }
    write_file_atomically(path, text);
}

}  // namespace musim::records
