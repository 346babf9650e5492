#include "lsdem/solid/compound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "lsdem/solid/detail/cells.hpp"
#include "lsdem/solid/detail/convex_wholes.hpp"
#include "lsdem/solid/detail/hull.hpp"
#include "lsdem/solid/detail/shared_faces.hpp"
#include "lsdem/solid/solid_gap.hpp"

namespace musim::lsdem {
namespace {

using detail::Cell;
using detail::SharedFace;

/// Faces of a part that lie in one plane to the tolerance become one.
Polyhedron join_faces(const Polyhedron& part, double tolerance) {
    std::optional<Polyhedron> hull = detail::find_hull(part.corners, tolerance);
    if (!hull) throw std::invalid_argument("a part of a compound is thinner than what counts as touching");
    return hull->faces.size() < part.faces.size() ? std::move(*hull) : part;
}

void refuse_overlaps_of_parts(std::span<const Polyhedron> parts, double tolerance) {
    for (std::size_t a = 0; a < parts.size(); ++a) {
        for (std::size_t b = a + 1; b < parts.size(); ++b) {
            const double depth = -find_gap(parts[a], parts[b], {});
            if (depth <= tolerance) continue;
            std::ostringstream message;
            message.precision(3);
            message << "parts " << a << " and " << b << " overlap by " << depth << " m; a compound's parts touch by faces";
            throw std::invalid_argument(message.str());
        }
    }
}

void refuse_loose_parts(std::size_t count, const std::vector<SharedFace>& shared_faces) {
    std::vector<bool> held(count, false);
    held[0] = true;
    for (bool grown = true; grown;) {
        grown = false;
        for (const SharedFace& shared : shared_faces) {
            const auto [a, b] = shared.parts;
            if (held[a] == held[b]) continue;
            held[a] = held[b] = grown = true;
        }
    }
    const auto loose = std::find(held.begin(), held.end(), false);
    if (loose == held.end()) return;
    throw std::invalid_argument("part " + std::to_string(loose - held.begin()) +
                                " does not hang together with part 0: no face of it touches one of the parts that do");
}

/// Joins parts whose union is convex, two at a time, until none are left.
void join_parts(std::vector<Polyhedron>& parts, double tolerance) {
    const auto join_two = [&] {
        for (const SharedFace& shared : detail::find_shared_faces(parts, tolerance)) {
            const auto [a, b] = shared.parts;
            const Cell of_a = detail::make_cell(parts[a], a), of_b = detail::make_cell(parts[b], b);
            std::optional<Polyhedron> hull = detail::find_filled_hull(std::array{&of_a, &of_b}, tolerance);
            if (!hull) continue;
            parts[a] = std::move(*hull);
            parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(b));
            return true;
        }
        return false;
    };
    while (join_two()) {
    }
}

/// Gives faces of several parts that lie in one plane the plane of the first, to the last bit.
void share_planes(std::vector<Polyhedron>& parts, double tolerance) {
    std::vector<Plane> known;
    for (Polyhedron& part : parts) {
        for (Polyhedron::Face& face : part.faces) {
            const auto loop = part.loop(face);
            const auto same = std::find_if(known.begin(), known.end(), [&](const Plane& plane) {
                return plane.normal.dot(face.plane.normal) > 0.0 && std::all_of(loop.begin(), loop.end(), [&](std::uint32_t c) {
                           return std::abs(plane.depth(part.corners[c])) <= tolerance;
                       });
            });
            if (same == known.end()) {
                known.push_back(face.plane);
            } else {
                face.plane = *same;
            }
        }
    }
}

/// Planes between which the core of a shared face lies in its first or second part.
std::vector<Plane> find_core_planes(const SharedFace& shared, std::size_t side, const std::vector<Polyhedron>& parts, double tolerance) {
    return detail::find_side_planes(shared, 1 - side, parts[shared.parts[1 - side]], tolerance);
}

Vector3 find_middle(const Polyhedron& body) {
    Vector3 sum = Vector3::Zero();
    for (const Vector3& corner : body.corners) sum += corner - body.corners.front();
    return body.corners.front() + sum / static_cast<double>(body.corners.size());
}

/// Parts cut so that each shared face is a whole one on both sides, and makes a convex body with what lies behind it on either side.
std::vector<Cell> cut_parts(const std::vector<Polyhedron>& parts, const std::vector<SharedFace>& shared_faces, double tolerance) {
    std::vector<Cell> cells;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        std::vector<Cell> own = {detail::make_cell(parts[p], p)};
        for (const SharedFace& shared : shared_faces) {
            for (std::size_t side = 0; side < 2; ++side) {
                if (shared.parts[side] != p) continue;
                const std::vector<Plane> planes = find_core_planes(shared, side, parts, tolerance);
                std::vector<Cell> shares;
                for (const Cell& cell : own) {
                    detail::CarvedCell carved = detail::carve(cell, planes, tolerance);
                    if (carved.inside) shares.push_back(std::move(*carved.inside));
                    std::move(carved.outside.begin(), carved.outside.end(), std::back_inserter(shares));
                }
                own = std::move(shares);
            }
        }
        std::move(own.begin(), own.end(), std::back_inserter(cells));
    }
    return cells;
}

