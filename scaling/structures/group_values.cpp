#include "scaling/structures/group_values.hpp"

#include <initializer_list>
#include <numbers>
#include <utility>

#include "scaling/laws/groups.hpp"

namespace musim::scaling {
namespace {

/// f(value), where there is a value.
template <class Value, class Function>
std::optional<double> map_value(const std::optional<Value>& value, const Function& f) {
    return value ? std::optional<double>(f(*value)) : std::nullopt;
}

template <class Quantity>
std::optional<double> over(const std::optional<Quantity>& value, Quantity unit) {
    return value ? std::optional<double>(value->value() / unit.value()) : std::nullopt;
}

std::optional<double> over(const std::optional<double>& value, double unit) {
    return map_value(value, [&](double number) { return number / unit; });
}

using Values = std::vector<GroupValue>;

void add(Values& values, std::initializer_list<GroupValue> more) { values.insert(values.end(), more); }

void add_geometry(Values& values, const StructureFacts& facts, Length wanted_block_height) {
    const auto& [thin, wide, height] = facts.block;
    add(values, {{"H/(lambda_l*H_prototype)", {}, height.value() / wanted_block_height.value()},
                 {"b/H", {}, thin.value() / height.value()},
                 {"w/H", {}, wide.value() / height.value()},
                 {"N", {}, static_cast<double>(facts.layers)},
                 {"blocks/layer", {}, map_value(facts.blocks_per_layer, [](int count) { return static_cast<double>(count); })},
                 {"gap/H", {}, over(facts.gap, height)},
                 {"edge_radius/H", {}, over(facts.edge_radius, height)},
                 {"sigma_H/H", {}, over(facts.height_deviation, height)}});
}

void add_friction(Values& values, const StructureFacts& facts) {
    add(values, {{"mu", {}, facts.friction},
                 {"mu_ground/mu", {}, over(facts.ground_friction, facts.friction)},
                 {"mu_kinetic/mu", {}, over(facts.kinetic_friction, facts.friction)}});
}

void add_contact(Values& values, const StructureFacts& facts, const MotionFacts* motion) {
    const Length height = facts.block[2];
    const Mass mass = facts.block_mass();
    const auto kappa = [&](Stiffness normal) { return groups::contact_rigidity(normal, facts.density, facts.gravity, height); };
    const auto speed = [&](Stiffness shear) {
        return groups::structural_speed_number(shear, height, facts.layers, facts.friction, mass, facts.gravity);
    };
    std::optional<double> stiffness_ratio, overlap, cauchy;
    if (facts.normal_stiffness) {
        stiffness_ratio = over(facts.shear_stiffness, *facts.normal_stiffness);
        overlap = map_value(facts.height_deviation, [&](Length deviation) {
            return groups::overlap_over_height_deviation(facts.layers, mass, facts.gravity, *facts.normal_stiffness, deviation);
        });
        if (motion != nullptr) {
            cauchy =
                map_value(motion->velocity, [&](Velocity v) { return groups::cauchy_number(v, height, *facts.normal_stiffness, mass); });
        }
    }
    add(values, {{"kappa_n", {}, map_value(facts.normal_stiffness, kappa)},
                 {"k_s/k_n", {}, stiffness_ratio},
                 {"c_res", {}, facts.restitution},
                 {"delta_w/sigma_H", {}, overlap},
                 {"S_e^N", {}, map_value(facts.shear_stiffness, speed)},
                 {"C^N", {}, cauchy}});
}

void add_rocking(Values& values, const StructureFacts& facts, const MotionFacts* motion) {
    for (const Direction direction : {Direction::thin, Direction::wide}) {
        const RockingBlock block = facts.rocking_block(direction);
        std::optional<double> demand, frequency;
        if (motion != nullptr) {
            demand = groups::rocking_demand(motion->acceleration, facts.gravity, block.slenderness());
            frequency = map_value(motion->pulse_period ? motion->pulse_period : motion->predominant_period, [&](Time period) {
                return groups::rocking_frequency(2.0 * std::numbers::pi / period, facts.gravity, block.half_diagonal());
            });
        }
        add(values, {{"mu/tan(alpha)", direction, groups::regime(facts.friction, block.slenderness())},
                     {"a/(g*tan(alpha))", direction, demand},
                     {"omega/p", direction, frequency},
                     {"e_r", direction, block.angular_restitution()}});
    }
}

void add_loading(Values& values, const StructureFacts& facts, const MotionFacts& motion) {
    const Length l = facts.height();
    const auto time = [&](Time t) { return groups::sliding_time(t, facts.friction, facts.gravity, l); };
    add(values,
        {{"a/(mu*g)", {}, groups::sliding_demand(motion.acceleration, facts.friction, facts.gravity)},
         {"mu^N", {}, map_value(motion.velocity, [&](Velocity v) { return groups::mu_number(v, facts.friction, facts.gravity, l); })},
         {"a/g", {}, motion.acceleration.value() / facts.gravity.value()},
         {"Fr^N", {}, map_value(motion.velocity, [&](Velocity v) { return groups::froude_number(v, facts.gravity, l); })},
         {"PGD/l", {}, over(motion.displacement, l)},
         {"T_D*sqrt(mu*g/l)", {}, map_value(motion.duration, time)},
         {"T_p*sqrt(mu*g/l)", {}, map_value(motion.predominant_period, time)},
         {"T_pulse*sqrt(mu*g/l)", {}, map_value(motion.pulse_period, time)},
         {"dt*sqrt(mu*g/l)", {}, map_value(motion.step, time)},
         {"a_vertical/g", {}, over(motion.vertical_acceleration, facts.gravity)},
         {"direction", {}, motion.direction}});
}

}  // namespace

std::vector<GroupValue> find_group_values(const StructureFacts& facts, const MotionFacts* motion, Length wanted_block_height) {
    Values values;
    add_geometry(values, facts, wanted_block_height);
    add_friction(values, facts);
    add_contact(values, facts, motion);
    add_rocking(values, facts, motion);
    if (motion != nullptr) add_loading(values, facts, *motion);
    return values;
}

}  // namespace musim::scaling
