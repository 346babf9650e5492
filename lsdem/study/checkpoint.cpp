#include "lsdem/study/checkpoint.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "lsdem/archive.hpp"
#include "records/atomic_file.hpp"

// The fields that a checkpoint consists of, type by type. With a new one, the version in kKind is raised.
namespace musim::lsdem {

static void exchange(Archive& archive, Energy& e) {
    archive(e.kinetic, e.gravitational, e.elastic_normal, e.elastic_shear, e.friction_loss, e.damping_loss, e.base_work,
            e.preparation_loss);
}

static void exchange(Archive& archive, Kinematics& k) { archive(k.time, k.position, k.orientation, k.velocity, k.angular_velocity); }

static void exchange(Archive& archive, BaseState& b) { archive(b.displacement, b.velocity, b.acceleration); }

}  // namespace musim::lsdem

namespace musim::lsdem::study {

static void exchange(Archive& archive, TimePlan& p) { archive(p.time_step, p.steps_per_sample, p.samples, p.samples_per_frame); }

static void exchange(Archive& archive, History& h) {
    archive(h.time, h.base, h.spine_position, h.spine_velocity, h.spine_rotation, h.energy);
}

static void exchange(Archive& archive, Frames& f) { archive(f.time, f.position, f.quaternion, f.velocity); }

static void exchange(Archive& archive, Rest& r) { archive(r.at_rest, r.steps, r.kinetic, r.reaction_over_weight); }

static void exchange(Archive& archive, Falls& f) { archive(f.time, f.displacement, f.at_collapse); }

static void exchange(Archive& archive, StageOrigin& o) { archive(o.stage, o.time, o.base, o.position, o.orientation); }

static void exchange(Archive& archive, RunResult& r) {
    archive(r.collapse_time, r.origin, r.rest, r.initial, r.history, r.frames, r.falls, r.wall_time);
}

namespace {

namespace fs = std::filesystem;

constexpr ArchiveKind kKind{{'m', 'u', 's', 'i', 'm', 'R', 'U', 'N'}, 3, "checkpoint"};

/// One list of what a checkpoint holds, for writing from where things are and for reading.
void exchange_all(Archive& archive, std::string& program_version, std::string& scene, TimePlan& plan, std::uint64_t& done, RunResult& run,
                  std::string& state) {
    archive(program_version, scene, plan, done, run, state);
}

}  // namespace

Checkpoint read_checkpoint(const fs::path& file, const std::string& program_version) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error(fmt::format("{}: there is no checkpoint to continue from; start the run anew", file.string()));
    Checkpoint c;
    try {
        const std::string bytes = read_sealed(in, kKind);
        Archive archive{std::string_view(bytes)};
        // the version comes first: of another one the rest may mean something else
        archive(c.program_version);
        if (c.program_version == program_version) {
            archive = Archive{std::string_view(bytes)};
            exchange_all(archive, c.program_version, c.scene, c.plan, c.samples_done, c.run, c.state);
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
    return c;
}

void remove_checkpoint(const fs::path& file) noexcept {
    std::error_code ignored;
    fs::remove(file, ignored);
    const std::string begin = fmt::format(".{}.", file.filename().string());
    std::vector<fs::path> leftovers;
    for (fs::directory_iterator entry(file.parent_path(), ignored), last; !ignored && entry != last; entry.increment(ignored)) {
        const std::string name = entry->path().filename().string();
        if (name.starts_with(begin) && name.ends_with(".tmp")) leftovers.push_back(entry->path());
    }
    for (const fs::path& leftover : leftovers) fs::remove(leftover, ignored);
}

void write_checkpoint(const CheckpointSettings& settings, std::uint64_t done, const TimePlan& plan, RunResult& run,
                      const Simulation& simulation) {
    std::ostringstream state_stream, out;
    try {
        simulation.save(state_stream);
        std::string version = settings.program_version, scene = settings.scene, state = std::move(state_stream).str();
        TimePlan same_plan = plan;
        Archive archive;
        exchange_all(archive, version, scene, same_plan, done, run, state);
        write_sealed(out, kKind, archive.bytes());
        records::write_file_atomically(settings.file, out.view());
    } catch (const std::runtime_error& error) {
        if (settings.on_failure) settings.on_failure(error.what());
    }
}

void CheckpointWriter::after_sample(std::uint64_t done, const TimePlan& plan, RunResult& run, const Simulation& simulation) {
    // after the last sample come the results
    if (done == plan.samples || !is_due(done)) return;
    write_checkpoint(settings_, done, plan, run, simulation);
    last_ = Clock::now();
}

bool CheckpointWriter::is_due(std::uint64_t done) const {
    if (settings_.samples > 0) return done % settings_.samples == 0;
    return std::chrono::duration<double>(Clock::now() - last_).count() >= settings_.interval;
}

}  // namespace musim::lsdem::study
