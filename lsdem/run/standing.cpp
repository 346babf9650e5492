#include "lsdem/run/standing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "lsdem/run/run.hpp"
#include "lsdem/scene/build_model.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/units.hpp"

namespace musim::lsdem {
namespace {

using nlohmann::json;

std::string write_length(double length) { return scaling::format_quantity(scaling::Length::from_value(length), 3); }

/// Force and moment that a block lacks, in words.
std::string describe_need(const BlockHelp& help) {
    if (!help.touches) return "nothing touches it";
    if (!(help.force > kInEquilibrium)) return fmt::format("its weight acts {} beside what could bear it", write_length(help.arm));
    const bool is_central = !(help.arm > kInEquilibrium * help.force);
    return fmt::format("it would need a force of {:.3g} of its weight{}", help.force,
                       is_central ? "" : fmt::format(", {} beside its centre of mass", write_length(help.arm / help.force)));
}

std::string describe_needs(const RigidStatics& statics, const BlockTable& blocks) {
    const BlockHelp& most = statics.needs.front();
    const std::size_t others = statics.needs.size() - 1;
    const std::string more = others > 0 ? fmt::format("; nor can {} other{}", others, others == 1 ? "" : "s") : "";
    const std::string block = blocks.describe(most.block);
    if (statics.each_alone) return fmt::format("{} cannot stand where it is drawn: {}{}", block, describe_need(most), more);
    const bool turns = !(most.force > kInEquilibrium);
    const std::string least = turns ? fmt::format("a moment of its weight times {}", write_length(most.arm))
                                    : fmt::format("a force of {:.3g} of its weight", most.force);
    return fmt::format("blocks cannot stand together where they are drawn; the least help that would do is on {}: {}{}", block, least,
                       others > 0 ? fmt::format(", and more on {} other{}", others, others == 1 ? "" : "s") : "");
}

json to_json(const RigidStatics& statics, const BlockTable& blocks) {
    static constexpr std::array<const char*, 4> kAnswers{"not_asked", "can_stand", "undecided", "cannot_stand"};
    json needs = json::array();
    for (const BlockHelp& help : statics.needs) {
        needs.push_back({{"block", help.block},
                         {"label", blocks.label(help.block)},
                         {"force_over_weight", help.force},
                         {"arm_m", help.arm},
                         {"touches", help.touches}});
    }
    json object{{"answer", kAnswers.at(static_cast<std::size_t>(statics.answer))},
                {"joints", statics.joints},
                {"gap_over_height", kRigidGap},
                {"residual", statics.residual},
                {"each_alone", statics.each_alone},
                {"needs", needs}};
    if (!statics.why.empty()) object["why"] = statics.why;
    return object;
}

}  // namespace

SceneStanding find_standing(const Scene& scene, const Specimen& upright) {
    using Begins = SceneStanding::Begins;
    SceneStanding standing;
    standing.blocks.name = upright.name;
    if (scene.preparation && scene.preparation->specimen) {
        standing.begins = Begins::from_specimen;
        return standing;
    }
    if (wants_preparation(scene, upright) && find_preparation(scene, upright).placing != BlockPlacing::as_drawn) {
        standing.begins = Begins::when_laid;
        return standing;
    }
    if (seeks_equilibrium(scene, upright)) {
        Specimen drawn = upright;
        standing.equilibrium = put_in_equilibrium(drawn, compute_time_step(scene, upright.model).value());
        const bool found = standing.equilibrium->residual <= kInEquilibrium;
        standing.begins = found ? Begins::in_equilibrium : Begins::out_of_equilibrium;
        if (found) return standing;
    }
    if (starts_at_rest(upright)) standing.statics = ask_rigid_statics(upright.model);
    return standing;
}

std::string describe(const RigidStatics& statics, const BlockTable& blocks) {
    switch (statics.answer) {
        case RigidStatics::Answer::not_asked:
            return "rigid statics was not asked: " + statics.why;
        case RigidStatics::Answer::can_stand:
            return fmt::format(
                "rigid blocks can stand where they are drawn: forces in {} joint{} bear all (gaps up to {:.2g} H count as contact)",
                statics.joints, statics.joints == 1 ? "" : "s", kRigidGap);
        case RigidStatics::Answer::undecided:
            return "whether rigid blocks can stand where they are drawn is undecided: " +
                   (statics.why.empty() ? "it depends on the last 2 % of friction" : statics.why);
        case RigidStatics::Answer::cannot_stand:
            break;
    }
    return describe_needs(statics, blocks);
}

std::string to_string(SceneStanding::Begins begins) {
    static constexpr std::array<const char*, 5> kNames{"in_equilibrium", "out_of_equilibrium", "when_laid", "from_specimen", "as_listed"};
    return kNames.at(static_cast<std::size_t>(begins));
}

json to_json(const SceneStanding& standing) {
    json object{{"begins", to_string(standing.begins)}, {"equilibrium", nullptr}, {"statics", nullptr}};
    if (standing.equilibrium) {
        object["equilibrium"] = {
            {"residual", standing.equilibrium->residual}, {"solves", standing.equilibrium->solves}, {"gap_over_height", kEquilibriumGap}};
    }
    if (standing.statics) object["statics"] = to_json(*standing.statics, standing.blocks);
    return object;
}

}  // namespace musim::lsdem
