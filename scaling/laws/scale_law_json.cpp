#include "scaling/laws/scale_law_json.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scaling/detail/json_reading.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "scaling/number.hpp"
#include "scaling/shorten.hpp"

namespace musim::scaling {

namespace {

using detail::Json;
using detail::list_at;
using detail::text_at;

constexpr std::string_view kSchema = "musim-law/1";

void read_texts(const JsonReader& law, const std::string& key, std::string_view example, std::vector<std::string>& texts) {
    for (const JsonReader& entry : list_at(law, key, example)) {
        const Json& text = entry.json();
        if (!text.is_string()) {
            law.fail(fmt::format("/{}: {} is no text; write \"{}\": {}", key, shorten(text.dump(), kEchoed), key, example));
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

void read_quantities(const JsonReader& law, std::vector<LawQuantity>& quantities) {
    std::vector<std::string> own;
    for (const JsonReader& object : list_at(law, "quantities", R"([{"name": "l", "unit": "m", "meaning": "length"}, ...])")) {
        PiQuantity quantity = detail::parse_quantity_object(object, {"name", "unit", "meaning"});
        if (std::find(own.begin(), own.end(), quantity.name) != own.end()) {
            object.fail(fmt::format("\"{}\" is there twice; rename one", quantity.name));
        }
        own.push_back(quantity.name);
        LawQuantity read{.quantity = std::move(quantity), .unit = text_at(object, "unit", ""), .meaning = {}};
        if (object.json().contains("meaning")) read.meaning = text_at(object, "meaning", "\"length\"");
        const auto same = std::find_if(quantities.begin(), quantities.end(),
                                       [&](const LawQuantity& other) { return other.quantity.name == read.quantity.name; });
        if (same == quantities.end()) {
            quantities.push_back(std::move(read));
        } else {
            *same = std::move(read);
        }
    }
}

void require_object(const JsonReader& value, std::string_view example, const std::vector<std::string>& known) {
    if (!value.json().is_object()) value.fail(fmt::format("not an object; write {}", example));
    value.object(known);
}

void read_choices(const JsonReader& law, std::vector<LawChoice>& choices) {
    for (const JsonReader& object : list_at(law, "chosen", R"([{"name": "l"}, {"name": "g", "default": 1}])")) {
        require_object(object, R"({"name": "g", "default": 1})", {"name", "default"});
        LawChoice choice{.name = text_at(object, "name", "\"g\""), .fallback = std::nullopt};
        try {
            if (object.json().contains("default")) choice.fallback = parse_number(detail::number_text_at(object, "default"));
        } catch (const ParseError& error) {
            object.fail(error.what());
        }
        choices.push_back(std::move(choice));
    }
}

void read_additions(const JsonReader& law, std::vector<LawAddition>& additions) {
    constexpr std::string_view kExample = R"({"name": "m_added", "total": "m", "own": "m_s"})";
    for (const JsonReader& object : list_at(law, "additions", fmt::format("[{}]", kExample))) {
        require_object(object, kExample, {"name", "meaning", "total", "own"});
        LawAddition addition{.name = text_at(object, "name", "\"m_added\""),
                             .meaning = {},
                             .total = text_at(object, "total", "\"m\""),
                             .own = text_at(object, "own", "\"m_s\"")};
        if (object.json().contains("meaning")) addition.meaning = text_at(object, "meaning", "\"mass to add\"");
        additions.push_back(std::move(addition));
    }
}

/// Takes definitions out that an extended law has and the extending one does without.
void release(const JsonReader& law, std::vector<std::string>& definitions) {
    std::vector<std::string> released;
    read_texts(law, "released", R"(["a_v/g"])", released);
    for (const std::string& text : released) {
        const auto place = std::find(definitions.begin(), definitions.end(), text);
        if (place == definitions.end()) {
            law.fail(fmt::format("/released: \"{}\" is no definition of the law that this one extends; take one of {}", text,
                                 fmt::join(definitions, ", ")));
        }
        definitions.erase(place);
    }
}

/// The law that another extends, without what it chooses; an empty one when it extends none.
ScaleLaw find_base(const JsonReader& law) {
    if (!law.json().contains("extends")) return {};
    const std::string name = text_at(law, "extends", "\"mechanics\"");
    auto base = find_scale_law(name);
    if (!base) law.fail(fmt::format("/extends: {}", no_such_law(name)));
    base->choices.clear();
    return *std::move(base);
}

}  // namespace

ScaleLaw parse_scale_law(std::string_view text, std::string_view origin) {
    const std::string file(origin);
    const Json document = detail::parse_json(text, file);
    const bool is_wrapped = document.is_object() && !document.contains("schema") && document.contains("law");
    const Json& json = is_wrapped ? document["law"] : document;
    if (!json.is_object() || !json.contains("schema") || json["schema"] != kSchema) {
        throw PiError(fmt::format("{}: is no law; add \"schema\": \"{}\"", origin, kSchema));
    }
    const detail::PiRules rules;
    const JsonReader object = JsonReader(json, rules, file)
                                  .object({"schema", "name", "title", "description", "extends", "sources", "assumptions", "quantities",
                                           "chosen", "released", "definitions", "held", "watched", "additions"});
    ScaleLaw law = find_base(object);
    law.name = text_at(object, "name", "\"my_law\"");
    law.title = text_at(object, "title", "\"what governs, in a line\"");
    if (law.name.empty()) object.fail("\"name\" is empty; give the law a name");
    law.description = json.contains("description") ? text_at(object, "description", "\"what it keeps\"") : "";
    std::vector<std::string> own_sources;
    read_texts(object, "sources", R"(["MoncarzKrawinkler81"])", own_sources);
    add_sources(own_sources, law.sources);
    read_texts(object, "assumptions", R"(["rigid blocks"])", law.assumptions);
    read_quantities(object, law.quantities);
    read_choices(object, law.choices);
    release(object, law.definitions);
    read_texts(object, "definitions", R"(["v*t/l"])", law.definitions);
    read_texts(object, "held", R"-(["v/sqrt(g*l)"])-", law.held);
    read_texts(object, "watched", R"-(["E/(rho*g*l)"])-", law.watched);
    read_additions(object, law.additions);
    try {
        check_law(law);
    } catch (const PiError& error) {
        object.fail(error.what());
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
