#include "lsdem/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <thread>
#include <utility>

#include "lsdem/base_motion.hpp"
#include "lsdem/bodies.hpp"
#include "lsdem/contacts.hpp"
#include "lsdem/neighbors.hpp"
#include "lsdem/rotation.hpp"
#include "lsdem/thread_team.hpp"

namespace musim::lsdem {
namespace {

/// Steps between two looks at finiteness and energy. An unstable mode grows by a factor of about (1 + ε)^64 in between, so a failure is
/// dated within a few oscillations; looking at every step would cost a few percent.
constexpr std::uint64_t kHealthInterval = 64;

/// Kinetic plus elastic energy may exceed what was put in by this factor before the run counts as diverged: far above any closure error,
/// and passed within a few steps once a mode grows exponentially.
constexpr double kEnergyFactor = 4.0;

/// Energy that needs no explanation, as a fraction of weight times smallest block edge: lets the noise of a stack at rest pass.
constexpr double kEnergyFloor = 1e-3;

/// Blocks that make a second thread worth its two meetings a step. Affects speed only.
constexpr std::size_t kBlocksPerThread = 24;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void require(bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(what);
}

bool finite(const Vector3& v) { return v.allFinite(); }

void check_model(const Model& model, double time_step) {
    require(std::isfinite(time_step) && time_step > 0.0, "Simulation: the time step must be positive and finite");
    require(finite(model.gravity), "Simulation: gravity is not finite");
    for (const Block& block : model.blocks) {
        require(block.shape < model.shapes.size(), "Simulation: a block names a shape that does not exist");
        require(block.material < model.materials.size(), "Simulation: a block names a material that does not exist");
        require(std::isfinite(block.mass) && block.mass > 0.0, "Simulation: a block's mass must be positive and finite");
        require(
            finite(block.position) && finite(block.velocity) && finite(block.angular_velocity) && block.orientation.coeffs().allFinite(),
            "Simulation: a block's initial state is not finite");
        require(std::abs(block.orientation.norm() - 1.0) < 1e-9, "Simulation: a block's quaternion must have unit length");
    }
}

/// Thread `index` of `count` gets the items [first, last).
struct Share {
    std::size_t first = 0, last = 0;
};

Share share_of(std::size_t items, int index, int count) {
    const auto i = static_cast<std::size_t>(index), n = static_cast<std::size_t>(count);
    return {items * i / n, items * (i + 1) / n};
}

/// One pair as seen from one of its blocks.
struct Touch {
    std::uint32_t pair;
    bool leads;
};

/// FNV-1a over the bytes of a vector.
void hash_bytes(const Vector3& v, std::uint64_t& hash) {
    unsigned char bytes[sizeof(double) * 3];
    std::memcpy(bytes, v.data(), sizeof bytes);
    for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211ULL;
}

}  // namespace

struct Simulation::Implementation {
    Model model;
    double dt;
    Bodies bodies;
    BaseMotion motion;
    BasePose base;
    NeighborSearch search;
    ContactList list;
    PairWork finished;                     ///< of pairs that have left the list
    std::vector<std::size_t> touch_begin;  ///< per block, into `touches`
    std::vector<Touch> touches;            ///< the pairs of each block, in the order of the list
    std::vector<Share> pair_shares;        ///< per thread
    std::uint64_t step = 0;
    std::uint64_t rebuilds = 0;
    double smallest_edge = 0.0;
    double start_energy = 0.0;  ///< kinetic plus elastic at t = 0 [J]
    std::optional<Divergence> divergence;
    PhaseTimes times;
    std::vector<double> drift;    ///< per thread, largest of its blocks [m]
    std::vector<double> overlap;  ///< per thread, largest overlap over height ever
    ThreadTeam team;

    Implementation(Model given, double time_step, int threads);

