#include "lsdem/report/pair_sections.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace musim::lsdem::report {
namespace {

Tone find_tone(const std::string& severity) {
    if (severity == "error") return Tone::bad;
    return severity == "warning" ? Tone::warning : Tone::note;
}

HtmlTable make_factor_table(const std::vector<ReportedRun>& runs) {
    HtmlTable table{.caption = "Factors of the models to their prototype", .heads = {"quantity"}, .rows = {}};
    std::set<std::string> names;
    std::vector<nlohmann::json> factors;
    for (const ReportedRun& run : runs) {
        const nlohmann::json similitude = run.summary.value("similitude", nlohmann::json::object());
        if (!similitude.contains("factors")) continue;
        table.heads.push_back(fmt::format("{} ({})", run.label, similitude.value("law", "")));
        factors.push_back(similitude["factors"]);
        for (const auto& [name, value] : factors.back().items()) names.insert(name);
    }
    for (const std::string& name : names) {
        std::vector<HtmlCell>& row = table.rows.emplace_back();
        row.push_back({.text = name});
        for (const nlohmann::json& of_model : factors) row.push_back(number_cell(of_model.value(name, std::nan("")), 6));
    }
    return table;
}

HtmlTable make_distortion_table(const nlohmann::json& pair) {
    HtmlTable table{.caption = "Groups that differ from the prototype's",
                    .heads = {"model", "group", "model over prototype", "how much it matters", "effect"},
                    .rows = {}};
    for (const nlohmann::json& model : pair.value("pairs", nlohmann::json::array())) {
        for (const nlohmann::json& distortion : model.value("distortions", nlohmann::json::array())) {
            const std::string severity = distortion.value("severity", "");
            table.rows.push_back({{.text = model.value("label", "")},
                                  {.text = distortion.value("group", "")},
                                  number_cell(distortion.value("factor", std::nan(""))),
                                  {.text = severity, .tone = find_tone(severity)},
                                  {.text = distortion.value("effect", "")}});
        }
    }
    return table;
}

HtmlTable make_alone_table(const nlohmann::json& pair) {
    HtmlTable table{.caption = "What each property of a model's own material does alone",
                    .heads = {"model", "property", "model over what is asked", "difference (rms)"},
                    .rows = {}};
    for (const nlohmann::json& model : pair.value("pairs", nlohmann::json::array())) {
        for (const nlohmann::json& lone : model.value("alone", nlohmann::json::array())) {
            table.rows.push_back({{.text = model.value("label", "")},
                                  {.text = lone.value("property", "")},
                                  number_cell(lone.value("factor", std::nan(""))),
                                  number_cell(lone.value("rms_relative_velocity_difference", std::nan("")))});
        }
    }
    return table;
}

}  // namespace

ReportSection make_scale_section(const ReportContent& content) {
    ReportSection section{.id = "scales", .title = "Scales and groups", .html = {}};
    const HtmlTable distortions = make_distortion_table(content.summary), alone = make_alone_table(content.summary);
    section.html = distortions.rows.empty() ? make_statement(Tone::good, "No group is distorted: every model is similar to the prototype")
                                            : to_html(distortions);
    if (!alone.rows.empty()) section.html += to_html(alone);
    section.html += "<details><summary>All factors</summary>\n" + to_html(make_factor_table(content.runs)) + "</details>\n";
    return section;
}

}  // namespace musim::lsdem::report
