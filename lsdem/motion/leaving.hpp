#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lsdem/bodies.hpp"
#include "lsdem/contact/contacts.hpp"
#include "lsdem/facing_sides.hpp"
#include "lsdem/model.hpp"
#include "lsdem/motion/motion_kernel.hpp"

namespace musim::lsdem::detail {

/// A block that is farther than this part of its smallest edge from all others and from the ground has left its place [-]: a structure that
/// stands has no such block.
inline constexpr double kLeavingGap = 1.0 / 16.0;

/// The first block that has left its place, if any: turned, see kLeavingTurn, or in the air. Any of its faces may land on any other thing
/// from now on. Poses alone decide, whatever the neighbor list holds; none has where there is neither ground nor another block. `touches`,
/// `forces`: what pushes each block now.
std::optional<std::size_t> find_block_out_of_place(const Model& model, const Bodies& bodies, const TouchList& touches,
                                                   const std::vector<PairForce>& forces);

}  // namespace musim::lsdem::detail
