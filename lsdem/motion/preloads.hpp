#pragma once

#include <vector>

#include "lsdem/contact/contacts.hpp"
#include "lsdem/model.hpp"

namespace musim::lsdem {

/// Friction of all boxes that touch, in the order of the list.
std::vector<Preload> find_preloads(const Bodies& bodies, const ContactList& list);

/// Makes friction of the contacts of a new list hold what `preloads` say; their blocks may be given in either order.
void preload_contacts(const std::vector<Preload>& preloads, const Bodies& bodies, ContactList& list);

}  // namespace musim::lsdem
