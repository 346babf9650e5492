#include "lsdem/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>

#include "lsdem/archive.hpp"
#include "lsdem/base_motion.hpp"
#include "lsdem/block_height.hpp"
#include "lsdem/bodies.hpp"
#include "lsdem/contacts.hpp"
#include "lsdem/detail/motion_kernel.hpp"
#include "lsdem/detail/patch_kernel.hpp"
#include "lsdem/detail/velocity_decay.hpp"
#include "lsdem/fallen.hpp"
#include "lsdem/model_hash.hpp"
#include "lsdem/neighbors.hpp"
#include "lsdem/preloads.hpp"
#include "lsdem/rotation.hpp"
#include "lsdem/state_fields.hpp"
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

/// The same without weight: the spring energy, k_n (ε L)², of overlaps that are the rounding of a position L away, times this.
constexpr double kRoundingFloor = 64.0;

/// Part of all energy that was put in by which the ledger may be off. Touching and parting within a step cost less than a percent; an
/// unstable mode that dashpots and parting keep small passes it.
constexpr double kLedgerBound = 0.1;

/// A structure is quiet when its kinetic energy is below this part of weight times smallest edge, at this many looks in a row: what is
/// passed over could not have moved it by more than rounding moves it (velocities of 1e-10·sqrt(g·edge), accelerations a thousand times
/// smaller than would bring these about between two looks).
constexpr double kQuietEnergy = 1e-20;
constexpr int kQuietLooks = 16;

/// A block may cross this part of the smallest edge in one step.
constexpr double kMaxStride = 0.5;

/// What pairs cost, in nodes: two boxes at an angle that touch, four patches of which one touches. What does not touch is mostly passed
/// over. Affects speed only.
constexpr std::size_t kNodesPerTiltedPair = 32;
constexpr std::size_t kNodesPerPatchGroup = 16;

/// Blocks that make a second thread worth its two meetings a step. Affects speed only.
constexpr std::size_t kBlocksPerThread = 256;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void require(bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(what);
}

bool finite(const Vector3& v) { return v.allFinite(); }

void check_velocity_damping(double rate, double time_step) {
    require(rate >= 0.0 && rate * time_step <= 1.0, "Simulation: the rate of the velocity damping must lie between 0 and 1/time step");
}

