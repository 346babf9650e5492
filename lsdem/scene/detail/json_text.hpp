#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lsdem/scene/scene_json.hpp"
#include "scaling/json_reader.hpp"

namespace musim::lsdem::detail {

using Json = scaling::JsonReader::Json;
using scaling::JsonPlace;

/// Whole content of a text file. Throws SceneError when it cannot be read.
std::string read_text(const std::filesystem::path& path);

/// JSON value of `text`. Throws SceneError with line and column (`origin:3:14: ...`) on a syntax error or a key given twice.
Json parse_json(std::string_view text, const std::string& origin);

/// Throws SceneError "origin: /path: message".
[[noreturn]] void fail(const JsonPlace& place, const std::string& message);

/// Scenes and materials: SceneError.
class SceneRules final : public scaling::JsonRules {
  public:
    /// `text` takes the JSON path of the first quantity that is a number without a unit, and notes on unit weights.
    explicit SceneRules(SceneText* text = nullptr) : text_(text) {}

    void raise(const std::string& message) const override { throw SceneError(message); }
    /// Says of a key that is unknown what musim has not, where that is what it asks for.
    std::string unknown(const std::string& place, const std::string& key, const std::vector<std::string>& known) const override;
    /// A density may be a unit weight γ: ρ = γ/g with standard gravity, whatever the scene's, since tables of unit weights mean that.
    double to_si(const scaling::JsonReader& value, scaling::Dimension dimension, std::string_view part) const override;

  private:
    SceneText* text_;
};

/// An object whose keys are all of a known kind (scene_keys), and whose comment, if it has one, is text.
scaling::JsonReader to_object(const scaling::JsonReader& value, const std::string& kind);

/// Position in `names` of a text. Throws SceneError, which lists them.
std::size_t to_choice(const scaling::JsonReader& value, const std::vector<std::string>& names);

/// Position in `kinds` of the text at `key`, which says what an object is and so which other keys it may have. Throws SceneError where it
/// is none of them.
std::size_t read_kind(const scaling::JsonReader& value, const std::string& key, const std::vector<std::string>& kinds);

/// A file named in a scene, beside the scene's own.
std::filesystem::path resolve(const std::string& file, const std::filesystem::path& origin);

}  // namespace musim::lsdem::detail
