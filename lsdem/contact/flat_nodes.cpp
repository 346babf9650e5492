#include "lsdem/contact/flat_nodes.hpp"

#include <algorithm>
#include <cmath>

#include "lsdem/detail/instructions.hpp"
#include "lsdem/detail/lanes.hpp"

namespace musim::lsdem::detail {

std::size_t largest_axis(const Row& v) {
    std::size_t axis = std::abs(v[0]) > std::abs(v[1]) ? 0 : 1;
    if (std::abs(v[2]) > std::abs(v[axis])) axis = 2;
    return axis;
}

StepLaw::StepLaw(const Interface& law, double dt)
    : kn(law.normal_stiffness),
      ks(law.shear_stiffness),
      mu(law.friction),
      cn(law.normal_damping / dt),
      cs(law.shear_damping / dt),
      ks_inverse(law.shear_stiffness > 0.0 ? 1.0 / law.shear_stiffness : 0.0) {}

void end_contact(const StepLaw& law, const Row& normal, const Row& change, double share, std::size_t entry, ContactHistory& history,
                 PairWork& work) {
    double released = 0.0, dashpot = history.damping_pressure[entry] * dot(normal, change);
    for (std::size_t a = 0; a < 3; ++a) {
        const double slip = history.slip[a][entry];
        released += slip * (slip + change[a]);
        if (history.has_viscous()) dashpot += history.viscous[a][entry] * change[a];
    }
    work.friction += 0.5 * share * law.ks * released;
    work.damping -= 0.5 * share * dashpot;
    history.end(entry);
}

namespace {

/// A contact that begins with more than this part of its area counts as noticed late [-]. One that slides over an edge begins, because the
/// edge is rounded, with the square of the part of a cell that it moves in a step: 1e-6 for a prototype block at 1 m/s.
constexpr double kSuddenPart = 1e-4;

/// Which axis of the leader goes with each axis of the follower's face.
struct AxisMatch {
    std::size_t normal, u, v;

    AxisMatch(const RelativePose& pose, const FlatFollower& face) : normal(face.leader_axis) {
        const std::size_t a = (normal + 1) % 3, b = (normal + 2) % 3;
        const Row& row = pose.rotation[(face.axis + 1) % 3];
        u = std::abs(row[a]) >= std::abs(row[b]) ? a : b;
        v = u == a ? b : a;
    }
};

/// Node arrays of the leader that a flat contact reads; plain pointers, so that writing history does not force reloads.
struct NodePointers {
    const double *x, *y, *z, *area_x, *area_y, *area_z, *center_x, *center_y, *center_z, *area_of_face, *reach_u, *reach_v;

    NodePointers(const SurfaceNodes& nodes, const AxisMatch& match)
        : x(nodes.x.data()),
          y(nodes.y.data()),
          z(nodes.z.data()),
          area_x(nodes.area_x.data()),
          area_y(nodes.area_y.data()),
          area_z(nodes.area_z.data()),
          center_x(nodes.center_x.data()),
          center_y(nodes.center_y.data()),
          center_z(nodes.center_z.data()),
          area_of_face(std::array{area_x, area_y, area_z}[match.normal]),
          reach_u(std::array{nodes.half_x.data(), nodes.half_y.data(), nodes.half_z.data()}[match.u]),
          reach_v(std::array{nodes.half_x.data(), nodes.half_y.data(), nodes.half_z.data()}[match.v]) {}
};

/// One row of an affine map of node positions, spread over the lanes.
struct LaneRow {
    Lanes x, y, z, at;