void check_model(const Model& model, double time_step) {
    require(std::isfinite(time_step) && time_step > 0.0, "Simulation: the time step must be positive and finite");
    require(finite(model.gravity), "Simulation: gravity is not finite");
    check_velocity_damping(model.velocity_damping, time_step);
    for (const Block& block : model.blocks) {
        require(block.shape < model.shapes.size(), "Simulation: a block names a shape that does not exist");
        require(block.material < model.materials.size(), "Simulation: a block names a material that does not exist");
        const Shape& shape = model.shapes[block.shape];
        require(block.height_offset == 0.0 || shape.faceted, "Simulation: only a box can be taller or shorter than its shape");
        require(std::isfinite(block.height_offset) && block.height_offset > -2.0 * shape.half_extents.z(),
                "Simulation: a block's height offset must be finite and leave it some height");
        require(std::isfinite(block.mass) && block.mass > 0.0, "Simulation: a block's mass must be positive and finite");
        require(
            finite(block.position) && finite(block.velocity) && finite(block.angular_velocity) && block.orientation.coeffs().allFinite(),
            "Simulation: a block's initial state is not finite");
        require(std::abs(block.orientation.norm() - 1.0) < 1e-9, "Simulation: a block's quaternion must have unit length");
    }
    for (const Preload& preload : model.preload) {
        require(preload.leader < model.blocks.size() && preload.follower.value_or(0) < model.blocks.size(),
                "Simulation: a preload names a block that does not exist");
        require(
            preload.is_sound() && preload.energy >= 0.0,
            "Simulation: the energy of a preload must be finite and not negative, its friction finite, with one traction for every node");
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

/// Items in a row for each thread, of about equal work.
template <class WorkOf>
std::vector<Share> share_equally(std::size_t items, int threads, const WorkOf& work_of) {
    std::vector<Share> shares(static_cast<std::size_t>(threads));
    std::size_t work = 0, done = 0, item = 0;
    for (std::size_t i = 0; i < items; ++i) work += work_of(i);
    for (int thread = 0; thread < threads; ++thread) {
        Share& share = shares[static_cast<std::size_t>(thread)];
        const std::size_t goal = share_of(work, thread, threads).last;
        share.first = item;
        for (; item < items && (done < goal || thread + 1 == threads); ++item) done += work_of(item);
        share.last = item;
    }
    return shares;
}

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
    Vector3 base_origin = Vector3::Zero();  ///< where the base would be without the present motion [m]
    NeighborSearch search;
    ContactList list;
    Losses finished;          ///< up to the last rebuild of the list
    double velocity_damping;  ///< [1/s]
    detail::TouchList touches;
    std::vector<Share> node_shares;        ///< of list.node_pairs, per thread
    std::vector<Share> patch_shares;       ///< of the groups of patches, per thread
    Vector3 base_force = Vector3::Zero();  ///< on the blocks, at step n [N]
    double base_work = 0.0;                ///< [J]
    std::uint64_t step = 0;
    std::uint64_t rebuilds = 0;
    double smallest_edge = 0.0;
    double start_energy = 0.0;       ///< kinetic plus elastic at t = 0 [J]
    double start_balance = 0.0;      ///< of the ledger at t = 0 [J]
    double energy_floor = 0.0;       ///< energy that needs no explanation [J]
    double weight_times_edge = 0.0;  ///< [J]
    int quiet_looks = 0;             ///< in a row at which nothing moved
    std::uint64_t quiet_end = 0;     ///< the step up to which nothing moves
    std::uint64_t skipped = 0;       ///< steps passed over
    bool preparing = false;          ///< the base stands
    std::optional<Divergence> divergence;
    PhaseTimes times;
    std::vector<double> drift;    ///< per thread, largest of its blocks [m]
    std::vector<double> overlap;  ///< per thread, largest overlap over height ever
    ThreadTeam team;

    Implementation(Model given, double time_step, int threads);

    /// The first forces, from the model's initial state.
    void start();
    /// Hands the whole state to an archive, or takes it from there.
    void exchange(Archive& archive);
    void move(double h);
    void update_contacts();
    void rebuild();
    void release(const Release& given);
    void restart_ledger();
    void share_work();
    detail::VelocityDecay decay_over(double h) const { return {velocity_damping, h}; }
    /// Velocity after a time of decay [m/s].
    Vector3 velocity_after(const detail::VelocityDecay& decay, std::size_t i, const Vector3& force) const {
        return decay.keep * bodies.velocity[i] + decay.push * (force * bodies.inverse_mass[i] + model.gravity);
    }
    void check_health();
    double kinetic() const;
    Energy find_energy() const;
    /// Of the damping's impulse on block i at this step, the work on the velocity before it [J].
    double half_preparation_loss(std::size_t i) const;
    std::uint64_t find_quiet_steps();
    double stored_and_kinetic() const;
    double gravitational() const;
    void find_non_finite();
    std::size_t fastest_block() const;
};

namespace {

int choose_threads(int wanted, std::size_t blocks) {
    const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    const int useful = static_cast<int>(std::min<std::size_t>(blocks / kBlocksPerThread + 1, 1024));
    return std::min(wanted > 0 ? wanted : cores, useful);
}

/// Spring energy of overlaps that are the rounding of the largest coordinate [J].
double find_rounding_energy(const Model& model) {
    double extent = 0.0, stiffest = 0.0;
    for (const Block& block : model.blocks) {
        const Shape& shape = model.shapes[block.shape];
        extent = std::max(extent, block.position.norm() + half_extents(model, block).norm());
        stiffest = std::max(stiffest, model.materials[block.material].normal_stiffness * shape.face_area);
    }
    const double rounding = std::numeric_limits<double>::epsilon() * extent;
    return kRoundingFloor * static_cast<double>(model.blocks.size()) * stiffest * rounding * rounding;
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
      finished{.block = std::vector<PairWork>(model.blocks.size()), .ground = {}},
      velocity_damping(model.velocity_damping),
      team(choose_threads(threads, model.blocks.size())) {
    drift.assign(static_cast<std::size_t>(team.size()), 0.0);
    overlap.assign(static_cast<std::size_t>(team.size()), 0.0);
    smallest_edge = std::numeric_limits<double>::infinity();
    for (const Vector3& half : bodies.half) smallest_edge = std::min(smallest_edge, 2.0 * half.minCoeff());
    for (const Block& block : model.blocks) weight_times_edge += block.mass * model.gravity.norm() * smallest_edge;
    energy_floor = kEnergyFloor * weight_times_edge + find_rounding_energy(model);
}

void Simulation::Implementation::start() {
    // where everything was one step ago, as the initial velocities have it
    base.displacement = motion.displacement(0.0);
    base.previous = motion.displacement(-dt);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        bodies.previous_position[i] = bodies.position[i] - dt * bodies.velocity[i];
        bodies.previous_rotation[i] =
            rotate_freely(bodies.orientation[i], bodies.momentum[i], bodies.inverse_inertia[i], -dt).toRotationMatrix();
    }
    rebuild();
    if (!model.preload.empty()) preload_contacts(model.preload, bodies, list);
    update_contacts();
    share_work();  // now that it is known what touches
    list.first_step = false;
    start_energy = stored_and_kinetic();

    // momenta of step −1/2, so that every step is the same
    const detail::VelocityDecay half = decay_over(0.5 * dt);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.fixed[i] != 0) continue;
        const detail::TouchList::Load load = touches.sum(i, list.forces);
        bodies.velocity[i] -= half.push * (load.force * bodies.inverse_mass[i] + model.gravity);
        bodies.velocity[i] /= half.keep;
        if (bodies.inverse_inertia[i].isZero(0.0)) continue;
        bodies.momentum[i] -= half.push * load.torque;
        bodies.momentum[i] /= half.keep;
        // that half lies before the start
        bodies.preparation_loss[i] = -half_preparation_loss(i);
    }
    start_balance = find_energy().balance();
}

