// g++: no matching function for call to .sliding_demand.musim::scaling::Velocity.*constraints not satisfied.*IsAcceleration
// clang: no matching function for call to 'sliding_demand'.*does not satisfy 'IsAcceleration'
#include "scaling/laws/groups.hpp"

using namespace musim::scaling;

double find_demand([[maybe_unused]] Velocity velocity, [[maybe_unused]] Acceleration acceleration) {
#ifdef MUSIM_WRONG
    return groups::sliding_demand(velocity, 0.59, kStandardGravity);
#else
    return groups::sliding_demand(acceleration, 0.59, kStandardGravity);
#endif
}
