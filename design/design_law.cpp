#include "design/design_law.hpp"

#include <algorithm>
#include <utility>

namespace musim::design {

DesignLaw::DesignLaw(scaling::Law law) : name_(to_string(law)), plain_(law) {}

DesignLaw::DesignLaw(scaling::ScaleLaw law, std::vector<scaling::GivenFactor> set) : name_(law.name), set_(std::move(set)) {
    check_law(law);
    data_ = std::make_shared<const scaling::ScaleLaw>(std::move(law));
}

bool DesignLaw::sets(std::string_view quantity) const {
    return std::any_of(set_.begin(), set_.end(), [&](const scaling::GivenFactor& factor) { return factor.name == quantity; });
}

bool DesignLaw::expects(std::string_view quantity) const {
    const std::vector<scaling::LawChoice>& choices = data_->choices;
    return std::any_of(choices.begin(), choices.end(), [&](const scaling::LawChoice& choice) { return choice.name == quantity; });
}

bool DesignLaw::has(std::string_view quantity) const {
    const std::vector<scaling::LawQuantity>& quantities = data_->quantities;
    return std::any_of(quantities.begin(), quantities.end(), [&](const auto& each) { return each.quantity.name == quantity; });
}

bool DesignLaw::operator==(const DesignLaw& other) const {
    const auto same = [](const scaling::GivenFactor& a, const scaling::GivenFactor& b) { return a.name == b.name && a.factor == b.factor; };
    return name_ == other.name_ && plain_ == other.plain_ &&
           std::equal(set_.begin(), set_.end(), other.set_.begin(), other.set_.end(), same);
}

}  // namespace musim::design
