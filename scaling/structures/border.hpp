#pragma once

#include <string_view>

namespace musim::scaling::detail {

/// A group whose response is of another kind above 1 than below.
struct Border {
    std::string_view group, topic;
    std::string_view above, below;  ///< what happens on either side
    std::string_view remedy;        ///< when prototype and model differ
};

/// The border of a group; null for a group without one.
const Border* find_border(std::string_view group);

/// What happens at a value of the group.
std::string_view name_side(const Border& border, double value);

}  // namespace musim::scaling::detail
