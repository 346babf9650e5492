#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Parts that all pictures of musim share: text, lines, colours, round numbers.
namespace musim::lsdem::detail {

/// Linear map of data to pixels.
struct PlotAxis {
    double data_min = 0.0;
    double data_max = 1.0;
    double pixel_min = 0.0;
    double pixel_max = 1.0;

    double operator()(double value) const { return pixel_min + (value - data_min) / (data_max - data_min) * (pixel_max - pixel_min); }
};

/// Look of a curve.
struct LineStyle {
    const char* color;
    double width;
    const char* dash;
};

/// Looks of runs, the prototype or first one broad, so that the others show on top of it: colours of Okabe and Ito's palette, chosen for
/// all kinds of colour vision; the dashes distinguish the lines in grey.
inline constexpr std::array<LineStyle, 6> kLineStyles{{{"#56B4E9", 3.4, ""},
                                                       {"#D55E00", 1.6, "8 7"},
                                                       {"#000000", 1.3, "1.5 4"},
                                                       {"#009E73", 1.3, "9 3 1.5 3"},
                                                       {"#CC79A7", 1.3, "4 4"},
                                                       {"#0072B2", 1.3, "12 5"}}};

/// Look of a place that is marked on an axis.
inline constexpr LineStyle kMarkLine{"#333", 1.0, "5 4"};

/// Opacity of a band about a curve, or of what is shaded between two, in the curve's colour [-].
inline constexpr double kBandOpacity = 0.3;

/// Text with the characters of `reserved` replaced, which are the first of &<>"'.
std::string escape_markup(const std::string& text, std::string_view reserved);
/// Text with the characters that XML reserves replaced, and without control letters, which are no XML.
std::string escape(std::string text);

/// 1, 2 or 5 times a power of ten, nearest below `value` > 0.
double round_down(double value);

/// Sizes of text of the classes `title` and `small` [px].
inline constexpr double kTitleFont = 15.0, kSmallFont = 11.5;

/// Width [px] of `text` (UTF-8), which no renderer reports when the SVG is made: in DejaVu Sans, the first of the fonts in open_svg() and
/// the widest of them; letters beyond ASCII count as the widest, so that it is never too small.
double find_text_width(const std::string& text, double font_size);

/// `text` as it is when it fits into `room` [px], or else with "…" for as much of its middle as it takes: beginnings and ends are what
/// distinguishes names.
std::string shorten(const std::string& text, double font_size, double room);

/// `text` in lines no wider than `room` [px], parted at spaces; a single word may be wider.
std::vector<std::string> wrap(const std::string& text, double font_size, double room);

/// Beginning of a document of `width` x `height` [px] on white ground, with the classes `title` and `small` for text; `name` says what it
/// shows to those who do not see it.
std::string open_svg(double width, double height, const std::string& name);

/// Text at (x, y) [px]; `anchor`: start, middle or end; `style`: further attributes.
void draw_text(std::string& svg, double x, double y, const char* anchor, const char* style, const std::string& text);

/// Text turned to run upward, its middle at (x, y) [px].
void draw_upward_text(std::string& svg, double x, double y, const std::string& text);

/// Line from (x1, y1) to (x2, y2) [px]; `style`: further attributes.
void draw_line(std::string& svg, double x1, double y1, double x2, double y2, const char* style);

/// Meaning of one direction of a frame, for programs that read values off a picture.
struct FrameAxis {
    double low = 0.0, high = 1.0;  ///< at its left or lower end, and at the other; decimal logarithms when it is logarithmic
    bool logarithmic = false;
    std::string name;
};

/// The frame of a pair of axes at (x, y) [px]. Its attributes data-x and data-y hold "LOW HIGH linear" or "LOW HIGH log", data-x-name and
/// data-y-name the axes' names; nothing for a direction without one scale.
void draw_frame(std::string& svg, double x, double y, double width, double height, const FrameAxis& x_axis,
                const std::optional<FrameAxis>& y_axis);

/// Attributes of a curve.
std::string stroke(const LineStyle& line);

}  // namespace musim::lsdem::detail
