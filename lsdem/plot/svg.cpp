#include "lsdem/plot/svg.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <sstream>

namespace musim::lsdem::detail {
namespace {

/// Advance widths of DejaVu Sans from space to ~ [font size/1000], of its table hmtx.
constexpr std::array<int, 95> kAsciiWidths{318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361,  318, 337, 636, 636, 636,
                                           636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632,
                                           575, 775, 752, 295, 295, 656, 557, 863, 748, 787, 603, 787, 695, 635,  611, 732, 684, 989, 685,
                                           611, 685, 390, 337, 390, 838, 500, 500, 613, 635, 550, 635, 615, 352,  635, 634, 278, 278, 579,
                                           278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592, 818, 592, 592,  525, 636, 337, 636, 838};
constexpr int kOtherWidth = 1000;

int find_letter_width(unsigned char first) {
    const int place = first - ' ';
    return place >= 0 && place < static_cast<int>(kAsciiWidths.size()) ? kAsciiWidths[static_cast<std::size_t>(place)] : kOtherWidth;
}

/// Does a byte of UTF-8 go on with the letter before?
bool continues_letter(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

/// Where the letters of `text` begin, and its end.
std::vector<std::size_t> find_letters(const std::string& text) {
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (!continues_letter(text[i])) starts.push_back(i);
    }
    starts.push_back(text.size());
    return starts;
}

}  // namespace

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

double find_text_width(const std::string& text, double font_size) {
    int width = 0;
    for (const char byte : text) {
        if (!continues_letter(byte)) width += find_letter_width(static_cast<unsigned char>(byte));
    }
    return font_size * width / 1000.0;
}

std::string shorten(const std::string& text, double font_size, double room) {
    if (find_text_width(text, font_size) <= room) return text;
    const std::vector<std::size_t> letters = find_letters(text);
    const std::size_t count = letters.size() - 1;
    // the letters that stay, the odd one in front
    for (std::size_t kept = count - 1; kept > 0; --kept) {
        const std::size_t front = letters[(kept + 1) / 2], back = letters[count - kept / 2];
        std::string shorter = text.substr(0, front) + "…" + text.substr(back);
        if (find_text_width(shorter, font_size) <= room) return shorter;
    }
    return "…";
}

std::vector<std::string> wrap(const std::string& text, double font_size, double room) {
    std::vector<std::string> lines;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const bool fits = !lines.empty() && find_text_width(lines.back() + " " + word, font_size) <= room;
        if (fits) {
            lines.back() += " " + word;
        } else {
            lines.push_back(word);
        }
    }
    return lines;
}

std::string open_svg(double width, double height, const std::string& name) {
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{4}\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
        "{0:.0f} {1:.0f}\" "
        "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#222\">\n"
        "<style>.small{{font-size:{2}px}} .title{{font-size:{3}px;font-weight:bold}}</style>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        width, height, kSmallFont, kTitleFont, escape(name));
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
