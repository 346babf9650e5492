#include "lsdem/solid/detail/convex_wholes.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "lsdem/solid/detail/hull.hpp"
#include "lsdem/solid/mass_properties.hpp"
#include "lsdem/solid/solid_gap.hpp"

namespace musim::lsdem::detail {
namespace {

/// Volumes within this part of each other are equal, so that rounding does not choose [-].
constexpr double kEqualVolume = 1e-9;

using CellSet = std::vector<bool>;

/// Do all corners of a body lie above one face of another, by more than a least height [m]?
bool is_beyond_a_face(const Polyhedron& body, const Polyhedron& other, double least) {
    return std::any_of(other.faces.begin(), other.faces.end(), [&](const Polyhedron::Face& face) {
        return std::all_of(body.corners.begin(), body.corners.end(), [&](const Vector3& x) { return face.plane.depth(x) < -least; });
    });
}

/// Does a point lie deeper than the tolerance below all faces?
bool lies_inside(const Vector3& x, const Polyhedron& body, double tolerance) {
    return std::all_of(body.faces.begin(), body.faces.end(), [&](const Polyhedron::Face& face) { return face.plane.depth(x) > tolerance; });
}

class WholeFinder {
  public:
    WholeFinder(std::span<const Cell> cells, double tolerance) : cells_(cells), tolerance_(tolerance) {
        for (const Cell& cell : cells) {
            volumes_.push_back(compute_mass_properties({{cell.body}}).volume);
            bounds_.push_back(find_bounds({{cell.body}}));
            for (const Polyhedron::Face& face : cell.body.faces) {
                if (face.outer) surface_.push_back(find_middle(cell.body, face));
            }
        }
        touching_.assign(cells.size(), CellSet(cells.size(), false));
        for (std::size_t a = 0; a < cells.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                touching_[a][b] = touching_[b][a] = !are_apart(cells[a].body, bounds_[a], b, tolerance);
            }
        }
    }

    /// The convex part that holds a set and that no cell enlarges; of several ways the one to the larger volume.
    std::optional<Whole> grow(const CellSet& seed) const {
        std::optional<Part> part = close(seed);
        while (part) {
            std::optional<Part> best;
            for (std::size_t c = 0; c < cells_.size(); ++c) {
                if (part->cells[c] || !touches(c, part->cells)) continue;
                CellSet larger = part->cells;
                larger[c] = true;
                std::optional<Part> candidate = close(std::move(larger));
                if (candidate && (!best || candidate->volume > best->volume * (1.0 + kEqualVolume))) best = std::move(candidate);
            }
            if (!best) return Whole{part->cells, collect_planes(part->hull)};
            part = std::move(best);
        }
        return std::nullopt;
    }

  private:
    struct Part {
        CellSet cells;
        Polyhedron hull;
        double volume = 0.0;
    };

    /// Is there a gap to a cell that is wider than a least one [m]?
    bool are_apart(const Polyhedron& body, const Bounds& bounds, std::size_t c, double least) const {
        const Bounds& other = bounds_[c];
        if (std::max((bounds.low - other.high).maxCoeff(), (other.low - bounds.high).maxCoeff()) > least) return true;
        // most are apart along a face
        return is_beyond_a_face(body, cells_[c].body, least) || is_beyond_a_face(cells_[c].body, body, least) ||
               find_gap(body, cells_[c].body, {}) > least;
    }

    bool touches(std::size_t c, const CellSet& set) const {
        for (std::size_t k = 0; k < set.size(); ++k) {
            if (set[k] && touching_[c][k]) return true;
        }
        return false;
    }

    /// The least convex part that holds a set of cells, if there is one.
    std::optional<Part> close(CellSet set) const {
        while (true) {
            std::vector<const Cell*> members;
            std::vector<Vector3> points;
            double volume = 0.0;
            for (std::size_t c = 0; c < set.size(); ++c) {
                if (!set[c]) continue;
                members.push_back(&cells_[c]);
                points.insert(points.end(), cells_[c].body.corners.begin(), cells_[c].body.corners.end());
                volume += volumes_[c];
            }
            const std::optional<Polyhedron> hull = find_hull(points, tolerance_);
            if (!hull) return std::nullopt;
            // what holds a point of the surface is not filled
            if (std::any_of(surface_.begin(), surface_.end(), [&](const Vector3& x) { return lies_inside(x, *hull, tolerance_); })) {
                return std::nullopt;
            }
            const Bounds bounds = find_bounds({{*hull}});
            bool grown = false;
            for (std::size_t c = 0; c < set.size(); ++c) {
                if (set[c] || are_apart(*hull, bounds, c, -tolerance_)) continue;
                set[c] = grown = true;
            }
            if (grown) continue;
            std::optional<Polyhedron> filled = find_filled_hull(members, tolerance_);
            if (!filled) return std::nullopt;
            return Part{std::move(set), std::move(*filled), volume};
        }
    }

    std::span<const Cell> cells_;
    double tolerance_ = 0.0;
    std::vector<double> volumes_;
    std::vector<Bounds> bounds_;
    std::vector<Vector3> surface_;  ///< points of the outer faces
    std::vector<CellSet> touching_;
};

/// Does one set of cells hold another?
bool holds(const CellSet& larger, const CellSet& smaller) {
    for (std::size_t c = 0; c < larger.size(); ++c) {
        if (smaller[c] && !larger[c]) return false;
    }
    return true;
}

}  // namespace

std::vector<Whole> find_wholes(std::span<const Cell> cells, std::span<const std::vector<bool>> seeds, double tolerance) {
    const WholeFinder finder(cells, tolerance);
    std::vector<Whole> wholes;
    for (const CellSet& seed : seeds) {
        std::optional<Whole> whole = finder.grow(seed);
        if (!whole || std::any_of(wholes.begin(), wholes.end(), [&](const Whole& known) { return holds(known.cells, whole->cells); }))
            continue;
        std::erase_if(wholes, [&](const Whole& known) { return holds(whole->cells, known.cells); });
        wholes.push_back(std::move(*whole));
    }
    return wholes;
}

}  // namespace musim::lsdem::detail