    void move(double h);
    void move_block(std::size_t i, double h);
    void update_contacts();
    void rebuild();
    void gather(std::size_t i);
    void check_health();
    double stored_and_kinetic() const;
    double gravitational() const;
    PairWork total_work() const;
    void find_non_finite();
    std::size_t fastest_block() const;
};

namespace {

int choose_threads(int wanted, std::size_t blocks) {
    const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    const int useful = static_cast<int>(std::min<std::size_t>(blocks / kBlocksPerThread + 1, 1024));
    return std::min(wanted > 0 ? wanted : cores, useful);
}

/// Model that has passed its checks; everything else may rely on it.
Model checked(Model model, double time_step) {
    check_model(model, time_step);
    return model;
}

}  // namespace

Simulation::Implementation::Implementation(Model given, double time_step, int threads)
    : model(checked(std::move(given), time_step)),
      dt(time_step),
      bodies(model),
      motion(model.ground.motion),
      search(model),
      team(choose_threads(threads, model.blocks.size())) {
    drift.assign(static_cast<std::size_t>(team.size()), 0.0);
    overlap.assign(static_cast<std::size_t>(team.size()), 0.0);
    smallest_edge = std::numeric_limits<double>::infinity();
    for (const Block& block : model.blocks)
        smallest_edge = std::min(smallest_edge, 2.0 * model.shapes[block.shape].half_extents.minCoeff());

    // where everything was one step ago, as the initial velocities have it
    base.displacement = motion.displacement(0.0);
    base.previous = motion.displacement(-dt);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        bodies.previous_position[i] = bodies.position[i] - dt * bodies.velocity[i];
        bodies.previous_rotation[i] =
            rotate_freely(bodies.orientation[i], bodies.momentum[i], bodies.inverse_inertia[i], -dt).toRotationMatrix();
    }
    rebuild();
    update_contacts();
    list.first_step = false;
    start_energy = stored_and_kinetic();

    // momenta of step −1/2, so that every step is the same
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        gather(i);
        if (bodies.fixed[i] != 0) continue;
        bodies.velocity[i] -= 0.5 * dt * (bodies.force[i] / bodies.mass[i] + model.gravity);
        bodies.momentum[i] -= 0.5 * dt * bodies.torque[i];
    }
}

void Simulation::Implementation::gather(std::size_t i) {
    Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
    for (std::size_t t = touch_begin[i]; t < touch_begin[i + 1]; ++t) {
        const PairForce& pair = list.forces[touches[t].pair];
        if (touches[t].leads) {
            force += pair.force;
            torque += pair.leader_torque;
        } else {
            force -= pair.force;
            torque += pair.follower_torque;
        }
    }
    bodies.force[i] = force;
    bodies.torque[i] = torque;
}

void Simulation::Implementation::move_block(std::size_t i, double h) {
    gather(i);
    bodies.previous_position[i] = bodies.position[i];
    bodies.previous_rotation[i] = bodies.rotation[i];
    if (bodies.fixed[i] != 0) return;
    bodies.velocity[i] += h * (bodies.force[i] / bodies.mass[i] + model.gravity);
    bodies.position[i] += h * bodies.velocity[i];
    if (bodies.inverse_inertia[i].isZero(0.0)) return;
    bodies.momentum[i] += h * bodies.torque[i];
    bodies.orientation[i] = rotate_freely(bodies.orientation[i], bodies.momentum[i], bodies.inverse_inertia[i], h);
    bodies.rotation[i] = bodies.orientation[i].toRotationMatrix();
}

void Simulation::Implementation::move(double h) {
    ++step;
    base.previous = base.displacement;
    base.displacement = motion.displacement(static_cast<double>(step) * dt);
    const auto task = [&](int thread) {
        const Share share = share_of(bodies.size(), thread, team.size());
        double farthest = 0.0;
        for (std::size_t i = share.first; i < share.last; ++i) {
            move_block(i, h);
            const double moved = search.compute_drift(i, bodies, base);
            // written so that a position that is not a number counts as far away
            if (!(moved <= farthest)) farthest = std::isnan(moved) ? std::numeric_limits<double>::infinity() : moved;
        }
        drift[static_cast<std::size_t>(thread)] = farthest;
    };
    team.run(task);
}

void Simulation::Implementation::rebuild() {
    ++rebuilds;
    search.rebuild(bodies, base, list, finished);

    // the pairs of each block, in list order, so that sums run in one order whatever the threads
    touch_begin.assign(bodies.size() + 1, 0);
    for (const ContactPair& pair : list.pairs) {
        ++touch_begin[pair.leader + 1];
        if (pair.follower != kGround) ++touch_begin[pair.follower + 1];
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) touch_begin[i + 1] += touch_begin[i];
    touches.resize(touch_begin.back());
    std::vector<std::size_t> next(touch_begin.begin(), touch_begin.end() - 1);
    for (std::uint32_t p = 0; p < list.pairs.size(); ++p) {
        touches[next[list.pairs[p].leader]++] = {p, true};
        if (list.pairs[p].follower != kGround) touches[next[list.pairs[p].follower]++] = {p, false};
    }

    // equal numbers of nodes to each thread
    pair_shares.assign(static_cast<std::size_t>(team.size()), {});
    std::size_t p = 0;
    for (int thread = 0; thread < team.size(); ++thread) {
        const std::size_t last_node = share_of(list.nodes.size(), thread, team.size()).last;
        Share& share = pair_shares[static_cast<std::size_t>(thread)];
        share.first = p;
        while (p < list.pairs.size() && (list.pairs[p].first_node < last_node || thread + 1 == team.size())) ++p;
        share.last = p;
    }
}

