#include "lsdem/contact/stiffness_watch.hpp"

#include <cmath>
#include <Eigen/Cholesky>
#include <functional>

#include "lsdem/contact/area_stiffness.hpp"
#include "lsdem/contact/overlap_pairs.hpp"

namespace musim::lsdem {
namespace {

using detail::Matrix6;

/// Stiffness of a contact against a motion of one of its blocks. `arm`: of the middle of the area from the block's centre [m].
Matrix6 find_opposition(const MeetingArea& area, const Vector3& arm, double along, double across) {
    const Matrix3 d = stiffness_per_area(area.normal, along, across), r = cross_matrix(arm);
    Matrix6 sum;
    sum.topLeftCorner<3, 3>() = area.area * d;
    sum.topRightCorner<3, 3>() = -area.area * d * r;
    sum.bottomLeftCorner<3, 3>() = sum.topRightCorner<3, 3>().transpose();
    sum.bottomRightCorner<3, 3>() = area.area * r.transpose() * d * r + turning_stiffness(area.normal, area.second, along, across);
    return sum;
}

}  // namespace

StiffestBlock StiffnessWatch::find_stiffest(const Bodies& bodies, const ContactList& list, double least) {
    const double dt = bodies.elapsed;
    opposition_.assign(bodies.size(), Matrix6::Zero());
    const auto add = [&](std::size_t index, const MeetingArea& area) {
        const ContactPair& pair = list.pairs[index];
        const Interface& law = pair.law;
        const double quarter = 0.25 * dt * dt, half = 0.5 * dt;
        const double along = quarter * law.normal_stiffness + half * law.normal_damping;
        const double across = quarter * law.shear_stiffness + half * law.shear_damping;
        const auto moves = [&](std::uint32_t block) { return bodies.fixed[block] == 0; };
        const double sides = moves(pair.leader) && moves(pair.follower) ? 2.0 : 1.0;
        for (const std::uint32_t block : {pair.leader, pair.follower}) {
            if (!moves(block)) continue;
            opposition_[block] += sides * find_opposition(area, area.middle - bodies.pose[block].position, along, across);
        }
    };
    visit_meeting_areas(bodies, list, std::cref(add));  // std::function needs no memory for a reference

    StiffestBlock stiffest{least, 0};
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.fixed[i] != 0) continue;
        Matrix6& m = opposition_[i];
        const Matrix3 to_body = bodies.pose[i].rotation.transpose();
        m.rightCols<3>() = (m.rightCols<3>() * to_body.transpose()).eval();
        m.bottomRows<3>() = (to_body * m.bottomRows<3>()).eval();
        Eigen::Matrix<double, 6, 1> root;
        root << Vector3::Constant(std::sqrt(bodies.inverse_mass[i])), bodies.inverse_inertia[i].cwiseSqrt();
        m = (root.asDiagonal() * m * root.asDiagonal()).eval();
        // most blocks use less than the largest so far, which costs little to see
        if (Eigen::LLT<Matrix6>(stiffest.used * Matrix6::Identity() - m).info() == Eigen::Success) continue;
        const double used = detail::largest_eigenvalue(m);
        if (used > stiffest.used) stiffest = {used, i};
    }
    return stiffest.used > least ? stiffest : StiffestBlock{};
}

}  // namespace musim::lsdem
