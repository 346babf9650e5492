#include "lsdem/mesh/mesh_solid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lsdem/mesh/detail/deepest_dent.hpp"
#include "lsdem/mesh/detail/mesh_making.hpp"
#include "lsdem/solid/convex_hull.hpp"
#include "lsdem/solid/mass_properties.hpp"
#include "scaling/nearest_name.hpp"
#include "scaling/shorten.hpp"

namespace musim::lsdem {
namespace {

std::string name_part(const ClosedPart& part) {
    return fmt::format("part {}{}", part.number,
                       part.name.empty() ? "" : fmt::format(" '{}'", scaling::shorten(part.name, scaling::kEchoed)));
}

/// Numbers and names of the first parts of a file.
std::string list_parts(const ClosedParts& mesh) {
    constexpr std::size_t kListed = 8;
    std::string text;
    for (std::size_t p = 0; p < std::min(mesh.parts.size(), kListed); ++p) {
        if (p > 0) text += ", ";
        text += name_part(mesh.parts[p]);
    }
    return mesh.parts.size() > kListed ? text + " ..." : text;
}

ClosedParts take_part(const ClosedParts& mesh, std::size_t number) {
    return {.file = mesh.file,
            .format = mesh.format,
            .single_precision = mesh.single_precision,
            .left_out = mesh.left_out,
            .parts = {mesh.parts[number]}};
}

/// The middle of the bounds of all parts, in the file's frame and unit.
Vector3 find_middle(const ClosedParts& mesh) {
    Vector3 low = mesh.parts.front().corners.front(), high = low;
    for (const ClosedPart& part : mesh.parts) {
        for (const Vector3& corner : part.corners) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
    }
    return 0.5 * low + 0.5 * high;
}

/// Distance between neighbouring numbers of 32 bits at a part's coordinate farthest from zero.
double find_spacing(const ClosedPart& part) {
    double farthest = 0.0;
    for (const Vector3& corner : part.corners) farthest = std::max(farthest, corner.cwiseAbs().maxCoeff());
    return std::ldexp(static_cast<double>(std::numeric_limits<float>::epsilon()), std::ilogb(farthest));
}

/// Where and how deep a part has its deepest dent, and what to do about it.
[[noreturn]] void refuse_dent(const ClosedParts& mesh, std::size_t number, const detail::Dent& dent, const MeshUnit& unit, double limit) {
    const double spacing = mesh.single_precision ? find_spacing(mesh.parts[number]) : 0.0;
    const bool coarse = dent.depth < 4.0 * spacing;
    detail::fail_mesh(
        mesh.file, 0,
        fmt::format("{} is not convex: at {} {} its surface lies {:.4g} {} below its convex hull (limit {:.2g} {}){}",
                    name_part(mesh.parts[number]), detail::name_point(dent.place), unit.name, dent.depth, unit.name, limit, unit.name,
                    coarse ? fmt::format("; numbers of 32 bits have steps of {:.2g} {} so far from zero", spacing, unit.name) : ""),
        coarse ? "write it about an origin near it" : "divide it into convex parts, or take its hull");
}

MeshSolid make_solid(const ClosedParts& mesh, std::size_t number, const Vector3& origin, const MeshUnit& unit, const MeshLimits& limits) {
    const ClosedPart& part = mesh.parts[number];
    std::vector<Vector3> corners;
    corners.reserve(part.corners.size());
    for (const Vector3& corner : part.corners) corners.push_back((corner - origin) * unit.metres);
    MeshSolid result{.name = part.name, .solid = make_convex_hull(corners)};
    if (result.solid.faces.size() > limits.faces) {
        detail::fail_mesh(
            mesh.file, 0,
            fmt::format("{} has a hull of {} faces (limit {})", name_part(mesh.parts[number]), result.solid.faces.size(), limits.faces),
            "take a coarser mesh");
    }

    const double size = part.size * unit.metres, limit = limits.dent * part.size;
    const detail::Dent dent = detail::find_deepest_dent(part, corners, result.solid, kSamePlane * size);
    result.dent = dent.depth / unit.metres;
    if (result.dent > limit) {
        refuse_dent(mesh, number, {.depth = result.dent, .place = dent.place / unit.metres + origin}, unit, limit);
    }
    // the surface lies no deeper, all over
    const double cube = size * size * size, volume = part.volume / (part.size * part.size * part.size);
    const double whole = compute_mass_properties({{result.solid}}).volume / cube;
    if (std::abs(volume - whole) > 2.0 * limits.dent * part.area / (part.size * part.size)) {
        detail::fail_mesh(mesh.file, 0,
                          fmt::format("{} encloses {:.6g} of the volume of its convex hull, on which it lies: its faces cover one another",
                                      name_part(mesh.parts[number]), volume / whole),
                          "correct the mesh");
    }
    return result;
}

}  // namespace

MeshSolids make_mesh_solids(const ClosedParts& mesh, const MeshUnit& unit, const MeshLimits& limits) {
    const Vector3 middle = find_middle(mesh);
    MeshSolids result{.origin = middle * unit.metres, .solids = {}};
    for (std::size_t p = 0; p < mesh.parts.size(); ++p) result.solids.push_back(make_solid(mesh, p, middle, unit, limits));
    return result;
}

ClosedParts choose_part(const ClosedParts& mesh, std::string_view name) {
    std::vector<std::string> names;
    std::vector<std::size_t> found;
    for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
        names.push_back(mesh.parts[p].name);
        if (mesh.parts[p].name == name) found.push_back(p);
    }
    if (found.size() == 1) return take_part(mesh, found.front());
    if (!found.empty()) {
        detail::fail_mesh(mesh.file, 0,
                          fmt::format("has {} parts '{}', from part {} on", found.size(), scaling::shorten(name, scaling::kEchoed),
                                      mesh.parts[found.front()].number),
                          "choose by number");
    }
    detail::fail_mesh(mesh.file, 0,
                      fmt::format("has no part '{}'{}: {}", scaling::shorten(name, scaling::kEchoed), scaling::hint_at_name(name, names),
                                  list_parts(mesh)),
                      "name one of these, or give its number");
}

ClosedParts choose_part(const ClosedParts& mesh, std::size_t number) {
    if (number < mesh.parts.size()) return take_part(mesh, number);
    detail::fail_mesh(mesh.file, 0, fmt::format("has no part {}: {}", number, list_parts(mesh)), "choose one of these");
}

ClosedParts choose_part(const ClosedParts& mesh) {
    if (mesh.parts.size() == 1) return mesh;
    detail::fail_mesh(mesh.file, 0, fmt::format("has {} closed parts: {}", mesh.parts.size(), list_parts(mesh)),
                      "choose one by number or name, or make a compound of all");
}

}  // namespace musim::lsdem
