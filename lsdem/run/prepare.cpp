#include "lsdem/run/prepare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "lsdem/block_height.hpp"
#include "lsdem/run/drawn_places.hpp"
#include "lsdem/run/equilibrium.hpp"
#include "lsdem/run/work_done.hpp"
#include "lsdem/scene/resting_pose.hpp"

namespace musim::lsdem {
namespace {

using detail::WorkDone;

/// A round before the last ends when the base bears what is there to this part of it: looser than at the end, since a block that still tips
/// is not borne in full.
constexpr double kEarlyReaction = 1e-3;

/// Time that both rounds of the whole take together after the layers, over 1/α: uneven walls of 3 and 6 layers 3.8 to 11, rings of 3 to 10
/// layers 6 to 12, in all ways of placing. For the progress alone [-].
constexpr double kLeastWhole = 4.0, kMostWhole = 12.0;

BoxPose box_of(const Model& model, const Block& block) { return {2.0 * half_extents(model, block), block.position, block.orientation}; }

/// Blocks [first, last) of each layer, from 1.
std::vector<std::pair<std::size_t, std::size_t>> find_layers(const Specimen& specimen) {
    std::vector<std::pair<std::size_t, std::size_t>> layers;
    for (std::size_t i = 0; i < specimen.layer.size(); ++i) {
        const int layer = specimen.layer[i];
        const int last = static_cast<int>(layers.size());
        if (layer < std::max(last, 1) || layer > last + 1) {
            throw std::invalid_argument("prepare: the blocks must be in layers, numbered from 1 upwards, in ascending order");
        }
        if (layer > last) layers.emplace_back(i, i);
        layers.back().second = i + 1;
    }
    if (layers.empty()) throw std::invalid_argument("prepare: there are no blocks");
    return layers;
}

/// Room that a block is given where it is put, as a part of half its diagonal [-]: an overlap that is there when it is let go would push at
/// once; heights that differ by a tenth of a percent leave as much.
constexpr double kClearance = 1e-3;

double find_clearance(const Vector3& size) { return 0.5 * std::hypot(size.x(), size.y()) * kClearance; }

/// One preparation on its way: layer after layer comes to rest, each put onto those that have, upright and let down, or as it will rest;
/// then the whole.
class PreparationRun {
  public:
    PreparationRun(const Specimen& upright, double time_step, const PreparationSettings& settings, int threads,
                   const std::optional<PreparationState>& from)
        : placing_(settings.placing),
          layers_(by_layers() ? find_layers(upright) : Layers{}),
          settings_(settings),
          state_(from.value_or(PreparationState{})),
          resumes_(from && !from->simulation.empty()),
          settling_(begin(upright, (scales_mass() ? settings.stride : 1.0) * time_step, threads)) {}

    void run(const RunSettings& settings, PreparedSpecimen& prepared, WorkDone& work) {
        CheckpointWriter checkpoints(settings.checkpoint.value_or(CheckpointSettings{}));
        for (; state_.round < layer_rounds() + settings_.whole_rounds; ++state_.round, state_.settling = {}) {
            if (!resumes_) begin_round();
            resumes_ = false;
            SettlingWatch watch;
            watch.on_progress = [&](double part, std::uint64_t steps) {
                work.report(static_cast<double>(state_.block_steps + steps * blocks_in_round()), find_left(part, steps));
            };
            if (settings.checkpoint) {
                watch.on_state = [&](const SettlingState& now) {
                    state_.settling = now;
                    checkpoints.after_look([&](const CheckpointSettings& to) { write_checkpoint(to, save()); });
                };
            }
            prepared.rest = settle(settling_, rule(), watch, state_.settling);
            state_.steps += prepared.rest.steps;
            state_.block_steps += prepared.rest.steps * blocks_in_round();
            if (!in_layers()) whole_steps_ += static_cast<double>(prepared.rest.steps);
            // the first, on the base, is at rest at once
            if (in_layers() && state_.round > 0) layer_steps_ = static_cast<double>(prepared.rest.steps);
            const bool hopeless = state_.round >= layer_rounds() && !prepared.rest.at_rest;
            if (simulation().divergence() || hopeless) break;
        }
        prepared.steps = state_.steps;
        prepared.block_steps = state_.block_steps;
    }

