#include "cli/pair_rows.hpp"

#include <fmt/format.h>

#include "scaling/angle.hpp"
#include "scaling/structures/structural_speed.hpp"

namespace musim::cli {
namespace {

using scaling::Direction;
using scaling::StructuralSpeeds;
using scaling::StructureProperties;

template <class Quantity>
PairRow make_row(const std::string& key, const std::string& title, const std::optional<Quantity>& prototype,
                 const std::optional<Quantity>& model, double required_factor) {
    PairRow row{.key = key, .title = title, .dimension = scaling::dimension_of<Quantity>(), .prototype = {}, .model = {}};
    if (prototype) row.prototype = prototype->value();
    if (model) row.model = model->value();
    row.required_factor = required_factor;
    return row;
}

std::optional<scaling::Ratio> to_ratio(const std::optional<double>& number) {
    return number ? std::optional(scaling::Ratio::from_value(*number)) : std::nullopt;
}

std::optional<scaling::Velocity> find_sway_speed(const StructureProperties& properties, const StructuralSpeeds& speeds,
                                                 Direction direction) {
    const auto chain = find_rotating_chain(properties, direction);
    if (!chain) return std::nullopt;
    return find_fastest_sway(*chain).speed * *speeds.shear;
}

}  // namespace

std::optional<double> PairRow::required() const { return prototype ? std::optional(*prototype * required_factor) : std::nullopt; }

std::optional<double> PairRow::factor() const { return prototype && model ? std::optional(*model / *prototype) : std::nullopt; }

std::vector<PairRow> make_speed_rows(const scaling::PairProperties& properties, const scaling::Similitude& similitude) {
    const StructureProperties &prototype = properties.prototype, &model = properties.model;
    const StructuralSpeeds of_prototype = find_structural_speeds(prototype), of_model = find_structural_speeds(model);
    const double velocity = similitude.velocity(), time = similitude.time();
    std::vector<PairRow> rows = {
        make_row("normal_stiffness_n_m", "k_n of a face", prototype.normal_stiffness, model.normal_stiffness,
                 similitude.stiffness_static()),
        make_row("shear_stiffness_n_m", "k_s of a face", prototype.shear_stiffness, model.shear_stiffness, similitude.stiffness()),
        make_row("modulus_pa", "E_eff = k_n H/A", of_prototype.modulus, of_model.modulus, similitude.stress_vertical()),
        make_row("shear_modulus_pa", "G_eff = k_s H/A", of_prototype.shear_modulus, of_model.shear_modulus, similitude.stress()),
        make_row("normal_wave_speed_m_s", "c_n, normal waves", of_prototype.normal, of_model.normal, velocity),
        make_row("shear_wave_speed_m_s", "c_e, interfaces stick", of_prototype.shear, of_model.shear, velocity),
        make_row("slip_front_speed_m_s", "c_e/2, interfaces slip", of_prototype.slip_front, of_model.slip_front, velocity),
    };
    for (const Direction direction : {Direction::thin, Direction::wide}) {
        rows.push_back(make_row(fmt::format("fastest_sway_{}_m_s", to_string(direction)),
                                fmt::format("fastest sway of a column, {} side", to_string(direction)),
                                find_sway_speed(prototype, of_prototype, direction), find_sway_speed(model, of_model, direction),
                                velocity));
    }
    rows.push_back(make_row("climb_stick_s", "base to top, interfaces stick", of_prototype.climb_stick, of_model.climb_stick, time));
    rows.push_back(make_row("climb_slip_s", "base to top, interfaces slip", of_prototype.climb_slip, of_model.climb_slip, time));
    rows.push_back(make_row("structural_speed_number", "S_e^N", to_ratio(of_prototype.number), to_ratio(of_model.number), 1.0));
    return rows;
}

std::vector<PairRow> make_rocking_rows(const scaling::PairProperties& properties, const scaling::Similitude& similitude,
                                       Direction direction) {
    const scaling::RockingBlock prototype = properties.prototype.rocking_block(direction),
                                model = properties.model.rocking_block(direction);
    // a plain number: as a frequency it would be written in Hz, 2π times too large
    const auto find_p = [](const scaling::RockingBlock& block, const StructureProperties& structure) {
        return scaling::Ratio::from_value(block.frequency_parameter(structure.gravity).value());
    };
    const auto make = [](const std::string& key, const std::string& title, auto of_prototype, auto of_model, double required_factor) {
        return make_row(key, title, std::optional(of_prototype), std::optional(of_model), required_factor);
    };
    const auto make_plain = [&](const std::string& key, const std::string& title, double of_prototype, double of_model) {
        return make_row(key, title, to_ratio(of_prototype), to_ratio(of_model), 1.0);
    };
    return {make("half_diagonal_m", "R", prototype.half_diagonal(), model.half_diagonal(), similitude.length()),
            make_plain("angle_deg", "alpha [deg]", prototype.angle() / scaling::kDegree, model.angle() / scaling::kDegree),
            make("frequency_parameter_rad_s", "p [rad/s]", find_p(prototype, properties.prototype), find_p(model, properties.model),
                 similitude.frequency()),
            make_plain("angular_restitution", "e_r", prototype.angular_restitution(), model.angular_restitution()),
            make_plain("energy_restitution", "r = e_r^2", prototype.energy_restitution(), model.energy_restitution())};
}

std::vector<PairRow> make_motion_rows(const scaling::MotionProperties& prototype, const scaling::MotionProperties& model,
                                      const scaling::Similitude& similitude) {
    using scaling::MotionProperties;
    std::vector<PairRow> rows;
    const auto add = [&](const std::string& key, const std::string& title, auto MotionProperties::*value, double required_factor) {
        if (prototype.*value || model.*value) rows.push_back(make_row(key, title, prototype.*value, model.*value, required_factor));
    };
    const double time = similitude.time(), frequency = similitude.frequency();
    rows.push_back(
        make_row("pga_m_s2", "PGA", std::optional(prototype.acceleration), std::optional(model.acceleration), similitude.acceleration()));
    add("pgv_m_s", "PGV", &MotionProperties::velocity, similitude.velocity());
    add("pgd_m", "PGD", &MotionProperties::displacement, similitude.length());
    add("vertical_pga_m_s2", "vertical PGA", &MotionProperties::vertical_acceleration, similitude.acceleration_vertical());
    add("predominant_period_s", "predominant period", &MotionProperties::predominant_period, time);
    add("pulse_period_s", "pulse period", &MotionProperties::pulse_period, time);
    add("duration_s", "duration", &MotionProperties::duration, time);
    add("step_s", "step", &MotionProperties::step, time);
    add("lowest_frequency_hz", "lowest frequency", &MotionProperties::lowest_frequency, frequency);
    add("highest_frequency_hz", "highest frequency", &MotionProperties::highest_frequency, frequency);
    return rows;
}

}  // namespace musim::cli
