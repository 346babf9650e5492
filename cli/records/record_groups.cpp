#include "cli/records/record_groups.hpp"

#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <cmath>
#include <numbers>

#include "records/measures/sliding_block.hpp"

namespace musim::cli {
namespace {

CLI::Validator below_right_angle() {
    return check_number([](double degrees) { return degrees < 90.0; }, " is not below 90");
}

}  // namespace

void StructureOptions::add_to(CLI::App& command) {
    command.add_option("--friction", friction, "Friction coefficient of a structure, for groups and sliding")
        ->type_name("MU")
        ->check(above_zero());
    command.add_option("--length", length, "Length [m] of a structure, for groups")->type_name("L")->check(above_zero());
    command.add_option("--slenderness", slenderness, "Angle [deg] between a block's diagonal and its height, for groups")
        ->type_name("ALPHA")
        ->check(above_zero())
        ->check(below_right_angle());
}

NamedValues compute_record_groups(const records::TimeSeries& leveled, const records::Intensity& intensity,
                                  const StructureOptions& structure) {
    const double g = scaling::kStandardGravity.value();
    std::optional<double> pga_friction, pgv_friction, pga_slenderness, sliding, sliding_length;
    if (structure.friction) {
        const double yield = structure.friction->value * g;  // [m/s²]
        if (intensity.pga) pga_friction = std::abs(intensity.pga->value.value()) / yield;
        if (intensity.pgv && structure.length) {
            pgv_friction = std::abs(intensity.pgv->value.value()) / std::sqrt(yield * structure.length->value);
        }
        if (leveled.quantity() == records::SampleQuantity::acceleration) {
            sliding = records::compute_sliding(leveled, scaling::Acceleration::from_value(yield)).largest.value();
            if (structure.length) sliding_length = *sliding / structure.length->value;
        }
    }
    if (structure.slenderness && intensity.pga) {
        pga_slenderness = std::abs(intensity.pga->value.value()) / (g * std::tan(structure.slenderness->value * std::numbers::pi / 180.0));
    }
    return {{"pga_over_mu_g", "PGA/(mu g)", or_null(pga_friction)},
            {"pgv_over_sqrt_mu_g_l", "PGV/sqrt(mu g l)", or_null(pgv_friction)},
            {"pga_over_g_tan_alpha", "PGA/(g tan alpha)", or_null(pga_slenderness)},
            {"newmark_sliding_m", "sliding [m]", or_null(sliding)},
            {"newmark_sliding_over_length", "sliding/l", or_null(sliding_length)}};
}

}  // namespace musim::cli
