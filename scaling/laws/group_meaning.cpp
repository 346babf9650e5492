#include "scaling/laws/group_meaning.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>

namespace musim::scaling {

namespace {

bool has_quantity(const SolvedLaw& solved, std::string_view name) {
    const std::vector<PiQuantity>& quantities = solved.problem.quantities;
    return std::any_of(quantities.begin(), quantities.end(), [&](const PiQuantity& each) { return each.name == name; });
}

bool is_kept(const SolvedLaw& solved, const std::string& number, const std::vector<std::string>& quantities) {
    if (!std::all_of(quantities.begin(), quantities.end(), [&](const std::string& name) { return has_quantity(solved, name); })) {
        return false;
    }
    ScaleProblem problem = solved.problem;
    problem.watched = {parse_scale_product(number, problem.quantities)};
    const std::vector<Rational> exponents = solve_scales(problem).watched.front().exponents;
    return std::all_of(exponents.begin(), exponents.end(), [](const Rational& exponent) { return exponent == 0; });
}

using enum GroupClass;

constexpr RequiringLaws kAll{.mu = true, .froude = true, .cauchy = true};
constexpr RequiringLaws kSliding{.mu = true, .froude = true, .cauchy = false};
constexpr RequiringLaws kWeight{.mu = false, .froude = true, .cauchy = false};
constexpr RequiringLaws kMaking{.mu = false, .froude = true, .cauchy = true};  // of bodies, whatever drives them
constexpr RequiringLaws kElastic{.mu = false, .froude = false, .cauchy = true};
constexpr RequiringLaws kExactOnly{};

constexpr std::string_view kTooLong = "it lasts too long for the sliding time of the structure";
constexpr std::string_view kTooShort = "it is too short for the sliding time of the structure";
constexpr std::string_view kDerived = "derived";

constexpr GroupMeaning kMeanings[] = {
    {"H/(lambda_l*H_prototype)",
     geometry,
     kAll,
     "blocks are taller than the chosen scale says; lengths scale back by the true one, this times the chosen",
     "blocks are lower than the chosen scale says; lengths scale back by the true one, this times the chosen",
     {"Buckingham14"}},
    {"b/H",
     geometry,
     kAll,
     "blocks are stockier across their thin side: they rock later and lose more at each impact",
     "blocks are more slender across their thin side: they rock earlier and lose less at each impact",
     {"Housner63"}},
    {"w/H",
     geometry,
     kAll,
     "blocks are stockier across their wide side: they rock later and lose more at each impact",
     "blocks are more slender across their wide side: they rock earlier and lose less at each impact",
     {"Housner63"}},
    {"N",
     geometry,
     kAll,
     "more interfaces: the base carries more blocks, and slip spreads over more levels",
     "fewer interfaces: the base carries fewer blocks, and slip spreads over fewer levels",
     {"Andrade22", kDerived}},
    {"blocks/layer",
     geometry,
     kAll,
     "more blocks share a layer: another tiling, other load paths",
     "fewer blocks share a layer: another tiling, other load paths",
     {"Andrade22"}},
    {"gap/H",
     geometry,
     kAll,
     "neighbours meet later: more slip and rocking before they lean on each other",
     "neighbours meet sooner: less slip and rocking before they lean on each other",
     {kDerived}},
    {"edge_radius/H",
     geometry,
     kMaking,
     "edges are rounder: blocks rock about a narrower base, hence earlier",
     "edges are sharper: blocks rock about a wider base, hence later",
     {kDerived}},
    {"sigma_H/H",
     geometry,
     kMaking,
     "blocks are less even: fewer of them carry, and the structural speed falls",
     "blocks are more even: more of them carry, and the structural speed rises",
     {"Harmon23"}},
    {"mu",
     friction,
     kMaking,
     "interfaces hold more of the weight: slip in combined motion does not scale back",
     "interfaces hold less of the weight: slip in combined motion does not scale back",
     {"Andrade22"}},
    {"mu_ground/mu",
     friction,
     kAll,
     "the lowest layer holds the ground better than layers hold each other: slip moves up from the ground",
     "the lowest layer holds the ground worse than layers hold each other: slip at the ground spares the structure",
     {kDerived}},
    {"mu_kinetic/mu",
     friction,
     kAll,
     "friction falls less once blocks slide: slip stops sooner",
     "friction falls more once blocks slide: slip runs on, and sticking is more abrupt",
     {kDerived}},
    {"kappa_n",
     contact,
     kExactOnly,
     "contacts are harder under the block's weight: they close fewer of the uneven gaps",
     "contacts are softer under the block's weight: they close more of the uneven gaps",
     {kDerived}},
    {"k_s/k_n",
     contact,
     kElastic,
     "interfaces are harder in shear: more of their deformation is normal, towers bend more than they shear",
     "interfaces are softer in shear: less of their deformation is normal, towers shear more than they bend",
     {kDerived}},
    {"c_res",
     contact,
     kMaking,
     "impacts lose less: blocks bounce and rock on for longer",
     "impacts lose more: bouncing and rocking die sooner",
     {"SchwagerPoeschel07", "Housner63"}},
    {"delta_w/sigma_H",
     contact,
     kExactOnly,
     "dead weight closes more of the uneven gaps: more blocks carry",
     "dead weight closes fewer of the uneven gaps: fewer blocks carry",
     {"Harmon23", kDerived}},
    {"S_e^N",
     contact,
     kExactOnly,
     "the elastic front climbs faster against the sliding motion: the top answers sooner",
     "the elastic front climbs more slowly against the sliding motion: the top answers later",
     {"Rosakis21", kDerived}},
    {"C^N",
     contact,
     kElastic,
     "normal contact waves are slower against the motion: contacts settle later",
     "normal contact waves are quicker against the motion: contacts settle sooner",
     {kDerived}},
    {"mu/tan(alpha)",
     rocking,
     kWeight,
     "blocks grip better for their width: rocking takes a larger share of the motion",
     "blocks grip worse for their width: sliding takes a larger share of the motion",
     {"ShentonJones91", "Shenton96"}},
    {"a/(g*tan(alpha))",
     rocking,
     kWeight,
     "rocking starts at a smaller share of the shaking: blocks rock more",
     "rocking starts at a larger share of the shaking: blocks rock less",
     {"Housner63"}},
    {"omega/p",
     rocking,
     kWeight,
     "a rocking block seems larger to the shaking than it is: harder to overturn",
     "a rocking block seems smaller to the shaking than it is: easier to overturn",
     {"Makris14", "ZhangMakris01"}},
    {"e_r",
     rocking,
     kWeight,
     "rocking loses less at each impact: it dies later",
     "rocking loses more at each impact: it dies sooner",
     {"Housner63"}},
    {"mu^N",
     loading,
     kSliding,
     "the shaking is fast for the sliding strength: blocks slip farther for their size",
     "the shaking is slow for the sliding strength: blocks slip less far for their size",
     {"Andrade22", "Newmark65"}},
    {"a/(mu*g)",
     loading,
     kSliding,
     "sliding starts at a smaller share of the shaking: blocks slip more",
     "sliding starts at a larger share of the shaking: blocks slip less",
     {"Andrade22", "Newmark65"}},
    {"a/g",
     loading,
     kWeight,
     "the shaking is strong against weight: uplift and changes of normal forces are larger",
     "the shaking is weak against weight: uplift and changes of normal forces are smaller",
     {"Housner63"}},
    {"Fr^N",
     loading,
     kWeight,
     "the shaking is fast against falls and rocking: their velocities do not scale back",
     "the shaking is slow against falls and rocking: their velocities do not scale back",
     {"MoncarzKrawinkler81"}},
    {"PGD/l",
     loading,
     kAll,
     "the base moves farther for the size of the structure",
     "the base moves less far for the size of the structure",
     {"Buckingham14"}},
    {"a_vertical/g",
     loading,
     kWeight,
     "vertical shaking changes normal forces, hence friction, by a larger share",
     "vertical shaking changes normal forces, hence friction, by a smaller share",
     {kDerived}},
    {"direction",
     loading,
     kAll,
     "the shaking is turned to the blocks' wide side, where they rock later",
     "the shaking is turned to the blocks' thin side, where they rock earlier",
     {"Housner63"}},
    {"t*sqrt(mu*g/l)", loading, kSliding, kTooLong, kTooShort, {"Andrade22"}},
    {"T_D*sqrt(mu*g/l)", loading, kSliding, kTooLong, kTooShort, {"Andrade22"}},
    {"T_p*sqrt(mu*g/l)", loading, kSliding, kTooLong, kTooShort, {"Andrade22"}},
    {"T_pulse*sqrt(mu*g/l)", loading, kSliding, kTooLong, kTooShort, {"Andrade22"}},
    {"dt*sqrt(mu*g/l)",
     loading,
     kSliding,
     "the record's samples are coarser for the sliding time: sharp changes of the shaking are lost",
     "the record's samples are finer for the sliding time",
     {kDerived}},
};

}  // namespace

KeptNumbers find_kept_numbers(const SolvedLaw& solved) {
    // squares of the numbers, with the acceleration l/t² that such a law has in one form or the other
    const bool by_time = has_quantity(solved, "t");
    const std::string acceleration = by_time ? "l/t^2" : "a";
    std::vector<std::string> moving{by_time ? "t" : "a"};
    const auto with = [&](std::initializer_list<const char*> more) {
        std::vector<std::string> names = moving;
        names.insert(names.end(), more.begin(), more.end());
        return names;
    };
    return {.mu = is_kept(solved, acceleration + "/(mu*g)", with({"mu", "g", "l"})),
            .froude = is_kept(solved, acceleration + "/g", with({"g", "l"})),
            .cauchy = is_kept(solved, acceleration + "*rho*l/E", with({"rho", "E", "l"}))};
}

std::string_view to_string(GroupClass kind) {
    constexpr std::string_view kNames[] = {"geometry", "friction", "contact", "rocking", "loading"};
    return kNames[static_cast<std::size_t>(kind)];
}

bool GroupMeaning::is_required_by(const KeptNumbers& kept) const {
    if (kept.froude && kept.cauchy) return true;
    const bool by_all = laws.mu && laws.froude && laws.cauchy;
    return by_all || (kept.mu && laws.mu) || (kept.froude && laws.froude) || (kept.cauchy && laws.cauchy);
}

std::vector<std::string> GroupMeaning::list_sources() const {
    std::vector<std::string> keys;
    for (const std::string_view source : sources) {
        if (!source.empty()) keys.emplace_back(source);
    }
    return keys;
}

const GroupMeaning& find_group_meaning(std::string_view name) {
    const auto* const found =
        std::find_if(std::begin(kMeanings), std::end(kMeanings), [&](const GroupMeaning& meaning) { return meaning.name == name; });
    if (found == std::end(kMeanings)) throw std::out_of_range("no group is called " + std::string(name));
    return *found;
}

}  // namespace musim::scaling
