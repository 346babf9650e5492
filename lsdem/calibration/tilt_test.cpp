#include "lsdem/calibration/tilt_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "lsdem/motion/simulation.hpp"
#include "lsdem/run/advance_in_pieces.hpp"
#include "lsdem/time_step.hpp"

namespace musim::lsdem {
namespace {

constexpr double kPi = std::numbers::pi;

/// Damping with which the run begins the test at rest, as on an incline that is tilted slowly: without tangential damping the jerk of
/// letting go would ring on in the stuck joint and carry the block downhill below its angle. Coulomb's limit holds for spring and dashpot
/// together, so that it shifts no threshold.
constexpr double kDampedRestitution = 0.1, kDampedShearDamping = 0.5;

/// Velocities decay at this many times p = √(3g/4R) in the first quarter of a run, so that the block comes to lean on its springs as on a
/// slope that is tilted slowly: let go at once it would swing over its edge. A choice, twice what is critical of a motion at p.
constexpr double kSlowness = 4.0;
/// A run in which a block may topple lasts so many times 1/p. A choice: with twice as many, wood topples 0.004° earlier.
constexpr double kFallTimes = 8.0;

/// A block on a slope; x is downhill.
struct Slope {
    Vector3 extent;          ///< of the block along the world axes: downhill, across, upward [m]
    Quaternion orientation;  ///< body to world
    double friction;
};

Slope make_slope(const BlockSample& sample, const TiltCase& test) {
    // columns: where the body axes b, w, H point
    Matrix3 axes;
    const bool wide = test.side == TiltSide::wide;
    if (test.pose == TiltPose::upright) {
        axes = wide ? (Matrix3() << 0, 1, 0, -1, 0, 0, 0, 0, 1).finished() : Matrix3(Matrix3::Identity());
    } else {
        axes = wide ? (Matrix3() << 0, 1, 0, 0, 0, 1, 1, 0, 0).finished() : (Matrix3() << 0, 0, 1, 0, -1, 0, 1, 0, 0).finished();
    }
    return {.extent = (axes.cwiseAbs() * sample.size).eval(),
            .orientation = Quaternion(axes),
            .friction = test.support == TiltSupport::ground ? sample.ground_friction : sample.friction};
}

/// Force that presses a block on the slope [N].
double pressing_force(const BlockSample& sample, double angle) { return sample.mass() * sample.gravity * std::cos(angle); }

/// The model at an angle: the block in the equilibrium of its normal springs, on the ground or on a fixed block twice as large.
Model make_tilted_model(const BlockSample& sample, const TiltCase& test, const Slope& slope, double angle) {
    Model model = make_model(sample);
    model.gravity = sample.gravity * Vector3(std::sin(angle), 0.0, -std::cos(angle));
    const double area = slope.extent.x() * slope.extent.y();
    const double sunk = pressing_force(sample, angle) / (sample.normal_pressure() * area);
    double top = 0.0;
    if (test.support == TiltSupport::block) {
        // a plate of the same material, on which the block stays while it is watched
        const Vector3 size(2.0 * slope.extent.x(), 2.0 * slope.extent.y(), slope.extent.z());
        model.shapes.push_back(make_box_shape(size, {2, 2, 2}));
        Block plate;
        plate.shape = 1;
        plate.mass = sample.density * size.prod();
        plate.position = {0.0, 0.0, 0.5 * size.z()};
        plate.fixed = true;
        model.blocks.push_back(plate);
        model.ground.present = false;
        top = size.z();
    }
    model.blocks.push_back(make_block(sample, {0.0, 0.0, top + 0.5 * slope.extent.z() - sunk}, slope.orientation));
    return model;
}

/// Place of the lower edge downhill along the slope, about which the block topples [m], and its lean downhill [rad].
struct Stance {
    double place, lean;
};

Stance find_stance(const Simulation& simulation, const Slope& slope) {
    const std::size_t block = simulation.model().blocks.size() - 1;
    const Quaternion turn = simulation.orientation(block) * slope.orientation.conjugate();
    const Vector3 up = turn * Vector3::UnitZ(), downhill = turn * Vector3::UnitX();
    const double place = simulation.position(block).x() + 0.5 * (slope.extent.x() * downhill.x() - slope.extent.z() * up.x());
    return {place, std::atan2(up.x(), up.z())};
}

/// Where a rigid block topples [rad].
double rigid_fall(const Slope& slope) { return std::atan2(slope.extent.x(), slope.extent.z()); }

/// Length a of the base, from the edge downhill, on which a block bears that is about to topple [m]. Under the pressure of its springs the
/// block leans by 2N/(K_n w a²) and bears a third of a from the edge, so tan(angle) = (b − 2a/3)/H − 2N/(K_n w a²), which is most where
/// a³ = 6 H N/(K_n w).
double least_base(const BlockSample& sample, const Slope& slope, double angle) {
    const double load = pressing_force(sample, angle);
    return std::cbrt(6.0 * slope.extent.z() * load / (sample.normal_pressure() * slope.extent.y()));
}

/// Where a block topples on the springs of its base: tan(angle) = (b − a)/H [rad]. An iteration leaves some a/(3H) of the error.
double fall_on_springs(const BlockSample& sample, const Slope& slope) {
    double angle = rigid_fall(slope);
    constexpr int kIterations = 10;
    for (int i = 0; i < kIterations; ++i) {
        angle = std::atan2(std::max(0.0, slope.extent.x() - least_base(sample, slope, angle)), slope.extent.z());
    }
    return angle;
}

/// Event at an angle; nothing when the block stays.
std::optional<TiltEvent> watch(const BlockSample& sample, const TiltCase& test, const Slope& slope, double angle, double resolution) {
    Model model = make_tilted_model(sample, test, slope, angle);
    const double length = test.pose == TiltPose::lying ? slope.extent.x() : std::min(slope.extent.x(), least_base(sample, slope, angle));
    const double swing =
        slope.friction * pressing_force(sample, angle) / (sample.shear_pressure() * length * slope.extent.y());  // μN/k_s [m]

    // sliding at `resolution` above its angle: by g·resolution·(T/4)² farther in the last quarter than in the one before
    const double slip_time = 4.0 * std::sqrt(2.0 * swing / (sample.gravity * resolution));
    // leaning out: by cosh(pt)
    const double p = std::sqrt(1.5 * sample.gravity / std::hypot(slope.extent.x(), slope.extent.z()));
    const double quarter = 0.25 * (test.pose == TiltPose::lying ? slip_time : std::max(slip_time, kFallTimes / p));

    const double step = 0.5 * compute_critical_time_step(model);
    const auto steps = static_cast<std::uint64_t>(std::ceil(quarter / step));
    Simulation simulation(model, step);
    std::array<Stance, 3> stance{};
    simulation.set_velocity_damping(kSlowness * p);
    detail::advance_in_pieces(simulation, steps, [](std::uint64_t /*taken*/) {});
    simulation.set_velocity_damping(0.0);
    for (Stance& now : stance) {
        detail::advance_in_pieces(simulation, steps, [](std::uint64_t /*taken*/) {});
        now = find_stance(simulation, slope);
    }
    if (simulation.divergence()) throw std::runtime_error("tilt test: the run diverged; are the stiffnesses consistent?");
    const bool past_edge = stance[2].lean + angle > rigid_fall(slope);
    const double lean = stance[2].lean - stance[0].lean, slip = stance[2].place - 2.0 * stance[1].place + stance[0].place;
    if (!past_edge && slip <= swing) return std::nullopt;
    // the faster of the two: a toppling block drags its edge a little, a slipping one leans on its springs
    return lean * slope.extent.z() > stance[2].place - stance[0].place ? TiltEvent::topples : TiltEvent::slips;
}

}  // namespace

std::string to_string(TiltSupport support) { return support == TiltSupport::ground ? "ground" : "block"; }
std::string to_string(TiltPose pose) { return pose == TiltPose::lying ? "lying" : "upright"; }
std::string to_string(TiltEvent event) { return event == TiltEvent::slips ? "slips" : "topples"; }

double TiltResult::friction() const { return std::tan(angle()); }

TiltResult run_tilt_test(const BlockSample& given, const TiltCase& test, double resolution) {
    if (!(resolution > 0.0) || resolution > 0.1) {
        throw std::invalid_argument(
            fmt::format("tilt test: the resolution is {} rad (must be positive, 0.1 at most); correct it", resolution));
    }
    const Slope slope = make_slope(given, test);
    BlockSample sample = given;
    sample.restitution = std::min(sample.restitution, kDampedRestitution);
    sample.shear_damping_ratio = std::max(sample.shear_damping_ratio, kDampedShearDamping);
    TiltResult result{.event = TiltEvent::slips,
                      .low = 0.0,
                      .high = 0.5 * kPi,
                      .expected_slip = std::atan(slope.friction),
                      .expected_fall = rigid_fall(slope),
                      .expected_fall_on_springs = fall_on_springs(sample, slope)};
    while (result.high - result.low > resolution) {
        const double angle = result.angle();
        if (const auto event = watch(sample, test, slope, angle, resolution)) {
            result.high = angle;
            result.event = *event;
        } else {
            result.low = angle;
        }
    }
    return result;
}

}  // namespace musim::lsdem
