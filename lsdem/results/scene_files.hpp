#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "lsdem/scene/scene.hpp"

/// The files that a scene names: records, tilings, specimens.
namespace musim::lsdem::study {

/// The scene with every path of a file replaced by what `name` makes of it.
scene::Scene rename_files(scene::Scene scene, const std::function<std::string(const std::filesystem::path&)>& name);

/// The scene with hashes of their contents in place of its files' paths. Throws records::ReadError for a file that cannot be read.
scene::Scene with_file_contents(const scene::Scene& scene);

}  // namespace musim::lsdem::study