void Simulation::Implementation::exchange(Archive& archive) {
    double deepest = *std::max_element(overlap.begin(), overlap.end());
    archive(bodies, base, base_origin, search.reference(), list, finished, velocity_damping, base_force, base_work);
    archive(preparing, step, rebuilds, skipped, start_energy, start_balance, quiet_looks, quiet_end, divergence, deepest);
    if (!archive.loads()) return;
    overlap.front() = deepest;
    check_restored(model, bodies, search.reference(), list, finished);
    share_work();
}

void Simulation::Implementation::move(double h) {
    ++step;
    base.previous = base.displacement;
    if (!preparing) base.displacement = base_origin + motion.displacement(static_cast<double>(step) * dt);
    std::swap(bodies.position, bodies.previous_position);
    std::swap(bodies.rotation, bodies.previous_rotation);
    const detail::Leap leap{.base_displacement = base.displacement,
                            .base_step = base.displacement - base.previous,
                            .gravity = model.gravity,
                            .h = h,
                            .decay = decay_over(h)};
    const auto task = [&](int thread) {
        const Share share = share_of(bodies.size(), thread, team.size());
        drift[static_cast<std::size_t>(thread)] =
            detail::move_blocks(touches, list.forces, search.reference(), leap, share.first, share.last, bodies);
    };
    team.run(task);
}

void Simulation::Implementation::rebuild() {
    ++rebuilds;
    search.rebuild(bodies, base, list, finished);
    share_work();
}

void Simulation::Implementation::share_work() {
    touches.rebuild(bodies.size(), list.pairs);

    const auto work_of_pair = [&](std::size_t i) -> std::size_t {
        const ContactPair& pair = list.pairs[list.node_pairs[i]];
        if (pair.is_tilted()) return list.tilted[pair.tilted].touches ? kNodesPerTiltedPair : 1;
        return pair.node_count;
    };
    const auto work_of_group = [&](std::size_t group) -> std::size_t {
        const double* const touching = list.patches.field(group, patch_field::touching);
        const bool any = std::any_of(touching, touching + PatchGroup::kSize, [](double nodes) { return nodes > 0.0; });
        return any ? kNodesPerPatchGroup : 1;
    };
    node_shares = share_equally(list.node_pairs.size(), team.size(), work_of_pair);
    patch_shares = share_equally(list.patches.groups.size(), team.size(), work_of_group);
}

void Simulation::Implementation::update_contacts() {
    const auto task = [&](int thread) {
        const auto i = static_cast<std::size_t>(thread);
        const double in_patches = detail::compute_patches(bodies, base, dt, patch_shares[i].first, patch_shares[i].last, list);
        const double at_nodes = compute_node_pairs(model, bodies, base, dt, node_shares[i].first, node_shares[i].last, list);
        overlap[i] = std::max(overlap[i], std::max(in_patches, at_nodes));
    };
    team.run(task);
    Vector3 force = Vector3::Zero();
    for (const std::uint32_t p : list.ground_pairs) force += list.forces[p].force;
    base_work += 0.5 * (base_force + force).dot(base.displacement - base.previous);
    base_force = force;
}

