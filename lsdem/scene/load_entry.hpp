#pragma once

#include <optional>
#include <string>

#include "lsdem/scene/material_presets.hpp"
#include "scaling/units.hpp"

namespace musim::lsdem {

/// A force, or a displacement by an actuator, that grows on a block at a point, see Load. One of the two is given.
struct LoadEntry {
    std::string name;                                     ///< in results and messages; empty: its number, counted from 0
    std::string block;                                    ///< name or number
    std::optional<Triple<scaling::Length>> point;         ///< in the world, of the block as drawn; default: its centre of mass
    std::optional<Triple<scaling::Force>> force;          ///< the whole
    std::optional<Triple<scaling::Length>> displacement;  ///< the whole, of the actuator's end
    std::optional<scaling::Stiffness> stiffness;          ///< of the actuator; default: kActuatorPart of that of the block's face
    scaling::Time start{};
    scaling::Time rise{};  ///< time that it takes to grow

    /// "push", or "load 0".
    std::string label(std::size_t number) const { return name.empty() ? "load " + std::to_string(number) : name; }
    bool operator==(const LoadEntry&) const = default;
};

/// Stiffness of an actuator over that of a whole face of its block against another one, k_n, where a scene gives none [-]. Softer: the
/// point lags behind its end, by W/k; stiffer: shorter steps, and a dashpot that pushes by c·v from the moment the end moves at v, which is
/// small beside the weight W of a block as long as v is small beside W/c.
inline constexpr double kActuatorPart = 1e-4;

}  // namespace musim::lsdem
