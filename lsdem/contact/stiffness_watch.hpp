#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/StdVector>

#include "lsdem/bodies.hpp"
#include "lsdem/contact/contacts.hpp"
#include "lsdem/detail/matrix6.hpp"

namespace musim::lsdem {

/// Share of the limit of the time step that the contacts of a block use [-], and the block.
struct StiffestBlock {
    double used = 0.0;
    std::size_t block = 0;
};

/// Holds the contacts as they are against the limit of the time step. Keeps its memory from one look to the next.
class StiffnessWatch {
  public:
    /// The largest eigenvalue, over single blocks that move, of M⁻¹(K dt²/4 + C dt/2), with K, C (6 x 6) those of the block's overlaps
    /// twice where the other block moves too, dt the last step: with no more than 1 every mode of the assembly is stable
    /// (docs/theory/integration.md). Zero unless a block uses more than `least`. Contacts by nodes are left out.
    StiffestBlock find_stiffest(const Bodies& bodies, const ContactList& list, double least);

  private:
    std::vector<detail::Matrix6, Eigen::aligned_allocator<detail::Matrix6>> opposition_;  ///< one per block
};

}  // namespace musim::lsdem
