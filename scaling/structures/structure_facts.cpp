#include "scaling/structures/structure_facts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace musim::scaling {
namespace {

/// Checks values of one structure or motion, which `owner` names.
class Checker {
  public:
    explicit Checker(std::string_view owner) : owner_(owner) {}

    void require_positive(std::string_view what, double value) const {
        if (!(std::isfinite(value) && value > 0.0)) fail(what, value, "must be positive and finite");
    }
    void require_not_negative(std::string_view what, double value) const {
        if (!(std::isfinite(value) && value >= 0.0)) fail(what, value, "must be finite and not below 0");
    }
    template <class Quantity>
    void positive(std::string_view what, const std::optional<Quantity>& value) const {
        if (value) require_positive(what, value->value());
    }
    void positive(std::string_view what, const std::optional<double>& value) const {
        if (value) require_positive(what, *value);
    }
    template <class Quantity>
    void not_negative(std::string_view what, const std::optional<Quantity>& value) const {
        if (value) require_not_negative(what, value->value());
    }

  private:
    [[noreturn]] void fail(std::string_view what, double value, std::string_view why) const {
        throw SimilitudeError(fmt::format("facts: the {} of the {} is {:g} ({}); correct it", what, owner_, value, why));
    }

    std::string_view owner_;
};

void check(const StructureFacts& facts, std::string_view owner) {
    const Checker checker(owner);
    for (const Length& edge : facts.block) checker.require_positive("block edge", edge.value());
    checker.require_positive("number of layers", facts.layers);
    checker.require_positive("density", facts.density.value());
    checker.require_positive("friction", facts.friction);
    checker.require_positive("gravity", facts.gravity.value());
    checker.positive("ground friction", facts.ground_friction);
    checker.positive("kinetic friction", facts.kinetic_friction);
    checker.positive("restitution", facts.restitution);
    checker.positive("normal stiffness", facts.normal_stiffness);
    checker.positive("shear stiffness", facts.shear_stiffness);
    checker.positive("height deviation", facts.height_deviation);
    checker.not_negative("gap", facts.gap);
    checker.not_negative("edge radius", facts.edge_radius);
    if (facts.blocks_per_layer) checker.require_positive("number of blocks per layer", *facts.blocks_per_layer);
}

void check(const MotionFacts& facts, std::string_view owner) {
    const Checker checker(owner);
    checker.require_positive("acceleration", facts.acceleration.value());
    checker.positive("velocity", facts.velocity);
    checker.positive("displacement", facts.displacement);
    checker.not_negative("vertical acceleration", facts.vertical_acceleration);
    checker.positive("predominant period", facts.predominant_period);
    checker.positive("pulse period", facts.pulse_period);
    checker.positive("duration", facts.duration);
    checker.positive("step", facts.step);
    checker.positive("lowest frequency", facts.lowest_frequency);
    checker.positive("highest frequency", facts.highest_frequency);
    if (facts.direction) checker.require_not_negative("direction", *facts.direction);
}

template <class Value>
std::optional<double> find_factor(const std::optional<Value>& model, const std::optional<Value>& prototype) {
    if (!model || !prototype) return std::nullopt;
    return static_cast<double>(*model / *prototype);
}

template <class Quantity>
std::optional<Quantity> scale(const std::optional<Quantity>& prototype, const Similitude& similitude) {
    return prototype ? std::optional(similitude.to_model(*prototype)) : std::nullopt;
}

}  // namespace

std::string_view to_string(Direction direction) { return direction == Direction::thin ? "thin" : "wide"; }

Length StructureFacts::height() const { return static_cast<double>(layers) * block[2]; }

Mass StructureFacts::block_mass() const { return density * block[0] * block[1] * block[2]; }

Area StructureFacts::face() const { return block[0] * block[1]; }

RockingBlock StructureFacts::rocking_block(Direction direction) const {
    return {.width = block[direction == Direction::thin ? 0 : 1], .height = block[2]};
}

void check(const PairFacts& facts) {
    check(facts.prototype, "prototype");
    check(facts.model, "model");
    if (facts.motion) check(*facts.motion, "prototype's motion");
    if (facts.model_motion) check(*facts.model_motion, "model's motion");
    if (facts.table) {
        const Checker checker("table");
        checker.positive("lowest frequency", facts.table->lowest);
        checker.positive("highest frequency", facts.table->highest);
    }
}

ScaleFactors make_scale_factors(const PairFacts& facts, double length) {
    return {.length = length,
            .friction = facts.model.friction / facts.prototype.friction,
            .gravity = facts.model.gravity / facts.prototype.gravity,
            .density = facts.model.density / facts.prototype.density};
}

ModelFacts make_model_facts(const PairFacts& facts) {
    const StructureFacts &model = facts.model, &prototype = facts.prototype;
    return {.friction_prototype = prototype.friction,
            .slenderness = {prototype.rocking_block(Direction::thin).slenderness(), prototype.rocking_block(Direction::wide).slenderness()},
            .normal_stiffness = find_factor(model.normal_stiffness, prototype.normal_stiffness),
            .shear_stiffness = find_factor(model.shear_stiffness, prototype.shear_stiffness),
            .restitution = find_factor(model.restitution, prototype.restitution),
            .height_deviation = find_factor(model.height_deviation, prototype.height_deviation)};
}

MotionFacts to_model(const MotionFacts& prototype, const Similitude& similitude) {
    std::optional<Acceleration> vertical = prototype.vertical_acceleration;
    if (vertical) *vertical *= similitude.acceleration_vertical();
    return {.acceleration = similitude.to_model(prototype.acceleration),
            .velocity = scale(prototype.velocity, similitude),
            .displacement = scale(prototype.displacement, similitude),
            .vertical_acceleration = vertical,
            .predominant_period = scale(prototype.predominant_period, similitude),
            .pulse_period = scale(prototype.pulse_period, similitude),
            .duration = scale(prototype.duration, similitude),
            .step = scale(prototype.step, similitude),
            .lowest_frequency = scale(prototype.lowest_frequency, similitude),
            .highest_frequency = scale(prototype.highest_frequency, similitude),
            .direction = prototype.direction};
}

}  // namespace musim::scaling
