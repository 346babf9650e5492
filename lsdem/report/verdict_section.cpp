#include "lsdem/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lsdem/report/json_parts.hpp"
#include "scaling/angle.hpp"
#include "scaling/quantity_text.hpp"

namespace musim::lsdem {
namespace {

std::string write_length(double metres) { return scaling::format_quantity(scaling::Length::from_value(metres), 3); }

std::string count_blocks(double fallen, double blocks) { return fmt::format("{:.0f} of {:.0f} blocks fell", fallen, blocks); }

/// The first two sentences of the verdict: do the models agree, and until when or how far.
Statement make_pair_headline(const nlohmann::json& pair) {
    const std::string agreement = find_text(pair, "agreement");
    Statement headline{.tone = agreement == "agree" ? Tone::good : agreement == "differ" ? Tone::bad : Tone::warning, .text = {}};
    for (const nlohmann::json& line : find_list(pair, "verdict")) {
        if (!line.is_string()) continue;
        const bool is_first = headline.text.empty();
        headline.text += (is_first ? "" : " ") + line.get<std::string>();
        if (!is_first) break;
    }
    return headline;
}

Statement make_sequence_headline(const nlohmann::json& sequence) {
    const nlohmann::json stages = find_list(sequence, "stages"), last = stages.empty() ? nlohmann::json::object() : stages.back();
    const double motions = find_number(sequence, "motions", static_cast<double>(stages.size()));
    const double damage = find_number(find_object(last, "since_first_start"), "damage_index");
    const std::string after = std::isfinite(damage) ? fmt::format("; damage index {:.3g} since the first start", damage) : "";
    const nlohmann::json collapse = find_object(sequence, "collapse");
    if (!collapse.empty()) {
        return {Tone::warning,
                fmt::format("The structure collapsed in motion {:.0f} of {:.0f} ({}), {:.3g} s after its start: {:.0f} blocks fell{}.",
                            find_number(collapse, "stage"), motions, find_text(collapse, "name", "unnamed"),
                            find_number(collapse, "time_s"), find_number(last, "fallen_blocks", 0.0), after)};
    }
    const std::string status = find_text(sequence, "status", "unknown");
    if (status != "completed") return {Tone::bad, fmt::format("The sequence did not end as planned: its status is \"{}\".", status)};
    const double fallen = find_number(last, "fallen_blocks", 0.0);
    const std::string falls = fallen > 0.0 ? fmt::format("; {:.0f} blocks fell", fallen) : "";
    return {fallen > 0.0 ? Tone::warning : Tone::good,
            fmt::format("The structure stands after {} of {:.0f} motions{}{}.", stages.size(), motions, falls, after)};
}

Statement make_ensemble_headline(const ReportedEnsemble& ensemble) {
    const nlohmann::json members = find_list(ensemble.summary, "members");
    std::size_t completed = 0, collapsed = 0;
    for (const nlohmann::json& member : members) {
        const std::string status = find_text(member, "status", "failed");
        completed += status == "completed" ? 1 : 0;
        collapsed += status == "collapsed" ? 1 : 0;
    }
    const std::size_t failed = members.size() - completed - collapsed;
    std::string text = fmt::format("{}: {} of {} members stand, {} collapsed", ensemble.label, completed, members.size(), collapsed);
    if (failed > 0) text += fmt::format(", {} without a result", failed);
    const nlohmann::json damage = find_object(ensemble.summary, "damage_index");
    const double mean = find_number(damage, "mean"), sd = find_number(damage, "sd");
    if (std::isfinite(mean)) text += fmt::format("; damage index {:.3g}", mean);
    if (std::isfinite(sd)) text += fmt::format(" ± {:.2g} (standard deviation)", sd);
    return {failed > 0 || members.empty() ? Tone::bad : collapsed > 0 ? Tone::warning : Tone::good, text + "."};
}

/// Displacement of the top against the base in words, at the scale of the run; empty when it was not kept.
std::string describe_top(const ReportedRun& run) {
    const nlohmann::json top = find_object(find_object(run.summary, "outcome"), "top");
    const double peak = find_number(top, "peak_displacement_m"), residual = find_number(top, "residual_displacement_m");
    if (!std::isfinite(peak) || !std::isfinite(residual)) return {};
    const bool moves = top.value("moves_at_end", false);
    return fmt::format("; largest displacement of the top relative to the base {}, {} {}", write_length(peak),
                       moves ? "at the end, where it still moves," : "residual", write_length(residual));
}

Statement make_run_headline(const ReportedRun& run) {
    if (run.run.status == RunStatus::diverged) {
        return {Tone::bad, "The run diverged, its results are not to be used: " + run.run.divergence};
    }
    if (!run.run.is_status_known) return {Tone::note, "How the run ended is not known."};
    const nlohmann::json outcome = find_object(run.summary, "outcome");
    const double blocks = find_number(outcome, "blocks"), fallen = find_number(outcome, "fallen");
    const std::string falls = std::isfinite(blocks) && std::isfinite(fallen) ? ": " + count_blocks(fallen, blocks) : "";
    if (run.run.collapsed_before()) {
        return {Tone::bad, fmt::format("The structure does not stand as drawn, and was not shaken{}.", falls)};
    }
    if (run.run.collapse_time) {
        return {Tone::warning, fmt::format("The structure collapsed at {:.4g} s{}.", *run.run.collapse_time, falls)};
    }
    return {fallen > 0.0 ? Tone::warning : Tone::good, fmt::format("The structure stands{}{}.", falls, describe_top(run))};
}

Statement make_runs_headline(const std::vector<ReportedRun>& runs) {
    std::size_t stand = 0;
    std::string others;
    Tone tone = Tone::good;
    for (const ReportedRun& run : runs) {
        const RunStatus status = run.run.status;
        if (run.run.is_status_known && status == RunStatus::completed) {
            ++stand;
            const double fallen = find_number(find_object(run.summary, "outcome"), "fallen", 0.0);
            if (!(fallen > 0.0)) continue;
            tone = std::max(tone, Tone::warning);
            others += fmt::format("{} {} lost {:.0f} blocks", others.empty() ? ";" : ",", run.label, fallen);
            continue;
        }
        tone = std::max(tone, status == RunStatus::diverged ? Tone::bad : Tone::warning);
        const char* how = !run.run.is_status_known ? "has no known end" : status == RunStatus::diverged ? "diverged" : "collapsed";
        others += fmt::format("{} {} {}", others.empty() ? ";" : ",", run.label, how);
    }
    return {tone, fmt::format("{} of {} structures stand{}.", stand, runs.size(), others)};
}

/// So few statements stand below the headline; more of them, if neither warnings nor bad, are folded.
constexpr std::size_t kMostUnfolded = 2;

std::string describe_status(const ReportedRun& run) {
    if (run.run.status == RunStatus::diverged) return "diverged: " + run.run.divergence;
    if (!run.run.is_status_known) return "how it ended is not known";
    if (run.run.collapsed_before()) return "collapsed while it was prepared; its motion was not run";
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
    // where it is open, the run says so in its warnings
    const double closure = find_number(run.summary, "energy_closure");
    if (std::isfinite(closure)) text += fmt::format("; energy balance closes to {:.2g} of the energy in play", closure);
    statements.push_back({run.run.is_status_known ? find_tone(to_string(run.run.status), Tone::bad) : Tone::note, text});
    for (const std::string& warning : run.run.warnings) statements.push_back({Tone::warning, run.label + ": " + warning});
}

/// Rest of a pair's verdict, which the headline leaves out, and the relation of each model to the prototype.
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
    const std::size_t fallen = specimen.fallen.value_or(0);
    const std::string what = fmt::format("{}: {} blocks prepared, at rest", reported.label, specimen.layer.size());
    if (fallen > 0) {
        statements.push_back({Tone::warning, fmt::format("{}, but {} of them fell meanwhile", what, fallen)});
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

std::vector<Statement> make_headlines(const ReportContent& content) {
    std::vector<Statement> headlines;
    switch (content.kind) {
        case ReportKind::pair:
            headlines.push_back(make_pair_headline(content.summary));
            break;
        case ReportKind::sequence:
            headlines.push_back(make_sequence_headline(content.summary));
            break;
        case ReportKind::ensemble:
            for (const ReportedEnsemble& ensemble : content.ensembles) headlines.push_back(make_ensemble_headline(ensemble));
            break;
        case ReportKind::run:
        case ReportKind::runs:
            if (content.runs.size() == 1) headlines.push_back(make_run_headline(content.runs.front()));
            if (content.runs.size() > 1) headlines.push_back(make_runs_headline(content.runs));
            break;
        case ReportKind::nothing:
            break;
    }
    std::erase_if(headlines, [](const Statement& headline) { return headline.text.empty(); });
    return headlines;
}

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
