// g++: no matching function for call to .parse_quantity<.*constraints not satisfied.*QuantityWithUnit
// clang: no matching function for call to 'parse_quantity'.*'double' does not satisfy 'QuantityWithUnit'
#include "scaling/quantity_text.hpp"
#include "scaling/units.hpp"

using namespace musim::scaling;

#ifdef MUSIM_WRONG
using Read = double;
#else
using Read = Ratio;
#endif

auto read() { return parse_quantity<Read>("0.63"); }