double Simulation::Implementation::kinetic() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.fixed[i] != 0) continue;
        sum += 0.5 * bodies.mass[i] * bodies.velocity[i].squaredNorm();
        sum += 0.5 * bodies.momentum[i].dot(bodies.spin(i, bodies.momentum[i]));
    }
    return sum;
}

double Simulation::Implementation::stored_and_kinetic() const {
    const ContactTotals contacts = sum_contacts(list);
    return kinetic() + contacts.elastic_normal + contacts.elastic_shear;
}

/// Number of steps from here in which the base stands and nothing moves.
std::uint64_t Simulation::Implementation::find_quiet_steps() {
    // with damping, blocks that hardly move may still fall: forces need not balance
    if (!model.skip_quiet || velocity_damping > 0.0) return 0;
    quiet_looks = kinetic() <= kQuietEnergy * weight_times_edge ? quiet_looks + 1 : 0;
    if (quiet_looks < kQuietLooks) return 0;
    const double now = static_cast<double>(step) * dt;
    const double still = preparing ? std::numeric_limits<double>::infinity() : motion.still_until(now) - now;
    return still > dt ? static_cast<std::uint64_t>(std::min(still / dt, 9e15)) - 1 : 0;
}

void Simulation::Implementation::release(const Release& given) {
    Block& block = model.blocks[given.block];
    block.fixed = false;
    block.position = given.position;
    block.orientation = given.orientation;
    block.velocity = given.velocity;
    const std::size_t i = given.block;
    bodies.travel[i] += (block.position - bodies.position[i]).norm() + search.reference().diameter[i];
    bodies.release(i, model);
    bodies.previous_position[i] = block.position - dt * block.velocity;
    bodies.previous_rotation[i] = bodies.rotation[i];
    const detail::VelocityDecay half = decay_over(0.5 * dt);
    bodies.velocity[i] = (bodies.velocity[i] - half.push * model.gravity) / half.keep;
    start_energy += 0.5 * block.mass * block.velocity.squaredNorm();
}

/// The state now becomes the one that energies are counted from.
void Simulation::Implementation::restart_ledger() {
    bodies.start_position = bodies.position;
    bodies.start_orientation = bodies.orientation;
    clear_losses(list);
    finished = Losses{.block = std::vector<PairWork>(bodies.size()), .ground = {}};
    std::fill(bodies.preparation_loss.begin(), bodies.preparation_loss.end(), 0.0);
    base_work = 0.0;
    start_energy = stored_and_kinetic();
    start_balance = find_energy().balance();
}

double Simulation::Implementation::gravitational() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        sum -= bodies.mass[i] * model.gravity.dot(bodies.position[i] - bodies.start_position[i]);
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

double Simulation::Implementation::half_preparation_loss(std::size_t i) const {
    if (velocity_damping == 0.0) return 0.0;
    const detail::VelocityDecay decay = decay_over(dt);
    const detail::TouchList::Load load = touches.sum(i, list.forces);
    const Vector3& velocity = bodies.velocity[i];
    const Vector3& momentum = bodies.momentum[i];
    const Vector3 kick = dt * (load.force * bodies.inverse_mass[i] + model.gravity), twist = dt * load.torque;
    const Vector3 impulse_per_mass = (velocity_after(decay, i, load.force) - velocity) - kick;
    const Vector3 twist_impulse = (decay.keep * momentum + decay.push * load.torque - momentum) - twist;
    return -0.5 * (bodies.mass[i] * impulse_per_mass.dot(velocity) + twist_impulse.dot(bodies.spin(i, momentum)));
}

