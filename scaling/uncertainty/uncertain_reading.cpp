#include "scaling/uncertainty/uncertain_reading.hpp"

#include <fmt/format.h>

namespace musim::scaling {

double UncertainReading::take(const std::string& place, const Uncertain& quantity, const RationalDimension& dimension) {
    if (!quantity.is_uncertain()) return quantity.value;
    const std::string prefix = source_ + ": ";
    const std::string base = place.starts_with(prefix) ? place.substr(prefix.size()) : place;
    std::string name = base;
    int namesakes = 1;
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
        if (inputs_[i].name != name) continue;
        const Uncertain& known = inputs_[i].quantity;
        if (known.value == quantity.value && known.uncertainty == quantity.uncertainty) {
            if (!drawn_.empty()) return drawn_[i];
            return i == moved_ ? factor_ * quantity.value : quantity.value;
        }
        name = fmt::format("{} ({})", base, ++namesakes);
    }
    inputs_.push_back({name, quantity, dimension});
    return quantity.value;
}

UncertainReading UncertainReading::move(std::size_t input, double factor) const {
    UncertainReading moved = *this;
    moved.moved_ = input;
    moved.factor_ = factor;
    return moved;
}

UncertainReading UncertainReading::draw(std::span<const double> values) const {
    UncertainReading drawn = *this;
    drawn.drawn_.assign(values.begin(), values.end());
    return drawn;
}

SimilitudeError UncertainReading::refuse_draw(const std::string& why) const {
    return SimilitudeError(fmt::format(
        "{}: a sample of the uncertain values is refused ({}); give smaller uncertainties, or choose another distribution", source_, why));
}

}  // namespace musim::scaling