/// Sets of cells that a whole is looked for about: each part, and what lies behind each shared face on both sides.
std::vector<std::vector<bool>> find_seeds(const std::vector<Cell>& cells, const std::vector<Polyhedron>& parts,
                                          const std::vector<SharedFace>& shared_faces, double tolerance) {
    std::vector<std::vector<bool>> seeds(parts.size() + shared_faces.size(), std::vector<bool>(cells.size(), false));
    for (std::size_t c = 0; c < cells.size(); ++c) {
        seeds[cells[c].part][c] = true;
        const Vector3 middle = find_middle(cells[c].body);
        for (std::size_t k = 0; k < shared_faces.size(); ++k) {
            for (std::size_t side = 0; side < 2; ++side) {
                if (shared_faces[k].parts[side] != cells[c].part) continue;
                const std::vector<Plane> planes = find_core_planes(shared_faces[k], side, parts, tolerance);
                seeds[parts.size() + k][c] =
                    std::all_of(planes.begin(), planes.end(), [&](const Plane& plane) { return plane.depth(middle) > 0.0; });
            }
        }
    }
    return seeds;
}

/// Marks the faces between cells: those of cuts, and shares of faces that a shared face covers.
void mark_inner_faces(Cell& cell, const std::vector<SharedFace>& shared_faces) {
    for (std::size_t f = 0; f < cell.body.faces.size(); ++f) {
        Polyhedron::Face& face = cell.body.faces[f];
        const Vector3 middle = detail::find_middle(cell.body, face);
        const bool covered = std::any_of(shared_faces.begin(), shared_faces.end(), [&](const SharedFace& shared) {
            for (std::size_t side = 0; side < 2; ++side) {
                if (shared.parts[side] != cell.part || shared.faces[side] != cell.sources[f]) continue;
                if (detail::lies_within(shared, middle)) return true;
            }
            return false;
        });
        face.outer = cell.sources[f] != Cell::kCut && !covered;
    }
}

}  // namespace

Solid make_compound(std::span<const Polyhedron> given, double touching) {
    if (given.empty()) throw std::invalid_argument("a compound has no parts");
    if (given.size() == 1) return {{given.front()}};
    const double tolerance = touching * find_bounds({{given.begin(), given.end()}}).size().maxCoeff();
    std::vector<Polyhedron> parts;
    for (const Polyhedron& part : given) parts.push_back(join_faces(part, tolerance));
    refuse_overlaps_of_parts(parts, tolerance);
    refuse_loose_parts(parts.size(), detail::find_shared_faces(parts, tolerance));
    join_parts(parts, tolerance);
    if (parts.size() == 1) return {std::move(parts)};
    share_planes(parts, tolerance);

    const std::vector<SharedFace> shared_faces = detail::find_shared_faces(parts, tolerance);
    std::vector<Cell> cells = cut_parts(parts, shared_faces, tolerance);
    if (cells.size() > kMostPieces) {
        throw std::invalid_argument("a compound of " + std::to_string(given.size()) + " parts needs " + std::to_string(cells.size()) +
                                    " convex pieces; at most " + std::to_string(kMostPieces) + " are possible");
    }
    for (Cell& cell : cells) mark_inner_faces(cell, shared_faces);
    const std::vector<detail::Whole> wholes = detail::find_wholes(cells, find_seeds(cells, parts, shared_faces, tolerance), tolerance);
    Solid solid;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        cells[c].body.wholes.clear();
        for (const detail::Whole& whole : wholes) {
            if (whole.cells[c]) cells[c].body.wholes.push_back(whole.planes);
        }
        solid.pieces.push_back(std::move(cells[c].body));
    }
    return solid;
}

}  // namespace musim::lsdem