Energy Simulation::Implementation::find_energy() const {
    Energy energy;
    const detail::VelocityDecay decay = decay_over(dt);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies.fixed[i] != 0) continue;
        const detail::TouchList::Load load = touches.sum(i, list.forces);
        const Vector3& velocity = bodies.velocity[i];
        const Vector3& momentum = bodies.momentum[i];
        const Vector3 spin = bodies.spin(i, momentum);
        const Vector3 next_velocity = velocity_after(decay, i, load.force);
        const Vector3 next_momentum = decay.keep * momentum + decay.push * load.torque;
        energy.kinetic += 0.5 * bodies.mass[i] * velocity.dot(next_velocity);
        energy.kinetic += 0.5 * spin.dot(next_momentum);
        energy.preparation_loss += half_preparation_loss(i);
    }
    for (const double loss : bodies.preparation_loss) energy.preparation_loss += loss;
    const ContactTotals contacts = sum_contacts(list);
    energy.elastic_normal = contacts.elastic_normal;
    energy.elastic_shear = contacts.elastic_shear;
    energy.gravitational = gravitational();
    const PairWork before = finished.total();
    energy.friction_loss = before.friction + contacts.work.friction;
    energy.damping_loss = before.damping + contacts.work.damping;
    energy.base_work = base_work;
    return energy;
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
    const double time = static_cast<double>(step) * dt;
    const double stored = stored_and_kinetic(), put_in = start_energy + std::max(0.0, -gravitational()) + std::abs(base_work);
    const double allowed = kEnergyFactor * put_in + energy_floor;
    const bool unbalanced = std::abs(find_energy().balance() - start_balance) > kLedgerBound * put_in + energy_floor;
    if (stored > allowed || unbalanced) divergence = Divergence{Divergence::Kind::energy_out_of_bounds, fastest_block(), time};
    for (std::size_t i = 0; i < bodies.size() && !divergence; ++i)
        if (bodies.velocity[i].norm() * dt > kMaxStride * smallest_edge) divergence = Divergence{Divergence::Kind::too_fast, i, time};
}

Simulation::Simulation(Model model, double time_step, int threads)
    : implementation_(std::make_unique<Implementation>(std::move(model), time_step, threads)) {
    implementation_->start();
}
Simulation::Simulation(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::advance(std::uint64_t steps) {
    Implementation& s = *implementation_;
    std::uint64_t left = steps;
    while (left > 0 && !s.divergence) {
        if (s.step < s.quiet_end) {
            const std::uint64_t quiet = std::min(left, s.quiet_end - s.step);
            s.step += quiet;
            s.skipped += quiet;
            left -= quiet;
            continue;
        }
        --left;
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
        if (s.step % kHealthInterval != 0) continue;
        s.check_health();
        s.quiet_end = s.step + s.find_quiet_steps();
    }
}

void Simulation::release(const std::vector<Release>& blocks) {
    Implementation& s = *implementation_;
    std::vector<std::uint8_t> named(s.bodies.size(), 0);
    for (const Release& given : blocks) {
        require(given.block < s.bodies.size() && s.bodies.fixed[given.block] != 0, "Simulation: only a held block can be released");
        require(named[given.block]++ == 0, "Simulation: a block is released twice");
        require(finite(given.position) && finite(given.velocity) && std::abs(given.orientation.norm() - 1.0) < 1e-9,
                "Simulation: a released block's state is not finite, or its quaternion not of unit length");
    }
    const double before = s.find_energy().balance();
    for (const Release& given : blocks) s.release(given);
    s.rebuild();
    s.start_balance += s.find_energy().balance() - before;
    s.quiet_end = s.step;
    s.quiet_looks = 0;
}

void Simulation::begin_preparation(double damping_rate) {
    Implementation& s = *implementation_;
    set_velocity_damping(damping_rate);
    s.preparing = true;
    s.quiet_end = s.step;
}

void Simulation::renew_neighbors() { implementation_->rebuild(); }

void Simulation::end_preparation() {
    Implementation& s = *implementation_;
    set_velocity_damping(0.0);
    s.preparing = false;
    s.base_origin = s.base.displacement - s.motion.displacement(0.0);
    s.restart_ledger();
    s.step = s.quiet_end = s.skipped = s.rebuilds = 0;
    s.quiet_looks = 0;
    s.times = {};
    std::fill(s.overlap.begin(), s.overlap.end(), 0.0);
}

void Simulation::begin_motion(const std::array<BaseComponent, 3>& motion) {
    BaseMotion next(motion);
    implementation_->motion = std::move(next);
    implementation_->model.ground.motion = motion;
    end_preparation();
}

double Simulation::time() const { return static_cast<double>(implementation_->step) * implementation_->dt; }
double Simulation::time_step() const { return implementation_->dt; }
const Model& Simulation::model() const { return implementation_->model; }
int Simulation::threads() const { return implementation_->team.size(); }
Vector3 Simulation::position(std::size_t block) const { return implementation_->bodies.position.at(block); }
Quaternion Simulation::orientation(std::size_t block) const { return implementation_->bodies.orientation.at(block); }

Vector3 Simulation::contact_force(std::size_t block) const {
    const Implementation& s = *implementation_;
    if (block >= s.bodies.size()) throw std::out_of_range("Simulation: there is no such block");
    return s.touches.sum(block, s.list.forces).force;
}

Vector3 Simulation::velocity(std::size_t block) const {
    const Implementation& s = *implementation_;
    if (s.bodies.fixed.at(block) != 0) return Vector3::Zero();
    return s.velocity_after(s.decay_over(0.5 * s.dt), block, contact_force(block));
}

Vector3 Simulation::angular_velocity(std::size_t block) const {
    const Implementation& s = *implementation_;
    const Vector3& momentum = s.bodies.momentum.at(block);
    const detail::VelocityDecay half = s.decay_over(0.5 * s.dt);
    return s.bodies.spin(block, half.keep * momentum + half.push * s.touches.sum(block, s.list.forces).torque);
}

std::vector<ContactForce> Simulation::contact_forces() const {
    const ContactList& list = implementation_->list;
    std::vector<ContactForce> forces;
    for (std::size_t p = 0; p < list.pairs.size(); ++p) {
        if (list.forces[p].force.isZero(0.0)) continue;
        const ContactPair& pair = list.pairs[p];
        const auto follower = pair.follower == kGround ? std::nullopt : std::optional<std::size_t>(pair.follower);
        forces.push_back({pair.leader, follower, list.forces[p].force, find_elastic(list, p).normal});
    }
    return forces;
}

std::vector<Preload> Simulation::preloads() const { return find_preloads(implementation_->bodies, implementation_->list); }

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
    const Vector3 displacement = implementation_->base.displacement - implementation_->base_origin;
    if (implementation_->preparing) return {displacement};
    return {displacement, motion.velocity(time()), motion.acceleration(time())};
}

