#pragma once

namespace musim::lsdem {

/// Holding of a block.
enum class Held {
    free,
    in_place,  ///< also while the base moves
    with_base  ///< it moves as the base does, and not otherwise
};

}  // namespace musim::lsdem
