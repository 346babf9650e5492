#include "lsdem/plot/svg.hpp"

#include <fmt/format.h>

#include <cmath>

namespace musim::lsdem::detail {

std::string escape_markup(const std::string& text, std::string_view reserved) {
    constexpr std::array kNames{"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
    std::string safe;
    safe.reserve(text.size());
    for (const char letter : text) {
        const std::size_t place = reserved.find(letter);
        if (place < reserved.size()) {
            safe += kNames.at(place);
        } else {
            safe += letter;
        }
    }
    return safe;
}

std::string escape(std::string text) {
    std::erase_if(text, [](unsigned char letter) { return letter < 0x20; });
    return escape_markup(text, "&<>\"");
}

double round_down(double value) {
    const double decade = std::pow(10.0, std::floor(std::log10(value)));
    const double leading = value / decade;
    if (leading >= 5.0) return 5.0 * decade;
    return leading >= 2.0 ? 2.0 * decade : decade;
}

std::string open_svg(double width, double height) {
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
        "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#222\">\n"
        "<style>.small{{font-size:{2}px}} .title{{font-size:{3}px;font-weight:bold}}</style>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        width, height, kSmallFont, kTitleFont);
}

void draw_text(std::string& svg, double x, double y, const char* anchor, const char* style, const std::string& text) {
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" {}>{}</text>\n", x, y, anchor, style, escape(text));
}

void draw_upward_text(std::string& svg, double x, double y, const std::string& text) {
    svg += fmt::format("<text transform=\"translate({:.0f} {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n", x, y, escape(text));
}

void draw_line(std::string& svg, double x1, double y1, double x2, double y2, const char* style) {
    svg += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, y1, x2, y2, style);
}

void draw_frame(std::string& svg, double x, double y, double width, double height, const FrameAxis& x_axis,
                const std::optional<FrameAxis>& y_axis) {
    const auto describe = [](const char* direction, const FrameAxis& axis) {
        return fmt::format(" data-{0}=\"{1} {2} {3}\" data-{0}-name=\"{4}\"", direction, axis.low, axis.high,
                           axis.logarithmic ? "log" : "linear", escape(axis.name));
    };
    svg += fmt::format(
        "<rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#333\"{}{}/>\n", x, y,
        width, height, describe("x", x_axis), y_axis ? describe("y", *y_axis) : "");
}

std::string stroke(const LineStyle& line) {
    const std::string dash = *line.dash != '\0' ? fmt::format(" stroke-dasharray=\"{}\"", line.dash) : "";
    return fmt::format("stroke=\"{}\" stroke-width=\"{}\"{} fill=\"none\" stroke-linejoin=\"round\"", line.color, line.width, dash);
}

}  // namespace musim::lsdem::detail
