#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "lsdem/scene/scene.hpp"

/// The files that a scene names: records, tilings, specimens.
namespace musim::lsdem {

/// The scene with every path of a file replaced by what `name` makes of it.
Scene rename_files(Scene scene, const std::function<std::string(const std::filesystem::path&)>& name);

/// The scene with hashes of their contents in place of its files' paths. Throws records::ReadError for a file that cannot be read.
Scene with_file_contents(const Scene& scene);

}  // namespace musim::lsdem
