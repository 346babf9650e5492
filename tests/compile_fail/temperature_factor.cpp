// g++: static assertion failed: similitude is mechanical: only length, mass and time
// clang: static_assert failed.*similitude is mechanical: only length, mass and time
#include <boost/units/systems/si/temperature.hpp>

#include "scaling/laws/similitude.hpp"

using namespace musim::scaling;

#ifdef MUSIM_WRONG
using Scaled = units::quantity<si::temperature>;
#else
using Scaled = Length;
#endif

double find_factor(const Similitude& similitude) { return similitude.factor<Scaled>(); }
