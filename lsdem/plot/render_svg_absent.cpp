#include <stdexcept>

#include "lsdem/plot/render_svg.hpp"

namespace musim::lsdem::detail {

bool can_render_svg() { return false; }

std::string render_png(const std::string&, double) { throw std::logic_error("PNG asked of a build without librsvg"); }

std::string render_pdf(const std::string&, double) { throw std::logic_error("PDF asked of a build without librsvg"); }

}  // namespace musim::lsdem::detail
