#include "records/design/detail/law_fields.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "scaling/laws/scale_law_catalogue.hpp"

namespace musim::records::detail {
namespace {

/// A law by name, or from a file beside the one that names it.
scaling::ScaleLaw load_law(const std::string& name, const std::string& source) {
    if (const auto shipped = scaling::find_scale_law(name)) return *shipped;
    const std::filesystem::path beside = std::filesystem::path(source).parent_path() / name;
    return scaling::load_scale_law(std::filesystem::exists(beside) ? beside.string() : name);
}

DesignLaw read_law_object(const JsonReader& fields, const std::string& source) {
    scaling::ScaleLaw law = load_law(require_text(fields, "law"), source);
    if (fields.has("hold")) {
        for (const std::string& product : read_names(fields, "hold", R"-(["F_R/(mu*m*g)"])-")) law.held.push_back(product);
    }
    std::vector<scaling::GivenFactor> set;
    if (fields.has("set")) {
        const JsonReader factors = fields["set"];
        if (!factors.json().is_object()) fields.fail("set is no object", R"(write {"F_R": "1/500"}, a factor by the quantity's name)");
        for (const auto& [quantity, value] : factors.json().items()) {
            set.push_back({quantity, require_positive<scaling::Ratio>(factors, quantity).value()});
        }
    }
    fields.refuse_unknown_keys();
    return {std::move(law), std::move(set)};
}

}  // namespace

DesignLaw read_law(const JsonReader& value, const std::string& source) {
    try {
        if (value.json().is_object()) return read_law_object(value, source);
        return load_law(value.text(), source);
    } catch (const scaling::SimilitudeError& error) {
        value.fail(error.what());
    }
}

}  // namespace musim::records::detail
