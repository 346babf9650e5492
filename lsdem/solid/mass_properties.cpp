#include "lsdem/solid/mass_properties.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace musim::lsdem {
namespace {

/// Integrals over a piece of a solid.
struct Moments {
    double volume = 0.0;               ///< [m³]
    Vector3 centre = Vector3::Zero();  ///< [m]
    Matrix3 second = Matrix3::Zero();  ///< ∫ x xᵀ dV about the centre [m⁵]
};

/// Sums over tetrahedra between a point within the piece, the mean of its corners, and the triangles of its faces. With v the other three
/// corners seen from there and s = Σ v: V = det(v)/6, ∫ x dV = V s/4, ∫ x xᵀ dV = V (Σ v vᵀ + s sᵀ)/20 [Tonon05].
Moments integrate(const Polyhedron& piece) {
    Vector3 mean = Vector3::Zero();
    for (const Vector3& corner : piece.corners) mean += (corner - piece.corners.front()) / static_cast<double>(piece.corners.size());
    const Vector3 within = piece.corners.front() + mean;
    Moments sum;
    Vector3 first = Vector3::Zero();
    for (const Polyhedron::Face& face : piece.faces) {
        const auto loop = piece.loop(face);
        const Vector3 a = piece.corners[loop[0]] - within;
        for (std::size_t i = 2; i < loop.size(); ++i) {
            const Vector3 b = piece.corners[loop[i - 1]] - within, c = piece.corners[loop[i]] - within, s = a + b + c;
            const double volume = a.dot(b.cross(c)) / 6.0;
            sum.volume += volume;
            first += volume / 4.0 * s;
            sum.second += volume / 20.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
        }
    }
    if (!(sum.volume > 0.0)) return sum;
    const Vector3 offset = first / sum.volume;
    sum.centre = within + offset;
    sum.second -= sum.volume * offset * offset.transpose();
    return sum;
}

/// Products below this part of the trace count as none [-].
constexpr double kNoProduct = 1e-12;

/// Numbers within this part of one another are equal, so that rounding chooses no axes [-].
constexpr double kTie = 1e-9;

/// Turns the axes p and q of a symmetric tensor by at most 45°, to the angle at which its product is zero.
void rotate_pair(Eigen::Index p, Eigen::Index q, Matrix3& tensor, Matrix3& axes) {
    const double theta = 0.5 * (tensor(q, q) - tensor(p, p)) / tensor(p, q);
    const double root = std::sqrt(theta * theta + 1.0);
    // the smaller root of t² + 2 theta t = 1; of two equal moments the positive one, whatever their rounding
    const double t = theta < -kTie ? 1.0 / (theta - root) : (theta > 0.0 ? 1.0 / (theta + root) : root - theta);
    const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
    const Eigen::Index r = 3 - p - q;
    const double product = tensor(p, q), of_p = tensor(r, p), of_q = tensor(r, q);
    tensor(p, p) -= t * product;
    tensor(q, q) += t * product;
    tensor(p, q) = tensor(q, p) = 0.0;
    tensor(r, p) = tensor(p, r) = c * of_p - s * of_q;
    tensor(r, q) = tensor(q, r) = s * of_p + c * of_q;
    const Vector3 axis_p = axes.col(p), axis_q = axes.col(q);
    axes.col(p) = c * axis_p - s * axis_q;
    axes.col(q) = s * axis_p + c * axis_q;
}

/// The order and the signs in which axes are nearest to those of the frame, right-handed; of equally near ones the first.
PrincipalAxes order_axes(const Matrix3& axes, const Vector3& moments) {
    using Order = std::array<Eigen::Index, 3>;
    constexpr std::array<Order, 6> kOrders = {Order{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}};
    PrincipalAxes best;
    double nearest = -4.0;
    for (const Order& order : kOrders) {
        for (unsigned signs = 0; signs < 8; ++signs) {
            PrincipalAxes turned;
            for (Eigen::Index k = 0; k < 3; ++k) {
                const Eigen::Index from = order[static_cast<std::size_t>(k)];
                turned.axes.col(k) = (signs >> k & 1U) != 0 ? Vector3(-axes.col(from)) : Vector3(axes.col(from));
                turned.moments[k] = moments[from];
            }
            const double trace = turned.axes.trace();
            if (turned.axes.determinant() < 0.0 || !(trace > nearest + kTie)) continue;
            nearest = trace;
            best = turned;
        }
    }
    return best;
}

}  // namespace

MassProperties compute_mass_properties(const Solid& solid) {
    std::vector<Moments> pieces;
    for (const Polyhedron& piece : solid.pieces) pieces.push_back(integrate(piece));
    MassProperties result;
    if (pieces.empty()) return result;
    Vector3 first = Vector3::Zero();
    const Vector3 origin = pieces.front().centre;
    for (const Moments& piece : pieces) {
        result.volume += piece.volume;
        first += piece.volume * (piece.centre - origin);
    }
    if (!(result.volume > 0.0)) return result;
    result.centre = origin + first / result.volume;
    Matrix3 second = Matrix3::Zero();
    for (const Moments& piece : pieces) {
        const Vector3 offset = piece.centre - result.centre;
        second += piece.second + piece.volume * offset * offset.transpose();
    }
    second /= result.volume;
    result.inertia_over_mass = second.trace() * Matrix3::Identity() - second;
    return result;
}

PrincipalAxes find_principal_axes(const Matrix3& tensor) {
    constexpr int kMostSweeps = 32;  // a handful is needed: the products fall by squares
    Matrix3 rest = 0.5 * (tensor + tensor.transpose()), axes = Matrix3::Identity();
    const double none = kNoProduct * std::abs(rest.trace());
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
        bool turned = false;
        for (const auto& [p, q] : {std::pair<Eigen::Index, Eigen::Index>{0, 1}, {0, 2}, {1, 2}}) {
            if (!(std::abs(rest(p, q)) > none)) continue;
            rotate_pair(p, q, rest, axes);
            turned = true;
        }
        if (!turned) break;
    }
    return order_axes(axes, rest.diagonal());
}

}  // namespace musim::lsdem
