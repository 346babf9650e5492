#include "lsdem/report/report.hpp"

#include <fmt/format.h>

#include "lsdem/report/web_assets.hpp"

namespace musim::lsdem {

namespace {

bool shows_blocks(const ReportContent& content) { return !content.runs.empty() || !content.specimens.empty(); }

/// The blocks, and beside them where the page is wide what their motion comes to.
ReportSection make_motion_section(const ReportContent& content) {
    ReportSection section = make_tower_section(content);
    section.figures = make_ensemble_figures(content.ensembles);
    if (content.runs.empty()) return section;
    for (ReportFigure& figure : make_spine_figures(content)) section.figures.push_back(std::move(figure));
    return section;
}

std::string to_html(const ReportSection& section) {
    std::string figures;
    for (const ReportFigure& figure : section.figures) figures += to_html(figure);
    if (!figures.empty()) figures = "<div class=\"figures\">\n" + figures + "</div>\n";
    return fmt::format(
        "<section class=\"{}\" aria-labelledby=\"{}\">\n<h2 id=\"{}\">{}</h2>\n<div "
        "class=\"body\">\n<div>\n{}</div>\n{}</div>\n</section>\n",
        section.figures_beside ? "beside" : "below", section.id, section.id, escape_html(section.title), section.html, figures);
}

}  // namespace

std::vector<ReportSection> make_sections(const ReportContent& content) {
    std::vector<ReportSection> sections{make_verdict_section(content)};
    const bool has_runs = !content.runs.empty();
    if (shows_blocks(content)) sections.push_back(make_motion_section(content));
    if (content.kind == ReportKind::ensemble) sections.push_back(make_ensemble_section(content));
    if (content.kind == ReportKind::sequence) sections.push_back(make_sequence_section(content));
    if (has_runs && content.kind == ReportKind::pair) sections.push_back(make_scale_section(content));
    for (const ReportedDocument& document : content.documents) sections.push_back(make_document_section(document, sections.size()));
    if (!content.records.empty()) sections.push_back(make_record_section(content));
    if (!content.specimens.empty()) sections.push_back(make_specimen_section(content));
    if (!has_runs) return sections;
    for (ReportSection& section : make_run_sections(content.runs)) sections.push_back(std::move(section));
    if (std::optional<ReportSection> base = make_base_motion_section(content)) sections.push_back(std::move(*base));
    sections.push_back(make_overview_section(content));
    return sections;
}

std::string make_page(const ReportContent& content, const std::vector<ReportSection>& sections, const std::string& version) {
    const std::string title = escape_html(content.title);
    std::string page =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, "
        "initial-scale=1\">\n<meta name=\"color-scheme\" content=\"light dark\">\n";
    page += fmt::format(
        "<title>{}</title>\n<style>\n{}\n</style>\n</head>\n<body>\n<header><h1>{}</h1></header>\n<nav aria-label=\"sections\"><ul>\n",
        title, kReportStyle, title);
    for (const ReportSection& section : sections) {
        page += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section.id, escape_html(section.title));
    }
    page += "</ul></nav>\n<main>\n";
    for (const ReportSection& section : sections) page += to_html(section);
    page += fmt::format("</main>\n<footer><p>made by musim {}</p></footer>\n", escape_html(version));
    if (shows_blocks(content)) page += make_tower_scripts();
    return page + "<script>\n" + kReportScript + "\n</script>\n</body>\n</html>\n";
}

}  // namespace musim::lsdem
