#include "cli/records/design_uncertainty_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "cli/scaling/uncertainty_output.hpp"
#include "scaling/json_optional.hpp"
#include "scaling/laws/length_range.hpp"
#include "scaling/uncertainty/propagate.hpp"

namespace musim::cli {
namespace {

using End = std::optional<scaling::FirstOrder>;

std::string describe_end_interval(const End& end) {
    if (!end || end->relative == 0.0) return "-";
    const scaling::CoverageInterval interval = scaling::find_interval(*end);
    return fmt::format("{} to {}", scaling::describe_scale(interval.lower), scaling::describe_scale(interval.upper));
}

nlohmann::json end_to_json(const End& end, const std::vector<scaling::UncertainInput>& inputs) {
    return end ? cli::to_json(*end, inputs) : nlohmann::json();
}

/// Median and coverage interval of a length scale.
std::vector<std::string> describe_scales(const scaling::SampleSummary& scales) {
    if (scales.given == 0) return {"-", "-"};
    return {scaling::describe_scale(scales.median),
            fmt::format("{} to {}", scaling::describe_scale(scales.lower), scaling::describe_scale(scales.upper))};
}

nlohmann::json scales_to_json(const scaling::SampleSummary& scales) {
    return scales.given == 0 ? nlohmann::json() : cli::to_json(scales, 1.0);
}

}  // namespace

scaling::TextTable make_ends_table(const std::vector<records::Candidate>& candidates, const DesignUncertainty& uncertainty) {
    scaling::TextTable table{{"material", "law", "end", "governing limit", "length scale", "u/value", coverage_title(), "mostly by"}};
    for (std::size_t c = 0; c < candidates.size(); ++c) {
        const records::Candidate& candidate = candidates[c];
        const auto add = [&](const char* name, const End& end, const std::string& limit) {
            if (!end) return;
            table.rows.push_back({candidate.material.name, candidate.law.name(), name, limit, scaling::describe_scale(end->value),
                                  format_share(end->relative), describe_end_interval(end), describe_main_input(*end, uncertainty.inputs)});
        };
        for (std::size_t i = 0; i < candidate.ranges.size(); ++i) {
            add("smallest", uncertainty.candidates[c].ranges[i].smallest, candidate.ranges[i].binds_below);
            add("largest", uncertainty.candidates[c].ranges[i].largest, candidate.ranges[i].binds_above);
        }
    }
    return table;
}

scaling::TextTable make_sampled_ends_table(const std::vector<records::Candidate>& candidates, const records::SampledDesign& samples) {
    scaling::TextTable table{{"material", "law", "feasible in", "smallest: median", coverage_title(), "largest: median", coverage_title()}};
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const records::SampledCandidate& sampled = samples.candidates[i];
        std::vector<std::string> row{candidates[i].material.name, candidates[i].law.name(), format_share(sampled.feasible)};
        for (const std::string& cell : describe_scales(sampled.smallest)) row.push_back(cell);
        for (const std::string& cell : describe_scales(sampled.largest)) row.push_back(cell);
        table.rows.push_back(row);
    }
    return table;
}

scaling::TextTable make_sampled_limits_table(const std::vector<records::Candidate>& candidates, const records::SampledDesign& samples) {
    scaling::TextTable table{{"material", "law", "limit", "smaller: governs in", "larger: governs in", "too much in", "at"}};
    for (std::size_t c = 0; c < candidates.size(); ++c) {
        const records::SampledCandidate& sampled = samples.candidates[c];
        for (std::size_t i = 0; i < sampled.limits.size(); ++i) {
            const records::SampledLimit& limit = sampled.limits[i];
            if (limit.sets_smallest == 0.0 && limit.sets_largest == 0.0 && limit.broken.value_or(0.0) == 0.0) continue;
            table.rows.push_back({candidates[c].material.name, candidates[c].law.name(), candidates[c].limits[i].limit,
                                  format_share(limit.sets_smallest), format_share(limit.sets_largest),
                                  format_share(limit.broken.value_or(0.0)),
                                  sampled.length ? scaling::describe_scale(*sampled.length) : "-"});
        }
    }
    return table;
}

nlohmann::json to_json(const records::Candidate& candidate, const records::SampledCandidate& sampled) {
    nlohmann::json limits = nlohmann::json::array();
    for (std::size_t i = 0; i < sampled.limits.size(); ++i) {
        const records::SampledLimit& limit = sampled.limits[i];
        limits.push_back({{"limit", candidate.limits[i].limit},
                          {"sets_smallest_share", limit.sets_smallest},
                          {"sets_largest_share", limit.sets_largest},
                          {"broken_share", scaling::or_null(limit.broken)}});
    }
    return {{"feasible_share", sampled.feasible},
            {"smallest", scales_to_json(sampled.smallest)},
            {"largest", scales_to_json(sampled.largest)},
            {"length", scaling::or_null(sampled.length)},
            {"limits", limits}};
}

std::string describe_ends(const std::vector<records::UncertainRange>& ranges) {
    std::string text;
    const auto is_certain = [](const records::UncertainRange& range) {
        return describe_end_interval(range.smallest) == "-" && describe_end_interval(range.largest) == "-";
    };
    if (std::all_of(ranges.begin(), ranges.end(), is_certain)) return "-";
    for (const records::UncertainRange& range : ranges) {
        text += fmt::format("{}{} ... {}", text.empty() ? "" : ", ", describe_end_interval(range.smallest),
                            describe_end_interval(range.largest));
    }
    return text;
}

void add_intervals(scaling::TextTable& table, const std::vector<scaling::FirstOrder>& results) {
    table.header.push_back(coverage_title());
    for (std::size_t i = 0; i < results.size(); ++i) table.rows[i].push_back(describe_interval(results[i]));
}

nlohmann::json to_json(const records::UncertainRange& range, const std::vector<scaling::UncertainInput>& inputs) {
    return {{"smallest", end_to_json(range.smallest, inputs)}, {"largest", end_to_json(range.largest, inputs)}};
}

nlohmann::json to_json(const records::ModelState& state, const records::UncertainState& uncertain,
                       const std::vector<scaling::UncertainInput>& inputs) {
    nlohmann::json groups = nlohmann::json::object(), factors = nlohmann::json::object(), used = nlohmann::json::array();
    for (std::size_t i = 0; i < state.groups.size(); ++i) groups[state.groups[i].name] = cli::to_json(uncertain.groups[i], inputs);
    for (std::size_t i = 0; i < std::size(scaling::kModelScales); ++i) {
        factors[std::string(scaling::kModelScales[i].name)] = cli::to_json(uncertain.scales[i], inputs);
    }
    for (const scaling::FirstOrder& share : uncertain.used) used.push_back(cli::to_json(share, inputs));
    return {{"groups", groups},
            {"factors", factors},
            {"used", used},
            {"mass_kg", cli::to_json(uncertain.mass, inputs)},
            {"cost", end_to_json(uncertain.cost, inputs)}};
}

}  // namespace musim::cli
