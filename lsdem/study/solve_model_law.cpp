#include "lsdem/study/solve_model_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "scaling/laws/scale_law_catalogue.hpp"

namespace musim::lsdem {
namespace {

constexpr const char* kOwnFactors[] = {"mu", "rho", "rho_s", "g"};

std::vector<scaling::GivenFactor> list_own(const MadeOf& made, double length) {
    std::vector<scaling::GivenFactor> own{{"mu", made.friction},
                                          {"rho", made.density},
                                          {"rho_s", made.density},
                                          {"E", made.normal_stiffness / length},
                                          {"k_s", made.shear_stiffness}};
    if (made.gravity) own.push_back({"g", *made.gravity});
    return own;
}

template <class List>
bool has_name(const List& list, const std::string& name) {
    return std::any_of(list.begin(), list.end(), [&](const auto& each) { return each.name == name; });
}

}  // namespace

bool is_own_factor(const std::string& name) {
    return std::find(std::begin(kOwnFactors), std::end(kOwnFactors), name) != std::end(kOwnFactors);
}

scaling::SolvedLaw solve_model_law(const ChosenLaw& chosen, double length, const std::optional<MadeOf>& made) {
    const scaling::ScaleLaw law = scaling::load_scale_law(chosen.name);
    const std::vector<scaling::PiQuantity> quantities = scaling::quantities_of(law);
    if (!has_name(quantities, "l")) {
        throw scaling::SimilitudeError(
            fmt::format("law {}: it has no length l for all directions, and scenes are scaled by one length; take another law", law.name));
    }
    std::vector<scaling::GivenFactor> given = chosen.set;
    given.push_back({"l", length});
    for (const scaling::GivenFactor& own : made ? list_own(*made, length) : std::vector<scaling::GivenFactor>()) {
        const bool is_given = has_name(chosen.set, own.name);
        if (is_given && is_own_factor(own.name)) {
            throw scaling::SimilitudeError(fmt::format(
                "law {}: the factor of {} is the model's own ({:.7g}) and cannot be given; leave it out", law.name, own.name, own.factor));
        }
        if (!is_given && has_name(law.choices, own.name)) given.push_back(own);
    }
    return scaling::solve_law(law, given);
}

}  // namespace musim::lsdem
