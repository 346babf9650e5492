#pragma once

#include <cstddef>

#include "lsdem/bodies.hpp"
#include "lsdem/contacts.hpp"
#include "lsdem/model.hpp"

/// Pairs of boxes, and of a box and the ground, that meet by their overlap.
namespace musim::lsdem {

/// Forces of pair `index` at step n, from the poses at n and n − 1; updates what it remembers, tally and work.
void compute_overlap_pair(const Bodies& bodies, const BasePose& base, double dt, std::size_t index, ContactList& list);

/// Energy of the normal springs of pair `index` at step n [J].
double compute_overlap_energy(const Bodies& bodies, const BasePose& base, const ContactList& list, std::size_t index);

}  // namespace musim::lsdem