    LaneRow(const PointMap& map, std::size_t r)
        : x(broadcast<Lanes>(map.rotation[r][0])),
          y(broadcast<Lanes>(map.rotation[r][1])),
          z(broadcast<Lanes>(map.rotation[r][2])),
          at(broadcast<Lanes>(map.position[r])) {}
    [[gnu::always_inline]] Lanes operator()(const Lanes& px, const Lanes& py, const Lanes& pz) const {
        return ((x * px + y * py) + z * pz) + at;
    }
};

/// Part of a cell [middle − reach, middle + reach] that lies within ±half, 0...1, and where the middle of that part lies, relative to the
/// middle of the cell [m]; both with their change as the cell moves.
struct LaneCover {
    Lanes part, slope;         ///< [-], [1/m]
    Lanes shift, shift_slope;  ///< [m], [-]
};

/// Part lost where a cell reaches over an edge by `over` of its widths: 0 up to the edge, then a ramp of slope one whose ends are rounded
/// over kEdgeBlend.
struct LaneLoss {
    Lanes part, slope;
};

[[gnu::always_inline]] inline LaneLoss find_loss(const Lanes& over) {
    constexpr double kPerBlend = 1.0 / kEdgeBlend;
    const Lanes zero = broadcast<Lanes>(0.0), one = broadcast<Lanes>(1.0);
    const Lanes begun = larger_of<Lanes>(over, zero), left = larger_of<Lanes>(1.0 + kEdgeBlend - over, zero);
    const Lanes start = 0.5 * kPerBlend * begun * begun, end = one - 0.5 * kPerBlend * left * left, middle = over - 0.5 * kEdgeBlend;
    const LaneMask starts = over < kEdgeBlend, ends = left < kEdgeBlend;
    return {choose(starts, start, choose(ends, end, middle)), choose(starts, kPerBlend * begun, choose(ends, kPerBlend * left, one))};
}

/// Does a cell reach over an edge? Most cells of a face do not.
[[gnu::always_inline]] inline LaneMask reaches_over(const Lanes& middle, const Lanes& reach, double half) {
    return (middle + reach > half) | (reach - middle > half);
}

[[gnu::always_inline]] inline LaneCover find_cover(const Lanes& middle, const Lanes& reach, double half) {
    const Lanes zero = broadcast<Lanes>(0.0), one = broadcast<Lanes>(1.0), width = reach + reach;
    const Lanes above = middle + reach - half, below = reach - middle - half;
    // a node without a cell is in or out
    const LaneMask sized = width > zero;
    const Lanes per_width = choose(sized, one / width, zero);
    const LaneLoss beyond = find_loss(above * per_width), short_of = find_loss(below * per_width);
    LaneCover cover;
    cover.part =
        choose(sized, larger_of<Lanes>(one - beyond.part - short_of.part, zero), choose((above <= zero) & (below <= zero), one, zero));
    cover.slope = choose(cover.part > zero, (short_of.slope - beyond.slope) * per_width, zero);
    cover.shift = reach * (short_of.part - beyond.part);
    cover.shift_slope = -0.5 * (short_of.slope + beyond.slope);
    return cover;
}

/// Sums of a pair in the axes (k, u, v) of its face, lane by lane.
struct LaneSums {
    Lanes force_k{}, force_u{}, force_v{}, moment_k{}, moment_u{}, moment_v{};
    Lanes elastic_normal{}, elastic_shear{}, friction{}, damping{}, overlap{}, touching{};

    [[gnu::always_inline]] void add_force_at(const Lanes& k, const Lanes& u, const Lanes& v, const Lanes& fk, const Lanes& fu,
                                             const Lanes& fv) {
        force_k += fk;
        force_u += fu;
        force_v += fv;
        moment_k += u * fv - v * fu;
        moment_u += v * fk - k * fv;
        moment_v += k * fu - u * fk;
    }
};

/// The tangential dashpot of one axis at a group of nodes; nothing when no interface has one.
struct ViscousAxis {
    double* traction;

