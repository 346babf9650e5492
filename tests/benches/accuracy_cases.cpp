#include "tests/benches/accuracy_cases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "lsdem/contact_law.hpp"

namespace musim::lsdem {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGravity = 9.81;  ///< of the closed forms [m/s²]
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Wood at 1:107, the reference block of the closed forms [Harmon23, Tables 2-4].
struct Wood {
    Vector3 size = Vector3(1.36, 2.82, 4.25) / 107.0;  ///< b, w, H [m]
    double density = 800.0;                            ///< [kg/m³]
    double normal_stiffness = 30e6;                    ///< of the face across z [N/m]
    double shear_stiffness = 26e6;                     ///< [N/m]
    double friction = 0.63;
    double restitution = 0.3;
    double shear_damping_ratio = 0.0;

    double mass() const { return density * size.prod(); }
    double face_area() const { return size.x() * size.y(); }
    /// ω0 = sqrt(k_n/m) [1/s].
    double frequency() const { return std::sqrt(normal_stiffness / mass()); }
};

Model make_model(const Wood& wood, const AccuracySetting& setting) {
    Model model;
    model.shapes.push_back(make_shape(setting, wood.size, wood.size));
    model.materials.push_back({wood.normal_stiffness / wood.face_area(), wood.shear_stiffness / wood.face_area(), wood.friction,
                               wood.restitution, wood.shear_damping_ratio});
    model.ground.material = model.materials.front();
    model.gravity = {0.0, 0.0, -kGravity};
    apply(setting, model);
    return model;
}

Block make_block(const Wood& wood, const Vector3& position, const Quaternion& orientation = Quaternion::Identity()) {
    Block block;
    block.mass = wood.mass();
    block.position = position;
    block.orientation = orientation;
    return block;
}

double relative_error(double measured, double expected) {
    const double error = std::abs(measured / expected - 1.0);
    if (!std::isfinite(error)) return kInfinity;
    return error;
}

/// ∫ f from a to b by Simpson's rule with 2n intervals.
template <class Function>
double integrate(double a, double b, int n, const Function& f) {
    const double h = (b - a) / (2 * n);
    double sum = f(a) + f(b);
    for (int i = 1; i < 2 * n; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(a + i * h);
    return sum * h / 3.0;
}

/// First time at which `value(simulation)` changes sign, linear between steps; not a number when it does not before `until` [s].
template <class Value>
double find_crossing(Simulation& s, double until, const Value& value) {
    double before = value(s);
    while (s.time() < until && !s.divergence()) {
        s.advance();
        const double now = value(s);
        if ((before > 0.0) != (now > 0.0)) return s.time() - s.time_step() * now / (now - before);
        before = now;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

void advance_to(Simulation& s, double time) {
    if (time > s.time()) s.advance(static_cast<std::uint64_t>(std::ceil((time - s.time()) / s.time_step())));
}

double tilt_about_y(const Simulation& s, std::size_t block) {
    const Quaternion q = s.orientation(block);
    return 2.0 * std::atan2(q.y(), q.w());
}

AccuracyOutcome run_slide(const AccuracySetting& setting) {
    const Wood wood;
    constexpr double kDuration = 0.05, kAcceleration = kGravity;
    Model model = make_model(wood, setting);
    const double area = wood.size.y() * wood.size.z();
    const double sunk = wood.mass() * kGravity / (wood.normal_stiffness / wood.face_area() * area);
    const Quaternion lying(Eigen::AngleAxisd(0.5 * kPi, Vector3::UnitY()));
    model.blocks.push_back(make_block(wood, {0.0, 0.0, 0.5 * wood.size.x() - sunk}, lying));
    model.blocks[0].rotation_locked = true;
    model.ground.motion.shift[0] = {0.0, kDuration, {0.0, kAcceleration * kDuration}};
    const double omega = std::sqrt(wood.shear_stiffness / wood.face_area() * area / wood.mass()), limit = wood.friction * kGravity;
    const double expected = compute_pulse_slip(kAcceleration, kDuration, limit, omega);

    MeteredSimulation run(model, setting);
    Simulation& s = run.simulation();
    double farthest = 0.0;
    while (s.time() < 1.1 * kAcceleration * kDuration / limit && !s.divergence()) {
        s.advance();
        farthest = std::max(farthest, s.base().displacement.x() - s.position(0).x());
    }
    AccuracyOutcome outcome{.error = relative_error(farthest, expected)};
    run.add_to(outcome);
    return outcome;
}

/// A block that falls to upright about a pivot in its base plane, `arm` [m] from its middle.
struct RockingCase {
    double arm, alpha, p;

    RockingCase(const Wood& wood, double pivot) : arm(pivot), alpha(std::atan2(2.0 * pivot, wood.size.z())) {
        const double radius = std::hypot(pivot, 0.5 * wood.size.z());
        const double inertia = (wood.size.x() * wood.size.x() + wood.size.z() * wood.size.z()) / 12.0;
        p = std::sqrt(kGravity * radius / (inertia + radius * radius));
    }

    double tilt() const { return 0.5 * alpha; }
    double quarter_period() const { return compute_quarter_period(alpha, p, tilt()); }

    /// The block tilted about its pivot at `place`.
    Block make(const Wood& wood, const Vector3& place) const {
        const Quaternion orientation(Eigen::AngleAxisd(tilt(), Vector3::UnitY()));
        return make_block(wood, place - orientation * Vector3(arm, 0.0, -0.5 * wood.size.z()), orientation);
    }
};

Wood rough_wood() {
    Wood wood;
    wood.friction = 2.0;  // it cannot slide under its edge
    return wood;
}

/// Times the fall of the last block of a model; the worst of several runs is kept.
void time_fall(const Model& model, const AccuracySetting& setting, const RockingCase& rocker, AccuracyOutcome& outcome) {
    const double expected = rocker.quarter_period();
    MeteredSimulation run(model, setting);
    const std::size_t block = model.blocks.size() - 1;
    const double measured = find_crossing(run.simulation(), 3.0 * expected, [&](const Simulation& s) { return tilt_about_y(s, block); });
    outcome.error = std::max(outcome.error, relative_error(measured, expected));
    run.add_to(outcome);
}

AccuracyOutcome run_rock_ground(const AccuracySetting& setting) {
    const Wood wood = rough_wood();
    const RockingCase rocker(wood, 0.5 * wood.size.x());
    Model model = make_model(wood, setting);
    model.blocks.push_back(rocker.make(wood, Vector3::Zero()));
    AccuracyOutcome outcome;
    time_fall(model, setting, rocker, outcome);
    return outcome;
}

AccuracyOutcome run_rock_own_edge(const AccuracySetting& setting) {
    const Wood wood = rough_wood();
    const RockingCase rocker(wood, 0.5 * wood.size.x());
    const Vector3 larger(4.0 * wood.size.x(), 2.0 * wood.size.y(), wood.size.z());
    AccuracyOutcome outcome;
    for (const double between : {0.25, 0.5, 0.75}) {
        Model model = make_model(wood, setting);
        model.shapes.push_back(make_shape(setting, larger, wood.size));
        Block support = make_block(wood, {0.0, 0.0, 0.5 * wood.size.z()});
        support.shape = 1;
        support.mass *= 8.0;
        support.fixed = true;
        model.blocks.push_back(support);
        // a node of the larger block stands half a block from its middle
        const double node = 0.5 * wood.size.x(), spacing = model.shapes[1].node_spacing.x();
        const double side = between * model.shapes[1].node_spacing.y();
        model.blocks.push_back(rocker.make(wood, {node + between * spacing, side, wood.size.z()}));
        time_fall(model, setting, rocker, outcome);
    }
    return outcome;
}

AccuracyOutcome run_rock_other_edge(const AccuracySetting& setting) {
    const Wood wood = rough_wood();
    const RockingCase rocker(wood, 0.3 * wood.size.x());
    Model model = make_model(wood, setting);
    Block support = make_block(wood, {0.0, 0.0, 0.5 * wood.size.z()});
    support.fixed = true;
    model.blocks.push_back(support);
    model.blocks.push_back(rocker.make(wood, {0.5 * wood.size.x(), 0.0, wood.size.z()}));
    AccuracyOutcome outcome;
    time_fall(model, setting, rocker, outcome);
    return outcome;
}

AccuracyOutcome run_lean(const AccuracySetting& setting) {
    Wood wood = rough_wood();
    wood.shear_damping_ratio = 0.5;  // brings the sway to rest
    const double b = wood.size.x(), lever = 0.5 * wood.size.z(), weight = wood.mass() * kGravity;
    const double slope = (b / 6.0) / lever / 3.0;
    Model model = make_model(wood, setting);
    model.gravity = kGravity * Vector3(slope, 0.0, -1.0);
    model.blocks.push_back(make_block(wood, {0.0, 0.0, lever - weight / wood.normal_stiffness}));
    // the weight leans with the block
    const double expected = weight * slope * lever / (wood.normal_stiffness * b * b / 12.0 - weight * lever);

    MeteredSimulation run(model, setting);
    // the slowest mode, rocking: k_θ = k_n b²/12, I = m(b² + 4H²)/12 and the dashpot's ζ b/sqrt(b² + 4H²), dies by e^-20
    const double slender = b / std::hypot(b, 4.0 * lever);
    advance_to(run.simulation(), 20.0 / (compute_damping_ratio(wood.restitution) * slender * slender * wood.frequency()));
    AccuracyOutcome outcome{.error = relative_error(tilt_about_y(run.simulation(), 0), expected)};
    run.add_to(outcome);
    return outcome;
}

/// Depth by which block i of a column sinks into what is below it under a number of weights [m].
struct Closing {
    double without_rims;
    /// Where boxes overlap by D, depths end at the sides in a rim of width D, of flush blocks on both faces, on the ground on the ground's
    /// alone: the force is K (S D − c P D²/2). The part by which D is larger; twice that, the joint is softer than K S [-].
    double by_rims;

    Closing(const Wood& wood, const AccuracySetting& setting, int i, int weights)
        : without_rims(weights * wood.mass() * kGravity / wood.normal_stiffness), by_rims(0.0) {
        if (setting.faces == FaceContact::nodes || setting.voxel > 0.0) return;
        by_rims = (i == 0 ? 0.5 : 1.0) * without_rims * (1.0 / wood.size.x() + 1.0 / wood.size.y());
    }
    double depth() const { return without_rims * (1.0 + by_rims); }
};

/// A column of blocks that only move up and down.
Model make_column(const Wood& wood, const AccuracySetting& setting, int count, bool at_rest) {
    Model model = make_model(wood, setting);
    double sunk = 0.0;
    for (int i = 0; i < count; ++i) {
        if (at_rest) sunk += Closing(wood, setting, i, count - i).depth();
        model.blocks.push_back(make_block(wood, {0.0, 0.0, (i + 0.5) * wood.size.z() - sunk}));
        model.blocks.back().rotation_locked = true;
    }
    return model;
}

AccuracyOutcome run_wave(const AccuracySetting& setting) {
    constexpr std::array<int, 4> kBlocks{5, 10, 20, 30};
    constexpr int kCount = 60;
    Wood wood;
    wood.restitution = 1.0;
    const double omega = wood.frequency();
    Model model = make_column(wood, setting, kCount, true);
    // small enough for no joint to open: V/ω0 is a tenth of the least overlap
    const double speed = 0.1 * omega * wood.mass() * kGravity / wood.normal_stiffness;
    model.ground.motion.shift[2] = {0.0, 0.0, {speed}};

    MeteredSimulation run(model, setting);
    Simulation& s = run.simulation();
    AccuracyOutcome outcome;
    // cubic through four steps around the arrival
    for (const int n : kBlocks) {
        // a joint that is softer by a part is passed later by half of it
        double joints = n;
        for (int i = 0; i < n; ++i) joints += Closing(wood, setting, i, kCount - i).by_rims;
        const double arrival = joints / omega, step = s.time_step();
        const auto block = static_cast<std::size_t>(n - 1);
        const auto second = static_cast<std::uint64_t>(arrival / step);
        s.advance(second - 1 - s.statistics().steps);
        std::array<double, 4> v{};
        for (std::size_t k = 0; k < v.size(); ++k) {
            if (k > 0) s.advance();
            v[k] = s.velocity(block).z() / speed;
        }
        const double x = arrival / step - static_cast<double>(second);
        const double measured = -x * (x - 1.0) * (x - 2.0) / 6.0 * v[0] + (x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0 * v[1] -
                                (x + 1.0) * x * (x - 2.0) / 2.0 * v[2] + (x + 1.0) * x * (x - 1.0) / 6.0 * v[3];
        outcome.error = std::max(outcome.error, relative_error(measured, compute_front(n, n)));
    }
    run.add_to(outcome);
    return outcome;
}

AccuracyOutcome run_settle(const AccuracySetting& setting) {
    constexpr int kCount = 20;
    Wood wood;
    wood.restitution = 0.15;
    const Model model = make_column(wood, setting, kCount, false);
    const double lowest = 2.0 * std::sin(0.5 * kPi / (2 * kCount + 1));
    // the lowest mode decays with ζ ω1²/(ω0 sqrt 2): to e^-25
    const double rate = compute_damping_ratio(wood.restitution) * lowest * lowest * wood.frequency() / std::sqrt(2.0);
    const double expected = wood.mass() * kGravity / wood.normal_stiffness * (0.5 * kCount * (kCount + 1));

    MeteredSimulation run(model, setting);
    advance_to(run.simulation(), 25.0 / rate);
    const double sunk = model.blocks.back().position.z() - run.simulation().position(kCount - 1).z();
    AccuracyOutcome outcome{.error = relative_error(sunk, expected)};
    run.add_to(outcome);
    return outcome;
}

AccuracyOutcome run_bounce(const AccuracySetting& setting) {
    const Wood wood;
    constexpr double kSpeed = 0.05;
    Model model = make_model(wood, setting);
    model.gravity.setZero();
    model.blocks.push_back(make_block(wood, {0.0, 0.0, 0.5 * wood.size.z()}));
    model.blocks[0].velocity.z() = -kSpeed;
    MeteredSimulation run(model, setting);
    advance_to(run.simulation(), 3.0 * kPi / wood.frequency());
    AccuracyOutcome outcome{.error = relative_error(run.simulation().velocity(0).z() / kSpeed, wood.restitution)};
    run.add_to(outcome);
    return outcome;
}

}  // namespace

double compute_quarter_period(double alpha, double p, double start) {
    // energy: θ̇² = 2p²(cos(α − θ0) − cos(α − θ)); θ = θ0 − s² takes the singular start out of the integral
    const double lowest = alpha - start;
    const auto f = [&](double s) {
        if (s == 0.0) return 2.0 / std::sqrt(2.0 * std::sin(lowest));
        // cos(a) − cos(a + s²), without loss of digits
        return 2.0 * s / std::sqrt(4.0 * std::sin(lowest + 0.5 * s * s) * std::sin(0.5 * s * s));
    };
    return integrate(0.0, std::sqrt(start), 400, f) / p;
}

double compute_front(int n, double time) {
    // jn of the C library: std::cyl_bessel_j writes lgamma's global sign, a race between cases that run side by side
    const auto f = [&](double u) { return u == 0.0 ? 0.0 : jn(2 * n, u) / u; };
    return 2.0 * n * integrate(0.0, 2.0 * time, 1000, f);
}

double compute_pulse_slip(double a, double duration, double limit, double omega) {
    // spring: u = (a/ω²)(1 − cos ωt) up to u = μg/ω²
    const double phase = std::acos(1.0 - limit / a), begin = phase / omega;
    const double stuck = limit / (omega * omega), speed = a / omega * std::sin(phase);
    // then friction is constant
    const double left = duration - begin, fastest = speed + (a - limit) * left;
    return stuck + speed * left + 0.5 * (a - limit) * left * left + 0.5 * fastest * fastest / limit;
}

std::vector<AccuracyCase> make_closed_form_cases() {
    return {{"slide", "Sliding under a pulse", run_slide},
            {"rock_ground", "Rocking on the ground", run_rock_ground},
            {"rock_own_edge", "Rocking on its own edge, on a larger block", run_rock_own_edge},
            {"rock_other_edge", "Rocking on the edge of the block below", run_rock_other_edge},
            {"lean", "Leaning within the kernel", run_lean},
            {"wave", "Wave front in a column", run_wave},
            {"settle", "Settlement of a column", run_settle},
            {"bounce", "Restitution of an impact", run_bounce}};
}

}  // namespace musim::lsdem
