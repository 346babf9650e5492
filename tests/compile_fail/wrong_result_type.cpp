// g++: error: could not convert .*to_model.*static_rational<-2>.* to .*static_rational<-1>
// clang: error: no viable conversion from returned value of type .*static_rational<-2.*to function return type .*static_rational<-1
#include "scaling/laws/similitude.hpp"

using namespace musim::scaling;

Velocity carry(const Similitude& similitude, [[maybe_unused]] Velocity velocity, [[maybe_unused]] Acceleration acceleration) {
#ifdef MUSIM_WRONG
    return similitude.to_model(acceleration);
#else
    return similitude.to_model(velocity);
#endif
}
