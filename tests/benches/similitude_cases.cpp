#include "tests/benches/similitude_cases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <utility>

namespace musim::lsdem {
namespace {

using Factors = std::vector<scaling::GivenFactor>;

constexpr double kLength = 1.0 / 25.0;

/// Scale of the column, where stick and slip make rounding grow: with it and factors that are powers of two there is none.
constexpr double kBitLength = 1.0 / 16.0;

constexpr double kWoodFriction = 0.63 / 0.59, kAluminiumFriction = 0.18 / 0.59;
constexpr double kWoodDensity = 800.0 / 2320.0, kAluminiumDensity = 2700.0 / 2320.0;

/// m = ρ l³ of a model of wood.
constexpr double kWoodMass = kWoodDensity * kLength * kLength * kLength;

/// The cases of one law, one after another.
class CaseList {
  public:
    explicit CaseList(std::string law) : law_(std::move(law)) {}

    TwinScales scale(const Factors& given) const { return make_twin_scales(law_, given); }

    /// Models whose curves are the prototype's.
    void add_equal(std::initializer_list<BenchScene> scenes, const TwinScales& scales) {
        for (const BenchScene scene : scenes) cases_.push_back({.law = law_, .scene = scene, .scales = scales, .collapses = true});
    }
    void add(BenchScene scene, const TwinScales& scales, const Break& broken = {}, Measure measure = Measure::peak) {
        cases_.push_back({.law = law_,
                          .scene = scene,
                          .scales = scales,
                          .broken = broken,
                          .measure = measure,
                          .prediction = predict(scene, scales, broken, measure)});
    }

    std::vector<SimilitudeCase> take() { return std::move(cases_); }

