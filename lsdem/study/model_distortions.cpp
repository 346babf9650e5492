#include "lsdem/study/model_distortions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "lsdem/block_height.hpp"
#include "lsdem/scene/block_heights.hpp"
#include "lsdem/scene/reference_block.hpp"
#include "scaling/factor_rounding.hpp"
#include "scaling/laws/group_meaning.hpp"

namespace musim::lsdem {
namespace {

using scaling::Distortion;
using scaling::ModelScales;

/// The key of a block's material; empty: the scene's.
std::string name_material(const Scene& scene, std::size_t block) {
    const auto* list = std::get_if<BlockList>(&scene.structure);
    return list == nullptr ? std::string() : list->blocks[block].material;
}

/// Blocks that are of one material in the prototype, and of one in the model.
struct BlockKind {
    std::string in_prototype, in_model;  ///< names
    std::vector<std::size_t> blocks;     ///< by number

    std::string describe() const {
        const auto name = [](const std::string& key) { return key.empty() ? std::string("the scene's material") : '"' + key + '"'; };
        const std::string text = "blocks of " + name(in_prototype);
        return in_prototype == in_model ? text : text + fmt::format(" (in the model of {})", name(in_model));
    }
};

std::vector<BlockKind> find_kinds(const BuiltScene& prototype, const BuiltScene& model) {
    std::vector<BlockKind> kinds;
    for (std::size_t b = 0; b < prototype.model.blocks.size(); ++b) {
        const std::string from = name_material(prototype.scene, b), to = name_material(model.scene, b);
        auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [&](const BlockKind& known) { return known.in_prototype == from && known.in_model == to; });
        if (kind == kinds.end()) kind = kinds.insert(kinds.end(), BlockKind{from, to, {}});
        kind->blocks.push_back(b);
    }
    return kinds;
}

/// tan α of the two directions in which blocks rock: of the structure's block, of listed blocks each once as they stand.
std::vector<double> find_slenderness(const BuiltScene& built, const std::vector<std::size_t>& blocks) {
    std::vector<double> all;
    const auto add = [&](double slenderness) {
        const auto is_it = [=](double known) { return std::abs(known / slenderness - 1.0) <= scaling::kFactorRounding; };
        if (std::none_of(all.begin(), all.end(), is_it)) all.push_back(slenderness);
    };
    if (!std::holds_alternative<BlockList>(built.scene.structure)) {
        const auto block = reference_block(built.scene);
        return {block[0] / block[2], block[1] / block[2]};
    }
    for (const std::size_t b : blocks) {
        const Block& block = built.model.blocks[b];
        const Vector3 half = half_extents(built.model, block);
        int upright = 0;
        block.orientation.toRotationMatrix().row(2).cwiseAbs().maxCoeff(&upright);
        add(half[(upright + 1) % 3] / half[upright]);
        add(half[(upright + 2) % 3] / half[upright]);
    }
    return all;
}

std::vector<Distortion> find_of_kind(const BuiltScene& prototype, const BuiltScene& model, const BlockKind& kind, ModelScales scales) {
    const std::size_t b = kind.blocks.front();
    const BlockMaterial &from = material_of_block(prototype.scene, b), &to = material_of_block(model.scene, b);
    const Material &contact_from = prototype.model.materials[prototype.model.blocks[b].material],
                   &contact_to = model.model.materials[model.model.blocks[b].material];
    const BlockMaterial &first_from = material_of_block(prototype.scene, 0), &first_to = material_of_block(model.scene, 0);
    const double heavier = (to.density / from.density) / (first_to.density / first_from.density);
    scales.friction = contact_to.friction / contact_from.friction;
    for (double* mass : {&scales.mass, &scales.weight, &scales.static_stiffness}) *mass *= heavier;
    const double face = scales.width * scales.width;
    const auto heights = find_height_variation(prototype.scene), of_model = find_height_variation(model.scene);
    scaling::ModelProperties properties{.friction_prototype = contact_from.friction,
                                        .slenderness = find_slenderness(prototype, kind.blocks),
                                        .normal_stiffness = contact_to.normal_stiffness / contact_from.normal_stiffness * face,
                                        .shear_stiffness = contact_to.shear_stiffness / contact_from.shear_stiffness * face,
                                        .restitution = contact_to.restitution / contact_from.restitution,
                                        .height_deviation = {}};
    if (heights && of_model) properties.height_deviation = of_model->deviation / heights->deviation;
    return scaling::find_distortions(scales, properties);
}

const Distortion* find_group(const std::vector<Distortion>& all, const std::string& group) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Distortion& each) { return each.group == group; });
    return found == all.end() ? nullptr : &*found;
}

/// What all kinds of blocks have alike once, the rest with their names.
std::vector<Distortion> join(const std::vector<BlockKind>& kinds, const std::vector<std::vector<Distortion>>& of_kinds) {
    std::vector<Distortion> joined;
    for (const std::vector<Distortion>& all : of_kinds) {
        for (const Distortion& first : all) {
            if (find_group(joined, first.group) != nullptr) continue;
            const auto is_like = [&](const std::vector<Distortion>& others) {
                const Distortion* const other = find_group(others, first.group);
                return other != nullptr && std::abs(other->factor / first.factor - 1.0) <= scaling::kFactorRounding &&
                       other->effect == first.effect;
            };
            if (std::all_of(of_kinds.begin(), of_kinds.end(), is_like)) {
                joined.push_back(first);
                continue;
            }
            for (std::size_t k = 0; k < kinds.size(); ++k) {
                const Distortion* const own = find_group(of_kinds[k], first.group);
                if (own == nullptr) continue;
                joined.push_back(*own);
                joined.back().effect = kinds[k].describe() + ": " + own->effect;
            }
        }
    }
    return joined;
}

/// The ground against the blocks on it, where it has a friction of its own.
void add_ground(const BuiltScene& prototype, const BuiltScene& model, std::vector<Distortion>& distortions) {
    const Ground &from = prototype.model.ground, &to = model.model.ground;
    if (!from.present || !to.present) return;
    const double ground = to.material.friction / from.material.friction;
    const double blocks = model.model.materials[model.model.blocks.front().material].friction /
                          prototype.model.materials[prototype.model.blocks.front().material].friction;
    constexpr std::string_view kGroup = "mu_ground/mu";
    const auto severity = scaling::find_severity(ground / blocks);
    if (!severity) return;
    distortions.push_back(
        {std::string(kGroup), ground / blocks, *severity, std::string(scaling::find_group_meaning(kGroup).effect(ground / blocks))});
}

}  // namespace

const BlockMaterial& material_of_block(const Scene& scene, std::size_t block) {
    const std::string name = name_material(scene, block);
    return name.empty() ? scene.material : scene.materials.at(name);
}

std::vector<Distortion> find_model_distortions(const BuiltScene& prototype, const BuiltScene& model, const ModelScales& scales) {
    const std::vector<BlockKind> kinds = find_kinds(prototype, model);
    std::vector<std::vector<Distortion>> of_kinds;
    for (const BlockKind& kind : kinds) of_kinds.push_back(find_of_kind(prototype, model, kind, scales));
    std::vector<Distortion> distortions = join(kinds, of_kinds);
    add_ground(prototype, model, distortions);
    return distortions;
}

}  // namespace musim::lsdem
