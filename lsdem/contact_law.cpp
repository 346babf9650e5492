#include "lsdem/contact_law.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lsdem/material_fields.hpp"

namespace musim::lsdem {
namespace {

/// −ln e as a function of ζ: 2ζ·acos(ζ)/sqrt(1 − ζ²), continued analytically through ζ = 1, where it is 2.
double log_decrement(double zeta) {
    const double gap = (1.0 - zeta) * (1.0 + zeta);
    if (gap == 0.0) return 2.0;
    return gap > 0.0 ? 2.0 * zeta * std::acos(zeta) / std::sqrt(gap) : 2.0 * zeta * std::acosh(zeta) / std::sqrt(-gap);
}

/// The inverse of the decrement.
double find_damping_ratio(double restitution) {
    const double wanted = -std::log(restitution);
    // the decrement grows monotonically with ζ: bracket, then bisect to the last bit
    double low = 0.0, high = 1.0;
    while (log_decrement(high) < wanted) high *= 2.0;
    for (double middle = 0.5 * high; middle > low && middle < high; middle = 0.5 * (low + high)) {
        (log_decrement(middle) < wanted ? low : high) = middle;
    }
    return low;
}

/// Stiffness of two springs in series, each half a block thick; equal ones are kept to the last bit.
double join_in_series(double a, double b) { return a == b ? a : 2.0 * a * b / (a + b); }

double join(MaterialField::Joint joint, double a, double b) {
    switch (joint) {
        case MaterialField::Joint::in_series:
            return join_in_series(a, b);
        case MaterialField::Joint::smaller:
            return std::min(a, b);
        case MaterialField::Joint::larger:
            break;
    }
    return std::max(a, b);
}

}  // namespace

double compute_restitution(double damping_ratio) {
    if (!(damping_ratio >= 0.0)) throw std::invalid_argument("compute_restitution: the damping ratio must not be negative");
    return std::exp(-log_decrement(damping_ratio));
}

double compute_damping_ratio(double restitution) {
    if (!(restitution > 0.0 && restitution <= 1.0)) throw std::invalid_argument("restitution must lie in (0, 1]");
    // asked for by pair after pair of the same material
    struct Known {
        double restitution = 1.0, ratio = 0.0;
    };
    thread_local Known last;
    if (restitution != last.restitution) last = {restitution, find_damping_ratio(restitution)};
    return last.ratio;
}

Material combine(const Material& a, const Material& b) {
    Material both;
    for (const auto& [member, joint] : kMaterialFields) both.*member = join(joint, a.*member, b.*member);
    return both;
}

Material find_joint(const Model& model, std::size_t a, const std::optional<std::size_t>& b) {
    const auto pair = std::find_if(model.pairs.begin(), model.pairs.end(), [&](const MaterialPair& each) { return each.is_of(a, b); });
    if (pair != model.pairs.end()) return pair->joint;
    return combine(model.materials[a], b ? model.materials[*b] : model.ground.material);
}

Material find_joint_of_blocks(const Model& model, std::size_t a, const std::optional<std::size_t>& b) {
    Material joint = find_joint(model, model.blocks[a].material, b ? std::optional(model.blocks[*b].material) : std::nullopt);
    joint.friction *= find_friction_factor(model.scatter, a, b);
    return joint;
}

Interface make_interface(const Material& joint, double effective_mass, double face_area) {
    Interface law;
    law.normal_stiffness = joint.normal_stiffness;
    law.shear_stiffness = joint.shear_stiffness;
    law.friction = joint.friction;
    law.normal_damping = 2.0 * compute_damping_ratio(joint.restitution) * std::sqrt(effective_mass * law.normal_stiffness / face_area);
    law.shear_damping = 2.0 * joint.shear_damping_ratio * std::sqrt(effective_mass * law.shear_stiffness / face_area);
    return law;
}

Interface scaled(const Interface& interface, double share) {
    Interface law = interface;
    law.normal_stiffness *= share;
    law.shear_stiffness *= share;
    law.normal_damping *= share;
    law.shear_damping *= share;
    return law;
}

}  // namespace musim::lsdem
