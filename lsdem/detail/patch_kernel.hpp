#pragma once

#include <cstddef>

#include "lsdem/bodies.hpp"
#include "lsdem/contacts.hpp"

namespace musim::lsdem::detail {

/// Forces of the patches of groups [first, last), four at a time; compiled for AVX2 and for plain x86-64, same bits. Returns the largest
/// overlap of any node over the height of its leader's shape [-]. See lsdem/README.md, "Patches".
double compute_patches(const Bodies& bodies, const BasePose& base, double dt, std::size_t first, std::size_t last, ContactList& list);

}  // namespace musim::lsdem::detail
