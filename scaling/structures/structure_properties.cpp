#include "scaling/structures/structure_properties.hpp"

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
        throw SimilitudeError(fmt::format("properties: the {} of the {} is {:g} ({}); correct it", what, owner_, value, why));
    }

    std::string_view owner_;
};

void check(const StructureProperties& properties, std::string_view owner) {
    const Checker checker(owner);
    for (const Length& edge : properties.block) checker.require_positive("block edge", edge.value());
    checker.require_positive("number of layers", properties.layers);
    checker.require_positive("density", properties.density.value());
    checker.require_positive("friction", properties.friction);
    checker.require_positive("gravity", properties.gravity.value());
    checker.positive("ground friction", properties.ground_friction);
    checker.positive("kinetic friction", properties.kinetic_friction);
    checker.positive("restitution", properties.restitution);
    checker.positive("normal stiffness", properties.normal_stiffness);
    checker.positive("shear stiffness", properties.shear_stiffness);
    checker.positive("height deviation", properties.height_deviation);
    checker.not_negative("gap", properties.gap);
    checker.not_negative("edge radius", properties.edge_radius);
    if (properties.blocks_per_layer) checker.require_positive("number of blocks per layer", *properties.blocks_per_layer);
}

void check(const MotionProperties& properties, std::string_view owner) {
    const Checker checker(owner);
    checker.require_positive("acceleration", properties.acceleration.value());
    checker.positive("velocity", properties.velocity);
    checker.positive("displacement", properties.displacement);
    checker.not_negative("vertical acceleration", properties.vertical_acceleration);
    checker.positive("predominant period", properties.predominant_period);
    checker.positive("pulse period", properties.pulse_period);
    checker.positive("duration", properties.duration);
    checker.positive("step", properties.step);
    checker.positive("lowest frequency", properties.lowest_frequency);
    checker.positive("highest frequency", properties.highest_frequency);
    if (properties.direction) checker.require_not_negative("direction", *properties.direction);
}

template <class Quantity>
std::optional<Quantity> scale(const std::optional<Quantity>& prototype, const Similitude& similitude) {
    return prototype ? std::optional(similitude.to_model(*prototype)) : std::nullopt;
}

}  // namespace

std::string_view to_string(Direction direction) { return direction == Direction::thin ? "thin" : "wide"; }

Length StructureProperties::height() const { return static_cast<double>(layers) * block[2]; }

Mass StructureProperties::block_mass() const { return density * block[0] * block[1] * block[2]; }

Area StructureProperties::face() const { return block[0] * block[1]; }

RockingBlock StructureProperties::rocking_block(Direction direction) const {
    return {.width = block[direction == Direction::thin ? 0 : 1], .height = block[2]};
}

void check(const PairProperties& properties) {
    check(properties.prototype, "prototype");
    check(properties.model, "model");
    if (properties.motion) check(*properties.motion, "prototype's motion");
    if (properties.model_motion) check(*properties.model_motion, "model's motion");
    if (properties.table) {
        const Checker checker("table");
        checker.positive("lowest frequency", properties.table->lowest);
        checker.positive("highest frequency", properties.table->highest);
    }
}

ScaleFactors make_scale_factors(const PairProperties& properties, double length) {
    return {.length = length,
            .friction = properties.model.friction / properties.prototype.friction,
            .gravity = properties.model.gravity / properties.prototype.gravity,
            .density = properties.model.density / properties.prototype.density};
}

ModelProperties make_model_properties(const PairProperties& properties) {
    const StructureProperties &model = properties.model, &prototype = properties.prototype;
    return {.friction_prototype = prototype.friction,
            .slenderness = {prototype.rocking_block(Direction::thin).slenderness(), prototype.rocking_block(Direction::wide).slenderness()},
            .normal_stiffness = find_ratio(model.normal_stiffness, prototype.normal_stiffness),
            .shear_stiffness = find_ratio(model.shear_stiffness, prototype.shear_stiffness),
            .restitution = find_ratio(model.restitution, prototype.restitution),
            .height_deviation = find_ratio(model.height_deviation, prototype.height_deviation)};
}

MotionProperties to_model(const MotionProperties& prototype, const Similitude& similitude) {
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
