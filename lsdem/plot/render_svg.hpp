#pragma once

#include <string>

namespace musim::lsdem::detail {

/// Was musim built with librsvg? The functions below throw std::logic_error otherwise.
bool can_render_svg();

/// An SVG document as the bytes of a PNG file of `scale` pixels for each of its own, rounded up. Throws std::runtime_error for a document
/// that is none.
std::string render_png(const std::string& svg, double scale);

/// The same as the bytes of a PDF file of one page, `scale` points for each of its pixels; the same bytes at any time.
std::string render_pdf(const std::string& svg, double scale);

}  // namespace musim::lsdem::detail
