#include "lsdem/scene/detail/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <set>
#include <system_error>

#include "lsdem/scene/detail/absent_features.hpp"
#include "scaling/json_text.hpp"
#include "scaling/nearest_name.hpp"
#include "scaling/number.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/regular_file.hpp"
#include "scaling/shorten.hpp"

namespace musim::lsdem::detail {

namespace {

/// "line:column" of a byte offset, both from 1.
std::string locate(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    return fmt::format("{}:{}", line, before.size() - line_start + 1);
}

/// Reason in nlohmann's message, after its own prefix and position.
std::string reason(const nlohmann::json::parse_error& error) {
    const std::string message = error.what();
    const std::size_t start = message.find(": ");
    return start == std::string::npos ? message : message.substr(start + 2);
}

/// A quantity in JSON that has no unit.
std::optional<double> find_plain_number(const Json& value) {
    if (value.is_number()) return value.get<double>();
    if (!value.is_string()) return std::nullopt;
    try {
        return scaling::parse_number(value.get_ref<const std::string&>());
    } catch (const scaling::ParseError&) {
        return std::nullopt;
    }
}

/// A weight per volume [N/m³], which has the dimension of a stiffness per area.
std::optional<double> find_unit_weight(const std::string& text) {
    try {
        return scaling::parse_si(text, scaling::dimension_of<scaling::StiffnessPerArea>());
    } catch (const scaling::ParseError&) {
        return std::nullopt;
    }
}

/// Refuses a key that an object already has: the parser would silently keep the last one.
class DuplicateKeys {
  public:
    explicit DuplicateKeys(const std::string& origin) : origin_(origin) {}

    void see(Json::parse_event_t event, const Json& value) {
        using Event = Json::parse_event_t;
        if (event == Event::object_start) open_.emplace_back();
        if (event == Event::object_end) open_.pop_back();
        if (event == Event::key && !open_.back().insert(value.get<std::string>()).second) {
            throw SceneError(fmt::format("{}: key \"{}\" is given twice in one object; keep one", origin_, value.get<std::string>()));
        }
    }

  private:
    const std::string& origin_;
    std::vector<std::set<std::string>> open_;
};

}  // namespace

std::string read_text(const std::filesystem::path& path) {
    const std::string obstacle = scaling::find_obstacle(path);
    if (!obstacle.empty()) throw SceneError(fmt::format("{}: cannot be read ({}); name a file", path.string(), obstacle));
    std::optional<std::string> text = scaling::read_regular_file(path);
    if (!text) {
        throw SceneError(fmt::format("{}: cannot be read ({}); check the name and its permissions", path.string(),
                                     std::error_code(errno, std::generic_category()).message()));
    }
    return *std::move(text);
}

Json parse_json(std::string_view text, const std::string& origin) {
    DuplicateKeys keys(origin);
    const auto check = [&](int depth, Json::parse_event_t event, const Json& value) {
        if (depth >= scaling::kMostJsonLevels) {
            throw SceneError(fmt::format("{}: nested in more than {} levels; correct the JSON", origin, scaling::kMostJsonLevels));
        }
        keys.see(event, value);
        return true;
    };
    try {
        return Json::parse(text, check);
    } catch (const nlohmann::json::parse_error& error) {
        const std::size_t byte = error.byte > 0 ? error.byte - 1 : 0;
        throw SceneError(
            fmt::format("{}:{}: not valid JSON ({}); correct the text there", origin, locate(text, byte), scaling::shorten(reason(error))));
    } catch (const nlohmann::json::out_of_range& error) {
        throw SceneError(fmt::format("{}: not valid JSON ({}); correct the number", origin, scaling::describe_json_error(error)));
    }
}

void fail(const JsonPlace& place, const std::string& message) { throw SceneError(fmt::format("{}: {}", place.text, message)); }

std::string SceneRules::unknown(const std::string& place, const std::string& key, const std::vector<std::string>& known) const {
    if (place.ends_with("/contact") && key == "stiffness") {
        return fmt::format(
            "{}: is no option any more (shared per contact, by the nodes that touch, the stiffness of a face has no potential, and runs "
            "diverge: docs/theory/surface_nodes.md); leave it out, faces share theirs by area",
            at(place, key));
    }
    const std::optional<std::string> absent = describe_absent_feature(key);
    // a known key that is spelled like it and is of the same matter was meant
    if (!absent || describe_absent_feature(scaling::find_nearest_name(key, known))) return JsonRules::unknown(place, key, known);
    return fmt::format("{}: unknown key \"{}\": {}", at(place, key), key, *absent);
}

double SceneRules::to_si(const scaling::JsonReader& value, scaling::Dimension dimension, std::string_view part) const {
    // zero is the same in every unit
    const std::optional<double> plain = find_plain_number(value.json());
    if (text_ != nullptr && text_->plain_number.empty() && plain.value_or(0.0) != 0.0) {
        text_->plain_number = value.place().substr(value.place().find(": /") + 2);
    }
    if (dimension == scaling::dimension_of<scaling::Density>() && !plain && value.json().is_string()) {
        if (const std::optional<double> weight = find_unit_weight(value.text())) {
            const double density = *weight / scaling::kStandardGravity.value();
            if (text_ != nullptr) {
                text_->notes.push_back(fmt::format("{}: a unit weight, taken as {:.6g} kg/m^3 (over standard gravity, 9.80665 m/s^2)",
                                                   value.place(), density));
            }
            return density;
        }
    }
    return JsonRules::to_si(value, dimension, part);
}

scaling::JsonReader to_object(const scaling::JsonReader& value, const std::string& kind) {
    const scaling::JsonReader object = value.object(scene_keys().at(kind));
    if (!object.json().contains("comment")) return object;
    const scaling::JsonReader comment = object.at("comment");
    const auto is_text = [](const Json& line) { return line.is_string(); };
    if (!is_text(comment.json()) && !(comment.json().is_array() && std::all_of(comment.json().begin(), comment.json().end(), is_text))) {
        comment.fail("a text or a list of texts is wanted; correct the value");
    }
    return object;
}

std::size_t to_choice(const scaling::JsonReader& value, const std::vector<std::string>& names) {
    const std::string name = value.text();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        value.fail(fmt::format("\"{}\" is not known{}; use one of {}", name, scaling::hint_at_name(name, names), fmt::join(names, ", ")));
    }
    return static_cast<std::size_t>(found - names.begin());
}

std::size_t read_kind(const scaling::JsonReader& value, const std::string& key, const std::vector<std::string>& kinds) {
    if (!value.json().is_object() || !value.json().contains(key)) {
        value.fail(fmt::format("an object with a \"{}\" is wanted ({}); add it", key, fmt::join(kinds, ", ")));
    }
    const std::string kind = value.at(key).text();
    const auto found = std::find(kinds.begin(), kinds.end(), kind);
    if (found == kinds.end()) value.at(key).fail(fmt::format("\"{}\" is not known; {}", kind, scaling::suggest_name(kind, kinds)));
    return static_cast<std::size_t>(found - kinds.begin());
}

std::filesystem::path resolve(const std::string& file, const std::filesystem::path& origin) {
    return std::filesystem::absolute(origin.parent_path() / file).lexically_normal();
}

}  // namespace musim::lsdem::detail