void Simulation::Implementation::update_contacts() {
    const auto task = [&](int thread) {
        const Share share = pair_shares[static_cast<std::size_t>(thread)];
        compute_contacts(model, bodies, base, dt, share.first, share.last, list);
        double& largest = overlap[static_cast<std::size_t>(thread)];
        for (std::size_t p = share.first; p < share.last; ++p) {
            const double height = 2.0 * model.shapes[model.blocks[list.pairs[p].leader].shape].half_extents.z();
            largest = std::max(largest, list.forces[p].overlap / height);
        }
    };
    team.run(task);
}

double Simulation::Implementation::stored_and_kinetic() const {
    double sum = 0.0;
    for (const PairForce& pair : list.forces) sum += pair.elastic_normal + pair.elastic_shear;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.fixed[i] != 0) continue;
        sum += 0.5 * bodies.mass[i] * bodies.velocity[i].squaredNorm();
        sum += 0.5 * bodies.momentum[i].dot(bodies.spin(i, bodies.momentum[i]));
    }
    return sum;
}

double Simulation::Implementation::gravitational() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        sum -= bodies.mass[i] * model.gravity.dot(bodies.position[i] - model.blocks[i].position);
    return sum;
}

PairWork Simulation::Implementation::total_work() const {
    PairWork sum = finished;
    for (const PairWork& work : list.work) {
        sum.friction += work.friction;
        sum.damping += work.damping;
        sum.base += work.base;
    }
    return sum;
}

std::size_t Simulation::Implementation::fastest_block() const {
    std::size_t fastest = 0;
    double most = -1.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const double energy =
            bodies.mass[i] * bodies.velocity[i].squaredNorm() + bodies.momentum[i].dot(bodies.spin(i, bodies.momentum[i]));
        if (energy > most) most = energy, fastest = i;
    }
    return fastest;
}

void Simulation::Implementation::find_non_finite() {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const bool good =
            finite(bodies.position[i]) && finite(bodies.velocity[i]) && finite(bodies.momentum[i]) && bodies.rotation[i].allFinite();
        if (good) continue;
        divergence = Divergence{Divergence::Kind::non_finite, i, static_cast<double>(step) * dt};
        return;
    }
}

void Simulation::Implementation::check_health() {
    find_non_finite();
    if (divergence) return;
    double weight = 0.0;
    for (const double mass : bodies.mass) weight += mass;
    weight *= model.gravity.norm();
    const double allowed = kEnergyFactor * (start_energy + std::max(0.0, -gravitational()) + std::abs(total_work().base)) +
                           kEnergyFloor * weight * smallest_edge;
    if (stored_and_kinetic() > allowed)
        divergence = Divergence{Divergence::Kind::energy_out_of_bounds, fastest_block(), static_cast<double>(step) * dt};
}

