#pragma once

#include <array>
#include <optional>
#include <string>

#include "scaling/laws/similitude.hpp"
#include "scaling/structures/distortion.hpp"
#include "scaling/structures/rocking_block.hpp"

namespace musim::scaling {

/// The two ways in which a block of plan b × w can rock.
enum class Direction { thin, wide };

/// "thin" or "wide".
std::string_view to_string(Direction direction);

/// Knowledge of one structure of equal blocks, prototype or model. Groups that need an absent value are left out.
struct StructureProperties {
    std::string name = {};          ///< for reports: "concrete", "wood 1:107"
    std::array<Length, 3> block{};  ///< b, w, H
    int layers = 1;                 ///< N
    Density density{};
    double friction = 0.0;                           ///< μ between blocks [-]
    Acceleration gravity = kStandardGravity;         ///< g where the structure stands
    std::optional<double> ground_friction = {};      ///< μ between blocks and ground [-]
    std::optional<double> kinetic_friction = {};     ///< μ between blocks while they slide [-]
    std::optional<double> restitution = {};          ///< normal coefficient e of the material [-]
    std::optional<Stiffness> normal_stiffness = {};  ///< k_n of a face
    std::optional<Stiffness> shear_stiffness = {};   ///< k_s of a face
    std::optional<Length> height_deviation = {};     ///< σ_H, standard deviation of the block heights
    std::optional<Length> gap = {};                  ///< between neighbours of a layer; 0: they touch
    std::optional<Length> edge_radius = {};          ///< of rounded or chipped edges; 0: sharp
    std::optional<int> blocks_per_layer = {};

    Length height() const;    ///< l = N H
    Mass block_mass() const;  ///< m = ρ b w H
    Area face() const;        ///< A = b w

    /// The block as it rocks in one direction.
    RockingBlock rocking_block(Direction direction) const;
};

/// Knowledge of a motion.
struct MotionProperties {
    Acceleration acceleration{};                                             ///< PGA
    std::optional<Velocity> velocity = {};                                   ///< PGV
    std::optional<Length> displacement = {};                                 ///< PGD
    std::optional<Acceleration> vertical_acceleration = {};                  ///< vertical PGA; 0: none
    std::optional<Time> predominant_period = {};                             ///< T_p, of the largest PSA
    std::optional<Time> pulse_period = {};                                   ///< of the velocity pulse
    std::optional<Time> duration = {};                                       ///< T_D
    std::optional<Time> step = {};                                           ///< dt between samples
    std::optional<Frequency> lowest_frequency = {}, highest_frequency = {};  ///< that matter
    std::optional<double> direction = {};                                    ///< angle of the shaking to the blocks' thin side [rad]
};

/// The frequencies that a shake table follows.
struct Bandwidth {
    std::optional<Frequency> lowest = {}, highest = {};
};

/// Prototype, model, and what shakes them.
struct PairProperties {
    StructureProperties prototype, model;
    std::optional<MotionProperties> motion = {};        ///< of the prototype
    std::optional<MotionProperties> model_motion = {};  ///< what the model was given; absent: `motion` scaled by the law
    std::optional<Bandwidth> table = {};                ///< what shakes the model
};

/// Throws SimilitudeError `properties: WHAT of PROTOTYPE OR MODEL is VALUE (why); what to do` for a value that no structure or motion has.
void check(const PairProperties& properties);

/// λ_μ, λ_g and λ_ρ that the properties give, with a chosen λ_l.
ScaleFactors make_scale_factors(const PairProperties& properties, double length);

/// model/prototype of numbers or quantities of one dimension, where both are known.
template <class Value>
std::optional<double> find_ratio(const std::optional<Value>& model, const std::optional<Value>& prototype) {
    return model && prototype ? std::optional(static_cast<double>(*model / *prototype)) : std::nullopt;
}

/// Properties that find_distortions() asks for, as factors; those that one side does not give are left out.
ModelProperties make_model_properties(const PairProperties& properties);

/// A motion by the similitude, its vertical acceleration by Similitude::acceleration_vertical(); the direction stays.
MotionProperties to_model(const MotionProperties& prototype, const Similitude& similitude);

}  // namespace musim::scaling
