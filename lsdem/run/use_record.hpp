#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/scene/scene.hpp"
#include "records/formats/read_record.hpp"

namespace musim::lsdem {

/// Names of a record's components along x, y, z; nothing leaves an axis at rest.
using AxisComponents = std::array<std::optional<std::string>, 3>;

/// Replaces a scene's base motion by the strong motion of a recorded one, and its duration by the length of that.
///
/// With no component named, the one with the largest PGA among the horizontal ones (those with an azimuth; all, when no azimuth is known)
/// goes along x. The window is records::find_base_window of the components used; the high-pass corner is the record's own (0.05 Hz for
/// uncorrected records). The scene then names the options of reading it. Returns what was done, one line each. Throws records::ReadError
/// and records::ProcessingError.
std::vector<std::string> use_record(Scene& scene, const std::filesystem::path& file, const AxisComponents& components,
                                    const records::ReadOptions& reading = {}, records::AtRest at_rest = records::AtRest::home);

/// Lets the record that a scene uses be of a prototype, of which the scene is a model by a law (RecordScale); its duration is then the
/// model's. Nothing is done where every factor is 1. Throws scaling::SimilitudeError. Requires a record.
void scale_record(Scene& scene, const RecordScale& scale);

}  // namespace musim::lsdem
