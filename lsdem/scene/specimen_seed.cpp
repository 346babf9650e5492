#include "lsdem/scene/specimen_seed.hpp"

#include <optional>
#include <type_traits>
#include <variant>

#include "lsdem/scene/scene_error.hpp"

namespace musim::lsdem {
namespace {

bool draws(const Scatter& scatter) { return scatter.size.value() > 0.0 || scatter.place.value() > 0.0 || scatter.friction > 0.0; }

/// Calls `visit` for each structure of a scene that has a seed.
template <class SomeScene, class Visit>
void for_each_seeded(SomeScene& scene, const Visit& visit) {
    const auto see = [&](auto& structure) {
        if constexpr (requires { structure.seed; }) visit(structure);
    };
    std::visit(
        [&](auto& structure) {
            if constexpr (requires { structure.structures; }) {
                for (auto& placed : structure.structures) std::visit(see, placed.structure);
            } else {
                see(structure);
            }
        },
        scene.structure);
}

/// Seeds of the scene, in the order in which they count.
struct Seeds {
    std::optional<std::uint64_t> of_heights, of_scatter, of_even_heights;

    explicit Seeds(const Scene& scene) {
        for_each_seeded(scene, [&](const auto& structure) {
            std::optional<std::uint64_t>& seed = structure.height_deviation.value() > 0.0 ? of_heights : of_even_heights;
            if (!seed) seed = structure.seed;
        });
        if (scene.scatter) of_scatter = scene.scatter->seed;
    }
};

}  // namespace

bool draws_specimen(const Scene& scene) { return Seeds(scene).of_heights || (scene.scatter && draws(*scene.scatter)); }

std::uint64_t seed_of(const Scene& scene) {
    const Seeds seeds(scene);
    return seeds.of_heights.value_or(seeds.of_scatter.value_or(seeds.of_even_heights.value_or(1)));
}

Scene with_seed(Scene scene, std::uint64_t seed) {
    const Seeds seeds(scene);
    if (!seeds.of_heights && !seeds.of_scatter && !seeds.of_even_heights) {
        throw SceneError(scene.place() +
                         ": specimens differ by the heights of a column, tower or wall, or by a \"scatter\" (single blocks without one are "
                         "placed as they are); add a \"scatter\"");
    }
    const std::uint64_t on = seed - seed_of(scene);  // whole numbers that go round: counts back as well
    for_each_seeded(scene, [&](auto& structure) { structure.seed += on; });
    if (scene.scatter) scene.scatter->seed += on;
    return scene;
}

}  // namespace musim::lsdem
