#include "lsdem/report/report.hpp"

#include <fmt/format.h>

#include "lsdem/report/document_sections.hpp"
#include "lsdem/report/pair_sections.hpp"
#include "lsdem/report/record_sections.hpp"
#include "lsdem/report/run_sections.hpp"
#include "lsdem/report/several_sections.hpp"
#include "lsdem/report/specimen_sections.hpp"
#include "lsdem/report/tower_section.hpp"
#include "lsdem/report/web_assets.hpp"

namespace musim::lsdem {

namespace {

bool shows_blocks(const ReportContent& content) { return !content.runs.empty() || !content.specimens.empty(); }

}  // namespace

std::vector<ReportSection> make_sections(const ReportContent& content) {
    std::vector<ReportSection> sections{make_verdict_section(content)};
    if (content.kind == ReportKind::ensemble) sections.push_back(make_ensemble_section(content));
    if (content.kind == ReportKind::sequence) sections.push_back(make_sequence_section(content));
    if (!content.runs.empty()) sections.push_back(make_overview_section(content));
    if (!content.runs.empty() && content.kind == ReportKind::pair) sections.push_back(make_scale_section(content));
    for (const ReportedDocument& document : content.documents) sections.push_back(make_document_section(document, sections.size()));
    if (!content.records.empty()) sections.push_back(make_record_section(content));
    if (std::optional<ReportSection> base = make_base_motion_section(content)) sections.push_back(std::move(*base));
    if (!content.specimens.empty()) sections.push_back(make_specimen_section(content));
    if (shows_blocks(content)) sections.push_back(make_tower_section(content));
    if (content.runs.empty()) return sections;
    for (ReportSection& section : make_run_sections(content)) sections.push_back(std::move(section));
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
    for (const ReportSection& section : sections) {
        page += fmt::format("<section aria-labelledby=\"{0}\">\n<h2 id=\"{0}\">{1}</h2>\n{2}", section.id, escape_html(section.title),
                            section.html);
        for (const ReportFigure& figure : section.figures) page += to_html(figure);
        page += "</section>\n";
    }
    page += fmt::format("</main>\n<footer><p>made by musim {}</p></footer>\n", escape_html(version));
    if (shows_blocks(content)) page += make_tower_scripts();
    return page + "<script>\n" + kReportScript + "\n</script>\n</body>\n</html>\n";
}

}  // namespace musim::lsdem
