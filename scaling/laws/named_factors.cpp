#include "scaling/laws/named_factors.hpp"

#include <cmath>

namespace musim::scaling::detail {

double find_time(const NamedFactors& factors) {
    if (const auto time = factors.find<Time>("t")) return *time;
    const auto displacement = factors.find<Length>("u");
    const auto acceleration = factors.find<Acceleration>("a");
    if (!displacement || !acceleration) factors.fail("it has neither a time t nor both a displacement u and an acceleration a");
    return std::sqrt(*displacement / *acceleration);
}

ShakingScales find_horizontal(const NamedFactors& factors, double time) {
    const auto displacement = factors.find<Length>("u");
    const auto velocity = factors.find<Velocity>("v");
    const auto acceleration = factors.find<Acceleration>("a");
    if (!displacement && !velocity && !acceleration) factors.fail("it has no displacement u, velocity v or acceleration a");
    ShakingScales scales;
    scales.displacement = displacement ? *displacement : velocity ? *velocity * time : *acceleration * time * time;
    scales.velocity = velocity ? *velocity : scales.displacement / time;
    scales.acceleration = acceleration ? *acceleration : scales.velocity / time;
    factors.require_equal(scales.velocity * time, scales.displacement, "v t/u");
    factors.require_equal(scales.acceleration * time, scales.velocity, "a t/v");
    return scales;
}

ShakingScales find_vertical(const NamedFactors& factors, const ShakingScales& horizontal) {
    const auto displacement = factors.find<Length>("u_v");
    const auto velocity = factors.find<Velocity>("v_v");
    const auto acceleration = factors.find<Acceleration>("a_v");
    const double ratio = acceleration   ? *acceleration / horizontal.acceleration
                         : velocity     ? *velocity / horizontal.velocity
                         : displacement ? *displacement / horizontal.displacement
                                        : 1.0;
    const ShakingScales scales{.displacement = displacement.value_or(ratio * horizontal.displacement),
                               .velocity = velocity.value_or(ratio * horizontal.velocity),
                               .acceleration = acceleration.value_or(ratio * horizontal.acceleration)};
    factors.require_equal(scales.velocity / horizontal.velocity, ratio, "v_v a/(a_v v)");
    factors.require_equal(scales.displacement / horizontal.displacement, ratio, "u_v a/(a_v u)");
    return scales;
}

}  // namespace musim::scaling::detail
