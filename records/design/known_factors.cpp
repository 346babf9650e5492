#include "records/design/known_factors.hpp"

namespace musim::records {

std::vector<scaling::GivenFactor> give_factors(const DesignLaw& law, const KnownFactors& known) {
    std::vector<scaling::GivenFactor> given = law.set();
    given.push_back(known.length);
    if (law.has("mu")) given.push_back({"mu", known.friction});
    if (law.has("rho")) given.push_back({law.has("rho_s") ? "rho_s" : "rho", known.density});
    if (known.gravity && law.has("g") && !law.sets("g")) given.push_back({"g", *known.gravity});
    for (const KnownProperty& property : known.properties) {
        if (property.factor && law.expects(property.name) && !law.sets(property.name)) given.push_back({property.name, *property.factor});
    }
    return given;
}

}  // namespace musim::records
