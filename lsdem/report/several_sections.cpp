#include "lsdem/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
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

HtmlTable make_member_table(const ReportedEnsemble& ensemble) {
    HtmlTable table{
        .caption = "Members of " + ensemble.label,
        .heads = {"member", "seed", "status", "damage index", "blocks fallen", "peak velocity of the top [m/s]", "why it is no result"}};
    for (const nlohmann::json& member : find_list(ensemble.summary, "members")) {
        const std::string status = find_text(member, "status");
        table.rows.push_back({{.text = find_text(member, "name")},
                              number_cell(find_number(member, "seed"), 9),
                              {.text = status, .tone = find_tone(status, Tone::bad)},
                              number_cell(find_number(member, "damage_index")),
                              number_cell(find_number(member, "fallen_blocks"), 9),
                              number_cell(find_number(member, "top_peak_velocity_m_s")),
                              {.text = find_text(member, "reason")}});
    }
    const bool has_reasons = std::any_of(table.rows.begin(), table.rows.end(), [](const auto& row) { return !row.back().text.empty(); });
    if (has_reasons) return table;
    table.heads.pop_back();
    for (std::vector<HtmlCell>& row : table.rows) row.pop_back();
    return table;
}

/// Share of the others' means that lie in the first one's band.
HtmlTable make_overlap_table(const std::vector<DimensionlessBands>& bands) {
    HtmlTable table{.caption = fmt::format("Agreement with {}, dimensionless", bands.front().name),
                    .heads = {"ensemble", "levels and times", "means within mean ± sd [%]", "within two standard errors [%]", "why not"}};
    for (std::size_t i = 1; i < bands.size(); ++i) {
        try {
            const BandOverlap overlap = compare_bands(bands.front(), bands[i]);
            table.rows.push_back({{.text = bands[i].name},
                                  number_cell(static_cast<double>(overlap.points), 9),
                                  number_cell(100.0 * overlap.within_sd),
                                  number_cell(100.0 * overlap.within_error),
                                  {}});
        } catch (const ResultError& error) {
            table.rows.push_back({{.text = bands[i].name}, {.text = "-"}, {.text = "-"}, {.text = "-"}, {.text = error.what()}});
        }
    }
    return table;
}

/// Bands of the ensembles that have some, by their labels.
std::vector<DimensionlessBands> name_bands(const std::vector<ReportedEnsemble>& ensembles) {
    std::vector<DimensionlessBands> bands;
    for (const ReportedEnsemble& ensemble : ensembles) {
        if (!ensemble.bands) continue;
        bands.push_back(*ensemble.bands);
        bands.back().name = ensemble.label;
    }
    return bands;
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

ReportSection make_sequence_section(const ReportContent& content) {
    HtmlTable table{.caption = "Stages",
                    .heads = {"stage", "status", "base v [m/s]", "base a [m/s²]", "damage of the stage", "since the first start",
                              "blocks fallen", "collapsed at [s]"}};
    for (const nlohmann::json& stage : find_list(content.summary, "stages")) {
        const std::string status = find_text(stage, "status");
        table.rows.push_back({{.text = find_text(stage, "name")},
                              {.text = status, .tone = find_tone(status, Tone::bad)},
                              number_cell(find_number(stage, "peak_base_velocity_m_s")),
                              number_cell(find_number(stage, "peak_base_acceleration_m_s2")),
                              number_cell(find_number(find_object(stage, "since_stage_start"), "damage_index")),
                              number_cell(find_number(find_object(stage, "since_first_start"), "damage_index")),
                              number_cell(find_number(stage, "fallen_blocks"), 9),
                              number_cell(find_number(stage, "collapse_time_s"))});
    }
    std::string html = to_html(table);
    for (const nlohmann::json& stage : find_list(content.summary, "stages")) {
        const std::string pga = find_text(stage, "pga");
        if (!pga.empty()) html += make_statement(Tone::note, fmt::format("{} {}", find_text(stage, "folder"), pga));
    }
    return {.id = "stages", .title = "One motion after another", .html = std::move(html)};
}

ReportSection make_ensemble_section(const ReportContent& content) {
    ReportSection section{.id = "members", .title = "Members"};
    for (const ReportedEnsemble& ensemble : content.ensembles) section.html += to_html(make_member_table(ensemble));
    const std::vector<DimensionlessBands> bands = name_bands(content.ensembles);
    if (bands.size() > 1) section.html += to_html(make_overlap_table(bands));
    return section;
}

std::vector<ReportFigure> make_ensemble_figures(const std::vector<ReportedEnsemble>& ensembles) {
    const std::vector<DimensionlessBands> bands = name_bands(ensembles);
    if (bands.empty()) return {};
    return {make_figure("bands", make_bands_plot(bands))};
}

}  // namespace musim::lsdem
