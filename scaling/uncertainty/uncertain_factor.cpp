#include "scaling/uncertainty/uncertain_factor.hpp"

namespace musim::scaling {

std::vector<GivenFactor> values_of(const std::vector<UncertainFactor>& factors) {
    std::vector<GivenFactor> values;
    values.reserve(factors.size());
    for (const auto& [name, factor] : factors) values.push_back({name, factor.value()});
    return values;
}

}  // namespace musim::scaling
