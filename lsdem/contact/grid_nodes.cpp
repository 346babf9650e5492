#include "lsdem/contact/grid_nodes.hpp"

#include <algorithm>
#include <cmath>

namespace musim::lsdem::detail {
namespace {

/// Share of a node's faces that looks along −normal, `normal` in the leader's frame: of a faceted shape the face that looks most that way.
double acting_area(const BlockNodes& nodes, std::size_t i, const Row& normal) {
    const Row area = row_of(nodes.area(i));
    if (!nodes.shape.faceted) return -dot(normal, area);
    const std::size_t axis = largest_axis(normal);
    return normal[axis] < 0.0 ? area[axis] : -area[axis];
}

/// One node against a grid that it touches: the contact law along the grid's normal there, with the history projected on today's tangent
/// plane. Losses are booked as in the flat kernel.
void add_grid_node(const StepLaw& law, const Row& y, const Row& normal, const Row& change, double overlap, double area, std::size_t entry,
                   ContactHistory& history, PairSums& sums) {
    const bool born = !history.touches(entry);
    const double normal_change = dot(normal, change), elastic = law.kn * overlap;
    const double pressure = std::max(0.0, elastic - law.cn * normal_change), damping_pressure = pressure - elastic;

    // of a new contact, the part of the change that came after it touched
    const double since_touch = born && normal_change < -overlap ? overlap / -normal_change : 1.0;
    Row old_slip{}, old_shear{}, tangential{}, slip{}, viscous{}, shear{};
    for (std::size_t a = 0; a < 3; ++a) tangential[a] = since_touch * (change[a] - normal_change * normal[a]);
    if (!born) {
        Row old_viscous{};
        for (std::size_t a = 0; a < 3; ++a) {
            old_slip[a] = history.slip[a][entry];
            if (history.has_viscous()) old_viscous[a] = history.viscous[a][entry];
        }
        const double slip_off = dot(old_slip, normal), viscous_off = dot(old_viscous, normal);
        for (std::size_t a = 0; a < 3; ++a) {
            old_slip[a] -= slip_off * normal[a];
            old_shear[a] = old_viscous[a] - viscous_off * normal[a] - law.ks * old_slip[a];
        }
    }
    for (std::size_t a = 0; a < 3; ++a) {
        slip[a] = old_slip[a] + tangential[a];
        viscous[a] = -law.cs * tangential[a];
        shear[a] = viscous[a] - law.ks * slip[a];
    }
    const double limit = law.mu * pressure, squared = dot(shear, shear);
    const bool slides = squared > limit * limit;
    if (slides) {
        const double scale = limit / std::sqrt(squared);
        for (std::size_t a = 0; a < 3; ++a) {
            shear[a] *= scale;
            slip[a] = -law.ks_inverse * shear[a];
            viscous[a] = 0.0;
        }
    }

    double work = 0.0;
    for (std::size_t a = 0; a < 3; ++a) work -= 0.5 * (old_shear[a] + shear[a]) * tangential[a];
    const double stored = 0.5 * law.ks * dot(slip, slip), stored_before = 0.5 * law.ks * dot(old_slip, old_slip);
    (slides ? sums.work.friction : sums.work.damping) += area * (work - (stored - stored_before));
    sums.work.damping -= 0.5 * area * ((born ? 0.0 : history.damping_pressure[entry]) + damping_pressure) * normal_change;
    sums.tally.elastic_normal += 0.5 * area * elastic * overlap;
    sums.tally.elastic_shear += area * stored;
    sums.tally.overlap = std::max(sums.tally.overlap, overlap);
    ++sums.tally.touching;
    history.damping_pressure[entry] = damping_pressure;
    Row force;
    for (std::size_t a = 0; a < 3; ++a) {
        history.slip[a][entry] = slip[a];
        if (history.has_viscous()) history.viscous[a][entry] = viscous[a];
        force[a] = area * (pressure * normal[a] + shear[a]);
    }
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
        sums.force[a] += force[a];
        sums.moment[a] += y[b] * force[c] - y[c] * force[b];
    }
}

/// The level set of a block of its own height, from the grid of its shape: cut in the middle, and the halves moved apart, or together, by
/// Δ. For a box this is its own distance wherever it can be touched, see docs/theory/shapes.md, "Blocks of unequal height".
class BlockGrid {
  public:
    BlockGrid(const GridLevelSet& grid, double height_offset) : grid_(grid), half_gap_(0.5 * height_offset) {}

    double value(const Vector3& y) const { return grid_.value(in_shape(y)); }
    Vector3 gradient(const Vector3& y) const {
        Vector3 gradient = grid_.gradient(in_shape(y));
        if (std::abs(y.z()) < half_gap_) gradient.z() = 0.0;
        return gradient;
    }

  private:
    Vector3 in_shape(const Vector3& y) const {
        const double moved = half_gap_ > 0.0 ? std::clamp(y.z(), -half_gap_, half_gap_) : (y.z() < 0.0 ? -half_gap_ : half_gap_);
        return {y.x(), y.y(), y.z() - moved};
    }

    const GridLevelSet& grid_;
    double half_gap_;  ///< Δ/2 [m]
};
}  // namespace

PairSums sum_grid_nodes(const NodeContact& contact, const GridLevelSet& shape, double height_offset) {
    const auto& [leader, pose, law, pair, list] = contact;
    const BlockGrid grid(shape, height_offset);
    PairSums sums;
    for (std::size_t entry = pair.first_node; entry < pair.first_node + pair.node_count; ++entry) {
        const std::size_t i = list.nodes[entry];
        const Row p = row_of(leader.position(i));
        const Row y = pose(p);
        const Vector3 point{y[0], y[1], y[2]};
        const double overlap = -grid.value(point);
        if (overlap <= 0.0 && !list.history.touches(entry)) continue;

        const Row change = pose.change(p);
        const Vector3 gradient = grid.gradient(point);
        const double norm = gradient.norm();
        const Row normal = norm > 0.0 ? row_of(gradient / norm) : Row{};
        const double area = acting_area(leader, i, pose.in_leader_frame(normal));
        if (overlap > 0.0 && area > 0.0) {
            // what a new contact overlapped before it was noticed carries nothing: a node that turns from one face to another begins deep
            const double before = list.first_step ? 0.0 : std::max(0.0, overlap + dot(normal, change));
            double& late = list.history.late[entry];
            late = list.history.touches(entry) ? std::min(late, overlap) : before;
            add_grid_node(law, y, normal, change, overlap - late, area, entry, list.history, sums);
        } else if (list.history.touches(entry)) {
            end_contact(law, normal, change, std::abs(area), entry, list.history, sums.work);
        }
    }
    return sums;
}

}  // namespace musim::lsdem::detail
