#include "lsdem/study/pair_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>

#include "lsdem/study/law_text.hpp"
#include "lsdem/study/own_models.hpp"
#include "lsdem/study/step_error.hpp"

namespace musim::lsdem {

std::string format_percent(double part) {
    if (part < kRoundingLevel) return fmt::format("less than {:.0g} %", 100.0 * kRoundingLevel);
    return part < 1.0 ? fmt::format("{:.2g} %", 100.0 * part) : fmt::format("{:.0f} %", 100.0 * part);
}

std::string format_up_to(double part) { return (part < kRoundingLevel ? "" : "up to ") + format_percent(part); }

std::string format_range(const DifferenceRange& range) {
    if (range.largest() < kRoundingLevel) return format_percent(range.largest());
    const auto end = [](const char* sign, double part) { return part < kRoundingLevel ? "0 %" : sign + format_percent(part); };
    return fmt::format("{} to {}", end("-", -range.lowest), end("+", range.highest));
}

std::string join_words(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
    return text;
}

namespace {

std::vector<std::string> labels_of(const PairStudy& study, Agreement agreement) {
    std::vector<std::string> labels;
    for (const PairedRun& model : study.models) {
        if (model.materials == Materials::exact && model.judgement.agreement == agreement) labels.push_back(model.name());
    }
    return labels;
}

/// Why a model differs, or may.
std::string give_reason(const Judgement& judgement) {
    if (judgement.lead > kPartsInTime) {
        return fmt::format(
            "at {:.3g} s its velocities are farther from the prototype's than those of the twins by {:.1f} standard deviations",
            judgement.lead_time, judgement.lead);
    }
    const auto least = std::min_element(judgement.quantities.begin(), judgement.quantities.end(),
                                        [](const QuantityCheck& a, const QuantityCheck& b) { return a.probability < b.probability; });
    if (least == judgement.quantities.end() || judgement.least_probability >= kAgrees) return "it diverged";
    const std::string where = !least->name.empty() ? " of " + least->name
                              : least->level > 0   ? fmt::format(" of level {}", least->level)
                                                   : "";
    return fmt::format("{}{} is {} off, twins {} (probability {:.1g})", least->title, where, format_percent(least->difference),
                       format_up_to(least->twins.largest()), judgement.least_probability);
}

std::string describe_exact(const PairStudy& study) {
    const auto is_exact = [](const PairedRun& model) { return model.materials == Materials::exact; };
    const bool one = std::count_if(study.models.begin(), study.models.end(), is_exact) == 1;
    Agreement all = Agreement::agree;
    for (const PairedRun& model : study.models) {
        if (is_exact(model)) all = worst({all, model.judgement.agreement});
    }
    switch (all) {
        case Agreement::agree:
            return one ? "The model agrees with the prototype." : "The models agree with the prototype.";
        case Agreement::not_judged:
            return "Not judged: without twins there is no measure of what rounding does.";
        case Agreement::differ:
        case Agreement::undecided:
            break;
    }
    std::string text;
    for (const Agreement agreement : {Agreement::differ, Agreement::undecided}) {
        for (const PairedRun& model : study.models) {
            if (!is_exact(model) || model.judgement.agreement != agreement) continue;
            text += (text.empty() ? "" : " ") + std::string(agreement == Agreement::differ ? "" : "Undecided: ");
            text += fmt::format("Model {} {} from the prototype: {}.", model.name(),
                                agreement == Agreement::differ ? "DIFFERS" : "may differ", give_reason(model.judgement));
        }
    }
    const std::vector<std::string> agree = labels_of(study, Agreement::agree);
    if (!agree.empty()) text += fmt::format(" {} agree{}.", join_words(agree), agree.size() == 1 ? "s" : "");
    return text;
}

/// Nothing when the scaling is not at fault.
std::string describe_scaling(const PairStudy& study, const Yardstick& yardstick) {
    if (!study.same_bits.value_or(true)) {
        return "The program is not free of scale: the prototype's image at a quarter of its length does not agree in every bit.";
    }
    const std::optional<Yardstick::ImageLead> images = yardstick.lead_of_images();
    if (!images || images->agreement() == Agreement::agree) return "";
    return fmt::format(
        "{}he program is not free of scale: images of the prototype are farther from it than copies at its own scale by {:.1f} standard "
        "deviations, at {:.3g} s.",
        images->agreement() == Agreement::differ ? "T" : "Undecided: perhaps t", images->lead, images->time);
}

std::string describe_horizon(const PairStudy& study, const Yardstick& yardstick) {
    if (study.twins.empty()) return "";
    if (!yardstick.is_within_run()) {
        return fmt::format("Twins agree to {} to the end ({:.4g} s).", format_percent(kPartingLevel), yardstick.end());
    }
    return fmt::format(
        "Up to {:.3g} s of {:.4g} s twins agree to {}; beyond, rounding alone changes the motion of single blocks: no two runs agree in "
        "detail.",
        yardstick.horizon(), yardstick.end(), format_percent(kPartingLevel));
}

/// The model for which that differs most.
const QuantityCheck* find_farthest_top(const PairStudy& study, const std::string& key) {
    const QuantityCheck* farthest = nullptr;
    for (const PairedRun& model : study.models) {
        const QuantityCheck* top = model.materials == Materials::exact ? find_top(model.judgement.quantities, key) : nullptr;
        if (top != nullptr && (farthest == nullptr || top->difference > farthest->difference)) farthest = top;
    }
    return farthest;
}

std::string describe_quantities(const PairStudy& study) {
    std::vector<std::string> parts;
    for (const auto& [key, name] : kReportedQuantities) {
        const QuantityCheck* const check = find_farthest_top(study, key);
        if (check == nullptr) continue;
        std::string part = fmt::format("{} {}", name, format_percent(check->difference));
        if (!study.twins.empty()) part += fmt::format(" (twins: {})", format_up_to(check->twins.largest()));
        parts.push_back(std::move(part));
    }
    if (parts.empty()) return "";
    return "Farthest from the prototype: " + join_words(parts) + ".";
}

std::string describe_power(const PairStudy& study, const Yardstick& yardstick) {
    const std::optional<Yardstick::Seen> seen = yardstick.smallest_seen();
    if (!seen || !study.has(Materials::exact)) return "";
    return fmt::format("A difference of {:.1g} of the peak velocity would have been seen, at {:.3g} s.", seen->difference, seen->time);
}

}  // namespace

std::vector<std::string> describe_verdict(const PairStudy& study) {
    const Yardstick yardstick = study.yardstick();
    std::vector<std::string> lines;
    const auto add = [&](std::string line) {
        if (!line.empty()) lines.push_back(std::move(line));
    };
    const std::string scaling = describe_scaling(study, yardstick);
    const bool exact = study.has(Materials::exact) || study.models.empty();
    for (const PairedRun& model : study.models) {
        if (model.scene) add(model.scene->way);
    }
    add(scaling);
    if (scaling.empty()) {
        if (exact) add(describe_exact(study));
        for (const PairedRun& model : study.models) {
            if (model.materials == Materials::own || study.tolerance) add(describe_own(study, model));
        }
    }
    for (const PairedRun& model : study.models) {
        if (model.scene && model.scene->same_structure) add(model.scene->describe_differences());
    }
    for (const PairedRun& model : study.models) add(describe_law(model));
    add(describe_horizon(study, yardstick));
    if (exact) add(describe_quantities(study));
    // how exact the prototype's own run is no twin shows: they all have its step
    if (const std::optional<StepError> error = find_step_error(study)) add(describe(*error));
    add(describe_power(study, yardstick));
    const bool scaled = std::any_of(study.models.begin(), study.models.end(),
                                    [](const PairedRun& model) { return model.materials == Materials::exact && !model.scene; });
    if (scaled || study.models.empty()) {
        add("This checks the program and the law, not a model test: a real model has a stiffness, a friction and heights of its own, "
            "which a comparison with its own materials has, too.");
    }
    return lines;
}

}  // namespace musim::lsdem
