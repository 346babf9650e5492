// g++: error: no match for .operator[+]. .operand types are .musim::scaling::Length.*musim::scaling::Time
// clang: error: invalid operands to binary expression .'musim::scaling::Length'.*'musim::scaling::Time'
#include "scaling/units.hpp"

using namespace musim::scaling;

auto add(Length length, [[maybe_unused]] Time time) {
#ifdef MUSIM_WRONG
    return length + time;
#else
    return length + length;
#endif
}
