#include "scaling/scale_law_json.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scaling/detail/json_reading.hpp"
#include "scaling/number.hpp"
#include "scaling/scale_law_catalogue.hpp"
#include "scaling/shorten.hpp"

namespace musim::scaling {

namespace {

using detail::Json;

constexpr std::string_view kSchema = "musim-law/1";

/// The list at a key; an empty one when the key is not there.
const Json& list_at(const Json& law, const char* key, std::string_view origin, std::string_view example) {
    static const Json kEmpty = Json::array();
    if (!law.contains(key)) return kEmpty;
    if (!law[key].is_array()) detail::fail_at(origin, fmt::format("\"{}\" is no list; write \"{}\": {}", key, key, example));
    return law[key];
}

void read_texts(const Json& law, const char* key, std::string_view origin, std::string_view example, std::vector<std::string>& texts) {
    for (const Json& text : list_at(law, key, origin, example)) {
        if (!text.is_string()) {
            detail::fail_at(origin, fmt::format("/{}: {} is no text; write \"{}\": {}", key, shorten(text.dump(), kEchoed), key, example));
        }
        texts.push_back(text.get<std::string>());
    }
}

/// A source that a law shares with the one it extends is one.
void add_sources(const std::vector<std::string>& own, std::vector<std::string>& sources) {
    for (const std::string& source : own) {
        if (std::find(sources.begin(), sources.end(), source) == sources.end()) sources.push_back(source);
    }
}

void read_quantities(const Json& law, std::string_view origin, std::vector<LawQuantity>& quantities) {
    std::vector<std::string> own;
    for (const Json& object : list_at(law, "quantities", origin, R"([{"name": "l", "unit": "m", "meaning": "length"}, ...])")) {
        const std::string where = fmt::format("{}: /quantities/{}", origin, own.size());
        PiQuantity quantity = detail::parse_quantity_object(object, where, {"name", "unit", "meaning"});
        if (std::find(own.begin(), own.end(), quantity.name) != own.end()) {
            detail::fail_at(where, fmt::format("\"{}\" is there twice; rename one", quantity.name));
        }
        own.push_back(quantity.name);
        LawQuantity read{.quantity = std::move(quantity), .unit = object["unit"].get<std::string>(), .meaning = {}};
        if (object.contains("meaning")) read.meaning = detail::text_at(object, "meaning", where, "\"length\"");
        const auto same = std::find_if(quantities.begin(), quantities.end(),
                                       [&](const LawQuantity& other) { return other.quantity.name == read.quantity.name; });
        if (same == quantities.end()) {
            quantities.push_back(std::move(read));
        } else {
            *same = std::move(read);
        }
    }
}

void read_choices(const Json& law, std::string_view origin, std::vector<LawChoice>& choices) {
    for (const Json& object : list_at(law, "chosen", origin, R"([{"name": "l"}, {"name": "g", "default": 1}])")) {
        const std::string where = fmt::format("{}: /chosen/{}", origin, choices.size());
        if (!object.is_object()) detail::fail_at(where, R"(not an object; write {"name": "g", "default": 1})");
        detail::refuse_unknown_keys(object, {"name", "default"}, where);
        LawChoice choice{.name = detail::text_at(object, "name", where, "\"g\""), .fallback = std::nullopt};
        try {
            if (object.contains("default")) choice.fallback = parse_number(detail::number_text_at(object, "default", where));
        } catch (const ParseError& error) {
            detail::fail_at(where, error.what());
        }
        choices.push_back(std::move(choice));
    }
}

void read_additions(const Json& law, std::string_view origin, std::vector<LawAddition>& additions) {
    for (const Json& object : list_at(law, "additions", origin, R"([{"name": "m_added", "total": "m", "own": "m_s"}])")) {
        const std::string where = fmt::format("{}: /additions/{}", origin, additions.size());
        if (!object.is_object()) detail::fail_at(where, R"(not an object; write {"name": "m_added", "total": "m", "own": "m_s"})");
        detail::refuse_unknown_keys(object, {"name", "meaning", "total", "own"}, where);
        LawAddition addition{.name = detail::text_at(object, "name", where, "\"m_added\""),
                             .meaning = {},
                             .total = detail::text_at(object, "total", where, "\"m\""),
                             .own = detail::text_at(object, "own", where, "\"m_s\"")};
        if (object.contains("meaning")) addition.meaning = detail::text_at(object, "meaning", where, "\"mass to add\"");
        additions.push_back(std::move(addition));
    }
}

/// Takes definitions out that an extended law has and the extending one does without.
void release(const Json& law, std::string_view origin, std::vector<std::string>& definitions) {
    std::vector<std::string> released;
    read_texts(law, "released", origin, R"(["a_v/g"])", released);
    for (const std::string& text : released) {
        const auto place = std::find(definitions.begin(), definitions.end(), text);
        if (place == definitions.end()) {
            detail::fail_at(origin, fmt::format("/released: \"{}\" is no definition of the law that this one extends; take one of {}", text,
                                                fmt::join(definitions, ", ")));
        }
        definitions.erase(place);
    }
}

/// The law that another extends, without what it chooses; an empty one when it extends none.
ScaleLaw find_base(const Json& law, std::string_view origin) {
    if (!law.contains("extends")) return {};
    const std::string& name = detail::text_at(law, "extends", origin, "\"mechanics\"");
    auto base = find_scale_law(name);
    if (!base) detail::fail_at(origin, fmt::format("/extends: {}", no_such_law(name)));
    base->choices.clear();
    return *std::move(base);
}

}  // namespace

ScaleLaw parse_scale_law(std::string_view text, std::string_view origin) {
    const Json document = detail::parse_json(text, origin);
    const bool is_wrapped = document.is_object() && !document.contains("schema") && document.contains("law");
    const Json& object = is_wrapped ? document["law"] : document;
    if (!object.is_object() || !object.contains("schema") || object["schema"] != kSchema) {
        detail::fail_at(origin, fmt::format("is no law; add \"schema\": \"{}\"", kSchema));
    }
    detail::refuse_unknown_keys(object,
                                {"schema", "name", "title", "description", "extends", "sources", "assumptions", "quantities", "chosen",
                                 "released", "definitions", "held", "watched", "additions"},
                                origin);
    ScaleLaw law = find_base(object, origin);
    law.name = detail::text_at(object, "name", origin, "\"my_law\"");
    law.title = detail::text_at(object, "title", origin, "\"what governs, in a line\"");
    if (law.name.empty()) detail::fail_at(origin, "\"name\" is empty; give the law a name");
    law.description = object.contains("description") ? detail::text_at(object, "description", origin, "\"what it keeps\"") : "";
    std::vector<std::string> own_sources;
    read_texts(object, "sources", origin, R"(["MoncarzKrawinkler81"])", own_sources);
    add_sources(own_sources, law.sources);
    read_texts(object, "assumptions", origin, R"(["rigid blocks"])", law.assumptions);
    read_quantities(object, origin, law.quantities);
    read_choices(object, origin, law.choices);
    release(object, origin, law.definitions);
    read_texts(object, "definitions", origin, R"(["v*t/l"])", law.definitions);
    read_texts(object, "held", origin, R"-(["v/sqrt(g*l)"])-", law.held);
    read_texts(object, "watched", origin, R"-(["E/(rho*g*l)"])-", law.watched);
    read_additions(object, origin, law.additions);
    try {
        check_law(law);
    } catch (const PiError& error) {
        detail::fail_at(origin, error.what());
    }
    return law;
}

std::string write_scale_law(const ScaleLaw& law) {
    nlohmann::ordered_json object{{"schema", kSchema},
                                  {"name", law.name},
                                  {"title", law.title},
                                  {"description", law.description},
                                  {"sources", law.sources},
                                  {"assumptions", law.assumptions},
                                  {"quantities", Json::array()},
                                  {"chosen", Json::array()},
                                  {"definitions", law.definitions},
                                  {"held", law.held},
                                  {"watched", law.watched},
                                  {"additions", Json::array()}};
    for (const LawQuantity& quantity : law.quantities) {
        object["quantities"].push_back({{"name", quantity.quantity.name}, {"unit", quantity.unit}, {"meaning", quantity.meaning}});
    }
    for (const LawChoice& choice : law.choices) {
        object["chosen"].push_back({{"name", choice.name}});
        if (choice.fallback) object["chosen"].back()["default"] = *choice.fallback;
    }
    for (const LawAddition& addition : law.additions) {
        object["additions"].push_back(
            {{"name", addition.name}, {"meaning", addition.meaning}, {"total", addition.total}, {"own", addition.own}});
    }
    return object.dump(2) + "\n";
}

}  // namespace musim::scaling
