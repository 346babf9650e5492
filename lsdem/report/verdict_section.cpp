#include "lsdem/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lsdem/report/json_parts.hpp"
#include "lsdem/results/fallen_blocks.hpp"
#include "scaling/angle.hpp"

namespace musim::lsdem {
namespace {

/// Energy that appears from nowhere beyond this share of what is in play is doubtful; runs call themselves so from a tenth on.
constexpr double kGoodClosure = 0.01;

/// So few statements stand below the headline; more of them, if neither warnings nor bad, are folded.
constexpr std::size_t kMostUnfolded = 2;

std::string describe_status(const ReportedRun& run) {
    if (run.run.status == RunStatus::diverged) return "diverged: " + run.run.divergence;
    if (!run.run.is_status_known) return "how it ended is not known";
    if (run.run.collapse_time) return fmt::format("collapsed at {:.4g} s", *run.run.collapse_time);
    return "ran to its end";
}

void add_run(std::vector<Statement>& statements, const ReportedRun& run) {
    std::string text = run.label + ": " + describe_status(run);
    if (run.response) {
        const Damage& damage = run.response->damage;
        text += fmt::format("; {} of {} blocks fallen, damage index {:.3g}", damage.fallen, damage.blocks, damage.index);
        if (run.response->failure) text += "; " + describe(*run.response->failure);
    }
    const double closure = find_number(run.summary, "energy_closure");
    const std::string balance = fmt::format("energy balance closes to {:.2g} of the energy in play", closure);
    if (closure < kGoodClosure) text += "; " + balance;
    statements.push_back({run.run.is_status_known ? find_tone(to_string(run.run.status), Tone::bad) : Tone::note, text});
    if (closure >= kGoodClosure) statements.push_back({Tone::warning, run.label + ": " + balance});
    for (const std::string& warning : run.run.warnings) statements.push_back({Tone::warning, run.label + ": " + warning});
}

/// What the headline leaves out of a pair's verdict, and how each model stands to the prototype.
void add_pair(std::vector<Statement>& statements, const nlohmann::json& pair) {
    std::size_t sentence = 0;
    for (const nlohmann::json& line : find_list(pair, "verdict")) {
        if (line.is_string() && ++sentence > 2) statements.push_back({Tone::note, line.get<std::string>()});
    }
    for (const nlohmann::json& model : find_list(pair, "pairs")) {
        const std::string label = find_text(model, "label", "model");
        if (find_flag(model, "bitwise_identical")) {
            statements.push_back({Tone::good, label + ": the same as the prototype, bit for bit"});
        } else if (find_text(model, "materials") == "own") {
            statements.push_back(
                {Tone::warning,
                 fmt::format(
                     "{}: made of its own material and distorted; velocities of the spine differ by {:.3g} of the prototype's (rms)", label,
                     find_number(model, "rms_relative_velocity_difference"))});
        }
    }
}

void add_specimen(std::vector<Statement>& statements, const ReportedSpecimen& reported) {
    const StoredSpecimen& specimen = reported.specimen;
    const double largest = specimen.tilt.empty() ? 0.0 : *std::max_element(specimen.tilt.begin(), specimen.tilt.end());
    const std::size_t fallen = count_fallen(specimen.size, specimen.layer, specimen.places);
    const std::string what = fmt::format("{}: {} blocks prepared, at rest", reported.label, specimen.layer.size());
    if (fallen > 0) {
        statements.push_back({Tone::warning, fmt::format("{}, but {} of them fell from their layers", what, fallen)});
    } else {
        statements.push_back({Tone::good, fmt::format("{}; the largest tilt is {:.3g}°", what, largest / scaling::kDegree)});
    }
}

std::string to_html(const std::vector<Statement>& statements) {
    std::string html;
    for (const Statement& statement : statements) html += make_statement(statement.tone, statement.text);
    return html;
}

}  // namespace

ReportSection make_verdict_section(const ReportContent& content) {
    std::vector<Statement> statements;
    if (content.kind == ReportKind::pair) add_pair(statements, content.summary);
    for (const ReportedRun& run : content.runs) add_run(statements, run);
    for (const ReportedSpecimen& specimen : content.specimens) add_specimen(statements, specimen);
    for (const ReportedRecord& record : content.records) {
        statements.push_back({Tone::good, fmt::format("{}: read as {}, {} components ({})", record.label, record.motion.format,
                                                      record.motion.components.size(), record.motion.component_names())});
    }

    ReportSection section{.id = "verdict", .title = "Verdict"};
    for (const Statement& headline : make_headlines(content)) section.html += make_statement(headline.tone, headline.text, true);
    const auto calm = std::stable_partition(statements.begin(), statements.end(), [](const Statement& statement) {
        return statement.tone == Tone::warning || statement.tone == Tone::bad;
    });
    section.html += to_html({statements.begin(), calm});
    for (const ReportedDocument& document : content.documents) section.html += make_document_verdict(document);
    for (const std::string& remark : content.remarks) section.html += make_statement(Tone::note, remark);
    const std::vector<Statement> rest(calm, statements.end());
    const bool folds = rest.size() > kMostUnfolded && !content.runs.empty();
    section.html +=
        folds ? fmt::format("<details><summary>How each run ended ({} statements)</summary>\n{}</details>\n", rest.size(), to_html(rest))
              : to_html(rest);
    return section;
}

}  // namespace musim::lsdem
