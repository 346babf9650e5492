#include "lsdem/motion/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "lsdem/contact/overlap_pairs.hpp"
#include "lsdem/fallen.hpp"
#include "lsdem/motion/preloads.hpp"
#include "lsdem/motion/simulation_core.hpp"

namespace musim::lsdem {

Simulation::Simulation(Model model, double time_step, int threads)
    : implementation_(std::make_unique<Implementation>(std::move(model), time_step, threads)) {
    implementation_->start();
}
Simulation::Simulation(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::renew_neighbors() { implementation_->rebuild(); }

/// The state becomes the start of a run.
void Simulation::Implementation::restart() {
    preparation.active = false;
    preparation.damping_rate = 0.0;
    preparation.mass_scaling.end(bodies, list);
    base.restart(bodies);
    loads.restart(bodies);
    update_loads(0.0);
    restart_balance();
    steps = {};
    note_leaving();
    work.times = {};
    std::fill(work.overlap.begin(), work.overlap.end(), 0.0);
    health.overstiff.reset();
}

void Simulation::begin_motion(const BaseComponents& motion) {
    implementation_->base.begin(motion);
    implementation_->model.ground.motion = motion;
    implementation_->restart();
}

double Simulation::time() const { return static_cast<double>(implementation_->steps.done) * implementation_->dt; }
double Simulation::time_step() const { return implementation_->dt; }
const Model& Simulation::model() const { return implementation_->model; }
int Simulation::threads() const { return implementation_->work.team.size(); }
Vector3 Simulation::position(std::size_t block) const { return implementation_->bodies.pose.at(block).position; }
Quaternion Simulation::orientation(std::size_t block) const { return implementation_->bodies.orientation.at(block); }

detail::TouchList::Load Simulation::Implementation::load_on(std::size_t block) const {
    if (block >= bodies.size()) throw std::out_of_range("Simulation: there is no such block");
    return work.touches.sum(block, list.forces);
}
Vector3 Simulation::contact_force(std::size_t block) const { return implementation_->load_on(block).force; }
Vector3 Simulation::contact_torque(std::size_t block) const { return implementation_->load_on(block).torque; }

Vector3 Simulation::velocity(std::size_t block) const {
    const Implementation& s = *implementation_;
    if (s.bodies.fixed.at(block) != 0) return s.bodies.velocity[block];
    return s.velocity_after(s.decay_over(0.5 * s.bodies.elapsed), block, contact_force(block));
}

Vector3 Simulation::angular_velocity(std::size_t block) const {
    const Implementation& s = *implementation_;
    if (s.bodies.fixed.at(block) != 0 && s.base.carries(block)) return base().turn_rates.velocity;
    return s.bodies.spin(block, s.momentum_after(s.decay_over(0.5 * s.bodies.elapsed), block, contact_torque(block)));
}

std::vector<ContactForce> Simulation::contact_forces() const {
    const Implementation& s = *implementation_;
    const ContactList& list = s.list;
    std::vector<ContactForce> forces;
    for (std::size_t p = 0; p < list.pairs.size(); ++p) {
        if (list.forces[p].force.isZero(0.0)) continue;
        const ContactPair& pair = list.pairs[p];
        forces.push_back({pair.leader, s.bodies.as_block(pair.follower), list.forces[p].force, find_overlap_energy(s.bodies, list, p)});
    }
    return forces;
}

std::vector<JointStiffness> Simulation::joint_stiffness() const {
    const Implementation& s = *implementation_;
    std::vector<JointStiffness> joints;
    visit_meeting_areas(s.bodies, s.list, [&](std::size_t index, const MeetingArea& at) {
        const ContactPair& pair = s.list.pairs[index];
        joints.push_back({pair.leader, s.bodies.as_block(pair.follower), pair.law.normal_stiffness, pair.law.shear_stiffness, at.area,
                          at.normal, at.middle, at.second});
    });
    return joints;
}

std::vector<Preload> Simulation::preloads() const { return find_preloads(implementation_->bodies, implementation_->list); }

Kinematics Simulation::kinematics() const {
    Kinematics all;
    all.time = time();
    all.position = implementation_->bodies.positions();
    all.orientation = implementation_->bodies.orientation;
    all.orientation.pop_back();  // that of the ground
    for (std::size_t i = 0; i < implementation_->bodies.size(); ++i) {
        all.velocity.push_back(velocity(i));
        all.angular_velocity.push_back(angular_velocity(i));
    }
    return all;
}

Vector3 Simulation::peak_base_acceleration() const { return implementation_->base.motion().peak_acceleration(time()); }

BaseState Simulation::base() const {
    const Implementation& s = *implementation_;
    BaseState state;
    state.displacement = s.base.displacement(s.bodies);
    if (s.base.is_turned()) state.turn = s.base.turn(s.bodies), state.pivot = s.base.pivot_place();
    if (s.preparation.active) return state;
    const BaseMotion& motion = s.base.motion();
    state.velocity = motion.velocity(time());
    state.acceleration = motion.acceleration(time());
    if (motion.turns()) state.turn_rates = motion.turn_rates(time());
    return state;
}

Vector3 Simulation::base_reaction() const { return implementation_->base.force(); }
Vector3 Simulation::base_couple() const {
    const Implementation& s = *implementation_;
    const Vector3 arm = s.bodies.pose.back().rotation * s.base.motion().pivot();
    return s.base.couple() - arm.cross(s.base.force());
}

Energy Simulation::energy() const { return implementation_->find_exact_energy(); }

Losses Simulation::losses() const {
    Losses losses = implementation_->balance.finished;
    add_losses(implementation_->bodies, implementation_->list, losses);
    return losses;
}

void Simulation::set_velocity_damping(double rate) {
    check_velocity_damping(rate, implementation_->dt);
    implementation_->preparation.damping_rate = rate;
    implementation_->steps.checks_at_rest = 0;
}

double Simulation::velocity_damping() const { return implementation_->preparation.damping_rate; }

Statistics Simulation::statistics() const {
    const Implementation& s = *implementation_;
    Statistics statistics;
    statistics.steps = s.steps.done;
    statistics.skipped = s.steps.skipped;
    statistics.substeps = s.steps.substeps;
    statistics.leaving = s.steps.leaving;
    statistics.pairs = s.list.pairs.size();
    statistics.apart = count_apart(s.bodies, s.list);
    const ContactTotals contacts = sum_contacts(s.list);
    statistics.contacts = contacts.contacts;
    statistics.contact_nodes = contacts.nodes;
    statistics.rebuilds = s.steps.rebuilds;
    statistics.overstiff = s.health.overstiff;
    statistics.max_overlap_over_height = *std::max_element(s.work.overlap.begin(), s.work.overlap.end());
    return statistics;
}

std::vector<LoadState> Simulation::loads() const { return implementation_->loads.states(); }

PhaseTimes Simulation::phase_times() const { return implementation_->work.times; }
std::optional<Divergence> Simulation::divergence() const { return implementation_->health.divergence; }

bool Simulation::has_fallen(std::size_t block) const {
    const Implementation& s = *implementation_;
    // seen from the ground
    const auto from = [](const Matrix3& ground, const Vector3& of_ground, const Vector3& x) {
        return Vector3(ground.transpose() * (x - of_ground));
    };
    const BodyPose &ground = s.bodies.pose.back(), &now = s.bodies.pose.at(block);
    const Matrix3 first_ground = s.bodies.start_orientation.back().toRotationMatrix();
    const double sunk = from(first_ground, s.bodies.start_position.back(), s.bodies.start_position.at(block)).z() -
                        from(ground.rotation, ground.position, now.position).z();
    const Matrix3 start = first_ground.transpose() * s.bodies.start_orientation[block].toRotationMatrix();
    return lsdem::has_fallen(s.bodies.find_extent(block, start.row(2)), start, ground.rotation.transpose() * now.rotation, sunk);
}

}  // namespace musim::lsdem
