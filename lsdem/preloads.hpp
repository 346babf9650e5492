#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "lsdem/bodies.hpp"
#include "lsdem/contacts.hpp"
#include "lsdem/model.hpp"

namespace musim::lsdem {

/// What all contacts that touch hold, in the order of the list; of nodes outside patches nothing.
std::vector<Preload> find_preloads(const Bodies& bodies, const ContactList& list);

/// Preloads by the pair they belong to; refers to them.
class PreloadMap {
  public:
    explicit PreloadMap(const std::vector<Preload>& preloads);
    /// That of leader and follower in this order, or nullptr.
    const Preload* find(std::uint32_t leader, std::uint32_t follower) const;

  private:
    std::map<std::pair<std::uint32_t, std::uint32_t>, const Preload*> by_pair_;
};

/// Makes the contacts of a new list hold what `preloads` say, whatever their blocks overlap; those that are not named hold nothing.
void preload_contacts(const std::vector<Preload>& preloads, const Bodies& bodies, ContactList& list);

}  // namespace musim::lsdem
