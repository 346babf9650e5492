#include "cli/progress_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cli/terminal.hpp"
#include "lsdem/response/response.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/units.hpp"

namespace musim::cli {

std::string describe_progress(const lsdem::RunProgress& progress) {
    std::string text = progress.stage > 1 ? fmt::format("motion {}, ", progress.stage) : "";
    text += fmt::format("{:.3f} of {:.3f} s, kinetic energy {}, largest drift {:.2g} %", progress.time, progress.duration,
                        scaling::format_quantity(progress.kinetic_energy * scaling::si::joules, 3), 100.0 * progress.drift);
    if (progress.fallen > 0) text += fmt::format(", {} of {} blocks fallen", progress.fallen, progress.blocks);
    if (progress.collapsed) text += ", collapsed";
    return text;
}

std::string draw_progress(const lsdem::RunProgress& progress) {
    if (progress.top_velocity.empty()) return {};
    return fmt::format(" top v_{} {}", lsdem::axis_name(progress.axis), make_sparkline(progress.top_velocity));
}

std::string format_duration(double seconds) {
    const auto whole = static_cast<long>(std::lround(seconds));
    if (whole >= 3600) return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
    if (whole >= 60) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} s", whole);
}

std::string describe_left(double least, double most) {
    const std::string from = format_duration(least), to = format_duration(most);
    return from == to ? to : from + " to " + to;
}

}  // namespace musim::cli
