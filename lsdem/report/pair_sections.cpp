#include "lsdem/report/report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "lsdem/report/json_parts.hpp"

namespace musim::lsdem {
namespace {

HtmlTable make_factor_table(const std::vector<ReportedRun>& runs) {
    HtmlTable table{.caption = "Factors of the models to their prototype", .heads = {"quantity"}};
    std::set<std::string> names;
    std::vector<nlohmann::json> factors;
    for (const ReportedRun& run : runs) {
        const nlohmann::json similitude = find_object(run.summary, "similitude");
        nlohmann::json of_model = find_object(similitude, "factors");
        if (of_model.empty()) continue;
        table.heads.push_back(fmt::format("{} ({})", run.label, find_text(similitude, "law")));
        factors.push_back(std::move(of_model));
        for (const auto& [name, value] : factors.back().items()) names.insert(name);
    }
    for (const std::string& name : names) {
        std::vector<HtmlCell>& row = table.rows.emplace_back();
        row.push_back({.text = name});
        for (const nlohmann::json& of_model : factors) row.push_back(number_cell(find_number(of_model, name), 6));
    }
    return table;
}

HtmlTable make_distortion_table(const nlohmann::json& pair) {
    HtmlTable table{.caption = "Groups that differ from the prototype's",
                    .heads = {"model", "group", "model over prototype", "how much it matters", "effect"}};
    for (const nlohmann::json& model : find_list(pair, "pairs")) {
        for (const nlohmann::json& distortion : find_list(model, "distortions")) {
            const std::string severity = find_text(distortion, "severity");
            table.rows.push_back({{.text = find_text(model, "label")},
                                  {.text = find_text(distortion, "group")},
                                  number_cell(find_number(distortion, "factor")),
                                  {.text = severity, .tone = find_tone(severity, Tone::note)},
                                  {.text = find_text(distortion, "effect")}});
        }
    }
    return table;
}

HtmlTable make_alone_table(const nlohmann::json& pair) {
    HtmlTable table{.caption = "What each property of a model's own material does alone",
                    .heads = {"model", "property", "model over what is asked", "difference (rms)"}};
    for (const nlohmann::json& model : find_list(pair, "pairs")) {
        for (const nlohmann::json& lone : find_list(model, "alone")) {
            table.rows.push_back({{.text = find_text(model, "label")},
                                  {.text = find_text(lone, "property")},
                                  number_cell(find_number(lone, "factor")),
                                  number_cell(find_number(lone, "rms_relative_velocity_difference"))});
        }
    }
    return table;
}

}  // namespace

ReportSection make_scale_section(const ReportContent& content) {
    ReportSection section{.id = "scales", .title = "Scales and groups"};
    const HtmlTable distortions = make_distortion_table(content.summary), alone = make_alone_table(content.summary);
    section.html = distortions.rows.empty() ? make_statement(Tone::good, "No group is distorted: every model is similar to the prototype")
                                            : to_html(distortions);
    if (!alone.rows.empty()) section.html += to_html(alone);
    section.html += "<details><summary>All factors</summary>\n" + to_html(make_factor_table(content.runs)) + "</details>\n";
    return section;
}

}  // namespace musim::lsdem
