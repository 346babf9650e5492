#include "lsdem/scene/detail/absent_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace musim::lsdem::detail {
namespace {

/// Something that musim has not, and words of keys that ask for it, or whole keys; small letters, without a plural's s.
struct AbsentFeature {
    const char* what;  ///< behind "musim has no"
    std::vector<std::string_view> words;
};

/// See docs/theory/limits.md, which says the same.
const std::vector<AbsentFeature>& absent_features() {
    static const std::vector<AbsentFeature> kFeatures{
        AbsentFeature{"fluid (blocks stand in nothing: no water, no buoyancy, no pore pressure, no wind)",
                      {"fluid", "water", "buoyancy", "pore", "hydrodynamic", "wind", "drag"}},
        AbsentFeature{"reinforcement (blocks are not held by bars, strips or fibres)", {"reinforcement", "rebar", "fiber", "fibre", "frp"}},
        AbsentFeature{"mortar (joints are dry)", {"mortar", "grout", "glue", "adhesive"}},
        AbsentFeature{"contact that bears tension (joints are dry: neither cohesion nor bond)",
                      {"cohesion", "cohesive", "tension", "tensile", "bond", "bonded", "adhesion"}},
        AbsentFeature{"connection between blocks but their contacts (no springs, ties, tendons, dowels or bolts)",
                      {"spring", "tie", "cable", "tendon", "anchor", "prestress", "clamp", "dowel", "bolt", "connector"}},
        AbsentFeature{"damper or isolator (what damps is the contacts' restitution and \"shear_damping_ratio\")",
                      {"damper", "damping", "isolator", "isolation", "bearing", "rayleigh", "viscosity"}},
        AbsentFeature{"load but weight, the motion of the base and \"loads\" at points of blocks",
                      {"load", "force", "pressure", "impact", "moment", "explosion", "blast"}},
        AbsentFeature{
            "block that bends or breaks (blocks are rigid; elasticity is that of the contacts, \"normal_stiffness\" is E A/H)",
            {"young", "youngs", "modulus", "elasticity", "poisson", "poissons", "strength", "fracture", "crushing", "plasticity", "creep"}},
        AbsentFeature{"friction but Coulomb's with one coefficient, the tangent of the friction angle",
                      {"kinetic", "rolling", "static_friction", "dynamic_friction", "friction_angle", "dilation", "dilatancy", "dilatation",
                       "roughness"}},
        AbsentFeature{"soil (the ground is a rigid plane that does not turn)", {"soil", "foundation", "subgrade"}},
        AbsentFeature{"shape but boxes, spheres and voxel grids",
                      {"mesh", "stl", "obj", "polyhedron", "hull", "vertice", "cylinder", "wedge", "arch", "drum"}},
        AbsentFeature{"temperature", {"temperature", "thermal", "expansion"}}};
    return kFeatures;
}

/// The next word of a key: letters up to a mark or a capital letter.
std::string take_word(std::string_view& key) {
    const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
    const auto is_capital = [](char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; };
    while (!key.empty() && !is_letter(key.front())) key.remove_prefix(1);
    std::string word;
    while (!key.empty() && is_letter(key.front()) && (word.empty() || !is_capital(key.front()))) {
        word += static_cast<char>(std::tolower(static_cast<unsigned char>(key.front())));
        key.remove_prefix(1);
    }
    if (word.size() > 3 && word.ends_with('s')) word.pop_back();
    return word;
}

}  // namespace

std::optional<std::string> describe_absent_feature(std::string_view key) {
    std::vector<std::string> words{std::string(key)};
    for (std::string word = take_word(key); !word.empty(); word = take_word(key)) words.push_back(word);
    for (const AbsentFeature& feature : absent_features()) {
        if (std::find_first_of(feature.words.begin(), feature.words.end(), words.begin(), words.end()) == feature.words.end()) continue;
        return fmt::format("musim has no {}; see Limits, docs/theory/limits.md", feature.what);
    }
    return std::nullopt;
}

}  // namespace musim::lsdem::detail
