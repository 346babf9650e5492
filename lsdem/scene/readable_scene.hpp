#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lsdem/scene/scene.hpp"

namespace musim::lsdem {

/// Text of a scene for people.
struct ReadableText {
    /// Comments by the JSON pointer of their object: "" is the scene itself, "/structure" its structure.
    std::map<std::string, std::vector<std::string>> comments = {};
    /// JSON pointers of settings that are written although they have their defaults: "/time/safety".
    std::set<std::string> kept = {};
    /// Where the file is to be: a record in or below this folder is named as seen from there, others, or all where it is not known, by
    /// their absolute path.
    std::optional<std::filesystem::path> folder = {};
};

/// A scene as JSON text for people to change: quantities as texts with units, to seven digits, and without the settings that have their
/// defaults. parse_scene reads the text back, in `folder`. Throws SceneError for a scene that check_scene refuses.
std::string write_readable_scene(const Scene& scene, const ReadableText& text);

}  // namespace musim::lsdem
