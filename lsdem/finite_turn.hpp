#pragma once

#include "lsdem/types.hpp"

namespace musim::lsdem {

/// The turn of a rotation vector θ [rad]: by |θ| about θ/|θ|, q = (cos |θ|/2, θ/|θ| sin |θ|/2). By series and halved angles, without
/// functions whose last bit depends on the machine; of unit length to rounding, exactly the unit for θ = 0.
Quaternion turn_by(const Vector3& rotation_vector);

/// Angular velocity and acceleration, fixed frame.
struct TurnRates {
    Vector3 velocity = Vector3::Zero();      ///< ω [rad/s]
    Vector3 acceleration = Vector3::Zero();  ///< dω/dt [rad/s²]
};

/// Rates of a turn by a rotation vector θ(t), from θ and its first two derivatives [rad, rad/s, rad/s²]:
///   ω = θ' + a θ×θ' + b θ×(θ×θ'),   a = (1 − cos φ)/φ²,  b = (φ − sin φ)/φ³,  φ = |θ|  [Bortz71].
/// About one axis ω = θ'. To rounding up to a whole turn.
TurnRates find_turn_rates(const Vector3& angle, const Vector3& rate, const Vector3& acceleration);

}  // namespace musim::lsdem
