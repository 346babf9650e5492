#include "lsdem/study/model_distortions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "lsdem/block_height.hpp"
#include "lsdem/contact_law.hpp"
#include "lsdem/scene/as_listed.hpp"
#include "lsdem/scene/block_heights.hpp"
#include "lsdem/scene/reference_block.hpp"
#include "scaling/factor_rounding.hpp"
#include "scaling/laws/group_meaning.hpp"

namespace musim::lsdem {
namespace {

using scaling::Distortion;
using scaling::ModelScales;

/// The key of a block's material in a scene as as_listed() gives it; empty: the scene's.
std::string name_material(const Scene& listed, std::size_t block) {
    const auto* list = std::get_if<BlockList>(&listed.structure);
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
    const Scene full = as_listed(prototype.scene), small = as_listed(model.scene);
    for (std::size_t b = 0; b < prototype.model.blocks.size(); ++b) {
        const std::string from = name_material(full, b), to = name_material(small, b);
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
    if (!is_listed(built.scene)) {
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

/// Joint of two blocks where they meet (find_joint).
Material find_contact(const Model& model, std::size_t a, std::size_t b) {
    return find_joint(model, model.blocks[a].material, model.blocks[b].material);
}

/// Nothing where there is none: without friction, say.
std::optional<double> find_ratio(double model, double prototype) {
    return model > 0.0 && prototype > 0.0 ? std::optional(model / prototype) : std::nullopt;
}

std::vector<Distortion> find_of_kind(const BuiltScene& prototype, const BuiltScene& model, const BlockKind& kind, ModelScales scales) {
    const std::size_t b = kind.blocks.front();
    const BlockMaterial &from = material_of_block(prototype.scene, b), &to = material_of_block(model.scene, b);
    const Material contact_from = find_contact(prototype.model, b, b), contact_to = find_contact(model.model, b, b);
    const BlockMaterial &first_from = material_of_block(prototype.scene, 0), &first_to = material_of_block(model.scene, 0);
    const double heavier = (to.density / from.density) / (first_to.density / first_from.density);
    const std::optional<double> friction = find_ratio(contact_to.friction, contact_from.friction);
    if (friction) scales.friction = *friction;
    for (double* mass : {&scales.mass, &scales.weight, &scales.static_stiffness}) *mass *= heavier;
    const double face = scales.width * scales.width;
    const auto heights = find_height_variation(prototype.scene), of_model = find_height_variation(model.scene);
    scaling::ModelProperties properties{.friction_prototype = {},
                                        .slenderness = find_slenderness(prototype, kind.blocks),
                                        .normal_stiffness = find_ratio(contact_to.normal_stiffness * face, contact_from.normal_stiffness),
                                        .shear_stiffness = find_ratio(contact_to.shear_stiffness * face, contact_from.shear_stiffness),
                                        .restitution = find_ratio(contact_to.restitution, contact_from.restitution),
                                        .height_deviation = {}};
    if (friction) properties.friction_prototype = contact_from.friction;
    if (heights && of_model) properties.height_deviation = of_model->deviation / heights->deviation;
    return scaling::find_distortions(scales, properties);
}

const Distortion* find_group(const std::vector<Distortion>& all, const std::string& group) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Distortion& each) { return each.group == group; });
    return found == all.end() ? nullptr : &*found;
}

/// Distortions that all kinds of blocks have alike once, the rest with their names.
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

void add_friction(const char* group, double factor, const std::string& where, std::vector<Distortion>& distortions) {
    const auto severity = scaling::find_severity(factor);
    if (!severity) return;
    distortions.push_back({group, factor, *severity, where + std::string(scaling::find_group_meaning(group).effect(factor))});
}

/// Blocks of two materials that meet otherwise than either does with its like.
void add_pairs(const BuiltScene& prototype, const BuiltScene& model, const std::vector<BlockKind>& kinds,
               std::vector<Distortion>& distortions) {
    const auto friction_of = [&](std::size_t a, std::size_t b) {
        return find_ratio(find_contact(model.model, a, b).friction, find_contact(prototype.model, a, b).friction);
    };
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        for (std::size_t j = i + 1; j < kinds.size(); ++j) {
            const std::size_t a = kinds[i].blocks.front(), b = kinds[j].blocks.front();
            const auto together = friction_of(a, b), first = friction_of(a, a), second = friction_of(b, b);
            const auto is_like = [&](double alone) { return std::abs(*together / alone - 1.0) <= scaling::kFactorRounding; };
            if (!together || !first || !second || is_like(*first) || is_like(*second)) continue;
            add_friction("mu", *together, kinds[i].describe() + " on " + kinds[j].describe() + ": ", distortions);
        }
    }
}

/// The ground against the lowest block, where friction on it differs by another factor than that of the block with its like.
void add_ground(const BuiltScene& prototype, const BuiltScene& model, std::vector<Distortion>& distortions) {
    if (!prototype.model.ground.present || !model.model.ground.present) return;
    const std::vector<Block>& blocks = prototype.model.blocks;
    const auto is_lower = [](const Block& a, const Block& b) { return a.position.z() < b.position.z(); };
    const auto b = static_cast<std::size_t>(std::min_element(blocks.begin(), blocks.end(), is_lower) - blocks.begin());
    const auto on_ground = [&](const Model& each) { return find_joint(each, each.blocks[b].material, {}).friction; };
    const auto ground = find_ratio(on_ground(model.model), on_ground(prototype.model));
    const auto alike = find_ratio(find_contact(model.model, b, b).friction, find_contact(prototype.model, b, b).friction);
    if (ground && alike) add_friction("mu_ground/mu", *ground / *alike, "", distortions);
}

}  // namespace

const BlockMaterial& material_of_block(const Scene& scene, std::size_t block) {
    const std::string name = name_material(as_listed(scene), block);
    return name.empty() ? scene.material : scene.materials.at(name);
}

std::vector<Distortion> find_model_distortions(const BuiltScene& prototype, const BuiltScene& model, const ModelScales& scales) {
    const std::vector<BlockKind> kinds = find_kinds(prototype, model);
    std::vector<std::vector<Distortion>> of_kinds;
    for (const BlockKind& kind : kinds) of_kinds.push_back(find_of_kind(prototype, model, kind, scales));
    std::vector<Distortion> distortions = join(kinds, of_kinds);
    add_pairs(prototype, model, kinds, distortions);
    add_ground(prototype, model, distortions);
    return distortions;
}

}  // namespace musim::lsdem