    const Simulation& simulation() const { return settling_.state(); }

    /// Did the whole fail to come to rest with inertia added?
    bool wants_own_inertia(const Rest& rest) const { return scales_mass() && !rest.at_rest && !in_layers() && !simulation().divergence(); }

    /// From where it goes on with its own.
    PreparationState begin_again() const {
        PreparationState state;
        state.steps = state_.steps;
        state.block_steps = state_.block_steps;
        state.max_overlap = simulation().statistics().max_overlap_over_height;
        state.start = find_places(simulation());
        return state;
    }

  private:
    using Layers = std::vector<std::pair<std::size_t, std::size_t>>;

    bool by_layers() const { return placing_ != BlockPlacing::as_drawn; }
    bool resting() const { return placing_ == BlockPlacing::resting; }
    bool scales_mass() const { return resting() || placing_ == BlockPlacing::layers_mass_scaled; }
    std::size_t layer_rounds() const { return layers_.size(); }
    bool in_layers() const { return state_.round < layer_rounds(); }
    bool is_last() const { return state_.round + 1 == layer_rounds() + settings_.whole_rounds; }
    std::size_t blocks_in_round() const { return in_layers() ? layers_[state_.round].second : simulation().model().blocks.size(); }

    SettlingSimulation begin(const Specimen& upright, double time_step, int threads) const {
        Model model = by_layers() ? hold_upper_layers(upright, layers_) : upright.model;
        if (resumes_) {
            for (const Release& release : state_.releases) release_block(release, model);
            std::istringstream saved(state_.simulation);
            return SettlingSimulation(Simulation::restore(std::move(model), saved, threads));
        }
        return {Simulation(std::move(model), time_step, threads), settings_.settling.damping_rate,
                scales_mass() ? Inertia::as_stable : Inertia::own};
    }

    PreparationState save() const {
        PreparationState state = state_;
        std::ostringstream out;
        simulation().save(out);
        state.simulation = std::move(out).str();
        return state;
    }

    /// Layers above the first are held where they meet nothing: as high above the structure as it is high.
    static Model hold_upper_layers(const Specimen& upright, const Layers& layers) {
        Model model = upright.model;
        const Block& last = model.blocks.back();
        const double top = last.position.z() + half_extents(model, last).z();
        for (std::size_t i = layers.front().second; i < model.blocks.size(); ++i) {
            model.blocks[i].fixed = true;
            model.blocks[i].position.z() += 2.0 * top;
        }
        return model;
    }

    void begin_round() {
        if (in_layers() && state_.round > 0) add_layer(state_.round);
        const double last_damping = scales_mass() ? settings_.last_damping_with_mass_scaling : settings_.last_damping;
        if (is_last()) settling_.set_damping_rate(last_damping * settings_.settling.damping_rate);
    }

    Settling rule() const {
        Settling rule = settings_.settling;
        if (scales_mass()) rule.patience = std::min(rule.patience, settings_.added_patience);
        if (is_last()) return rule;
        rule.reaction = kEarlyReaction;
        if (!in_layers()) {
            rule.rest = std::max(rule.rest, settings_.early_rest);
            return rule;
        }
        rule.rest = std::max(rule.rest, settings_.layer_rest);
        rule.patience = std::min(rule.patience, resting() ? settings_.resting_patience : settings_.layer_patience);
        return rule;
    }