  private:
    std::string law_;
    std::vector<SimilitudeCase> cases_;
};

/// Stiffness of the prototype's own solid, λ_k = λ_l, over what the law asks for.
Break own_solid(const TwinScales& scales) { return {BrokenGroup::stiffness, scales.similitude.length() / scales.similitude.stiffness()}; }

using enum BenchScene;

void add_mu(CaseList& list) {
    const TwinScales wood = list.scale({{"l", kLength}, {"mu", kWoodFriction}, {"rho", kWoodDensity}});
    list.add_equal({slide}, wood);
    list.add(slide, wood, {BrokenGroup::friction, 0.5});
    list.add(slide, wood, {BrokenGroup::duration, 1.5});
    list.add(slide, wood, own_solid(wood));
    list.add(rock, wood);
    list.add(rock, list.scale({{"l", kLength}, {"mu", kAluminiumFriction}, {"rho", kAluminiumDensity}}));
}

void add_froude(CaseList& list) {
    const TwinScales wood = list.scale({{"l", kLength}, {"rho", kWoodDensity}});
    list.add_equal({slide, rock}, wood);
    list.add_equal({column}, list.scale({{"l", kBitLength}, {"rho", 0.5}}));
    list.add(slide, wood, {BrokenGroup::friction, 2.0});
    list.add(slide, wood, own_solid(wood));
    list.add(slide, list.scale({{"l", kLength}, {"mu", kAluminiumFriction}, {"rho", kAluminiumDensity}}));
    list.add(rock, wood, {BrokenGroup::amplitude, 1.2});
    list.add(rock, wood, own_solid(wood));
}

void add_exact(CaseList& list) {
    const TwinScales heavier = list.scale({{"l", kLength}, {"g", 3.0}, {"rho", kWoodDensity}});
    list.add_equal({slide, rock, chain}, heavier);
    list.add_equal({column}, list.scale({{"l", kBitLength}, {"g", 4.0}, {"rho", 0.5}}));
    list.add(slide, heavier, {BrokenGroup::amplitude, 1.25});
    list.add(rock, heavier, {BrokenGroup::duration, 1.25});
    list.add(chain, heavier, {BrokenGroup::stiffness, 4.0});
}

void add_cauchy(CaseList& list) {
    // at 1/25 a block would slide 25 times as hard, for longer than a short run
    const TwinScales same_solid = list.scale({{"l", 1.0 / 5.0}});
    // a/g is not kept: no equal groups, though nothing slips
    list.add(chain, same_solid);
    list.add(chain, same_solid, {BrokenGroup::stiffness, 4.0});
    list.add(chain, same_solid, {BrokenGroup::stiffness, 4.0}, Measure::peak_time);
    list.add(chain, same_solid, {BrokenGroup::stiffness, 0.25}, Measure::peak_time);
    list.add(slide, same_solid);
}

void add_centrifuge(CaseList& list) {
    const TwinScales same_solid = list.scale({{"l", kLength}});
    list.add_equal({slide, rock, chain}, same_solid);
    list.add_equal({column}, list.scale({{"l", kBitLength}}));
    list.add(slide, same_solid, {BrokenGroup::gravity, 0.5});
    list.add(rock, same_solid, {BrokenGroup::gravity, 0.8});
}

void add_true_replica(CaseList& list) {
    const TwinScales soft = list.scale({{"l", kLength}, {"rho", kWoodDensity}});
    list.add_equal({slide, rock, chain}, soft);
    list.add_equal({column}, list.scale({{"l", kBitLength}, {"rho", 0.5}}));
    list.add(chain, soft, own_solid(soft));
    list.add(chain, soft, {BrokenGroup::stiffness, 4.0}, Measure::peak_time);
    list.add(rock, soft, {BrokenGroup::gravity, 0.8});
}

void add_artificial_mass(CaseList& list) {
    const TwinScales laden = list.scale({{"l", kLength}});
    const Break bare{BrokenGroup::density, 1.0 / laden.similitude.density()};
    list.add_equal({slide, rock, chain}, laden);
    list.add_equal({column}, list.scale({{"l", kBitLength}}));
    list.add(chain, laden, bare);
    list.add(chain, laden, bare, Measure::peak_time);
    list.add(slide, laden, bare);
    list.add(rock, laden, bare);
    list.add(slide, laden, {BrokenGroup::friction, 0.5});
}

void add_gravity_distorted(CaseList& list) {
    const TwinScales stronger = list.scale({{"l", kLength}, {"a", 2.0}, {"rho", kWoodDensity}});
    list.add_equal({slide}, list.scale({{"l", kLength}, {"a", 2.0}, {"mu", 2.0}, {"rho", kWoodDensity}}));
    list.add(chain, stronger);
    list.add(slide, stronger);
    list.add(rock, list.scale({{"l", kLength}, {"a", 1.2}, {"rho", kWoodDensity}}));
    list.add(rock, list.scale({{"l", kLength}, {"a", 0.5}, {"rho", kWoodDensity}}));
}

void add_restoring_force(CaseList& list) {
    // the force that friction has, and one that nothing in the model has
    const auto force = [&](double over_friction) {
        const double friction = kWoodFriction * kWoodMass;
        return list.scale({{"l", kLength}, {"F_R", over_friction * friction}, {"mu", kWoodFriction}, {"rho", kWoodDensity}});
    };
    list.add_equal({slide}, force(1.0));
    list.add(slide, force(2.0));
    list.add(slide, force(0.5));
    list.add(slide, force(1.0), {BrokenGroup::duration, 1.5});
}

void add_restoring_rocking(CaseList& list) {
    const auto block = [&](double slenderness) {
        return list.scale({{"l", kLength}, {"tan_alpha", slenderness}, {"mu", kAluminiumFriction}, {"rho", kAluminiumDensity}});
    };
    list.add(rock, block(1.0));
    list.add(rock, block(1.5));
    list.add(rock, block(1.0), {BrokenGroup::gravity, 0.8});
    list.add(rock, block(1.0), {BrokenGroup::height, 0.8});
    list.add(slide, block(1.0));
}

void add_restoring_spring(CaseList& list) {
    // twice the prototype's acceleration
    const double stiffness = 2.0 * kWoodMass / kLength;
    const TwinScales stiffer = list.scale({{"l", kLength}, {"k_s", stiffness}, {"rho", kWoodDensity}});
    list.add_equal({slide, rock, chain}, list.scale({{"l", kLength}, {"k_s", stiffness}, {"g", 2.0}, {"rho", kWoodDensity}}));
    list.add(chain, stiffer);
    list.add(chain, stiffer, {BrokenGroup::stiffness, 0.25});
    list.add(chain, stiffer, {BrokenGroup::density, 4.0}, Measure::peak_time);
    list.add(slide, stiffer);
}

void add_restoring_cohesion(CaseList& list) {
    // dry blocks: their friction is the cohesion that the law asks for, or is not
    const auto cohesion = [&](double over_friction) {
        const double friction = kWoodFriction * kWoodDensity * kLength;
        return list.scale({{"l", kLength}, {"c_coh", over_friction * friction}, {"mu", kWoodFriction}, {"rho", kWoodDensity}});
    };
    list.add_equal({slide}, cohesion(1.0));
    list.add(slide, cohesion(2.0));
    list.add(slide, cohesion(0.75));
}

void add_restoring_mixed(CaseList& list) {
    const TwinScales wood = list.scale({{"l", kLength}, {"mu", kWoodFriction}, {"rho", kWoodDensity}});
    list.add_equal({slide}, wood);
    list.add(slide, wood, {BrokenGroup::friction, 0.5});
    list.add(slide, wood, {BrokenGroup::gravity, 0.5});
}

void add_mu_vertical_distortion(CaseList& list) {
    const TwinScales wood = list.scale({{"H", kLength}, {"mu", kWoodFriction}, {"rho", kWoodDensity}});
    const TwinScales aluminium = list.scale({{"H", kLength}, {"mu", kAluminiumFriction}, {"rho", kAluminiumDensity}});
    list.add_equal({slide}, wood);
    list.add_equal({slide}, aluminium);
    list.add(rock, wood);
    list.add(rock, aluminium);
    // heights as the widths, as the mu law would have it
    list.add(rock, wood, {BrokenGroup::height, kWoodFriction});
    list.add(rock, aluminium, {BrokenGroup::height, kAluminiumFriction});
    list.add(slide, aluminium, {BrokenGroup::friction, 2.0});
}

struct TriedLaw {
    std::string name;
    std::function<void(CaseList&)> add_cases;
};

const std::vector<TriedLaw>& tried_laws() {
    static const std::vector<TriedLaw> kLaws{
        {"mu", add_mu},
        {"froude", add_froude},
        {"exact", add_exact},
        {"cauchy", add_cauchy},
        {"centrifuge", add_centrifuge},
        {"true_replica", add_true_replica},
        {"artificial_mass", add_artificial_mass},
        {"gravity_distorted", add_gravity_distorted},
        {"restoring_force", add_restoring_force},
        {"restoring_rocking", add_restoring_rocking},
        {"restoring_spring", add_restoring_spring},
        {"restoring_cohesion", add_restoring_cohesion},
        {"restoring_mixed", add_restoring_mixed},
        {"mu_vertical_distortion", add_mu_vertical_distortion},
    };
    return kLaws;
}

std::vector<std::string> list_names() {
    std::vector<std::string> names;
    for (const TriedLaw& law : tried_laws()) names.push_back(law.name);
    return names;
}

}  // namespace

const std::vector<std::string>& similitude_law_names() {
    static const std::vector<std::string> kNames = list_names();
    return kNames;
}

std::vector<SimilitudeCase> make_similitude_cases(const std::string& law) {
    const std::vector<std::string>& names = similitude_law_names();
    if (!law.empty() && std::find(names.begin(), names.end(), law) == names.end()) {
        throw scaling::SimilitudeError(fmt::format("law: \"{}\" has no cases (known: {})", law, fmt::join(names, ", ")));
    }
    std::vector<SimilitudeCase> all;
    for (const TriedLaw& tried : tried_laws()) {
        if (!law.empty() && law != tried.name) continue;
        CaseList list(tried.name);
        tried.add_cases(list);
        for (SimilitudeCase& made : list.take()) all.push_back(std::move(made));
    }
    return all;
}

}  // namespace musim::lsdem
