#include "lsdem/scene/accuracy_presets.hpp"

#include <array>
#include <cstddef>

namespace musim::lsdem {

const AccuracyPreset& find_accuracy_preset(Accuracy accuracy) {
    static constexpr std::array<AccuracyPreset, 3> kPresets{{{.safety = 0.8}, {.safety = 0.4}, {.safety = 0.1}}};
    return kPresets[static_cast<std::size_t>(accuracy)];
}

const std::vector<std::string>& accuracy_names() {
    static const std::vector<std::string> kNames{"fast", "standard", "reference"};
    return kNames;
}

std::string to_string(Accuracy accuracy) { return accuracy_names()[static_cast<std::size_t>(accuracy)]; }

}  // namespace musim::lsdem