    [[gnu::always_inline]] Lanes before() const { return traction != nullptr ? load(traction) : broadcast<Lanes>(0.0); }
    [[gnu::always_inline]] void set(const Lanes& value) const {
        if (traction != nullptr) store(value, traction);
    }
};

/// The kernel: see sum_flat_nodes. Works in the axes (k, u, v) of the face, a cyclic permutation of the follower's.
///
/// The acting area of a node is its share of the leader's face that looks at the follower, clipped to the follower's face. The springs'
/// energy ½(K_n d² + K_s ξ²)·A depends on the pose through A too: its gradient is the edge force at the end, smaller than the normal force
/// by overlap/spacing, without which the contact is not conservative and slender stacks flutter. Losses are booked so that the sum of work
/// closes in discrete time: a force works over a step with the mean of its values at both ends.
///
/// Long, since it is one loop over nodes whose steps share some forty values in registers.
template <bool Faceted, bool Bounded>
[[gnu::always_inline]] inline PairSums sum_flat(const NodeContact& contact, const FlatFollower& face) {
    const auto& [leader, pose, law, pair, list] = contact;
    const std::size_t k = face.axis, u = (k + 1) % 3, v = (k + 2) % 3;
    const AxisMatch match(pose, face);
    const NodePointers nodes(leader.shape.nodes, match);
    const LaneRow y_k(pose, k), y_u(pose, u), y_v(pose, v);
    const LaneRow d_k(pose.change, k), d_u(pose.change, u), d_v(pose.change, v);
    const double side = face.side, half_k = face.half[k], half_u = face.half[u], half_v = face.half[v];
    const double facing_sign = -side * pose.rotation[k][match.normal] < 0.0 ? -1.0 : 1.0;
    // the leader's face, as a slope in the axes of the follower's: y_k rises by slant_u per y_u along it
    const double normal_k = pose.rotation[k][match.normal];
    const double slant_u = Faceted ? -pose.rotation[u][match.normal] / normal_k : 0.0;
    const double slant_v = Faceted ? -pose.rotation[v][match.normal] / normal_k : 0.0;
    const double rise_u = std::abs(slant_u), rise_v = std::abs(slant_v);
    const Row &back_k = pose.rotation[k], &back_u = pose.rotation[u], &back_v = pose.rotation[v];
    // the block's own height: what lies along z is stretched
    const double strain = Faceted ? leader.strain : 0.0, strain_u = match.u == 2 ? strain : 0.0, strain_v = match.v == 2 ? strain : 0.0,
                 strain_area = match.normal == 2 ? 0.0 : strain;
    const auto stretched = [](const Lanes& value, double by) MUSIM_INLINE_LAMBDA { return Faceted ? value + by * value : value; };
    const Lanes zero = broadcast<Lanes>(0.0), none = broadcast<Lanes>(ContactHistory::kNoContact);
    ContactHistory& history = list.history;
    double* const slip_k = history.slip[k].data();
    double* const slip_u = history.slip[u].data();
    double* const slip_v = history.slip[v].data();
    double* const dashpot = history.damping_pressure.data();
    double* const late_of = history.late.data();
    LaneSums total;
    PairWork ended;

    for (std::size_t entry = pair.first_node, end = entry + pair.node_count; entry < end; entry += kLanes) {
        const std::uint32_t* const index = &list.nodes[entry];
        const bool consecutive = index[3] == index[0] + 3;
        const auto read = [&](const double* from) MUSIM_INLINE_LAMBDA { return consecutive ? load(from + index[0]) : gather(from, index); };
        const auto left = static_cast<double>(end - entry);
        const LaneMask real = Lanes{0.0, 1.0, 2.0, 3.0} < broadcast<Lanes>(left);

        Lanes px = read(nodes.x), py = read(nodes.y), pz = stretched(read(nodes.z), strain);
        Lanes yk = y_k(px, py, pz);
        Lanes overlap = half_k - side * yk;
        const Lanes old_dashpot = load(dashpot + entry);
        const LaneMask touched = old_dashpot != none;
        const Lanes reach_u = stretched(read(nodes.reach_u), strain_u), reach_v = stretched(read(nodes.reach_v), strain_v);
        // the covered part of a cell may lie deeper than its node, by as much as the leader's face rises within a cell
        const Lanes highest = Bounded ? overlap + (rise_u * reach_u + rise_v * reach_v) : overlap;
        if (!some(((highest > zero) & real) | touched)) continue;

        Lanes yu = y_u(px, py, pz), yv = y_v(px, py, pz);
        const Lanes share = Faceted ? facing_sign * stretched(read(nodes.area_of_face), strain_area)
                                    : -side * ((pose.rotation[k][0] * read(nodes.area_x) + pose.rotation[k][1] * read(nodes.area_y)) +
                                               pose.rotation[k][2] * read(nodes.area_z));
        Lanes area = share;
        LaneCover cover_u{}, cover_v{};
        Lanes middle_k{}, middle_u{}, middle_v{};
        const Lanes node_k = yk, node_u = yu, node_v = yv;
        LaneMask partial{};
        if (Bounded) {
            const Lanes mx = px + read(nodes.center_x), my = py + read(nodes.center_y), mz = pz + stretched(read(nodes.center_z), strain);
            middle_k = y_k(mx, my, mz), middle_u = y_u(mx, my, mz), middle_v = y_v(mx, my, mz);
            const LaneMask beyond = reaches_over(middle_u, reach_u, half_u) | reaches_over(middle_v, reach_v, half_v);
            if (some(beyond & real)) {
                cover_u = find_cover(middle_u, reach_u, half_u);
                cover_v = find_cover(middle_v, reach_v, half_v);
                area = share * cover_u.part * cover_v.part;
                partial = ((cover_u.slope != zero) | (cover_v.slope != zero)) & real;
            }
            if (some(partial)) {
                // a cell that is covered in part acts at the middle of that part, on the leader's face
                const Lanes su = cover_u.shift, sv = cover_v.shift, sk = slant_u * su + slant_v * sv;
                px += (back_k[0] * sk + back_u[0] * su) + back_v[0] * sv;
                py += (back_k[1] * sk + back_u[1] * su) + back_v[1] * sv;
                pz += (back_k[2] * sk + back_u[2] * su) + back_v[2] * sv;
                yk += sk, yu += su, yv += sv;
                overlap = half_k - side * yk;
            }
        }
        const LaneMask deep = (overlap > zero) & real;
        const Lanes normal_change = side * d_k(px, py, pz), change_u = d_u(px, py, pz), change_v = d_v(px, py, pz);
        const LaneMask active = deep & (area > zero);
        const LaneMask lasting = active & touched;
        const LaneMask over = touched & ~lasting;
        if (some(over)) {
            Row normal{};
            normal[k] = side;
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                if (over[lane] == 0) continue;
                Row change{};
                change[k] = side * normal_change[lane], change[u] = change_u[lane], change[v] = change_v[lane];
                end_contact(law, normal, change, std::max(0.0, area[lane]), entry + lane, history, ended);
            }
        }
        area = choose(active, area, zero);

        // what a new contact overlapped before it was noticed carries nothing, unless its area begins at zero too
        const Lanes overlap_before = larger_of<Lanes>(overlap + normal_change, zero);
        const Lanes sudden = smaller_of<Lanes>(area * (1.0 / kSuddenPart) / share, broadcast<Lanes>(1.0));
        Lanes late = choose(lasting, smaller_of<Lanes>(load(late_of + entry), overlap), list.first_step ? zero : overlap_before * sudden);
        late = choose(active, late, zero);
        overlap -= late;

        // normal: spring and dashpot that never pull
        const Lanes elastic = law.kn * overlap;
        const Lanes pressure = larger_of<Lanes>(elastic - law.cn * normal_change, zero);
        const Lanes new_dashpot = pressure - elastic;

        // tangential trial: all of the change is elastic; of a new contact, what came after it touched
        const LaneMask sinking = deep & (normal_change < -overlap);
        const Lanes since_touch = choose(lasting, broadcast<Lanes>(1.0), choose(sinking, overlap / -normal_change, broadcast<Lanes>(1.0)));
        const ViscousAxis viscous_u{history.has_viscous() ? history.viscous[u].data() + entry : nullptr};
        const ViscousAxis viscous_v{history.has_viscous() ? history.viscous[v].data() + entry : nullptr};
        const Lanes old_u = choose(lasting, load(slip_u + entry), zero), old_v = choose(lasting, load(slip_v + entry), zero);
        const Lanes step_u = since_touch * change_u, step_v = since_touch * change_v;
        const Lanes old_shear_u = choose(lasting, viscous_u.before(), zero) - law.ks * old_u;
        const Lanes old_shear_v = choose(lasting, viscous_v.before(), zero) - law.ks * old_v;
        Lanes new_u = old_u + step_u, new_v = old_v + step_v;
        Lanes drag_u = -law.cs * step_u, drag_v = -law.cs * step_v;
        Lanes shear_u = drag_u - law.ks * new_u, shear_v = drag_v - law.ks * new_v;

        // Coulomb limit
        const Lanes limit = law.mu * pressure;
        const Lanes squared = shear_u * shear_u + shear_v * shear_v;
        const LaneMask slides = (squared > limit * limit) & active;
        if (some(slides)) {
            const Lanes scale = limit / square_root(squared);
            shear_u = choose(slides, shear_u * scale, shear_u);
            shear_v = choose(slides, shear_v * scale, shear_v);
            new_u = choose(slides, -law.ks_inverse * shear_u, new_u);
            new_v = choose(slides, -law.ks_inverse * shear_v, new_v);
            drag_u = choose(slides, zero, drag_u);
            drag_v = choose(slides, zero, drag_v);
        }

        const Lanes work = -0.5 * ((old_shear_u + shear_u) * step_u + (old_shear_v + shear_v) * step_v);
        const Lanes stored = (0.5 * law.ks) * (new_u * new_u + new_v * new_v);
        const Lanes stored_before = (0.5 * law.ks) * (old_u * old_u + old_v * old_v);
        const Lanes tangential_loss = area * (work - (stored - stored_before));
        total.friction += choose(slides, tangential_loss, zero);
        total.damping += choose(slides, zero, tangential_loss);
        total.damping -= 0.5 * area * (choose(lasting, old_dashpot, zero) + new_dashpot) * normal_change;
        total.elastic_normal += 0.5 * area * elastic * overlap;
        total.elastic_shear += area * stored;
        total.overlap = larger_of<Lanes>(total.overlap, choose(active, overlap + late, zero));
        total.touching += choose(active, broadcast<Lanes>(1.0), zero);
        total.add_force_at(yk, yu, yv, side * area * pressure, area * shear_u, area * shear_v);

        if (Bounded && some(partial & active)) {
            // gradient of the springs' energy as the cell moves over the edge: the covered part changes, and its middle, which stays at its
            // distance from the node in the follower's axes, not on the leader
            const Lanes density = choose(active & partial, share * (0.5 * elastic * overlap + stored), zero);
            const Lanes push = side * choose(active & partial, area * elastic, zero);
            total.add_force_at(middle_k, middle_u, middle_v, zero,
                               push * slant_u * cover_u.shift_slope - density * cover_u.slope * cover_v.part,
                               push * slant_v * cover_v.shift_slope - density * cover_v.slope * cover_u.part);
            total.add_force_at(node_k, node_u, node_v, zero, push * slant_u, push * slant_v);
            total.add_force_at(yk, yu, yv, zero, -push * slant_u, -push * slant_v);
        }

        store(zero, slip_k + entry);
        store(choose(active, new_u, zero), slip_u + entry);
        store(choose(active, new_v, zero), slip_v + entry);
        store(choose(active, new_dashpot, none), dashpot + entry);
        store(late, late_of + entry);
        viscous_u.set(choose(active, drag_u, zero));
        viscous_v.set(choose(active, drag_v, zero));
    }

