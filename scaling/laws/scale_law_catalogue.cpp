#include "scaling/laws/scale_law_catalogue.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <mutex>

#include "scaling/laws/law_texts.hpp"
#include "scaling/laws/scale_law_json.hpp"
#include "scaling/nearest_name.hpp"
#include "scaling/regular_file.hpp"

namespace musim::scaling {

namespace {

/// A law that comes with musim, read when it is asked for first: reading its laws was 0.39 of the time of a design's sample. Another law
/// may extend it, so each has a flag of its own.
struct ShippedLaw {
    std::string_view json;
    std::once_flag is_read;
    ScaleLaw law;

    explicit ShippedLaw(std::string_view text) : json(text) {}
};

std::map<std::string_view, ShippedLaw>& shipped_laws() {
    static std::map<std::string_view, ShippedLaw> laws = [] {
        std::map<std::string_view, ShippedLaw> all;
        for (const detail::LawText& law : detail::law_texts()) all.try_emplace(law.name, law.json);
        return all;
    }();
    return laws;
}

}  // namespace

const std::vector<std::string>& scale_law_names() {
    static const std::vector<std::string> kNames = [] {
        std::vector<std::string> names;
        for (const detail::LawText& law : detail::law_texts()) names.emplace_back(law.name);
        return names;
    }();
    return kNames;
}

std::optional<ScaleLaw> find_scale_law(std::string_view name) {
    const auto place = shipped_laws().find(name);
    if (place == shipped_laws().end()) return std::nullopt;
    ShippedLaw& shipped = place->second;
    std::call_once(shipped.is_read, [&] { shipped.law = parse_scale_law(shipped.json, fmt::format("law {}", name)); });
    return shipped.law;
}

ScaleLaw load_scale_law(const std::string& name_or_file) {
    if (auto law = find_scale_law(name_or_file)) return *std::move(law);
    const std::string obstacle = find_obstacle(name_or_file);
    std::error_code ignored;
    if (!obstacle.empty() && std::filesystem::exists(name_or_file, ignored)) {
        throw PiError(fmt::format("{}: is {}; name a law file", name_or_file, obstacle));
    }
    if (!obstacle.empty()) throw PiError(no_such_law(name_or_file) + ", or give a law file");
    const std::optional<std::string> text = read_regular_file(name_or_file);
    if (!text) throw PiError(name_or_file + ": cannot be read; check its permissions");
    return parse_scale_law(*text, name_or_file);
}

std::string no_such_law(std::string_view name) {
    return fmt::format("there is no law \"{}\"{}; choose one of {}", name, hint_at_name(name, scale_law_names()),
                       fmt::join(scale_law_names(), ", "));
}

}  // namespace musim::scaling
