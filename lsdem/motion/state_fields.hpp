#pragma once

#include "lsdem/archive.hpp"
#include "lsdem/bodies.hpp"
#include "lsdem/contact/contacts.hpp"
#include "lsdem/losses.hpp"
#include "lsdem/motion/neighbors.hpp"
#include "lsdem/motion/simulation.hpp"

/// The fields that a saved state consists of, type by type. What follows from the model is left out. A new field of the state is added
/// here, and the version in kStateKind raised.
namespace musim::lsdem {

inline constexpr ArchiveKind kStateKind{{'m', 'u', 's', 'i', 'm', 'D', 'E', 'M'}, 12, "saved state"};

void exchange(Archive& archive, Bodies& bodies);
void exchange(Archive& archive, NeighborSearch::Reference& reference);
void exchange(Archive& archive, ContactList& list);
void exchange(Archive& archive, PairWork& work);
void exchange(Archive& archive, Losses& losses);
void exchange(Archive& archive, Divergence& divergence);
void exchange(Archive& archive, Overstiff& overstiff);
void exchange(Archive& archive, Leaving& leaving);

/// Throws std::runtime_error when a state that was read points outside itself or the model, so that nothing else has to look.
void check_restored(const Model& model, const Bodies& bodies, const NeighborSearch::Reference& reference, const ContactList& list,
                    const Losses& losses);

}  // namespace musim::lsdem