    /// Work that is left, from the steps that the present round has taken and the part of it that the decay of its energy suggests: layers
    /// to come take as long as the last one, at first their patience; the whole takes as long as others did, or longer.
    PreparationWork find_left(double part, std::uint64_t steps) const {
        const auto taken = static_cast<double>(steps), blocks = static_cast<double>(simulation().model().blocks.size());
        const double by_decay = part > 0.0 ? taken * (1.0 - part) / part : std::numeric_limits<double>::infinity();
        if (!by_layers()) return {blocks * by_decay, blocks * by_decay};
        const double decay_time = 1.0 / (settings_.settling.damping_rate * simulation().time_step());
        if (!in_layers()) {
            const double whole = whole_steps_ + taken, least = kLeastWhole * decay_time - whole, most = kMostWhole * decay_time - whole;
            // what takes longer than others goes by its decay
            if (most <= 0.0) return {blocks * by_decay, blocks * by_decay};
            return {blocks * std::clamp(least > 0.0 || !is_last() ? least : by_decay, 0.0, most), blocks * most};
        }
        const double patience = rule().patience * decay_time, as_before = layer_steps_.value_or(patience);
        double layers = static_cast<double>(blocks_in_round()) * std::max(0.0, (taken < as_before ? as_before : patience) - taken);
        for (std::size_t k = state_.round + 1; k < layer_rounds(); ++k) layers += static_cast<double>(layers_[k].second) * as_before;
        return {layers + blocks * kLeastWhole * decay_time, layers + blocks * kMostWhole * decay_time};
    }

    void add_layer(std::size_t k) {
        const Model& model = simulation().model();
        const auto [first_below, first] = layers_[k - 1];
        const std::size_t last = layers_[k].second;
        std::vector<BoxPose> below, boxes;
        for (std::size_t i = first_below; i < first; ++i) {
            below.push_back({2.0 * half_extents(model, model.blocks[i]), simulation().position(i), simulation().orientation(i)});
        }
        for (std::size_t i = first; i < last; ++i) boxes.push_back(box_of(model, model.blocks[i]));
        const double clearance = find_clearance(boxes.front().size);
        if (resting()) put_to_rest(below, boxes, clearance);
        std::vector<Release> releases;
        for (std::size_t i = first; i < last; ++i) {
            BoxPose& box = boxes[i - first];
            if (!resting()) box = tilt_onto(box, {}, find_support_points(box, below), 0.0);
            const double speed = resting() ? 0.0 : settings_.lowering * std::sqrt(model.gravity.norm() * box.size.z());
            releases.push_back({i, box.position + clearance * Vector3::UnitZ(), box.orientation, {0.0, 0.0, -speed}});
        }
        settling_.release(releases);
        state_.releases.insert(state_.releases.end(), releases.begin(), releases.end());
    }

