#include "lsdem/scene/preparation.hpp"

namespace musim::lsdem {

const std::vector<std::string>& placing_names() {
    static const std::vector<std::string> kNames{"as_drawn", "resting", "layers", "layers_mass_scaled"};
    return kNames;
}

std::string to_string(BlockPlacing placing) { return placing_names()[static_cast<std::size_t>(placing)]; }

}  // namespace musim::lsdem
