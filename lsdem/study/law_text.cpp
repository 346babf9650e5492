#include "lsdem/study/law_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "lsdem/study/pair_text.hpp"
#include "scaling/factor_rounding.hpp"

namespace musim::lsdem {
namespace {

bool keeps(double factor) { return std::abs(factor - 1.0) <= scaling::kFactorRounding; }

/// "by law froude, as its base moves"
std::string name_law(const PairedRun& model) {
    const std::string& name = model.run.similitude.law_name();
    if (name == kNoLaw) return "by none of the laws mu, froude and cauchy, as its base moves";
    switch (model.law.source) {
        case LawSource::chosen:
            return "by law " + name;
        case LawSource::scene:
            return fmt::format("by law {}, as its scene says", name);
        case LawSource::measured:
            return fmt::format("by law {}, as its base moves", name);
        case LawSource::assumed:
            break;
    }
    return fmt::format("by law {}, which is assumed, since {}", name, model.law.why);
}

/// Where the base of a scene moves otherwise than the law asks for; else empty.
std::string describe_other_shaking(const PairedRun& model) {
    const scaling::Similitude& similitude = model.run.similitude;
    if (!model.law.shaking) return "";
    std::vector<std::string> parts;
    const auto add = [&](const char* what, const std::optional<double>& has, double asked) {
        if (has && std::abs(*has / asked - 1.0) > kMeasuredFactor) parts.push_back(fmt::format("{} x {:.4g}", what, *has));
    };
    const BaseShaking& shaking = *model.law.shaking;
    if (!shaking.time) {
        add("velocities", shaking.velocity, similitude.velocity());
        add("vertical velocities", shaking.velocity_vertical, similitude.velocity_vertical());
    } else {
        const auto over_time = [&](const std::optional<double>& velocity) {
            return velocity ? std::optional(*velocity / *shaking.time) : std::nullopt;
        };
        add("times", shaking.time, similitude.time());
        add("accelerations", over_time(shaking.velocity), similitude.acceleration());
        add("vertical accelerations", over_time(shaking.velocity_vertical), similitude.acceleration_vertical());
    }
    return parts.empty() ? "" : fmt::format("; its base moves at {} instead", join_words(parts));
}

/// "its specimen ..."
std::string describe_specimen(const PairedRun& model) {
    const scaling::Similitude& similitude = model.run.similitude;
    if (model.scene) return "";
    if (model.is_image) return "; it starts from the prototype's specimen";
    if (model.materials == Materials::own) return "; its blocks have the prototype's heights and settled anew";
    std::vector<std::string> reasons;
    if (!keeps(similitude.friction())) reasons.push_back(fmt::format("friction is {:.4g} times the prototype's", similitude.friction()));
    if (const double stiffer = similitude.acceleration() / similitude.gravity(); !keeps(stiffer)) {
        reasons.push_back(fmt::format("contacts are {:.4g} times as stiff for their weight", stiffer));
    }
    return "; its blocks have the prototype's heights and settled anew, " +
           (reasons.empty() ? std::string("as asked for") : "since " + join_words(reasons));
}

}  // namespace

std::string to_string(LawSource source) {
    constexpr const char* kNames[] = {"chosen", "scene", "measured", "assumed"};
    return kNames[static_cast<std::size_t>(source)];
}

std::string describe_law(const PairedRun& model) {
    const scaling::Similitude& similitude = model.run.similitude;
    if (model.scene && model.scene->same_structure) return "";
    if (model.is_image && similitude.law_name() == "exact") return "";
    std::string text = fmt::format("Model {} is shaken {}: times x {:.4g}, accelerations x {:.4g}", model.name(), name_law(model),
                                   similitude.time(), similitude.acceleration());
    if (!keeps(similitude.gravity())) text += fmt::format(", in gravity x {:.4g}", similitude.gravity());
    return text + describe_other_shaking(model) + describe_specimen(model) + ".";
}

}  // namespace musim::lsdem
