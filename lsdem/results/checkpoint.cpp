#include "lsdem/results/checkpoint.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "lsdem/archive.hpp"
#include "lsdem/motion/state_fields.hpp"
#include "lsdem/results/staged_files.hpp"
#include "records/atomic_file.hpp"
#include "scaling/interruption.hpp"
#include "scaling/regular_file.hpp"

// The fields that a checkpoint consists of, type by type. With a new one, the version in kKind is raised.
namespace musim::lsdem {

static void exchange(Archive& archive, Energy& e) {
    archive(e.kinetic, e.gravitational, e.elastic_normal, e.elastic_shear, e.friction_loss, e.damping_loss, e.base_work, e.preparation_loss,
            e.load_work);
}

static void exchange(Archive& archive, LoadState& l) { archive(l.force, l.displacement); }

static void exchange(Archive& archive, Kinematics& k) { archive(k.time, k.position, k.orientation, k.velocity, k.angular_velocity); }

static void exchange(Archive& archive, Statistics& s) {
    archive(s.steps, s.skipped, s.substeps, s.leaving, s.pairs, s.apart, s.contacts, s.contact_nodes, s.rebuilds, s.overstiff,
            s.max_overlap_over_height);
}

static void exchange(Archive& archive, Release& r) { archive(r.block, r.position, r.orientation, r.velocity); }

static void exchange(Archive& archive, Preload& p) { archive(p.leader, p.follower, p.friction, p.couple); }

static void exchange(Archive& archive, BaseState& b) {
    archive(b.displacement, b.velocity, b.acceleration, b.turn, b.turn_rates.velocity, b.turn_rates.acceleration, b.pivot);
}

}  // namespace musim::lsdem

