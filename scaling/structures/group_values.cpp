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

void add_geometry(Values& values, const StructureProperties& properties, Length wanted_block_height) {
    const auto& [thin, wide, height] = properties.block;
    add(values, {{"H/(lambda_l*H_prototype)", {}, height.value() / wanted_block_height.value()},
                 {"b/H", {}, thin.value() / height.value()},
                 {"w/H", {}, wide.value() / height.value()},
                 {"N", {}, static_cast<double>(properties.layers)},
                 {"blocks/layer", {}, map_value(properties.blocks_per_layer, [](int count) { return static_cast<double>(count); })},
                 {"gap/H", {}, over(properties.gap, height)},
                 {"edge_radius/H", {}, over(properties.edge_radius, height)},
                 {"sigma_H/H", {}, over(properties.height_deviation, height)}});
}

void add_friction(Values& values, const StructureProperties& properties) {
    add(values, {{"mu", {}, properties.friction},
                 {"mu_ground/mu", {}, over(properties.ground_friction, properties.friction)},
                 {"mu_kinetic/mu", {}, over(properties.kinetic_friction, properties.friction)}});
}

void add_contact(Values& values, const StructureProperties& properties, const MotionProperties* motion) {
    const Length height = properties.block[2];
    const Mass mass = properties.block_mass();
    const auto kappa = [&](Stiffness normal) { return groups::contact_rigidity(normal, properties.density, properties.gravity, height); };
    const auto speed = [&](Stiffness shear) {
        return groups::structural_speed_number(shear, height, properties.layers, properties.friction, mass, properties.gravity);
    };
    std::optional<double> stiffness_ratio, overlap, cauchy;
    if (properties.normal_stiffness) {
        stiffness_ratio = over(properties.shear_stiffness, *properties.normal_stiffness);
        overlap = map_value(properties.height_deviation, [&](Length deviation) {
            return groups::overlap_over_height_deviation(properties.layers, mass, properties.gravity, *properties.normal_stiffness,
                                                         deviation);
        });
        if (motion != nullptr) {
            cauchy = map_value(motion->velocity,
                               [&](Velocity v) { return groups::cauchy_number(v, height, *properties.normal_stiffness, mass); });
        }
    }
    add(values, {{"kappa_n", {}, map_value(properties.normal_stiffness, kappa)},
                 {"k_s/k_n", {}, stiffness_ratio},
                 {"c_res", {}, properties.restitution},
                 {"delta_w/sigma_H", {}, overlap},
                 {"S_e^N", {}, map_value(properties.shear_stiffness, speed)},
                 {"C^N", {}, cauchy}});
}

void add_rocking(Values& values, const StructureProperties& properties, const MotionProperties* motion) {
    for (const Direction direction : {Direction::thin, Direction::wide}) {
        const RockingBlock block = properties.rocking_block(direction);
        std::optional<double> demand, frequency;
        if (motion != nullptr) {
            demand = groups::rocking_demand(motion->acceleration, properties.gravity, block.slenderness());
            frequency = map_value(motion->pulse_period ? motion->pulse_period : motion->predominant_period, [&](Time period) {
                return groups::rocking_frequency(2.0 * std::numbers::pi / period, properties.gravity, block.half_diagonal());
            });
        }
        add(values, {{"mu/tan(alpha)", direction, groups::regime(properties.friction, block.slenderness())},
                     {"a/(g*tan(alpha))", direction, demand},
                     {"omega/p", direction, frequency},
                     {"e_r", direction, block.angular_restitution()}});
    }
}

void add_loading(Values& values, const StructureProperties& properties, const MotionProperties& motion) {
    const Length l = properties.height();
    const auto time = [&](Time t) { return groups::sliding_time(t, properties.friction, properties.gravity, l); };
    add(values, {{"a/(mu*g)", {}, groups::sliding_demand(motion.acceleration, properties.friction, properties.gravity)},
                 {"mu^N",
                  {},
                  map_value(motion.velocity, [&](Velocity v) { return groups::mu_number(v, properties.friction, properties.gravity, l); })},
                 {"a/g", {}, motion.acceleration.value() / properties.gravity.value()},
                 {"Fr^N", {}, map_value(motion.velocity, [&](Velocity v) { return groups::froude_number(v, properties.gravity, l); })},
                 {"PGD/l", {}, over(motion.displacement, l)},
                 {"T_D*sqrt(mu*g/l)", {}, map_value(motion.duration, time)},
                 {"T_p*sqrt(mu*g/l)", {}, map_value(motion.predominant_period, time)},
                 {"T_pulse*sqrt(mu*g/l)", {}, map_value(motion.pulse_period, time)},
                 {"dt*sqrt(mu*g/l)", {}, map_value(motion.step, time)},
                 {"a_vertical/g", {}, over(motion.vertical_acceleration, properties.gravity)},
                 {"direction", {}, motion.direction}});
}

}  // namespace

std::vector<GroupValue> find_group_values(const StructureProperties& properties, const MotionProperties* motion,
                                          Length wanted_block_height) {
    Values values;
    add_geometry(values, properties, wanted_block_height);
    add_friction(values, properties);
    add_contact(values, properties, motion);
    add_rocking(values, properties, motion);
    if (motion != nullptr) add_loading(values, properties, *motion);
    return values;
}

}  // namespace musim::scaling