Vector3 Simulation::base_reaction() const { return implementation_->base_force; }

Energy Simulation::energy() const { return implementation_->find_energy(); }

Losses Simulation::losses() const {
    Losses losses = implementation_->finished;
    add_losses(implementation_->list, losses);
    return losses;
}

void Simulation::set_velocity_damping(double rate) {
    check_velocity_damping(rate, implementation_->dt);
    implementation_->velocity_damping = rate;
    implementation_->quiet_looks = 0;
}

double Simulation::velocity_damping() const { return implementation_->velocity_damping; }

void Simulation::save(std::ostream& out) const {
    Implementation& s = *implementation_;
    std::uint64_t model = hash_model(s.model, s.dt);
    Archive archive;
    archive(model, s.dt);
    s.exchange(archive);
    write_sealed(out, kStateKind, archive.bytes());
}

Simulation Simulation::restore(Model model, std::istream& in, int threads) {
    const std::string bytes = read_sealed(in, kStateKind);
    Archive archive{std::string_view(bytes)};
    std::uint64_t wanted = 0;
    double dt = 0.0;
    archive(wanted, dt);
    if (!(dt > 0.0 && std::isfinite(dt)) || hash_model(model, dt) != wanted)
        throw std::runtime_error("saved state: it belongs to another model or time step");
    auto restored = std::make_unique<Implementation>(std::move(model), dt, threads);
    restored->exchange(archive);
    archive.finish();
    return Simulation(std::move(restored));
}

Statistics Simulation::statistics() const {
    const Implementation& s = *implementation_;
    Statistics statistics;
    statistics.steps = s.step;
    statistics.skipped = s.skipped;
    statistics.pairs = s.list.pairs.size();
    statistics.apart = count_apart(s.bodies, s.list);
    statistics.contact_nodes = sum_contacts(s.list).touching;
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

bool Simulation::has_fallen(std::size_t block) const {
    const Implementation& s = *implementation_;
    const double sunk =
        (s.bodies.start_position.at(block).z() - s.bodies.position[block].z()) + (s.base.displacement.z() - s.base_origin.z());
    return lsdem::has_fallen(s.bodies.half[block], s.bodies.start_orientation[block].toRotationMatrix(), s.bodies.rotation[block], sunk);
}

double Simulation::fallen_fraction() const {
    const std::size_t blocks = implementation_->bodies.size();
    if (blocks == 0) return 0.0;
    std::size_t fallen = 0;
    for (std::size_t i = 0; i < blocks; ++i) fallen += has_fallen(i) ? 1 : 0;
    return static_cast<double>(fallen) / static_cast<double>(blocks);
}

}  // namespace musim::lsdem