Simulation::Simulation(Model model, double time_step, int threads)
    : implementation_(std::make_unique<Implementation>(std::move(model), time_step, threads)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::advance(std::uint64_t steps) {
    Implementation& s = *implementation_;
    for (std::uint64_t n = 0; n < steps && !s.divergence; ++n) {
        const auto start = Clock::now();
        s.move(s.dt);
        const auto moved = Clock::now();
        s.times.motion += std::chrono::duration<double>(moved - start).count();

        const double farthest = *std::max_element(s.drift.begin(), s.drift.end());
        if (farthest > s.search.allowed_drift()) {
            s.find_non_finite();
            if (s.divergence) return;
            s.rebuild();
            s.times.neighbors += seconds_since(moved);
        }
        const auto listed = Clock::now();
        s.update_contacts();
        s.times.contacts += seconds_since(listed);
        if (s.step % kHealthInterval == 0) s.check_health();
    }
}

double Simulation::time() const { return static_cast<double>(implementation_->step) * implementation_->dt; }
double Simulation::time_step() const { return implementation_->dt; }
const Model& Simulation::model() const { return implementation_->model; }
int Simulation::threads() const { return implementation_->team.size(); }
Vector3 Simulation::position(std::size_t block) const { return implementation_->bodies.position.at(block); }
Quaternion Simulation::orientation(std::size_t block) const { return implementation_->bodies.orientation.at(block); }

Vector3 Simulation::contact_force(std::size_t block) const {
    implementation_->gather(block);
    return implementation_->bodies.force[block];
}

Vector3 Simulation::velocity(std::size_t block) const {
    const Implementation& s = *implementation_;
    if (s.bodies.fixed.at(block) != 0) return Vector3::Zero();
    return s.bodies.velocity[block] + 0.5 * s.dt * (contact_force(block) / s.bodies.mass[block] + s.model.gravity);
}

Vector3 Simulation::angular_velocity(std::size_t block) const {
    Implementation& s = *implementation_;
    s.gather(block);
    return s.bodies.spin(block, s.bodies.momentum.at(block) + 0.5 * s.dt * s.bodies.torque[block]);
}

Kinematics Simulation::kinematics() const {
    Kinematics all;
    all.time = time();
    all.position = implementation_->bodies.position;
    all.orientation = implementation_->bodies.orientation;
    for (std::size_t i = 0; i < implementation_->bodies.size(); ++i) {
        all.velocity.push_back(velocity(i));
        all.angular_velocity.push_back(angular_velocity(i));
    }
    return all;
}

BaseState Simulation::base() const {
    const BaseMotion& motion = implementation_->motion;
    return {implementation_->base.displacement, motion.velocity(time()), motion.acceleration(time())};
}

Vector3 Simulation::base_reaction() const {
    Vector3 sum = Vector3::Zero();
    for (std::size_t p = 0; p < implementation_->list.pairs.size(); ++p)
        if (implementation_->list.pairs[p].follower == kGround) sum += implementation_->list.forces[p].force;
    return sum;
}

Energy Simulation::energy() const {
    Implementation& s = *implementation_;
    Energy energy;
    for (std::size_t i = 0; i < s.bodies.size(); ++i) {
        if (s.bodies.fixed[i] != 0) continue;
        s.gather(i);
        const Vector3 next_velocity = s.bodies.velocity[i] + s.dt * (s.bodies.force[i] / s.bodies.mass[i] + s.model.gravity);
        const Vector3 next_momentum = s.bodies.momentum[i] + s.dt * s.bodies.torque[i];
        energy.kinetic += 0.5 * s.bodies.mass[i] * s.bodies.velocity[i].dot(next_velocity);
        energy.kinetic += 0.5 * s.bodies.spin(i, s.bodies.momentum[i]).dot(next_momentum);
    }
    for (const PairForce& pair : s.list.forces) {
        energy.elastic_normal += pair.elastic_normal;
        energy.elastic_shear += pair.elastic_shear;
    }
    energy.gravitational = s.gravitational();
    const PairWork work = s.total_work();
    energy.friction_loss = work.friction;
    energy.damping_loss = work.damping;
    energy.base_work = work.base;
    return energy;
}

Statistics Simulation::statistics() const {
    const Implementation& s = *implementation_;
    Statistics statistics;
    statistics.steps = s.step;
    statistics.pairs = s.list.pairs.size();
    for (const PairForce& pair : s.list.forces) statistics.contact_nodes += pair.touching;
    statistics.rebuilds = s.rebuilds;
    statistics.max_overlap_over_height = *std::max_element(s.overlap.begin(), s.overlap.end());
    return statistics;
}

PhaseTimes Simulation::phase_times() const { return implementation_->times; }
std::optional<Divergence> Simulation::divergence() const { return implementation_->divergence; }

std::string Simulation::state_hash() const {
    const Bodies& bodies = implementation_->bodies;
    std::uint64_t hash = 14695981039346656037ULL;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        hash_bytes(bodies.position[i], hash);
        hash_bytes(bodies.velocity[i], hash);
        hash_bytes(bodies.momentum[i], hash);
        hash_bytes(bodies.orientation[i].vec(), hash);
        hash_bytes({bodies.orientation[i].w(), 0.0, 0.0}, hash);
    }
    std::string text(16, '0');
    for (std::size_t digit = 16; digit-- > 0; hash >>= 4U) text[digit] = "0123456789abcdef"[hash & 15U];
    return text;
}

double Simulation::fallen_fraction() const {
    const Implementation& s = *implementation_;
    if (s.bodies.size() == 0) return 0.0;
    std::size_t fallen = 0;
    for (std::size_t i = 0; i < s.bodies.size(); ++i) {
        const Block& start = s.model.blocks[i];
        const Matrix3 start_rotation = start.orientation.toRotationMatrix();
        const double height = 2.0 * start_rotation.row(2).cwiseAbs().dot(s.model.shapes[start.shape].half_extents);
        const double sunk = (start.position.z() - s.bodies.position[i].z()) + s.base.displacement.z();
        const double upright = s.bodies.rotation[i].row(2).dot(start_rotation.row(2));
        if (sunk > 0.25 * height || upright < std::numbers::sqrt2 / 2.0) ++fallen;
    }
    return static_cast<double>(fallen) / static_cast<double>(s.bodies.size());
}

}  // namespace musim::lsdem