namespace musim::lsdem {

static void exchange(Archive& archive, ReadingPlan& r) { archive(r.steps, r.count, r.corner_steps, r.order); }

static void exchange(Archive& archive, TimePlan& p) {
    archive(p.time_step, p.steps_per_sample, p.samples, p.samples_per_frame, p.readings);
}

static void exchange(Archive& archive, SensorHistory& s) {
    archive(s.name, s.kind, s.axes, s.bodies, s.relative, s.gravity, s.interval, s.corner, s.order, s.delay, s.values);
}

static void exchange(Archive& archive, SensorMemory& m) { archive(m.filter, m.last, m.place, m.normal, m.across); }

static void exchange(Archive& archive, History& h) {
    archive(h.time, h.base, h.spine_position, h.spine_velocity, h.spine_rotation, h.energy, h.load);
}

static void exchange(Archive& archive, Frames& f) { archive(f.time, f.position, f.quaternion, f.velocity, f.contact_force); }

static void exchange(Archive& archive, MovedBlock& m) { archive(m.block, m.drawn, m.now, m.turned); }

static void exchange(Archive& archive, Rest& r) { archive(r.at_rest, r.steps, r.kinetic, r.reaction_over_weight, r.fallen, r.collapsed); }

static void exchange(Archive& archive, Falls& f) { archive(f.time, f.displacement, f.at_collapse, f.airborne); }

static void exchange(Archive& archive, StageOrigin& o) { archive(o.stage, o.time, o.base, o.position, o.orientation); }

template <class Quantity>
requires scaling::QuantityWithUnit<Quantity>
static void exchange(Archive& archive, Quantity& q) {
    double value = q.value();
    archive(value);
    q = Quantity::from_value(value);
}

static void exchange(Archive& archive, BaseChange& c) {
    for (records::MotionPeaks* p : {&c.peaks.record, &c.peaks.base, &c.peaks.difference}) archive(p->pga, p->pgv, p->pgd);
    archive(c.of_record);
}

static void exchange(Archive& archive, RunResult& r) {
    archive(r.status, r.collapse_time, r.origin, r.rest, r.steps, r.initial, r.history, r.frames, r.falls, r.final, r.statistics, r.losses);
    archive(r.state_hash, r.energy_closure, r.start_reaction_over_weight, r.base_reaction_over_weight, r.peak_base_acceleration,
            r.base_changes, r.wall_time, r.sensors, r.sensor_memory);
}

static void exchange(Archive& archive, SettlingState& s) { archive(s.steps, s.checks_at_rest, s.liveliest); }

static void exchange(Archive& archive, PreparedPlaces& p) { archive(p.position, p.orientation, p.preload); }

static void exchange(Archive& archive, PreparationState& p) {
    archive(p.round, p.steps, p.block_steps, p.settling, p.releases, p.simulation, p.max_overlap, p.start);
}

static void exchange(Archive& archive, RestPhaseState& q) { archive(q.clock, q.moved, q.stop, q.wall_time, q.settling); }

namespace {

namespace fs = std::filesystem;

constexpr ArchiveKind kKind{{'m', 'u', 's', 'i', 'm', 'R', 'U', 'N'}, 17, "checkpoint"};

/// The fields of a checkpoint beside its run, which need not be copied to be written.
struct Beside {
    std::string program_version, build, scene;
    std::optional<PreparedPlaces> places;
    std::optional<PreparationState> preparation;
    std::optional<SettlingState> settling;
    TimePlan plan;
    std::uint64_t samples_done = 0;
    std::optional<RestPhaseState> rest_phase;
    std::string state;
};

/// One list of what a checkpoint holds, for writing from where things are and for reading.
template <class Fields>
void exchange_all(Archive& archive, Fields& c, RunResult& run) {
    archive(c.program_version, c.build, c.scene, c.places, c.preparation, c.settling, c.plan, c.samples_done, run, c.rest_phase, c.state);
}

/// Writes a checkpoint with the state of a simulation, if there is one. A failure is reported to the settings, and the run goes on.
void write_file(const CheckpointSettings& settings, Beside beside, RunResult& run, const Simulation* simulation) {
    try {
        if (simulation != nullptr) {
            std::ostringstream state;
            simulation->save(state);
            beside.state = std::move(state).str();
        }
        beside.program_version = settings.program_version;
        beside.build = settings.build;
        beside.scene = settings.scene;
        std::ostringstream out;
        Archive archive;
        exchange_all(archive, beside, run);
        write_sealed(out, kKind, archive.bytes());
        records::write_file_atomically(settings.file, out.view());
    } catch (const std::runtime_error& error) {
        if (settings.on_failure) settings.on_failure(error.what());
    }
}

}  // namespace

Checkpoint read_checkpoint(const fs::path& file, const std::string& program_version) {
    std::ifstream in = scaling::open_regular_file(file);
    if (!in) throw std::runtime_error(fmt::format("{}: there is no checkpoint to continue from; start the run anew", file.string()));
    Checkpoint c;
    try {
        const std::string bytes = read_sealed(in, kKind);
        Archive archive{std::string_view(bytes)};
        // version and build come first: of another one the rest may mean something else
        archive(c.program_version, c.build);
        if (c.program_version == program_version && c.build == describe_build()) {
            archive = Archive{std::string_view(bytes)};
            exchange_all(archive, c, c.run);
            archive.finish();
        }
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: the run cannot be continued ({}); start it anew", file.string(), error.what()));
    }
    if (c.program_version != program_version) {
        throw std::runtime_error(
            fmt::format("{}: the run was begun by musim {}, this is {}; continue it with that version or start it anew", file.string(),
                        c.program_version, program_version));
    }
    if (c.build != describe_build()) {
        throw std::runtime_error(fmt::format(
            "{}: the run was begun by another build ({}; this is {}), whose bits may differ; continue it with that one or start "
            "it anew",
            file.string(), c.build, describe_build()));
    }
    return c;
}

void remove_checkpoint(const fs::path& file) noexcept { detail::remove_with_leftovers(file); }

void write_checkpoint(const CheckpointSettings& settings, std::uint64_t done, const TimePlan& plan, RunResult& run,
                      const Simulation& simulation, const std::optional<RestPhaseState>& rest_phase) {
    Beside beside;
    beside.places = settings.places;
    beside.plan = plan;
    beside.samples_done = done;
    beside.rest_phase = rest_phase;
    write_file(settings, std::move(beside), run, &simulation);
}

void write_checkpoint(const CheckpointSettings& settings, PreparationState preparation) {
    Beside beside;
    beside.preparation = std::move(preparation);
    RunResult none;
    write_file(settings, std::move(beside), none, nullptr);
}

void write_checkpoint(const CheckpointSettings& settings, const SettlingState& settling, const Simulation& simulation) {
    Beside beside;
    beside.places = settings.places;
    beside.settling = settling;
    RunResult none;
    write_file(settings, std::move(beside), none, &simulation);
}

void CheckpointWriter::after_sample(std::uint64_t done, const TimePlan& plan, RunResult& run, const Simulation& simulation) {
    // after the last sample come the results
    if (done == plan.samples || !is_due(done)) return;
    write_checkpoint(settings_, done, plan, run, simulation);
    note_written();
}

void CheckpointWriter::between_samples(std::uint64_t done, const TimePlan& plan, RunResult& run, const Simulation& simulation) {
    const bool by_time = settings_.samples == 0 && settings_.interval > 0.0 && is_time();
    if (!by_time && !scaling::is_interrupted()) return;
    write_checkpoint(settings_, done, plan, run, simulation);
    note_written();
}

void CheckpointWriter::after_look(const std::function<void(const CheckpointSettings&)>& write) {
    if (!is_due(++looks_)) return;
    write(settings_);
    note_written();
}

bool CheckpointWriter::is_due(std::uint64_t done) const {
    if (scaling::is_interrupted()) return true;
    return settings_.samples > 0 ? done % settings_.samples == 0 : is_time();
}

bool CheckpointWriter::is_time() const { return std::chrono::duration<double>(Clock::now() - last_).count() >= wait_; }

void CheckpointWriter::note_written() {
    last_ = Clock::now();
    wait_ = settings_.interval;
}

}  // namespace musim::lsdem
