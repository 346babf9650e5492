#include "lsdem/scene/accuracy_presets.hpp"

#include <array>
#include <cstddef>

namespace musim::lsdem::scene {

const AccuracyPreset& find_accuracy_preset(Accuracy accuracy) {
    static constexpr std::array<AccuracyPreset, 3> kPresets{
        {{.nodes_per_face = 20}, {.nodes_per_face = 40}, {.nodes_per_face = 440, .spacing = PatchSpacing::lobatto, .safety = 0.2}}};
    return kPresets[static_cast<std::size_t>(accuracy)];
}

const std::vector<std::string>& accuracy_names() {
    static const std::vector<std::string> kNames{"fast", "standard", "reference"};
    return kNames;
}

std::string to_string(Accuracy accuracy) { return accuracy_names()[static_cast<std::size_t>(accuracy)]; }

}  // namespace musim::lsdem::scene
