#include "scaling/structures/border.hpp"

#include <algorithm>
#include <iterator>

namespace musim::scaling::detail {
namespace {

constexpr Border kBorders[] = {
    {"mu/tan(alpha)", "sliding or rocking first", "rocking can start first", "sliding first",
     "no scaling of the input restores it, choose a model material with friction nearer the prototype's"},
    {"a/(g*tan(alpha))", "uplift", "the peak lifts a block", "the peak lifts no block",
     "the motion of law froude keeps this group, with equal friction that of law mu does too"},
    {"a/(mu*g)", "sliding", "the peak moves a block", "the peak moves no block",
     "the motion of law mu keeps this group, with equal friction that of law froude does too"},
};

}  // namespace

const Border* find_border(std::string_view group) {
    const auto* const found =
        std::find_if(std::begin(kBorders), std::end(kBorders), [&](const Border& each) { return each.group == group; });
    return found == std::end(kBorders) ? nullptr : found;
}

std::string_view name_side(const Border& border, double value) { return value > 1.0 ? border.above : border.below; }

}  // namespace musim::scaling::detail
