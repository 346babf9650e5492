#include <algorithm>
#include <cmath>
#include <cstring>
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "lsdem/model_hash.hpp"
#include "lsdem/motion/simulation_core.hpp"
#include "lsdem/motion/state_fields.hpp"

/// Saved states, and the number that says whether two states are the same.
namespace musim::lsdem {
namespace {

/// FNV-1a over the bytes of a vector.
void hash_bytes(const Vector3& v, std::uint64_t& hash) {
    unsigned char bytes[sizeof(double) * 3];
    std::memcpy(bytes, v.data(), sizeof bytes);
    for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211ULL;
}

}  // namespace

void Simulation::Implementation::exchange(Archive& archive) {
    double deepest = *std::max_element(work.overlap.begin(), work.overlap.end());
    archive(bodies, search.reference(), list, balance.finished, preparation.damping_rate);
    base.exchange(archive);
    archive(preparation.active, steps.done, steps.rebuilds, steps.skipped, steps.substeps, steps.leaving, balance.start_energy,
            balance.start, steps.checks_at_rest, steps.rest_end, health.divergence, health.overstiff, deepest);
    if (!loads.empty()) archive(loads);
    if (!archive.loads()) return;
    work.overlap.front() = deepest;
    check_restored(model, bodies, search.reference(), list, balance.finished);
    if (list.demand.wanted) preparation.mass_scaling.begin(model, dt, list);
    share_work();
}

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
    if (!(dt > 0.0 && std::isfinite(dt)) || hash_model(model, dt) != wanted) {
        throw std::runtime_error("saved state: it belongs to another model or time step");
    }
    auto restored = std::make_unique<Implementation>(std::move(model), dt, threads);
    restored->exchange(archive);
    archive.finish();
    return Simulation(std::move(restored));
}

std::string Simulation::state_hash() const {
    const Bodies& bodies = implementation_->bodies;
    std::uint64_t hash = 14695981039346656037ULL;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        hash_bytes(bodies.pose[i].position, hash);
        hash_bytes(bodies.velocity[i], hash);
        hash_bytes(bodies.momentum[i], hash);
        hash_bytes(bodies.orientation[i].vec(), hash);
        hash_bytes({bodies.orientation[i].w(), 0.0, 0.0}, hash);
    }
    std::string text(16, '0');
    for (std::size_t digit = 16; digit-- > 0; hash >>= 4U) text[digit] = "0123456789abcdef"[hash & 15U];
    return text;
}

}  // namespace musim::lsdem
