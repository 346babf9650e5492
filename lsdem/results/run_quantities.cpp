#include "lsdem/results/run_quantities.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "lsdem/results/base_frame.hpp"

namespace musim::lsdem {
namespace {

/// Largest of one number over the samples for each spine block: `of(spine block, sample)`.
template <class Of>
std::vector<double> largest_of_spine(const RunResult& run, std::size_t first_sample, const Of& of) {
    std::vector<double> largest(run.spine.size(), 0.0);
    for (std::size_t s = 0; s < run.spine.size(); ++s) {
        for (std::size_t k = first_sample; k < run.history.samples(); ++k) largest[s] = std::max(largest[s], of(s, k));
    }
    return largest;
}

}  // namespace

std::vector<QuantityFamily> find_quantities(const RunResult& run, const scaling::Similitude& similitude) {
    const History& h = run.history;
    const std::size_t spine = run.spine.size(), last = h.samples() - 1;
    const double length = similitude.length(), velocity = similitude.velocity(), energy = similitude.energy();
    const auto speed = [&](std::size_t s, std::size_t k) {
        return find_velocity_on_base(h.base[k], h.spine_position[k * spine + s], h.spine_velocity[k * spine + s]).norm() / velocity;
    };
    const auto displacement = [&](std::size_t s, std::size_t k) { return find_moved(run, s, k).head<2>().norm() / length; };
    const auto rotation = [&](std::size_t s, std::size_t k) { return h.spine_rotation[k * spine + s].norm(); };

    std::vector<QuantityFamily> families;
    const auto add_spine = [&](const char* key, const char* title, const char* unit, std::vector<double> values) {
        families.push_back({key, title, unit, run.spine.level, std::move(values)});
        if (run.blocks.is_listed()) families.back().name = label_spine(run);
    };
    add_spine("peak_velocity", "peak velocity", "m/s", largest_of_spine(run, 0, speed));
    add_spine("residual_displacement", "residual displacement", "m", largest_of_spine(run, last, displacement));
    add_spine("residual_rotation", "residual rotation", "rad", largest_of_spine(run, last, rotation));

    const Damage damage = assess_damage(run);
    QuantityFamily slip{"slip", "slip", "m", {}, {}}, loss{"loss", "loss of a level", "J", {}, {}};
    for (const LevelDamage& level : damage.levels) {
        slip.level.push_back(level.level), loss.level.push_back(level.level);
        slip.value.push_back(level.slip.mean / length);
        loss.value.push_back(level.loss ? level.loss->total() / energy : 0.0);
    }
    families.push_back(std::move(slip));
    families.push_back(std::move(loss));
    const auto add_one = [&](const char* key, const char* title, const char* unit, double value) {
        families.push_back({key, title, unit, {0}, {value}});
    };
    add_one("total_loss", "losses", "J", (damage.loss ? damage.loss->total() : 0.0) / energy);
    add_one("damage_index", "damage index", "", damage.index);
    add_one("fallen_blocks", "fallen blocks", "", static_cast<double>(damage.fallen));
    return families;
}

}  // namespace musim::lsdem
