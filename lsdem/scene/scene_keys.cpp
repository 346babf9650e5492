#include "lsdem/scene/scene_json.hpp"

namespace musim::lsdem::scene {

const std::map<std::string, std::vector<std::string>>& scene_keys() {
    static const std::map<std::string, std::vector<std::string>> kKeys = {
        {"scene",
         {"schema", "name", "gravity", "material", "materials", "shape", "structure", "base_motion", "motions", "ground", "contact", "time",
          "output", "accuracy", "preparation"}},
        {"material", {"preset", "density", "normal_stiffness", "shear_stiffness", "friction", "restitution", "shear_damping_ratio"}},
        {"material_file", {"schema", "name", "block", "material"}},
        {"shape", {"kind", "level_set", "nodes_per_face", "nodes", "voxel", "radius"}},
        {"blocks", {"kind", "blocks"}},
        {"block", {"size", "position", "quaternion", "velocity", "angular_velocity", "fixed", "rotation_locked", "material"}},
        {"column", {"kind", "layers", "block", "rotation_locked", "height_deviation", "seed"}},
        {"tower", {"kind", "layers", "block", "pitch", "tiling", "height_deviation", "seed"}},
        {"tiling", {"cells_across", "inner_radius", "outer_radius", "file"}},
        {"wall", {"kind", "layers", "blocks_per_layer", "block", "pitch", "height_deviation", "seed"}},
        {"record", {"record", "components", "unit", "quantity", "dt", "window", "highpass", "scale", "factors"}},
        {"components", {"x", "y", "z"}},
        {"scale", {"law", "length", "friction", "gravity", "density", "set"}},
        {"factors", {"time", "velocity", "velocity_vertical"}},
        {"step", {"signal", "direction", "start", "factors", "velocity"}},
        {"sine", {"signal", "direction", "start", "factors", "dt", "amplitude", "frequency", "cycles"}},
        {"half_sine", {"signal", "direction", "start", "factors", "dt", "amplitude", "duration"}},
        {"ricker", {"signal", "direction", "start", "factors", "dt", "amplitude", "frequency"}},
        {"synthetic", {"signal", "direction", "start", "factors", "dt", "pga", "pgv", "duration", "seed"}},
        {"motion", {"name", "base_motion", "duration", "settle", "repeat"}},
        {"ground", {"present", "friction"}},
        {"contact", {"nodes", "stiffness", "faces", "spacing"}},
        {"preparation", {"placing", "damping_rate", "specimen"}},
        {"time", {"duration", "step", "safety"}},
        {"output", {"spine_rate", "frame_rate"}},
    };
    return kKeys;
}

}  // namespace musim::lsdem::scene
