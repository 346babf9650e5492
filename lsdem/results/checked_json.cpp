#include "lsdem/results/checked_json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "lsdem/results/checksum.hpp"
#include "lsdem/results/result_error.hpp"
#include "scaling/error.hpp"
#include "scaling/json_text.hpp"
#include "scaling/regular_file.hpp"

namespace musim::lsdem {
namespace {

constexpr const char* kChecksum = "checksum";

std::string hash_rest(nlohmann::json object) {
    object.erase(kChecksum);
    // what is no UTF-8 is damage, not a mistake of ours
    return detail::name_content(object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

[[noreturn]] void refuse_json(const std::filesystem::path& file, const std::string& what) {
    throw ResultError(fmt::format("{}: {}; make it again with the command that made it", file.string(), what));
}

}  // namespace

std::string make_checked_json(nlohmann::json object) {
    object[kChecksum] = hash_rest(object);
    return object.dump(2) + "\n";
}

bool agrees_with_checksum(const nlohmann::json& object) {
    return object.is_object() && object.contains(kChecksum) && object[kChecksum] == hash_rest(object);
}

nlohmann::json read_checked_json(const std::filesystem::path& file) {
    const std::string obstacle = scaling::find_obstacle(file);
    const std::optional<std::string> text = scaling::read_regular_file(file);
    if (!text) refuse_json(file, fmt::format("cannot be read ({})", obstacle.empty() ? "no permission" : obstacle));
    nlohmann::json object;
    try {
        object = scaling::parse_json_text(*text);
    } catch (const scaling::ParseError&) {
        // no object, which is said below
    }
    if (!object.is_object()) refuse_json(file, "is damaged (it is cut off, or no JSON object)");
    if (!object.contains(kChecksum)) refuse_json(file, "has no checksum (it is damaged, or an older musim wrote it)");
    if (!agrees_with_checksum(object)) refuse_json(file, "is damaged (its checksum does not match)");
    return object;
}

}  // namespace musim::lsdem
