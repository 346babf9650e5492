#pragma once

#include <variant>

#include "lsdem/scene/scene.hpp"
#include "scaling/json_reader.hpp"

namespace musim::lsdem::detail {

/// Calls `visit(structure, place)` for the structure of a scene, or for each of several; `root` is the scene's place.
template <class Visit>
void for_each_structure(const Scene& scene, const scaling::JsonPlace& root, const Visit& visit) {
    const auto see = [&]<class Kind>(const Kind& structure) {
        if constexpr (std::is_same_v<Kind, Assembly>) {
            for (std::size_t k = 0; k < structure.structures.size(); ++k) {
                const scaling::JsonPlace place = root.at("structures").at(k);
                std::visit([&](const auto& one) { visit(one, place); }, structure.structures[k].structure);
            }
        } else {
            visit(structure, root.at("structure"));
        }
    };
    std::visit(see, scene.structure);
}

}  // namespace musim::lsdem::detail
