#pragma once

#include <string>
#include <vector>

/// How much room text takes in a picture, which no renderer reports when the SVG is made.
namespace musim::lsdem::detail {

/// Width [px] of `text` (UTF-8) in DejaVu Sans, the first of the fonts in open_svg() and the widest of them; letters beyond ASCII count as
/// the widest, so that it is never too small.
double find_text_width(const std::string& text, double font_size);

/// `text` as it is when it fits into `room` [px], or else with "…" for as much of its middle as it takes: beginnings and ends are what
/// distinguishes names.
std::string shorten(const std::string& text, double font_size, double room);

/// `text` in lines no wider than `room` [px], parted at spaces; a single word may be wider.
std::vector<std::string> wrap(const std::string& text, double font_size, double room);

}  // namespace musim::lsdem::detail
