#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <variant>

#include "lsdem/motion/simulation.hpp"
#include "tests/support/models.hpp"
#include "tests/support/relative.hpp"
#include "tests/support/rocking.hpp"
#include "tests/support/round_bodies.hpp"

using namespace musim::lsdem;
using namespace musim::lsdem::tests;

namespace {

/// Errors of a sphere's grid over its surface, at points that lie anywhere in the voxels.
struct SurfaceError {
    double mean = 0.0, spread = 0.0;  ///< of φ: mean, and root mean square about it, over R [-]
    double normal = 0.0;              ///< root mean square angle of the normal [rad]
};

SurfaceError measure_surface(double voxel) {
    const Shape sphere = make_sphere_shape(kBallRadius, 20011, voxel * kBallRadius);
    const auto& grid = std::get<GridLevelSet>(sphere.level_set);
    const auto n = static_cast<double>(sphere.nodes.size());
    double sum = 0.0, squares = 0.0, angles = 0.0;
    for (std::size_t i = 0; i < sphere.nodes.size(); ++i) {
        const Vector3 x = sphere.nodes.position(i);
        const double phi = grid.value(x) / kBallRadius, angle = grid.gradient(x).normalized().cross(x.normalized()).norm();
        sum += phi, squares += phi * phi, angles += angle * angle;
    }
    return {sum / n, std::sqrt(squares / n - sum * sum / (n * n)), std::sqrt(angles / n)};
}

/// Order at which an error falls when the voxel is halved.
double order(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace

// An interpolant that is linear along each axis is off by h²/12·∂²φ on average: h²/12·2/R of a sphere. Its slope is off by up to h/2·∂²φ.
TEST_CASE("a sphere's grid converges with the square of its voxel, its normal with the voxel") {
    const std::array<double, 4> voxels{0.2, 0.1, 0.05, 0.025};
    std::array<SurfaceError, 4> errors;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        errors[i] = measure_surface(voxels[i]);
        // next order: curvature 1/(R − h) inside against 1/R
        CHECK(errors[i].mean == relative(voxels[i] * voxels[i] / 6.0, voxels[i]));
    }
    for (std::size_t i = 1; i < voxels.size(); ++i) {
        CAPTURE(i);
        // orders observed within the next one, a tenth of the voxel over R at most
        CHECK(order(errors[i - 1].mean, errors[i].mean) == doctest::Approx(2.0).epsilon(0.05));
        CHECK(order(errors[i - 1].spread, errors[i].spread) == doctest::Approx(2.0).epsilon(0.05));
        CHECK(order(errors[i - 1].normal, errors[i].normal) == doctest::Approx(1.0).epsilon(0.1));
    }
}

namespace {

/// Depth to which a sphere on a plate must be pressed to carry the weight of a bed at `overlap` [m]; mean over several turns of the sphere.
double find_depth(double voxel, double spacing, double overlap) {
    const double r = kBallRadius, force = kPi * r * overlap * overlap * (1.0 - overlap / r), mass = ball_mass(r);
    const Shape sphere = make_sphere_shape(r, 1, voxel);
    constexpr int kTurns = 24;
    double sum = 0.0;
    for (int turn = 0; turn < kTurns; ++turn) {
        Model model = make_empty_model(make_ball_material(1.0, 0.0, 1.0));
        add_shape(model, sphere);
        // middle of the cap anywhere between nodes and voxels: golden ratio steps
        const double u = std::fmod(0.618034 * turn, 1.0), v = std::fmod(0.7548777 * turn, 1.0);
        add_block(model, 0, mass, {u * spacing, v * spacing, 0.0}, skew_orientation(0.7 + turn));
        add_plate(model, -0.4 * r, 0.4 * r, 0.8 * r, spacing, voxel);
        sum += bisect(0.0, 4.0 * overlap, 24, [&](double depth) {
            model.blocks[0].position.z() = r - depth;
            return Simulation(model, 1.0).contact_force(0).z() > force;
        });
    }
    return sum / kTurns;
}

}  // namespace

TEST_CASE("a sphere on a plate rests at the height of its bed of springs, to second order in the voxel") {
    const double r = kBallRadius, overlap = 0.01 * r;
    std::array<double, 3> errors{};
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const double voxel = 0.2 / static_cast<double>(1U << i);
        errors[i] = find_depth(voxel * r, 0.015 * r, overlap) / r - overlap / r;
        // the cap is a tenth of the surface in all turns together: its mean of φ differs from that of the sphere by a part of the bumps
        CHECK(errors[i] == relative(voxel * voxel / 6.0, 0.25));
    }
    for (std::size_t i = 1; i < errors.size(); ++i) CHECK(order(errors[i - 1], errors[i]) == doctest::Approx(2.0).epsilon(0.15));
}

namespace {

/// Root mean square of the force on a pressed sphere about that of its bed, relative, as the plate's lattice is shifted under it.
double measure_scatter(double spacing, double overlap) {
    const double r = kBallRadius, voxel = 0.02 * r, force = kPi * r * overlap * overlap * (1.0 - overlap / r);
    Model model = make_empty_model(make_ball_material(1.0, 0.0, 1.0));
    add_shape(model, make_sphere_shape(r, 1, voxel));
    add_block(model, 0, ball_mass(r), Vector3::Zero(), skew_orientation());
    add_plate(model, -0.4 * r, 0.4 * r, 0.8 * r, spacing, voxel);
    constexpr int kShifts = 64;
    double squares = 0.0;
    for (int shift = 0; shift < kShifts; ++shift) {
        // golden ratio steps fill the cell between nodes evenly
        const double u = std::fmod(0.618034 * shift, 1.0), v = std::fmod(0.7548777 * shift, 1.0);
        model.blocks[0].position = {u * spacing, v * spacing, r - sphere_shrinkage(r, voxel) - overlap};
        const double off = Simulation(model, 1.0).contact_force(0).z() / force - 1.0;
        squares += off * off;
    }
    return std::sqrt(squares / kShifts);
}

}  // namespace

// The lattice samples the pressure of the cap, K(d − r²/2R) within a = sqrt(2Rd). Its Fourier transform falls as (q a)^(−5/2), and so does
// what sums over the lattice, q = 2π/s, differ by from the integral. In the mean over all places the sum is exact.
TEST_CASE("the force on a sphere scatters with the power five halves of the plate's node spacing") {
    const double r = kBallRadius, overlap = 0.02 * r;
    const std::array<double, 3> spacings{0.16, 0.08, 0.04};
    std::array<double, 3> scatter{};
    for (std::size_t i = 0; i < spacings.size(); ++i) {
        scatter[i] = measure_scatter(spacings[i] * r, overlap);
    }
    // the power holds on average: the transform oscillates about it, by a Bessel function's phase
    CHECK(0.5 * order(scatter[0], scatter[2]) == doctest::Approx(2.5).epsilon(0.2));
}
