#include "records/design/design_law.hpp"

#include <algorithm>
#include <utility>

namespace musim::records {

namespace {

/// Spelling by laws of groups that scaling::group_factors() gives by name.
struct CommonGroup {
    const char* name;
    const char* product;
    std::vector<std::string> quantities;
};

const std::vector<CommonGroup>& common_groups() {
    static const std::vector<CommonGroup> kGroups{{"mu^N", "v/sqrt(mu*g*l)", {"v", "mu", "g", "l"}},
                                                  {"t*sqrt(mu*g/l)", "t*sqrt(mu*g/l)", {"t", "mu", "g", "l"}},
                                                  {"a/(mu*g)", "a/(mu*g)", {"a", "mu", "g"}},
                                                  {"a/g", "a/g", {"a", "g"}},
                                                  {"a/(g*tan(alpha))", "a/(g*tan_alpha)", {"a", "g", "tan_alpha"}},
                                                  {"a_vertical/g", "a_v/g", {"a_v", "g"}},
                                                  {"Fr^N", "v/sqrt(g*l)", {"v", "g", "l"}},
                                                  {"mu/tan(alpha)", "mu/tan_alpha", {"mu", "tan_alpha"}},
                                                  {"mu", "mu", {"mu"}}};
    return kGroups;
}

/// The law's products that are one of them, in whatever way they are written.
std::map<std::string, std::string> find_common_names(const scaling::ScaleLaw& law) {
    const std::vector<scaling::PiQuantity> quantities = quantities_of(law);
    const auto has = [&](const std::string& name) {
        return std::any_of(quantities.begin(), quantities.end(), [&](const scaling::PiQuantity& each) { return each.name == name; });
    };
    std::vector<std::pair<std::string, std::vector<scaling::Rational>>> products;
    for (const std::vector<std::string>* list : {&law.held, &law.watched}) {
        for (const std::string& text : *list) products.emplace_back(text, parse_scale_product(text, quantities).exponents);
    }
    std::map<std::string, std::string> names;
    for (const CommonGroup& group : common_groups()) {
        if (!std::all_of(group.quantities.begin(), group.quantities.end(), has)) continue;
        const auto exponents = parse_scale_product(group.product, quantities).exponents;
        for (const auto& [text, own_exponents] : products) {
            if (own_exponents == exponents) names.emplace(text, group.name);
        }
    }
    return names;
}

}  // namespace

DesignLaw::DesignLaw(scaling::ScaleLaw law, std::vector<scaling::GivenFactor> set) : name_(law.name), set_(std::move(set)) {
    check_law(law);
    common_names_ = find_common_names(law);
    law_ = std::make_shared<const scaling::ScaleLaw>(std::move(law));
}

bool DesignLaw::sets(std::string_view quantity) const {
    return std::any_of(set_.begin(), set_.end(), [&](const scaling::GivenFactor& factor) { return factor.name == quantity; });
}

bool DesignLaw::expects(std::string_view quantity) const {
    const std::vector<scaling::LawChoice>& choices = law_->choices;
    return std::any_of(choices.begin(), choices.end(), [&](const scaling::LawChoice& choice) { return choice.name == quantity; });
}

bool DesignLaw::has(std::string_view quantity) const {
    const std::vector<scaling::LawQuantity>& quantities = law_->quantities;
    return std::any_of(quantities.begin(), quantities.end(), [&](const auto& each) { return each.quantity.name == quantity; });
}

std::optional<std::string> DesignLaw::find_common_name(const std::string& product) const {
    const auto place = common_names_.find(product);
    return place == common_names_.end() ? std::nullopt : std::optional(place->second);
}

bool DesignLaw::operator==(const DesignLaw& other) const {
    const auto same = [](const scaling::GivenFactor& a, const scaling::GivenFactor& b) { return a.name == b.name && a.factor == b.factor; };
    return name_ == other.name_ && std::equal(set_.begin(), set_.end(), other.set_.begin(), other.set_.end(), same);
}

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