    BlockPlacing placing_;
    Layers layers_;
    const PreparationSettings& settings_;
    PreparationState state_;
    bool resumes_;                       ///< in the middle of the present round
    std::optional<double> layer_steps_;  ///< of the last layer's round
    double whole_steps_ = 0.0;           ///< of the rounds of the whole that have ended
    SettlingSimulation settling_;
};

void describe(const Simulation& simulation, PreparedSpecimen& prepared) {
    const Model& model = prepared.specimen.model;
    const Vector3 up = -model.gravity.normalized();
    for (std::size_t i = 0; i < model.blocks.size(); ++i) {
        const double cosine = std::clamp((simulation.orientation(i) * Vector3::UnitZ()).dot(up), -1.0, 1.0);
        prepared.tilt.push_back(std::acos(cosine));
    }
    const std::vector<int>& layer = prepared.specimen.layer;
    if (std::find(layer.begin(), layer.end(), 0) != layer.end()) return;
    const auto layers = find_layers(prepared.specimen);
    std::vector<std::vector<double>> forces(layers.size());
    for (const ContactForce& contact : simulation.contact_forces()) {
        // the leader is the lower block, or the one on the ground
        const auto leader_layer = static_cast<std::size_t>(layer[contact.leader]);
        const std::size_t upper = contact.follower ? static_cast<std::size_t>(layer[*contact.follower]) : leader_layer;
        if (contact.follower && upper != leader_layer + 1) continue;
        const double force = std::abs(contact.force.dot(up));
        forces[upper - 1].push_back(force);
        prepared.force.push_back(force / (model.blocks[contact.leader].mass * model.gravity.norm()));
    }
    for (std::size_t k = 0; k < layers.size(); ++k) {
        LayerState state;
        const auto [first, last] = layers[k];
        for (std::size_t i = first; i < last; ++i) {
            state.mean_tilt += prepared.tilt[i] / static_cast<double>(last - first);
            state.max_tilt = std::max(state.max_tilt, prepared.tilt[i]);
        }
        const auto count = static_cast<double>(std::max<std::size_t>(forces[k].size(), 1));
        for (const double force : forces[k]) state.mean_force += force / count;
        for (const double force : forces[k]) state.sd_force += (force - state.mean_force) * (force - state.mean_force) / count;
        state.sd_force = std::sqrt(state.sd_force);
        prepared.layers.push_back(state);
    }
}

}  // namespace

PreparedSpecimen prepare(const Specimen& upright, double time_step, const PreparationSettings& preparation, const RunSettings& settings,
                         const std::optional<PreparationState>& from, const WorkToFollow& to_follow) {
    WorkDone progress(settings.observer, to_follow);
    PreparedSpecimen prepared;
    prepared.specimen = upright;
    const auto finish = [&](const Simulation& simulation, double overlap_before) {
        progress.report(static_cast<double>(prepared.block_steps), {});
        put_in_place(find_places(simulation), prepared.specimen);
        note_fallen(upright, simulation.kinematics(), prepared.rest);
        prepared.max_overlap = std::max(overlap_before, simulation.statistics().max_overlap_over_height);
        describe(simulation, prepared);
        return prepared;
    };
    std::optional<PreparationState> own = from && from->start ? from : std::nullopt;
    if (!own) {
        Specimen placed = upright;
        if (preparation.from_equilibrium) put_in_equilibrium(placed, time_step, settings.threads);
        PreparationRun work(placed, time_step, preparation, settings.threads, from);
        work.run(settings, prepared, progress);
        if (!work.wants_own_inertia(prepared.rest)) return finish(work.simulation(), 0.0);
        own = work.begin_again();
    }
    put_in_place(*own->start, prepared.specimen);
    PreparationSettings standing = preparation;
    standing.placing = BlockPlacing::as_drawn;
    standing.whole_rounds = 1;
    PreparationRun work(prepared.specimen, time_step, standing, settings.threads, own);
    work.run(settings, prepared, progress);
    return finish(work.simulation(), own->max_overlap);
}

PreparationWork estimate_preparation(const Specimen& upright, double time_step, const PreparationSettings& preparation) {
    if (preparation.placing == BlockPlacing::as_drawn) return {};
    const bool resting = preparation.placing == BlockPlacing::resting;
    const double stride = resting || preparation.placing == BlockPlacing::layers_mass_scaled ? preparation.stride : 1.0;
    const double decay_time = 1.0 / (preparation.settling.damping_rate * stride * time_step);
    double in_layers = 0.0;
    for (const auto& [first, last] : find_layers(upright)) in_layers += static_cast<double>(last);
    const double layers = in_layers * decay_time * (resting ? preparation.resting_patience : preparation.layer_patience);
    const double whole = static_cast<double>(upright.model.blocks.size()) * decay_time;
    return {layers + kLeastWhole * whole, layers + kMostWhole * whole};
}

PreparedPlaces find_places(const Simulation& simulation) {
    PreparedPlaces places;
    for (std::size_t i = 0; i < simulation.model().blocks.size(); ++i) {
        places.position.push_back(simulation.position(i));
        places.orientation.push_back(simulation.orientation(i));
    }
    places.preload = simulation.preloads();
    return places;
}

PreparedPlaces places_of(const Specimen& specimen) {
    PreparedPlaces places;
    for (const Block& block : specimen.model.blocks) {
        places.position.push_back(block.position);
        places.orientation.push_back(block.orientation);
    }
    places.preload = specimen.model.preload;
    return places;
}

void put_in_place(const PreparedPlaces& places, Specimen& specimen) {
    std::vector<Block>& blocks = specimen.model.blocks;
    if (places.position.size() != blocks.size() || places.orientation.size() != blocks.size()) {
        throw std::runtime_error("checkpoint: it is of other blocks");
    }
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        blocks[i].position = places.position[i];
        blocks[i].orientation = places.orientation[i];
    }
    specimen.model.preload = places.preload;
}

}  // namespace musim::lsdem
