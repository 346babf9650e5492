#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lsdem/plot/space_view.hpp"
#include "lsdem/solid/solid.hpp"

/// Blocks in space, as seen from afar.
namespace musim::lsdem {

/// One of them.
struct DrawnBody {
    std::shared_ptr<const Solid> solid;  ///< in the body frame; of a ball facets of its surface
    Placing place;                       ///< body to world
    double radius = 0.0;                 ///< of a ball, which is drawn as a circle [m]; 0: the solid is drawn
    int color = 0;                       ///< of the palette: materials
    bool is_marked = false;              ///< drawn in the colour that stands out
};

/// Bounds of all bodies.
ViewBounds find_bounds(const std::vector<DrawnBody>& bodies, const SpaceView& view);

/// Colour of a body's side, for legends.
const char* find_swatch(const DrawnBody& body);

/// The same for bodies of a colour of the palette that are not marked.
const char* find_swatch(int color);

/// Draws the bodies, the nearer over the farther, see sort_by_depth(). Faces that are hidden behind others everywhere are left out, as far
/// as a grid of points about a pixel apart shows. Edges between two outer faces of a compound in one plane are not drawn.
void draw_bodies(std::string& svg, const std::vector<DrawnBody>& bodies, const SpaceView& view, const ViewPlace& place);

}  // namespace musim::lsdem
