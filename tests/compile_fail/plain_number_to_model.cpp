// g++: no matching function for call to .*to_model.double..*constraints not satisfied.*QuantityWithUnit
// clang: no matching member function for call to 'to_model'.*'double' does not satisfy 'QuantityWithUnit'
#include "scaling/laws/similitude.hpp"

using namespace musim::scaling;

auto carry(const Similitude& similitude) {
#ifdef MUSIM_WRONG
    return similitude.to_model(0.424);
#else
    return similitude.to_model(0.424 * si::meters_per_second);
#endif
}
