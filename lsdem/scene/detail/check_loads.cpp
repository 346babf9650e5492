#include <fmt/format.h>

#include <algorithm>

#include "lsdem/scene/detail/require.hpp"

namespace musim::lsdem::detail {
namespace {

template <class Quantity>
bool is_zero(const Triple<Quantity>& triple) {
    return std::all_of(triple.begin(), triple.end(), [](Quantity component) { return component.value() == 0.0; });
}

void check_load(const LoadEntry& load, const JsonPlace& place) {
    require_fields(load, place);
    if (!load.name.empty()) check_name(load.name, place.at("name"));
    if (load.force && load.displacement) {
        fail(place.at("force"), "there is a \"displacement\" as well (one follows from the other); leave one of the two out");
    }
    if (!load.force && !load.displacement) fail(place, "neither a \"force\" nor a \"displacement\" is given; add one of them");
    if (load.force && is_zero(*load.force)) fail(place.at("force"), "zero (it has no direction, and does nothing); correct it");
    if (load.displacement && is_zero(*load.displacement)) {
        fail(place.at("displacement"), "zero (it has no direction along which to hold the block); correct it");
    }
    if (load.force && load.stiffness) {
        fail(place.at("stiffness"), "a force has none (it is that of an actuator, which a \"displacement\" moves); leave it out");
    }
}

}  // namespace

void check_loads(const Scene& scene, const JsonPlace& place) {
    if (!scene.loads.empty() && !scene.motions.empty()) {
        fail(place, "loads act while one motion does (there is a list of \"motions\"); leave one of the two out");
    }
    for (std::size_t k = 0; k < scene.loads.size(); ++k) {
        check_load(scene.loads[k], place.at(k));
        for (std::size_t before = 0; before < k; ++before) {
            if (scene.loads[before].label(before) != scene.loads[k].label(k)) continue;
            fail(place.at(k).at("name"),
                 fmt::format("load {} is called \"{}\" as well; give each a name of its own", before, scene.loads[k].label(k)));
        }
    }
}

}  // namespace musim::lsdem::detail
