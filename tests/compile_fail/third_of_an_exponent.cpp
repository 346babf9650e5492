// g++: static assertion failed: similitude handles whole and half-integer exponents only
// clang: static_assert failed.*similitude handles whole and half-integer exponents only
#include <boost/units/pow.hpp>

#include "scaling/laws/similitude.hpp"

using namespace musim::scaling;

#ifdef MUSIM_WRONG
constexpr int kRoot = 3;
#else
constexpr int kRoot = 2;
#endif

double find_factor(const Similitude& similitude) {
    return similitude.factor<units::root_typeof_helper<Length, units::static_rational<kRoot>>::type>();
}
