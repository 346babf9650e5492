#include "lsdem/study/prepare.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "lsdem/block_height.hpp"
#include "lsdem/patches.hpp"
#include "lsdem/scene/resting_pose.hpp"

namespace musim::lsdem::study {
namespace {

/// The next layer comes when the base bears what is there to this part of it: looser than at the end, since a block that still tips is not
/// borne in full.
constexpr double kLayerReaction = 1e-3;

/// Where a preparation stands, for progress: the layers are worth this much of it, the last settling the rest.
constexpr double kLayersWorth = 0.9;

scene::BoxPose box_of(const Model& model, const Block& block) {
    return {2.0 * half_extents(model, block), block.position, block.orientation};
}

/// Blocks [first, last) of each layer, from 1.
std::vector<std::pair<std::size_t, std::size_t>> find_layers(const Specimen& specimen) {
    std::vector<std::pair<std::size_t, std::size_t>> layers;
    for (std::size_t i = 0; i < specimen.layer.size(); ++i) {
        const int layer = specimen.layer[i];
        const int last = static_cast<int>(layers.size());
        if (layer < std::max(last, 1) || layer > last + 1)
            throw std::invalid_argument("prepare: the blocks must be in layers, numbered from 1 upwards, in ascending order");
        if (layer > last) layers.emplace_back(i, i);
        layers.back().second = i + 1;
    }
    if (layers.empty()) throw std::invalid_argument("prepare: there are no blocks");
    return layers;
}

/// Room that a block is given where it is put, so that no contact begins before it is met: the faces of boxes meet in a rectangle whose
/// corners may lie deeper than those of the true overlap by half a diagonal times kMaxPatchTwist.
double find_clearance(const Vector3& size) { return 0.5 * std::hypot(size.x(), size.y()) * kMaxPatchTwist; }

/// Puts one layer after the other onto those that have settled: upright and let down, or as it will rest.
class LayerByLayer {
  public:
    LayerByLayer(const Specimen& upright, double time_step, const PreparationSettings& settings, int threads)
        : layers_(find_layers(upright)), settings_(settings), simulation_(hold_upper_layers(upright, layers_), time_step, threads) {
        simulation_.begin_preparation(settings.settling.damping_rate);
    }

    void run(const std::function<void(double)>& on_progress, PreparedSpecimen& prepared) {
        Settling rule = settings_.settling;
        rule.rest = std::max(rule.rest, settings_.layer_rest);
        rule.patience = std::min(rule.patience, resting() ? settings_.resting_patience : settings_.layer_patience);
        rule.reaction = kLayerReaction;
        for (std::size_t k = 0; k < layers_.size(); ++k) {
            if (k > 0) add(k);
            const Rest rest = settle(simulation_, rule);
            prepared.steps += rest.steps;
            prepared.block_steps += rest.steps * layers_[k].second;
            if (simulation_.divergence()) return;
            const double done = static_cast<double>(layers_[k].second) / static_cast<double>(layers_.back().second);
            if (on_progress) on_progress(kLayersWorth * done * done);
        }
    }

    Simulation& simulation() { return simulation_; }

  private:
    using Layers = std::vector<std::pair<std::size_t, std::size_t>>;

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

    bool resting() const { return settings_.placing == scene::Placing::resting; }

    void add(std::size_t k) {
        const Model& model = simulation_.model();
        const auto [first_below, first] = layers_[k - 1];
        const std::size_t last = layers_[k].second;
        std::vector<scene::BoxPose> below, boxes;
        for (std::size_t i = first_below; i < first; ++i)
            below.push_back({2.0 * half_extents(model, model.blocks[i]), simulation_.position(i), simulation_.orientation(i)});
        for (std::size_t i = first; i < last; ++i) boxes.push_back(box_of(model, model.blocks[i]));
        const double clearance = find_clearance(boxes.front().size);
        if (resting()) scene::put_to_rest(below, boxes, clearance);
        std::vector<Release> releases;
        for (std::size_t i = first; i < last; ++i) {
            scene::BoxPose& box = boxes[i - first];
            if (!resting()) box = scene::tilt_onto(box, {}, scene::find_support_points(box, below), 0.0);
            const double speed = resting() ? 0.0 : settings_.lowering * std::sqrt(model.gravity.norm() * box.size.z());
            releases.push_back({i, box.position + clearance * Vector3::UnitZ(), box.orientation, {0.0, 0.0, -speed}});
        }
        simulation_.release(releases);
    }

    Layers layers_;
    PreparationSettings settings_;
    Simulation simulation_;
};

void describe(const Simulation& simulation, PreparedSpecimen& prepared) {
    const Model& model = prepared.specimen.model;
    const auto layers = find_layers(prepared.specimen);
    const Vector3 up = -model.gravity.normalized();
    std::vector<std::vector<double>> forces(layers.size());
    for (std::size_t i = 0; i < model.blocks.size(); ++i) {
        const double cosine = std::clamp((simulation.orientation(i) * Vector3::UnitZ()).dot(up), -1.0, 1.0);
        prepared.tilt.push_back(std::acos(cosine));
    }
    for (const ContactForce& contact : simulation.contact_forces()) {
        // the leader is the lower block, or the one on the ground
        const auto leader_layer = static_cast<std::size_t>(prepared.specimen.layer[contact.leader]);
        const std::size_t upper = contact.follower ? static_cast<std::size_t>(prepared.specimen.layer[*contact.follower]) : leader_layer;
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

PreparedSpecimen prepare(const Specimen& upright, double time_step, const PreparationSettings& preparation, const RunSettings& settings) {
    PreparedSpecimen prepared;
    prepared.specimen = upright;
    const auto relax = [&](Simulation& simulation, double begun) {
        const auto come_to_rest = [&] {
            prepared.rest = settle(simulation, preparation.settling, [&](double part) {
                if (settings.on_progress) settings.on_progress(begun + (1.0 - begun) * part);
            });
            prepared.steps += prepared.rest.steps;
            prepared.block_steps += prepared.rest.steps * simulation.model().blocks.size();
        };
        come_to_rest();
        // whoever uses the specimen begins with a new list: where a contact then meets in another way, it does so here
        simulation.renew_neighbors();
        if (prepared.rest.at_rest) come_to_rest();
        Model& model = prepared.specimen.model;
        for (std::size_t i = 0; i < model.blocks.size(); ++i) {
            model.blocks[i].position = simulation.position(i);
            model.blocks[i].orientation = simulation.orientation(i);
        }
        model.preload = simulation.preloads();
        prepared.max_overlap = simulation.statistics().max_overlap_over_height;
        describe(simulation, prepared);
    };
    if (preparation.placing == scene::Placing::as_drawn) {
        Simulation simulation(upright.model, time_step, settings.threads);
        simulation.begin_preparation(preparation.settling.damping_rate);
        relax(simulation, 0.0);
    } else {
        LayerByLayer layers(upright, time_step, preparation, settings.threads);
        layers.run(settings.on_progress, prepared);
        relax(layers.simulation(), kLayersWorth);
    }
    return prepared;
}

}  // namespace musim::lsdem::study
