#include "cli/live_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cli/terminal.hpp"
#include "lsdem/response/response.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/units.hpp"

namespace musim::cli {

std::string describe_live(const lsdem::LiveRun& live) {
    std::string text = live.stage > 1 ? fmt::format("motion {}, ", live.stage) : "";
    text += fmt::format("{:.3f} of {:.3f} s, kinetic energy {}, largest drift {:.2g} %", live.time, live.duration,
                        scaling::format_quantity(live.kinetic_energy * scaling::si::joules, 3), 100.0 * live.drift);
    if (live.fallen > 0) text += fmt::format(", {} of {} blocks fallen", live.fallen, live.blocks);
    if (live.collapsed) text += ", collapsed";
    return text;
}

std::string draw_live(const lsdem::LiveRun& live) {
    if (live.top_velocity.empty()) return {};
    return fmt::format(" top v_{} {}", lsdem::axis_name(live.axis), make_sparkline(live.top_velocity));
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
