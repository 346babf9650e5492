#include "lsdem/report/several_sections.hpp"

#include <fmt/format.h>

#include <cmath>

namespace musim::lsdem::report {
namespace {

/// A number of an object that may be null or missing.
HtmlCell find_cell(const nlohmann::json& object, const char* key, int digits = 4) {
    const auto found = object.find(key);
    return number_cell(found != object.end() && found->is_number() ? found->get<double>() : std::nan(""), digits);
}

Tone find_status_tone(const std::string& status) {
    if (status == "completed") return Tone::good;
    return status == "collapsed" ? Tone::warning : Tone::bad;
}

}  // namespace

ReportSection make_sequence_section(const ReportContent& content) {
    HtmlTable table{.caption = "Stages",
                    .heads = {"stage", "status", "base v [m/s]", "base a [m/s²]", "damage of the stage", "since the first start",
                              "blocks fallen", "collapsed at [s]"},
                    .rows = {}};
    for (const nlohmann::json& stage : content.summary.value("stages", nlohmann::json::array())) {
        const std::string status = stage.value("status", "");
        table.rows.push_back({{.text = stage.value("name", "")},
                              {.text = status, .tone = find_status_tone(status)},
                              find_cell(stage, "peak_base_velocity_m_s"),
                              find_cell(stage, "peak_base_acceleration_m_s2"),
                              find_cell(stage.value("since_stage_start", nlohmann::json::object()), "damage_index"),
                              find_cell(stage.value("since_first_start", nlohmann::json::object()), "damage_index"),
                              find_cell(stage, "fallen_blocks", 9),
                              find_cell(stage, "collapse_time_s")});
    }
    return {.id = "stages", .title = "One motion after another", .html = to_html(table)};
}

ReportSection make_ensemble_section(const ReportContent& content) {
    HtmlTable table{
        .caption = "Members",
        .heads = {"member", "seed", "status", "damage index", "blocks fallen", "peak velocity of the top [m/s]", "why it is no result"},
        .rows = {}};
    for (const nlohmann::json& member : content.summary.value("members", nlohmann::json::array())) {
        const std::string status = member.value("status", "");
        table.rows.push_back({{.text = member.value("name", "")},
                              find_cell(member, "seed", 9),
                              {.text = status, .tone = find_status_tone(status)},
                              find_cell(member, "damage_index"),
                              find_cell(member, "fallen_blocks", 9),
                              find_cell(member, "top_peak_velocity_m_s"),
                              {.text = member.value("reason", "")}});
    }
    ReportSection section{.id = "members", .title = "Members", .html = to_html(table)};
    if (!content.picture.empty()) {
        section.figures.push_back({.name = "bands",
                                   .title = "Spine velocities: mean and mean ± standard deviation over the members",
                                   .svg = content.picture,
                                   .csv = {},
                                   .twin = {.caption = "Numbers of the bands are in ensemble.csv", .heads = {}, .rows = {}}});
    }
    return section;
}

}  // namespace musim::lsdem::report