    PairSums sums;
    sums.force[k] = sum(total.force_k), sums.force[u] = sum(total.force_u), sums.force[v] = sum(total.force_v);
    sums.moment[k] = sum(total.moment_k), sums.moment[u] = sum(total.moment_u), sums.moment[v] = sum(total.moment_v);
    sums.tally = {sum(total.elastic_normal), sum(total.elastic_shear), largest(total.overlap),
                  static_cast<std::uint32_t>(sum(total.touching))};
    sums.work = {sum(total.friction) + ended.friction, sum(total.damping) + ended.damping};
    return sums;
}

/// The kernel for the kind of leader and follower.
[[gnu::always_inline]] inline PairSums sum_any(const NodeContact& contact, const FlatFollower& face) {
    if (contact.leader.shape.faceted) return face.bounded ? sum_flat<true, true>(contact, face) : sum_flat<true, false>(contact, face);
    return face.bounded ? sum_flat<false, true>(contact, face) : sum_flat<false, false>(contact, face);
}

MUSIM_AVX2 PairSums sum_wide(const NodeContact& contact, const FlatFollower& face) { return sum_any(contact, face); }

PairSums sum_plain(const NodeContact& contact, const FlatFollower& face) { return sum_any(contact, face); }

}  // namespace

PairSums sum_flat_nodes(const NodeContact& contact, const FlatFollower& face) {
    return (active_instructions() >= Instructions::avx2 ? sum_wide : sum_plain)(contact, face);
}

}  // namespace musim::lsdem::detail
