#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "lsdem/response/field_picture.hpp"
#include "lsdem/results/write_results.hpp"

namespace musim::lsdem {

/// Which frames of a run move, and how.
struct AnimationSettings {
    std::vector<std::size_t> frames;  ///< in the order in which they are shown, one at least
    CameraSettings camera;
    FieldPicture picture;                          ///< limit 0: the largest velocity that any frame shows
    int threads = 0;                               ///< pictures drawn at a time; 0: all cores. They are the same for any number
    std::function<void(double)> on_progress = {};  ///< fraction done, from any thread
};

/// Names of the pictures of an animation, as printf has it: "field_00001.png" is the first.
inline constexpr const char* kAnimationFrames = "field_%05d.png";

/// Adds one PNG per frame to a folder; where the colours end [m/s]. Throws records::WriteError when musim was built without PNG.
double add_animation_frames(ResultFolder& folder, const StoredRun& run, const AnimationSettings& settings);

/// Film of the pictures that add_animation_frames() left in a folder. `file` ends with .mp4 (H.264) or .gif; `rate`: pictures a second.
/// The file is complete or absent; the pictures stay. Throws records::WriteError when there is no ffmpeg, or it fails.
void write_film(const std::filesystem::path& pictures, const std::filesystem::path& file, double rate);

/// Is there an ffmpeg on the PATH?
bool can_write_film();

}  // namespace musim::lsdem
